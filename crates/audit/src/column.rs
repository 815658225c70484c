//! One column of the free-space diagram: a chord of the motion against the chords of the program.

use crate::free_space::{Chord, Interval, Near, NearTurn};
use crate::program::{DiagramRow, DiagramRows, Presence};

/// How near an exact stop must be met, mm.
pub(crate) const EXACT_MM: f64 = 1e-6;
/// The same of the rotary axes, degrees.
const EXACT_DEG: f64 = 1e-6;

/// Intervals on the program that a matching can have reached at a sample.
#[derive(Debug, Default)]
pub(crate) struct Reach {
    /// Chord of the first interval.
    pub(crate) low: usize,
    pub(crate) intervals: Vec<Interval>,
}

impl Clone for Reach {
    fn clone(&self) -> Self {
        Self {
            low: self.low,
            intervals: self.intervals.clone(),
        }
    }

    /// Once for every sample: memory is used again.
    fn clone_from(&mut self, source: &Self) {
        self.low = source.low;
        self.intervals.clone_from(&source.intervals);
    }
}

impl Reach {
    pub(crate) fn get(&self, index: usize) -> Interval {
        let here = index
            .checked_sub(self.low)
            .and_then(|i| self.intervals.get(i));
        here.copied().unwrap_or(Interval::EMPTY)
    }

    /// One past the last chord.
    pub(crate) fn end(&self) -> usize {
        self.low + self.intervals.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.intervals.is_empty()
    }

    /// Drops empty intervals at both ends.
    pub(crate) fn trim(&mut self) {
        while self
            .intervals
            .last()
            .is_some_and(|interval| interval.is_empty())
        {
            self.intervals.pop();
        }
        let empty = self
            .intervals
            .iter()
            .take_while(|interval| interval.is_empty())
            .count();
        self.intervals.drain(..empty);
        self.low += empty;
    }
}

/// What counts as near.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Level {
    /// No more than this, whatever the tolerance.
    pub(crate) lambda_mm: f64,
    /// At exact stops.
    pub(crate) exact_mm: f64,
    /// At least this, whatever the tolerance: 0 but for a motion that is out of tolerance.
    pub(crate) floor_mm: f64,
    /// Whatever the direction of the tool is.
    pub(crate) any_way: bool,
}

impl Level {
    /// Tolerances, but no more than this.
    pub(crate) const fn up_to(lambda_mm: f64) -> Self {
        Self {
            lambda_mm,
            exact_mm: EXACT_MM,
            floor_mm: 0.0,
            any_way: false,
        }
    }

    pub(crate) fn along(&self, row: &DiagramRow) -> Near {
        self.near(row, row.tolerance_mm, row.turn.along_deg)
    }

    /// At the end of a row, for a chord of the motion.
    fn at_end(&self, row: &DiagramRow, chord: &Chord) -> Near {
        let Some(exact) = row.exact_end else {
            return self.near(row, row.end_tolerance_mm, row.turn.end_deg);
        };
        let along = chord.displacement();
        let exact_mm = (self.exact_mm + exact.cut_mm(&along)).min(row.end_tolerance_mm);
        let mm = exact_mm.min(self.lambda_mm).max(self.floor_mm);
        let turn = &row.turn;
        let rotary = if self.any_way {
            NearTurn::Any
        } else {
            // There the axes themselves are where the program has them.
            let relaxed_deg = (self.exact_mm - EXACT_MM).max(0.0) / turn.mm_per_deg;
            let exact_deg = EXACT_DEG + relaxed_deg + exact.cut_deg(&along);
            NearTurn::Axes(
                exact_deg
                    .min(turn.end_deg)
                    .max(self.floor_mm / turn.mm_per_deg),
            )
        };
        Near { mm, rotary }
    }

    fn near(&self, row: &DiagramRow, tolerance_mm: f64, tolerance_deg: f64) -> Near {
        let mm = tolerance_mm.min(self.lambda_mm).max(self.floor_mm);
        let turn = &row.turn;
        let rotary = if self.any_way {
            NearTurn::Any
        } else if turn.is_way {
            // What is wanted of the level is how far the tip is off; the direction has all of its tolerance.
            let floor_deg = self.floor_mm / turn.mm_per_deg;
            NearTurn::Way {
                deg: tolerance_deg.max(floor_deg),
                axes_deg: turn
                    .axes_r
                    .map(|axes_r| tolerance_deg.max(floor_deg) * axes_r),
            }
        } else {
            NearTurn::Axes(mm / turn.mm_per_deg)
        };
        Near { mm, rotary }
    }
}

/// A chord of the motion.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    pub(crate) chord: Chord,
    /// Its length over all axes.
    pub(crate) travel_mm: f64,
    pub(crate) tick: u64,
    pub(crate) line: u32,
    /// What could be reached at its start.
    pub(crate) reach: Reach,
}

/// What became of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Passage {
    Passed,
    Blocked,
    /// The program has not been fed far enough to tell.
    NotYet,
}

/// Carries what can be reached at the start of a chord of the motion over to its end, `next`.
pub(crate) fn step(
    rows: &mut DiagramRows,
    now: &Reach,
    chord: &Chord,
    level: &Level,
    next: &mut Reach,
) -> Passage {
    next.intervals.clear();
    next.low = now.low;
    // What can be reached on the lower edge of the present cell.
    let mut bottom = Interval::EMPTY;
    let mut index = now.low;
    while index < now.end() || !bottom.is_empty() {
        // Along a long chord the motion mostly goes on; short ones it mostly leaves behind.
        let left_is_last = index + 1 == now.end();
        match rows.reach(index) {
            Presence::Here => {}
            Presence::NotYet => return Passage::NotYet,
            Presence::Never => break,
        }
        let left = now.get(index);
        let Some(row) = rows.get(index) else { break };
        let mut right = Interval::EMPTY;
        let mut top = Interval::EMPTY;
        if !(left.is_empty() && bottom.is_empty()) {
            // From below every place on the right is above; from the left every place on top is
            // to the right.
            let along = level.along(row);
            if left_is_last || !row.chord.is_far(&chord.to, along.mm) {
                right = row.chord.near(&chord.end(), &along);
            }
            if bottom.is_empty() {
                right = right.from(left.low);
            }
            let end = level.at_end(row, chord);
            if !chord.is_far(&row.chord.to, end.mm) {
                top = chord.near(&row.chord.end(), &end);
            }
            if left.is_empty() {
                top = top.from(bottom.low);
            }
        }
        next.intervals.push(right);
        bottom = top;
        index += 1;
    }
    next.trim();
    if next.is_empty() {
        Passage::Blocked
    } else {
        Passage::Passed
    }
}
