//! The budget of planning: multiplications of the solvers, which the time it takes follows.
//!
//! ```text
//!   before a period    PLAN_WORK ── at the feed ── window: FIRST_WORK at most ── halt: what is left
//!   of each window     search ── end, if it sees that of the path or is to halt
//! ```
//!
//! A multiplication takes 1 ns with two axes, half of that with six: with 70 million before a
//! period, planning keeps a processor for 70 ms at most. Where joints are not the axes it may be four times
//! that ([`OF_JOINTS`]): such stretches are planned ahead of their first frame. Two or three axes need less, and are
//! given up earlier: from a little further on another window is found sooner than by more work on
//! this one.

use super::solver::Allowance;

/// Most work before a period, where joints are the axes.
pub(crate) const PLAN_WORK: usize = 70_000_000;
/// Most of it for the first window tried.
const FIRST_WORK: usize = 50_000_000;

/// Work wanted for the search, for making it smooth, and for the end of a window of three axes; that
/// of more grows with their square. No measurement of the numbers is kept.
const SEARCH_WORK: usize = 30_000_000;
const SMOOTHING_WORK: usize = 10_000_000;
const FINISH_WORK: usize = 10_000_000;
/// One part in so many of the most is kept for the end.
const FINISH_PART: usize = 5;

/// How many times as much it is where joints are not the axes: rows of joints are linear about the last motion
/// only, so that motions settle in more rounds, and such stretches are planned ahead of their first frame. With 3 a
/// star on a rotary delta took 5 % longer, and a corner on a table and head 3 %; less was not measured by itself.
const OF_JOINTS: usize = 4;

/// Most work of the first window tried before a period, in multiplications.
pub(crate) const fn first_work(has_joints: bool) -> usize {
    factor(has_joints) * FIRST_WORK
}

/// Most work that is left before a period of which some is spent, in multiplications.
pub(crate) const fn left_work(has_joints: bool, spent: usize) -> usize {
    (factor(has_joints) * PLAN_WORK).saturating_sub(spent)
}

const fn factor(has_joints: bool) -> usize {
    if has_joints { OF_JOINTS } else { 1 }
}

/// What the windows of a path may cost.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Budget {
    axes: usize,
    factor: usize,
}

impl Budget {
    /// For so many axes, with joints beside them or without.
    pub(crate) const fn new(axes: usize, has_joints: bool) -> Self {
        Self {
            axes: if axes < 3 { 3 } else { axes },
            factor: factor(has_joints),
        }
    }

    /// What a window may do in its search, of `most_work` in all.
    pub(crate) const fn search(self, has_end: bool, most_work: usize) -> Allowance {
        let kept = if has_end { most_work / FINISH_PART } else { 0 };
        Allowance {
            wanted: self.of(SEARCH_WORK),
            most: most_work - kept,
        }
    }

    /// What it may do to make the best motion smooth, of `left_work`.
    pub(crate) const fn smoothing(self, left_work: usize) -> Allowance {
        Allowance {
            wanted: self.of(SMOOTHING_WORK),
            most: left_work,
        }
    }

    /// What it may do to go on at the feed.
    pub(crate) const fn at_feed(self) -> Allowance {
        Allowance {
            wanted: self.of(SMOOTHING_WORK),
            most: self.factor * (PLAN_WORK - FIRST_WORK),
        }
    }

    /// What it may do for its end, of `most_work` that is left.
    pub(crate) const fn finish(self, most_work: usize) -> Allowance {
        Allowance {
            wanted: self.of(FINISH_WORK),
            most: most_work,
        }
    }

    const fn of(self, work: usize) -> usize {
        self.factor * work * self.axes * self.axes / 9
    }
}

#[cfg(test)]
mod tests {
    use super::{FIRST_WORK, PLAN_WORK, first_work, left_work};

    /// The halt that is tried after a hard window needs its share with joints, too: on a zigzag of a CoreXY
    /// machine eight of nine halts had none left when joints counted for the first window only.
    #[test]
    fn a_first_window_that_spends_all_leaves_the_halt_its_share() {
        let share_of = |has_joints| {
            let left = left_work(has_joints, first_work(has_joints));
            left * FIRST_WORK == first_work(has_joints) * (PLAN_WORK - FIRST_WORK)
        };
        assert!(share_of(false));
        assert!(share_of(true));
    }
}
