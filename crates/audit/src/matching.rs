//! Deviation both ways and in order: a monotone matching of the motion with the program.
//!
//! Motion and program are polygons. A *matching* runs along both, never backwards, from the two
//! starts to the two ends; its width is the largest distance between the two points on the way, and
//! the deviation is the width of the narrowest matching (the Fréchet distance). A skipped spike, a
//! reversed or swapped move, a second pass over the same place cannot hide from it.
//!
//! ```text
//!   program                      The free-space diagram: a point (x, y) is a place on the motion and
//!    y ▲ ┌────┬────┬────┐        one on the program; it is free if they are near. There is a matching
//!      │ │    │  ╭─┼──· │        if a path through free space leads from corner to corner without
//!      │ ├────┼─╱──┼────┤        turning left or down. In a cell (a chord against a chord) free space
//!      │ │ ╭──┼╯   │    │        is convex, so what can be reached on its right and upper edge follows
//!      │ ├─╱──┼────┼────┤        from what can be reached on its left and lower one.
//!      │ │·   │    │    │
//!      └─┴────┴────┴────┴─▶ x motion
//! ```
//!
//! The diagram is run through column by column, one sample at a time, keeping only the intervals
//! that can be reached at the present sample. "Near" means the tolerance of the place, but not
//! more than the level λ, the width needed so far. Where a column cannot be passed the last
//! columns are tried again with a larger λ, found by search; so at the end λ is the deviation. If
//! even the tolerance is not enough, exact stops are relaxed, then everything, until the motion is
//! back on the path: that is reported, with the width that was needed.

use crate::column::{Column, Level, Passage, Reach, step};
use crate::end::End;
use crate::free_space::{Chord, Interval};
use crate::out_of_tolerance::{Goal, OutOfTolerance};
use crate::program::{DiagramRows, Presence, SMALLEST_TOLERANCE_MM};
use crate::sample::Seen;
use crate::settings::AuditSettings;
use crate::tremor::{Cruise, SlowDown, StillAxes};
use crate::violation::{ViolationKind, ViolationList, Worst};
use glidepath_geometry::AxisVector;
use glidepath_program::Item;
use std::collections::VecDeque;

/// Columns that are tried again first where one cannot be passed; a retry over the full history
/// costs more.
pub(crate) const SHORT: usize = 8;
/// Most columns kept.
const MAX_HISTORY: usize = 4096;
/// Travel of the motion over which columns are kept, in tolerances.
const HISTORY_TOLERANCES: f64 = 8.0;

/// A sample, as far as it is matched.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spot {
    pub(crate) tick: u64,
    pub(crate) line: u32,
    pub(crate) position: AxisVector,
    pub(crate) is_between_frames: bool,
}

/// A sample that waits for the program.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    spot: Spot,
    /// Periods since the sample before.
    ticks: u64,
    /// Periods for which the position before it was kept.
    rest_ticks: u64,
}

/// The matching under way.
#[derive(Debug)]
pub(crate) struct Matching {
    pub(crate) rows: DiagramRows,
    pub(crate) violations: ViolationList,
    pub(crate) still: StillAxes,
    pub(crate) cruise: Cruise,
    pub(crate) slow_down: SlowDown,
    pub(crate) tremors: ViolationList,
    /// The deviation in mm, as `ratio`, and where it was met.
    pub(crate) max_deviation: Worst,
    pub(crate) max_feed: Worst,
    /// How far the direction of the tool was off in degrees, as `ratio`, and where.
    pub(crate) max_turn: Worst,
    pub(crate) is_complete: bool,
    pub(crate) period_t: f64,
    /// Largest override the feed may have been run at.
    pub(crate) feed_factor: f64,
    /// Samples that wait for the program.
    queue: VecDeque<Waiting>,
    /// The last sample fed.
    pub(crate) last_fed: Option<Spot>,
    /// Tick at which the last position fed was taken up.
    pub(crate) since_tick: u64,
    /// The latest rests: where, and for how many periods.
    pub(crate) rests: VecDeque<(AxisVector, u64)>,
    /// Position of the last sample matched.
    pub(crate) at: Option<AxisVector>,
    pub(crate) reach: Reach,
    pub(crate) history: VecDeque<Column>,
    /// What could be reached in columns that were dropped: memory to be used again.
    spare: Vec<Reach>,
    /// Travel of the motion over the history, mm.
    travel_mm: f64,
    pub(crate) lambda_mm: f64,
    /// The level up to which the full history has been searched for something better, in vain.
    pub(crate) searched_mm: f64,
    pub(crate) out_of_tolerance: Option<OutOfTolerance>,
    /// Cells looked at for a motion out of tolerance.
    pub(crate) trouble_cells: usize,
    /// The history must not be gone back to.
    pub(crate) is_history_void: bool,
    is_lost: bool,
    pub(crate) scratch: [Reach; 2],
}

