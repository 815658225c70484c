//! The jerk that a curve has at the feed.
//!
//! Where the motion is at the feed jerk is dear ([`super::tube::JERK_AT_FEED`]), and that of a circle is no fault of the
//! motion: with a price on all of it, small circles would become larger, and slower where they end. So the price there
//! counts from what the curve asks for.
//!
//! On a curve of curvature κ jerk at a speed v is −v³·κ² along it, but for what κ changes. A piece of length L stands
//! for a curve whose middle is s beside it: κ = 8·s/L².

use super::solver::{Problem, dot};
use super::tube::Layout;

/// Takes the jerk of the curve out of the price of jerk in the first knot intervals.
pub(crate) fn add<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    intervals: usize,
) {
    let (path, samples, grid) = (layout.path, layout.samples, &layout.style.grid);
    for k in 0..intervals {
        // The sample in the middle of the interval, or before it where there are several knots in a period.
        let at = ((2 * k + 1) * grid.periods / (2 * grid.knots)).min(samples.count());
        let segment = &path.segments[samples.piece[at]];
        let u = ((samples.progress[at] - segment.s) / segment.length).clamp(0.0, 1.0);
        let chord = (&segment.tangent, segment.length);
        if let Some(jerk) = on_chord(chord, &segment.sagitta_vector, u, segment.top) {
            problem.aim_jerk(k, &jerk.map(|part| part * grid.knot_t.powi(3)));
        }
    }
}

/// The jerk at a speed, `u` of the way along a chord of a curve; none on a line.
fn on_chord<const D: usize>(
    (tangent, length): (&[f64; D], f64),
    sagitta_vector: &[f64; D],
    u: f64,
    speed_v: f64,
) -> Option<[f64; D]> {
    let sagitta = dot(sagitta_vector, sagitta_vector).sqrt();
    if sagitta <= 0.0 {
        return None;
    }
    // The direction of the parabola there.
    let slope = 4.0 * (1.0 - 2.0 * u) / length;
    let along: [f64; D] = core::array::from_fn(|a| tangent[a] + slope * sagitta_vector[a]);
    let curvature = 8.0 * sagitta / (length * length);
    let jerk = -speed_v.powi(3) * curvature * curvature / dot(&along, &along).sqrt();
    Some(along.map(|part| jerk * part))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against differences of positions on the circle itself.
    #[test]
    fn the_jerk_of_a_chord_is_that_of_its_circle() {
        let (radius, half_rad, speed_v) = (1.3_f64, 0.04_f64, 25.0);
        // A chord across the bottom of a circle about the origin, from left to right.
        let length = 2.0 * radius * half_rad.sin();
        let sagitta = [0.0, -radius * (1.0 - half_rad.cos())];
        for u in [0.0, 0.2, 0.5, 0.9] {
            let told = on_chord((&[1.0, 0.0], length), &sagitta, u, speed_v).unwrap();
            let middle_rad = (2.0 * u - 1.0) * half_rad;
            let t = 1e-3;
            let place = |steps: f64| {
                let turned_rad = middle_rad + steps * speed_v * t / radius;
                [radius * turned_rad.sin(), -radius * turned_rad.cos()]
            };
            let places = [1.5, 0.5, -0.5, -1.5].map(place);
            for a in 0..2 {
                let [p, q, r, s] = places.map(|place| place[a]);
                let jerk = (p - 3.0 * q + 3.0 * r - s) / (t * t * t);
                let most = 0.01 * speed_v.powi(3) / (radius * radius);
                assert!((told[a] - jerk).abs() < most, "{u} {a}: {} {jerk}", told[a]);
            }
        }
        assert!(on_chord((&[1.0, 0.0], length), &[0.0, 0.0], 0.5, speed_v).is_none());
    }
}
