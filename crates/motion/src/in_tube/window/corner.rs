//! The sides of a piece that the corners at the ends of its run ask for: see [`super::run_corners`].

use super::solver::dot;

/// Cosines of how much a run may have turned from its corner, 60° and 75°: up to the first its border is next to it,
/// beyond the second the inner side of the corner is not that of the run. Between them the border goes out of the
/// tube little by little. Where it ended at once, a motion at the feed that goes over to the inner side of an arc was
/// refused for a sample that the judge took to be in front of that end and the rows behind it, and slowed down.
const LEAVING_CORNER_COS: f64 = 0.5;
const STILL_OF_CORNER_COS: f64 = 0.258_819_045_102_520_74;
/// Share of a run, or of a rest of an axis, on both sides of its middle in which neither end is the nearer one:
/// where the sides of both ends are opposite ones, the motion goes over there.
const MIDDLE: f64 = 0.08;

/// The side of a piece that a corner asks for.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerSide<const D: usize> {
    /// A point of the piece.
    pub(super) at: [f64; D],
    /// The direction to the inner side.
    pub(super) inner: [f64; D],
    /// How far outside of the piece the border is, at the start of the piece and at its end.
    pub(super) beyond: [f64; 2],
    /// The direction to the inner side of the other run, next to the corner.
    pub(super) other: Option<[f64; D]>,
}

/// The corners at both ends of the run that a piece is of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RunCorners<const D: usize> {
    pub(super) sides: [Option<CornerSide<D>>; 2],
    /// Where the run begins and ends, as far as it is seen: progress.
    pub(super) run: [f64; 2],
}

/// A corner: unit vectors along the path before and after it, and its progress.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex<const D: usize> {
    pub(super) along: [[f64; D]; 2],
    pub(super) s: f64,
}

/// True if a progress is about the middle of a way.
pub(super) fn is_middle(progress: f64, [from, to]: [f64; 2]) -> bool {
    (progress - 0.5 * (from + to)).abs() < MIDDLE * (to - from)
}

impl<const D: usize> RunCorners<D> {
    pub(super) const NONE: Self = Self {
        sides: [None; 2],
        run: [0.0; 2],
    };

    /// Gives the sides on which the motion is to be at a progress, each with a direction to the inner side: those
    /// of the nearer corner; none where the motion goes over from the side of one to that of the other.
    pub(super) fn inner_sides(
        &self,
        progress: f64,
        mut give: impl FnMut(&CornerSide<D>, &[f64; D]),
    ) {
        if let [Some(start), Some(end)] = &self.sides
            && is_middle(progress, self.run)
            && dot(&start.inner, &end.inner) < 0.0
        {
            return;
        }
        let is_late = progress - self.run[0] > self.run[1] - progress;
        if let Some(side) = &self.sides[usize::from(is_late)] {
            give(side, &side.inner);
            if let Some(other) = &side.other {
                give(side, other);
            }
        }
    }
}

impl<const D: usize> Vertex<D> {
    /// How far the border of a run has left it, of 1, where its direction is a unit vector: see
    /// [`LEAVING_CORNER_COS`].
    pub(super) fn left_r(&self, along: &[f64; D], is_after: bool) -> f64 {
        let turned = dot(along, &self.along[usize::from(is_after)]);
        let left_r = (LEAVING_CORNER_COS - turned) / (LEAVING_CORNER_COS - STILL_OF_CORNER_COS);
        left_r.clamp(0.0, 1.0)
    }

    /// The direction to the inner side of a piece along a unit vector, before or after it; none where it has
    /// turned too far.
    pub(super) fn inner(&self, along: &[f64; D], is_after: bool) -> Option<[f64; D]> {
        let [before, after] = &self.along;
        let at_corner = if is_after { after } else { before };
        if dot(along, at_corner) < STILL_OF_CORNER_COS {
            return None;
        }
        let across = |vector: &[f64; D], along: &[f64; D]| -> [f64; D] {
            let part = dot(vector, along);
            core::array::from_fn(|k| vector[k] - part * along[k])
        };
        // First the inner side at the corner. Taken across the run at once, it would change over where a run that
        // bends on has turned by a right angle less half of the corner.
        let turned: [f64; D] = core::array::from_fn(|k| after[k] - before[k]);
        let across = across(&across(&turned, at_corner), along);
        let size = dot(&across, &across).sqrt();
        Some(across.map(|value| value / size))
    }
}
