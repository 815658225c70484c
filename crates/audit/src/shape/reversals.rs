//! The count of reversals of each axis, in a motion and in a program.

use glidepath_geometry::{AXES, Arc, AxisVector, Segment};

/// An axis has turned once it has come back by this much, mm or degrees: less is lost in any drive.
pub const HYSTERESIS_MM: f64 = 2e-3;
/// Points of a piece of another curve.
const CURVE_POINTS: u32 = 8;

/// The reversals of all axes.
#[derive(Debug, Default)]
pub(super) struct Reversals {
    axes: Option<[Axis; AXES]>,
    pub(super) counts: [u64; AXES],
}

/// Where an axis has come furthest, and in which direction, 0 before it moves.
#[derive(Debug, Clone, Copy, Default)]
struct Axis {
    furthest: f64,
    sign: f64,
}

impl Reversals {
    pub(super) fn next(&mut self, position: &AxisVector) {
        let Some(axes) = &mut self.axes else {
            let begin = |i: usize| Axis {
                furthest: position[i],
                sign: 0.0,
            };
            self.axes = Some(core::array::from_fn(begin));
            return;
        };
        for (i, axis) in axes.iter_mut().enumerate() {
            let way = position[i] - axis.furthest;
            if way * axis.sign > 0.0 {
                axis.furthest = position[i];
            } else if way.abs() > HYSTERESIS_MM {
                self.counts[i] += u64::from(axis.sign != 0.0);
                (axis.furthest, axis.sign) = (position[i], way.signum());
            }
        }
    }
}

/// Points of a segment between which no axis turns round by more than the rounding of a curve.
pub(super) fn waypoints(segment: &Segment, mut point: impl FnMut(&AxisVector)) {
    point(&segment.start());
    match segment {
        Segment::Line(_) => {}
        Segment::Arc(arc) => quadrants(arc, &mut point),
        Segment::Curve(curve) => {
            for k in 1..CURVE_POINTS {
                let s = curve.length * f64::from(k) / f64::from(CURVE_POINTS);
                point(&curve.jet(s).position);
            }
        }
    }
    point(&segment.end());
}

/// The points of an arc in which an axis of its plane turns round.
fn quadrants(arc: &Arc, point: &mut impl FnMut(&AxisVector)) {
    const QUARTER: f64 = core::f64::consts::FRAC_PI_2;
    let (first, second) = arc.plane.axes();
    let from = |axis: usize, center: f64| arc.start[axis] - center;
    let start_rad = from(second.index(), arc.center[1]).atan2(from(first.index(), arc.center[0]));
    let (per_rad, sign) = (arc.length() / arc.sweep_rad.abs(), arc.sweep_rad.signum());
    // Way to the first quadrant, then a quarter of a turn each.
    let begun = (sign * start_rad).rem_euclid(QUARTER);
    let mut way_rad = QUARTER - begun;
    while way_rad < arc.sweep_rad.abs() {
        point(&arc.jet(way_rad * per_rad).position);
        way_rad += QUARTER;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::Plane;

    fn count(points: &[f64]) -> u64 {
        let mut reversals = Reversals::default();
        for x in points {
            reversals.next(&(AxisVector::x() * *x));
        }
        reversals.counts[0]
    }

    #[test]
    fn less_than_the_hysteresis_is_no_reversal() {
        assert_eq!(count(&[0.0, 1.0, 2.0]), 0);
        assert_eq!(count(&[0.0, 1.0, 0.999, 2.0]), 0);
        assert_eq!(count(&[0.0, 1.0, 0.997, 2.0]), 2);
        // In small steps, too.
        let back: Vec<f64> = (0..10).map(|k| 1.0 - 5e-4 * f64::from(k)).collect();
        assert_eq!(count(&[&[0.0][..], &back].concat()), 1);
        assert_eq!(count(&[0.0, 0.001, -0.001, 0.001]), 0);
    }

    #[test]
    fn a_turn_has_two_reversals_of_each_axis_whatever_its_direction() {
        for sweep_turns in [1.0, -1.0, 3.0] {
            let mut start = AxisVector::zeros();
            (start[0], start[1]) = (3.0, 4.0);
            let arc = Arc {
                start,
                end: start,
                plane: Plane::Xy,
                center: [0.0, 0.0],
                sweep_rad: core::f64::consts::TAU * sweep_turns,
            };
            let mut reversals = Reversals::default();
            waypoints(&Segment::Arc(arc), |point| reversals.next(point));
            let wanted = if sweep_turns > 1.0 { 6 } else { 2 };
            assert_eq!(reversals.counts[..3], [wanted, wanted, 0], "{sweep_turns}");
        }
    }
}
