//! The speed at which the chords of periods stay near a curve.
//!
//! What is handed out is the polyline through the positions at the periods. On a curve of curvature κ, driven at v,
//! its chords are v²·T²·κ/8 high. Windows plan with positions, and learn what chords cut off from one motion to the
//! next ([`super::window`]); where that comes near the tolerance there is little room left in which a motion is to be
//! found, so the speed on pieces of a curve is bounded in advance.

/// Share of the tolerance that the chord of a period may be away from a curve. Without a bound windows found no motion
/// at tolerances of some micrometres, and the motion stopped at the vertices of an arc; with .7, .85 and 1 in its place
/// arcs of 1 to 10 mm took up to 1 % longer.
const CHORD_R: f64 = 0.8;
/// Radius of a curve, in tolerances, from which on its own curvature counts: a smaller one is cut so much that the
/// motion bends less than it does. With a bound there, small letters and teeth of .15 mm took .6 to .8 % longer.
const LEAST_RADIUS_R: f64 = 50.0;

/// The speed on a piece of a curve, mm/s, from the length of the piece, how high the curve is over it and the
/// tolerance, all in mm, and the period. The height over a chord grows with the square of its length.
pub(super) fn chord_speed(
    length_mm: f64,
    (sagitta_mm, tolerance_mm): (f64, f64),
    period_t: f64,
) -> f64 {
    if length_mm * length_mm <= 8.0 * sagitta_mm * LEAST_RADIUS_R * tolerance_mm
        || sagitta_mm <= 0.0
    {
        return f64::INFINITY;
    }
    length_mm * (CHORD_R * tolerance_mm / sagitta_mm).sqrt() / period_t
}

#[cfg(test)]
mod tests {
    use super::chord_speed;

    #[test]
    fn the_chord_of_a_period_is_as_high_as_its_share_of_the_tolerance() {
        let (radius_mm, period_t, tolerance_mm) = (3.0_f64, 0.004, 0.001);
        let height_mm =
            |length_mm: f64| radius_mm - (radius_mm.powi(2) - length_mm.powi(2) / 4.0).sqrt();
        let length_mm = 0.04;
        let speed_v = chord_speed(length_mm, (height_mm(length_mm), tolerance_mm), period_t);
        let height_r = height_mm(speed_v * period_t) / tolerance_mm;
        assert!((height_r - 0.8).abs() < 1e-3, "{height_r}");
        // A line, and an arc of 30 tolerances.
        assert!(chord_speed(length_mm, (0.0, tolerance_mm), period_t).is_infinite());
        assert!(chord_speed(length_mm, (height_mm(length_mm), 0.1), period_t).is_infinite());
    }
}
