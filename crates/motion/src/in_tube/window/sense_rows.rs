//! Rows that keep axes from turning round where the program does not.
//!
//! Where an axis rests next to a stop, or is slow, its control points rise or fall with the program. Else
//! the motion would dip into the inner side after each corner and come back, each time through the
//! backlash of the drive.

use super::scaled_path::ScaledPath;
use super::sides::TURNING_R;
use super::solver::Problem;
use super::travel_rows::NOWHERE;
use super::tube::Layout;
use crate::in_tube::path::WORTH_R;

/// How slow an axis is, in radii a knot, where it might turn round. An axis that is faster than that in one
/// round and turns round in the next gets its row one round late.
const SLOW_R: f64 = 0.25;
/// What a row counts as one, in radii a knot: going back a tenth of the radius costs as much as leaving the
/// tube by all of it.
const BACK_R: f64 = 0.1;

/// Adds rows to the last site, which is first difference `k` of the control points.
pub(super) fn add<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>, k: usize) {
    let (path, points) = (layout.path, layout.points);
    let place = DifferencePlace::of(layout, k);
    let segment = &path.segments[place.piece];
    let radius = segment.radius;
    for (axis, sides) in segment.sides.axes.iter().enumerate() {
        let sense = sides.sense(place.progress, radius, place.way);
        let step = sense * (points[k + 1][axis] - points[k][axis]);
        let is_slow = sides.is_rest || step < SLOW_R * radius;
        if sense == 0.0 || !is_slow || problem.is_given((k, &[1.0, 1.0, 0.0, 0.0]), axis) {
            continue;
        }
        if !sides.is_rest && place.is_on_a_bend(path, axis, sense) {
            continue;
        }
        let at = f64::midpoint(points[k][axis], points[k + 1][axis]);
        if !sides.is_rest && segment.has_to_come_back(place.progress, (axis, at), sense) {
            continue;
        }
        // Beyond the end of a run that is none: it came so from the inner side of the corner before, and has to come back
        // to be on that of the next one.
        let is_worth = (sides.to - sides.from).abs() >= WORTH_R * radius;
        if !sides.is_rest && !is_worth && sense * (at - sides.to) > 0.0 {
            continue;
        }
        let mut normal = [0.0; D];
        normal[axis] = sense / (BACK_R * radius);
        // An axis that rests in the last motion, as all do in the tail's rest, may be fast in the next one:
        // `FAR` would be 25 mm/s at a tolerance of 1 µm and knots of 4 ms.
        problem.add_row(normal, &[0.0; D], [0.0, NOWHERE]);
    }
}

/// Where a first difference of the control points is, in the middle of a knot interval.
struct DifferencePlace {
    piece: usize,
    progress: f64,
    /// The way in the interval.
    way: f64,
}

impl DifferencePlace {
    fn of<const D: usize>(layout: &Layout<'_, D>, k: usize) -> Self {
        let (grid, samples) = (&layout.style.grid, layout.samples);
        let halves = (2 * k - 1) * grid.periods;
        let before = (halves / (2 * grid.knots)).min(samples.count() - 1);
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let (share, knots) = (
            (halves as f64 / (2 * grid.knots) as f64 - before as f64).min(1.0),
            grid.periods as f64 / grid.knots as f64,
        );
        let [from, to] = [before, before + 1].map(|k| samples.progress[k]);
        let progress = from + share * (to - from);
        let segments = &layout.path.segments;
        let mut piece = samples.piece[before];
        while piece > 0 && progress < segments[piece].s {
            piece -= 1;
        }
        while piece + 1 < segments.len() && progress >= segments[piece + 1].s {
            piece += 1;
        }
        Self {
            piece,
            progress,
            way: knots * (to - from),
        }
    }

    /// True if the program itself turns round here, along a curve: the motion need not do so at the same
    /// place to the bit, and would tremble if it had to. A piece has the sense of its ends: up to where the curve
    /// that it stands for turns round, that goes the other way.
    fn is_on_a_bend<const D: usize>(&self, path: &ScaledPath<D>, axis: usize, sense: f64) -> bool {
        let radius = path.segments[self.piece].radius;
        let reach = (TURNING_R * radius).max(self.way);
        [-reach, reach]
            .iter()
            .any(|shift| sense * path.heading(self.piece, self.progress + shift)[axis] < 0.0)
    }
}
