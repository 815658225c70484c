//! One column of the free-space diagram: a chord of the motion against the chords of the program.

use super::free_space::{Interval, distance, near};
use super::program::{Presence, Row, Rows};
use glidepath_geometry::AxisVector;

/// Intervals on the program that a matching can have reached at a sample.
#[derive(Debug, Clone, Default)]
pub(super) struct Reach {
    /// Chord of the first interval.
    pub(super) low: usize,
    pub(super) intervals: Vec<Interval>,
}

impl Reach {
    pub(super) fn get(&self, index: usize) -> Interval {
        let here = index
            .checked_sub(self.low)
            .and_then(|i| self.intervals.get(i));
        here.copied().unwrap_or(Interval::EMPTY)
    }

    /// One past the last chord.
    pub(super) fn end(&self) -> usize {
        self.low + self.intervals.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.intervals.is_empty()
    }

    /// Drops empty intervals at both ends.
    pub(super) fn trim(&mut self) {
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
pub(super) struct Level {
    /// No more than this, whatever the tolerance.
    pub(super) lambda_mm: f64,
    /// At exact stops.
    pub(super) exact_mm: f64,
    /// At least this, whatever the tolerance: 0 but for a motion that is out of tolerance.
    pub(super) floor_mm: f64,
}

impl Level {
    pub(super) fn along(&self, row: &Row) -> f64 {
        row.tolerance_mm.min(self.lambda_mm).max(self.floor_mm)
    }

    /// At the end of a row, for a chord of the motion of some length.
    fn at_end(&self, row: &Row, chord_mm: f64) -> f64 {
        let tolerance = row.exact_end.map_or(row.end_tolerance_mm, |exact| {
            (self.exact_mm + exact.cut(chord_mm)).min(row.end_tolerance_mm)
        });
        tolerance.min(self.lambda_mm).max(self.floor_mm)
    }
}

/// A chord of the motion.
#[derive(Debug, Clone)]
pub(super) struct Column {
    pub(super) from: AxisVector,
    pub(super) to: AxisVector,
    pub(super) tick: u64,
    pub(super) line: u32,
    /// What could be reached at `from`.
    pub(super) reach: Reach,
}

/// What became of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Passage {
    Passed,
    Blocked,
    /// The program has not been fed far enough to tell.
    NotYet,
}

/// Carries what can be reached at the start of a chord of the motion over to its end, `next`.
pub(super) fn step(
    rows: &mut Rows,
    now: &Reach,
    column: &Column,
    level: &Level,
    next: &mut Reach,
) -> Passage {
    next.intervals.clear();
    next.low = now.low;
    // What can be reached on the lower edge of the present cell.
    let mut bottom = Interval::EMPTY;
    let mut index = now.low;
    let chord_mm = distance(&(column.to - column.from));
    while index < now.end() || !bottom.is_empty() {
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
            right = near(&row.start, &row.end, &column.to, level.along(row));
            if bottom.is_empty() {
                right = right.from(left.low);
            }
            top = near(
                &column.from,
                &column.to,
                &row.end,
                level.at_end(row, chord_mm),
            );
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
