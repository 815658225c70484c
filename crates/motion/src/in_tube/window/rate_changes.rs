//! The change of the rate in a wide tube.
//!
//! ```text
//!     rapid ─────────●╌╌╌ ┊         The faster piece is the motion's as far as that is as near as the
//!         samples  ·  ╲ ┊           slower one ([`crate::in_tube::verify`]): up to the plane half-way
//!                   ·  ╲            between both. In a narrow tube there is nothing between that and the
//!                    · ┊│ feed      tolerance. In a wide one a sample on the faster piece could be far
//!                      ┊▼           into the slower one, and no such motion passes.
//! ```

use super::scaled_path::{SLOWER, ScaledPath};
use super::solver::{Problem, dot};

/// From how many times what a rate may be off the radius is wide: in a narrower tube the windows are found
/// all the same, and more of them.
const WIDE_R: f64 = 3.0;
/// Share of what the judge allows that is used.
const KEEP_R: f64 = 0.8;
/// One more than the cosine of the turn up to which two pieces have a half-way between them: a path that
/// folds back is as near to the one as to the other.
const LEAST_HALF_WAY: f64 = 0.05;
/// How near to the corner a sample is to need a row, in radii.
const NEAR_R: f64 = 4.0;

/// Which of two pieces is the faster one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Faster {
    Before,
    After,
}

impl<const D: usize> ScaledPath<D> {
    /// True if another rate begins after piece `i`, in a tube that is wide beside what that may be off.
    pub(super) fn changes_rate_after(&self, i: usize) -> bool {
        self.faster_at(i).is_some()
    }

    /// The faster one of piece `i` and the next, if the tube is wide and not both are rapids.
    fn faster_at(&self, i: usize) -> Option<Faster> {
        let (before, after) = (&self.segments[i], self.segments.get(i + 1)?);
        let is_wide = before.radius.min(after.radius) > WIDE_R * self.rate_change;
        if !is_wide || (before.is_rapid && after.is_rapid) {
            None
        } else if self.feed_falls_after(i) {
            Some(Faster::Before)
        } else {
            let mut axes = before.feed_axes.iter().zip(&after.feed_axes);
            let rises = axes.any(|(now, then)| *then < SLOWER * now);
            rises.then_some(Faster::After)
        }
    }
}

/// Keeps the last site, which belongs to a sample on piece `i` at a progress, from going on at the rate of
/// that where the rate of the piece before or after it holds.
pub(super) fn keep<const D: usize>(
    problem: &mut Problem<D>,
    path: &ScaledPath<D>,
    (i, progress): (usize, f64),
    radius: f64,
) {
    let segment = &path.segments[i];
    let near = NEAR_R * segment.radius;
    if segment.s + segment.length - progress < near && path.faster_at(i) == Some(Faster::Before) {
        keep_side(problem, path, (i, -1.0), radius);
    }
    let before = i.checked_sub(1).filter(|_| progress - segment.s < near);
    if let Some(before) = before.filter(|before| path.faster_at(*before) == Some(Faster::After)) {
        keep_side(problem, path, (before, 1.0), radius);
    }
}

/// Keeps the last site on its side of the plane half-way between piece `i` and the next: before it with −1.
fn keep_side<const D: usize>(
    problem: &mut Problem<D>,
    path: &ScaledPath<D>,
    (i, side): (usize, f64),
    radius: f64,
) {
    let [before, after] = path.headings(i).map(|heading| {
        let size = dot(&heading, &heading).sqrt();
        heading.map(|h| h / size)
    });
    let half_way = 1.0 + dot(&before, &after);
    if half_way < LEAST_HALF_WAY {
        return;
    }
    let size = (2.0 * half_way).sqrt();
    let normal: [f64; D] = core::array::from_fn(|a| side * (before[a] + after[a]) / size);
    let room = half_way / size * KEEP_R * path.rate_change;
    let vertex = &path.segments[i + 1].start;
    problem.keep_beyond(&normal, dot(&normal, vertex) - room, radius);
}
