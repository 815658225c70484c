//! The feed that a motion is held against: that of the program where the motion is.
//!
//! ```text
//!     rapid ───────────●             Next to a corner the motion may be on the chord behind it already,
//!        motion ───╮ ┊ │ feed        or still on the one before it: the tolerance allows both. Of what it
//!                   ╲┊ │             allows, the chords count that are as near as the nearest one, give
//!                    ╲ ▼             or take FEED_CHANGE_MM. However wide the tolerance is, a rapid does
//!                     ┊              not go on into the cut.
//! ```

use crate::column::{Column, Level, Passage, Reach};
use crate::free_space::Chord;
use crate::matching::Matching;
use crate::out_of_tolerance::Goal;
use glidepath_geometry::{AxisVector, feed_length};

/// The programmed feed counts as kept up to this factor.
pub(crate) const FEED_SLACK: f64 = 1.0 + 1e-3;
/// How much further than the nearest chord one may be whose feed still counts, mm, and beside that as a
/// share of its tolerance: a planner may drive lines for arcs, or a curve for short lines, and change the
/// feed where the one begins that stands for the other.
const FEED_CHANGE_MM: f64 = 0.1;
const FEED_CHANGE_R: f64 = 0.05;

impl Matching {
    /// The feed of the last column, which begins on chord `first` or behind it, mm/s; 0 if there is none.
    /// `None` if the program has not been fed far enough to tell.
    pub(crate) fn feed_v(&mut self, ticks: u64, first: usize) -> Option<f64> {
        let Some(column) = self.history.back() else {
            return Some(0.0);
        };
        let speed_v = self.speed_v(&column.chord, ticks);
        let keeps = |feed_v: f64| speed_v <= FEED_SLACK * feed_v * self.feed_factor;
        let [least_v, most_v] = self.feeds_v(first..self.reach.end());
        if keeps(least_v) {
            return Some(most_v);
        }
        let matched = [&column.reach, &self.reach];
        let [_, near_v] = self.feeds_v(self.near_rows(column, matched));
        if keeps(near_v) {
            return Some(near_v);
        }
        // At the level the motion is matched at it may be on fewer chords than the tolerance allows.
        let widest = Level::up_to(self.cap());
        match self.replay(0, &widest, Goal::Anything) {
            Passage::NotYet => return None,
            Passage::Blocked => return Some(near_v),
            Passage::Passed => {}
        }
        let [after, before] = &self.scratch;
        let column = self.history.back()?;
        let [_, near_v] = self.feeds_v(self.near_rows(column, [before, after]));
        Some(near_v)
    }

    /// Path speed of a chord of the motion, mm/s.
    pub(crate) fn speed_v(&self, chord: &Chord, ticks: u64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a few")]
        let elapsed_t = self.period_t * ticks as f64;
        feed_length(&chord.displacement()) / elapsed_t
    }

    /// The slowest and the fastest feed of some chords, mm/s; 0 if there are none.
    fn feeds_v(&self, rows: core::ops::Range<usize>) -> [f64; 2] {
        let mut feeds_v = rows.filter_map(|index| Some(self.rows.get(index)?.feed_v));
        let Some(first_v) = feeds_v.next() else {
            return [0.0; 2];
        };
        feeds_v.fold([first_v; 2], |[least, most], v| [least.min(v), most.max(v)])
    }

    /// The chords that count for the last column: of those in reach at its start and at its end, from the
    /// first one near its start to the last one near its end.
    fn near_rows(&self, column: &Column, [before, after]: [&Reach; 2]) -> core::ops::Range<usize> {
        let (start, end) = (&column.chord.from, &column.chord.to);
        let mut at_start = self.near(start, (&column.reach, before));
        let first = at_start.next().unwrap_or(before.low);
        let last = self.near(end, (&self.reach, after)).last();
        let last = last.unwrap_or(after.low);
        first.min(last)..first.max(last) + 1
    }

    /// Of the chords in reach, those near a position. How near that is, those say that are in reach at the
    /// level the motion is matched at.
    fn near(
        &self,
        at: &AxisVector,
        (matched, reach): (&Reach, &Reach),
    ) -> impl Iterator<Item = usize> {
        let away = |reach: &Reach, index: usize| {
            let (row, part) = (self.rows.get(index)?, reach.get(index));
            let away_mm = || row.chord.part(part).distance_mm(at, row.turn.mm_per_deg);
            (!part.is_empty()).then(|| (away_mm(), row))
        };
        let nearest_mm = (matched.low..matched.end())
            .filter_map(|index| away(matched, index))
            // Behind a wide move a narrow one may be in reach, but the motion is not on it yet.
            .filter(|(mm, row)| *mm <= row.own_tolerance_mm)
            .fold(f64::INFINITY, |nearest, (mm, _)| nearest.min(mm));
        (reach.low..reach.end()).filter(move |&index| {
            away(reach, index).is_some_and(|(mm, row)| {
                mm - nearest_mm <= FEED_CHANGE_MM + FEED_CHANGE_R * row.own_tolerance_mm
            })
        })
    }
}
