//! What planning may cost: multiplications of the solvers, which the time it takes follows.
//!
//! ```text
//!   before a period    PLAN_WORK ── at the feed ── window: FIRST_WORK at most ── halt: what is left
//!   of each window     search ── end, if it sees that of the path or is to halt
//! ```
//!
//! A multiplication takes 1 ns with two axes, half of that with six: with 70 million before a
//! period, planning keeps a processor for less than 50 ms. Two or three axes need less, and are
//! given up earlier: from a little further on another window is found sooner than by more work on
//! this one.

use super::solver::Allowance;

/// Most work before a period.
pub(crate) const PLAN_WORK: usize = 70_000_000;
/// Most of it for the first window tried.
pub(crate) const FIRST_WORK: usize = 50_000_000;

/// Work wanted for the search, for making it smooth, and for the end of a window of three axes; that
/// of more grows with their square. No measurement of the numbers is kept.
const SEARCH_WORK: usize = 30_000_000;
const SMOOTHING_WORK: usize = 10_000_000;
const FINISH_WORK: usize = 10_000_000;
/// One part in so many of the most is kept for the end.
const FINISH_PART: usize = 5;

/// What a window may do in its search, of `most_work` in all.
pub(crate) const fn search(axes: usize, has_end: bool, most_work: usize) -> Allowance {
    let kept = if has_end { most_work / FINISH_PART } else { 0 };
    Allowance {
        wanted: of_axes(SEARCH_WORK, axes),
        most: most_work - kept,
    }
}

/// What it may do to make the best motion smooth, of `left_work`.
pub(crate) const fn smoothing(axes: usize, left_work: usize) -> Allowance {
    Allowance {
        wanted: of_axes(SMOOTHING_WORK, axes),
        most: left_work,
    }
}

/// What it may do to go on at the feed.
pub(crate) const fn at_feed(axes: usize) -> Allowance {
    Allowance {
        wanted: of_axes(SMOOTHING_WORK, axes),
        most: PLAN_WORK - FIRST_WORK,
    }
}

/// What it may do for its end, of `most_work` that is left.
pub(crate) const fn finish(axes: usize, most_work: usize) -> Allowance {
    Allowance {
        wanted: of_axes(FINISH_WORK, axes),
        most: most_work,
    }
}

const fn of_axes(work: usize, axes: usize) -> usize {
    let axes = if axes < 3 { 3 } else { axes };
    work * axes * axes / 9
}