impl Matching {
    pub(crate) fn new(settings: &AuditSettings) -> Self {
        Self {
            rows: DiagramRows::new(settings),
            violations: ViolationList::default(),
            still: StillAxes::new(settings.period_t),
            cruise: Cruise::new(settings),
            slow_down: SlowDown::new(settings),
            tremors: ViolationList::default(),
            max_deviation: Worst::default(),
            max_feed: Worst::default(),
            max_turn: Worst::default(),
            is_complete: false,
            period_t: settings.period_t,
            feed_factor: 1.0,
            queue: VecDeque::new(),
            last_fed: None,
            since_tick: 0,
            rests: VecDeque::new(),
            at: None,
            reach: Reach {
                low: 0,
                intervals: vec![Interval {
                    low: 0.0,
                    high: 0.0,
                }],
            },
            history: VecDeque::new(),
            spare: Vec::new(),
            travel_mm: 0.0,
            lambda_mm: SMALLEST_TOLERANCE_MM,
            searched_mm: 0.0,
            out_of_tolerance: None,
            trouble_cells: 0,
            is_history_void: false,
            is_lost: false,
            scratch: [Reach::default(), Reach::default()],
        }
    }

    pub(crate) fn program(&mut self, item: &Item) {
        self.rows.feed(item);
        if self.is_lost {
            self.rows.discard();
        }
        self.advance();
    }

    pub(crate) fn sample(&mut self, sample: &Seen<'_>) {
        if self.is_lost || !sample.position.iter().all(|p| p.is_finite()) {
            return;
        }
        let spot = Spot {
            tick: sample.tick,
            line: sample.line,
            position: *sample.position,
            is_between_frames: sample.is_between_frames,
        };
        let (mut ticks, mut rest_ticks) = (1, 0);
        if let Some(previous) = &mut self.last_fed {
            let is_at_rest = previous.position == spot.position;
            ticks = spot.tick.saturating_sub(previous.tick).max(1);
            rest_ticks = previous.tick.saturating_sub(self.since_tick);
            *previous = spot;
            // A motion at rest stays where it is in the diagram.
            if is_at_rest {
                return;
            }
        } else {
            self.last_fed = Some(spot);
        }
        self.since_tick = spot.tick;
        let waiting = Waiting {
            spot,
            ticks,
            rest_ticks,
        };
        // Where another one waits, the program has not been fed far enough.
        if !self.queue.is_empty() || !self.take(&waiting) {
            self.queue.push_back(waiting);
        }
    }

    pub(crate) fn finish(&mut self, end: End) {
        self.rows.end();
        self.advance();
        if !self.is_lost {
            self.still.finish(&mut self.tremors);
            self.judge_end(end);
        }
    }

    /// Matches as many waiting samples as the program allows.
    fn advance(&mut self) {
        while let Some(&waiting) = self.queue.front() {
            if !self.take(&waiting) {
                return;
            }
            self.queue.pop_front();
        }
    }

    /// Matches a sample; false if the program has not been fed far enough to tell.
    fn take(&mut self, waiting: &Waiting) -> bool {
        let spot = &waiting.spot;
        if self.rows.reach(0) == Presence::Never {
            // Nothing moves in the program: the motion has to stay where it is.
            if self.at.is_some() {
                self.lose(spot);
            }
            self.at = Some(spot.position);
            return true;
        }
        if self.at.is_none() && !self.judge_start(spot) {
            return false;
        }
        let chord = self
            .rows
            .chord(self.at.unwrap_or(spot.position), spot.position);
        let first = self.reach.low;
        let passage = match self.out_of_tolerance {
            None => {
                let [next, _] = &mut self.scratch;
                let level = Level::up_to(self.lambda_mm);
                step(&mut self.rows, &self.reach, &chord, &level, next)
            }
            Some(_) => Passage::Blocked,
        };
        let mut reach = self.spare.pop().unwrap_or_default();
        let passage = match passage {
            Passage::Passed => {
                core::mem::swap(&mut reach, &mut self.scratch[0]);
                core::mem::swap(&mut reach, &mut self.reach);
                self.put_column(chord, spot, reach);
                Passage::Passed
            }
            Passage::Blocked => {
                reach.clone_from(&self.reach);
                self.put_column(chord, spot, reach);
                let passage = self.pass_somehow();
                if passage == Passage::Passed {
                    core::mem::swap(&mut self.reach, &mut self.scratch[0]);
                }
                passage
            }
            Passage::NotYet => {
                self.spare.push(reach);
                return false;
            }
        };
        match passage {
            Passage::Passed => {
                let is_followed = self.out_of_tolerance.is_none();
                let feed_v = is_followed.then(|| self.feed_v(waiting.ticks, first));
                // Behind an exact stop that was missed nothing is gone back to.
                if feed_v == Some(None) && !self.is_history_void {
                    self.take_back();
                    return false;
                }
                self.commit(waiting, first, feed_v.flatten());
            }
            Passage::Blocked => self.lose(spot),
            Passage::NotYet => {
                self.drop_column(VecDeque::pop_back);
                return false;
            }
        }
        true
    }

    /// The last column has not been passed yet.
    fn take_back(&mut self) {
        if let Some(column) = self.history.back_mut() {
            core::mem::swap(&mut self.reach, &mut column.reach);
        }
        self.drop_column(VecDeque::pop_back);
    }

    /// The last column does not pass at the present level, or the motion is out of tolerance. What
    /// can be reached is left in the scratch.
    fn pass_somehow(&mut self) -> Passage {
        if let Some(OutOfTolerance { floor_mm, .. }) = self.out_of_tolerance {
            let level = Level {
                floor_mm,
                ..Level::up_to(self.cap())
            };
            let passage = self.replay(self.history.len() - 1, &level, Goal::Anything);
            if passage != Passage::Blocked {
                return passage;
            }
        }
        self.widen(Goal::Anything)
    }

    /// What follows from a sample that was matched; `first` is the first chord it may have been on,
    /// `feed_v` the feed there, mm/s, if that is known.
    fn commit(&mut self, waiting: &Waiting, first: usize, feed_v: Option<f64>) {
        let spot = &waiting.spot;
        let from = self.at.replace(spot.position);
        if let Some(at) = from {
            self.note_rest(at, waiting.rest_ticks);
        }
        self.judge_dwells(first, spot);
        let rested_at = from.filter(|_| waiting.rest_ticks > 0);
        self.judge_tremor(spot, waiting.ticks, rested_at, first);
        if self.out_of_tolerance.is_some() {
            if self.count_within_tolerance(&self.reach, &spot.position) > 0 {
                self.settle(Goal::WithinTolerance);
            }
        } else {
            if let Some(feed_v) = feed_v {
                self.judge_feed(spot, waiting.ticks, feed_v);
            }
            self.note_deviation(self.lambda_mm, spot.tick, spot.line);
            self.note_turn(spot);
        }
        if core::mem::take(&mut self.is_history_void) {
            self.restart_history(spot.position);
        }
        self.forget();
    }

    fn put_column(&mut self, chord: Chord, spot: &Spot, reach: Reach) {
        let travel_mm = chord.travel_mm();
        self.travel_mm += travel_mm;
        self.history.push_back(Column {
            chord,
            travel_mm,
            tick: spot.tick,
            line: spot.line,
            reach,
        });
    }

    /// The history starts anew: the motion is here, and no retry goes back.
    pub(crate) fn restart_history(&mut self, at: AxisVector) {
        let last = self.history.back();
        let (tick, line) = last.map_or((0, 0), |column| (column.tick, column.line));
        self.history.clear();
        self.travel_mm = 0.0;
        let reach = self.reach.clone();
        self.history.push_back(Column {
            chord: self.rows.chord(at, at),
            travel_mm: 0.0,
            tick,
            line,
            reach,
        });
    }

    /// Gives up following the motion.
    fn lose(&mut self, spot: &Spot) {
        self.violations
            .push(spot.tick, spot.line, ViolationKind::Lost);
        self.is_lost = true;
        self.queue.clear();
        self.history.clear();
        self.rows.discard();
    }

    pub(crate) fn note_deviation(&mut self, deviation_mm: f64, tick: u64, line: u32) {
        if deviation_mm > self.max_deviation.ratio {
            self.max_deviation = Worst {
                ratio: deviation_mm,
                axis: None,
                tick,
                line,
            };
        }
    }

    /// Drops the column that `take` takes from the history; its memory is used again.
    fn drop_column(&mut self, take: fn(&mut VecDeque<Column>) -> Option<Column>) {
        if let Some(column) = take(&mut self.history) {
            self.travel_mm -= column.travel_mm;
            self.spare.push(column.reach);
        }
    }

    /// Drops history that can no longer matter, and chords no matching can go back to.
    fn forget(&mut self) {
        let keep_mm = HISTORY_TOLERANCES * self.cap();
        while self.history.len() > SHORT {
            let is_far = self.out_of_tolerance.is_none() && self.travel_mm > keep_mm;
            if !is_far && self.history.len() <= MAX_HISTORY {
                break;
            }
            self.drop_column(VecDeque::pop_front);
        }
        let oldest = self
            .history
            .front()
            .map_or(self.reach.low, |column| column.reach.low);
        self.rows.forget_before(oldest.min(self.reach.low));
    }

    /// The level above which a larger λ changes nothing.
    pub(crate) fn cap(&self) -> f64 {
        self.rows.max_tolerance_mm() * 1.001
    }

    /// What is kept, in chords, columns and samples.
    #[cfg(test)]
    pub(crate) fn kept(&self) -> usize {
        self.rows.kept() + self.history.len() + self.queue.len() + self.reach.intervals.len()
    }
}
