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
//! The diagram is run through column by column, one sample at a time, keeping only the intervals that
//! can be reached at the present sample. "Near" means the tolerance of the place, but not more than
//! the level λ, the width needed so far. Where a column cannot be passed the last columns are tried
//! again with a larger λ, found by search; so at the end λ is the deviation. If even the tolerance is
//! not enough, exact stops are relaxed, then everything, until the motion is back on the path: that is
//! reported, with the width that was needed.

use super::column::{Column, Level, Passage, Reach};
use super::free_space::{Interval, near};
use super::program::{Presence, Rows, SMALLEST_TOLERANCE_MM};
use super::report::{ViolationKind, ViolationList, Worst};
use super::widen::SHORT;
use super::{AuditSettings, Sample};
use crate::Item;
use glidepath_geometry::AxisVector;
use std::collections::VecDeque;

/// How near an exact stop must be met, mm.
pub(super) const EXACT_MM: f64 = 1e-6;
/// Most columns kept.
const MAX_HISTORY: usize = 4096;
/// Travel of the motion over which columns are kept, in tolerances.
const HISTORY_TOLERANCES: f64 = 8.0;

/// What must hold after the last column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Goal {
    /// Something can be reached.
    Anything,
    /// Something within tolerance can be reached.
    WithinTolerance,
    /// The end of the program can be reached.
    End,
}

/// A motion that is out of tolerance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trouble {
    /// Width at which it is followed, mm.
    pub(super) floor_mm: f64,
    /// Where it began.
    pub(super) tick: u64,
    pub(super) line: u32,
}

/// A sample that waits for the program.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    sample: Sample,
    /// Periods since the sample before.
    ticks: u64,
    /// Periods for which the position before it was kept.
    rest_ticks: u64,
}

/// The matching under way.
#[derive(Debug)]
pub(super) struct Matching {
    pub(super) rows: Rows,
    pub(super) violations: ViolationList,
    /// The deviation in mm, as `ratio`, and where it was met.
    pub(super) max_deviation: Worst,
    pub(super) max_feed: Worst,
    pub(super) is_complete: bool,
    pub(super) period_t: f64,
    /// Largest override the feed may have been run at.
    pub(super) feed_factor: f64,
    /// Samples that wait for the program.
    queue: VecDeque<Waiting>,
    /// The last sample fed.
    pub(super) last_fed: Option<Sample>,
    /// Tick at which the last position fed was taken up.
    pub(super) since_tick: u64,
    /// The latest rests: where, and for how many periods.
    pub(super) rests: VecDeque<(AxisVector, u64)>,
    /// Position of the last sample matched.
    pub(super) at: Option<AxisVector>,
    pub(super) reach: Reach,
    pub(super) history: VecDeque<Column>,
    /// Travel of the motion over the history, mm.
    travel_mm: f64,
    pub(super) lambda_mm: f64,
    /// The level up to which the full history has been searched for something better, in vain.
    pub(super) searched_mm: f64,
    pub(super) trouble: Option<Trouble>,
    /// Cells looked at for a motion out of tolerance.
    pub(super) trouble_cells: usize,
    /// The history must not be gone back to.
    pub(super) is_history_void: bool,
    is_lost: bool,
    pub(super) scratch: [Reach; 2],
}

impl Matching {
    pub(super) fn new(settings: &AuditSettings) -> Self {
        Self {
            rows: Rows::new(settings.tolerance_mm),
            violations: ViolationList::default(),
            max_deviation: Worst::default(),
            max_feed: Worst::default(),
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
            travel_mm: 0.0,
            lambda_mm: SMALLEST_TOLERANCE_MM,
            searched_mm: 0.0,
            trouble: None,
            trouble_cells: 0,
            is_history_void: false,
            is_lost: false,
            scratch: [Reach::default(), Reach::default()],
        }
    }

    pub(super) fn program(&mut self, item: &Item) {
        self.rows.feed(item);
        if self.is_lost {
            self.rows.discard();
        }
        self.advance();
    }

    pub(super) fn sample(&mut self, sample: &Sample) {
        if self.is_lost || !sample.position.iter().all(|p| p.is_finite()) {
            return;
        }
        let previous = self.last_fed.replace(*sample);
        // A motion at rest stays where it is in the diagram.
        if previous.is_some_and(|previous| previous.position == sample.position) {
            return;
        }
        let ticks = previous.map_or(1, |previous| {
            sample.tick.saturating_sub(previous.tick).max(1)
        });
        let rest_ticks =
            previous.map_or(0, |previous| previous.tick.saturating_sub(self.since_tick));
        self.since_tick = sample.tick;
        self.queue.push_back(Waiting {
            sample: *sample,
            ticks,
            rest_ticks,
        });
        self.advance();
    }

    pub(super) fn finish(&mut self) {
        self.rows.end();
        self.advance();
        if !self.is_lost {
            self.judge_end();
        }
    }

    /// Matches as many waiting samples as the program allows.
    fn advance(&mut self) {
        while !self.is_lost {
            let Some(&waiting) = self.queue.front() else {
                return;
            };
            let sample = waiting.sample;
            if self.rows.reach(0) == Presence::Never {
                // Nothing moves in the program: the motion has to stay where it is.
                if self.at.is_some() {
                    self.lose(&sample);
                }
                self.at = Some(sample.position);
                self.queue.pop_front();
                continue;
            }
            let from = self.at.unwrap_or(sample.position);
            let column = Column {
                from,
                to: sample.position,
                tick: sample.tick,
                line: sample.line,
                reach: self.reach.clone(),
            };
            if self.at.is_none() && !self.judge_start(&sample) {
                return;
            }
            self.travel_mm += (column.to - column.from).norm();
            self.history.push_back(column);
            let level = self.level();
            let passage = self.replay(self.history.len() - 1, &level, Goal::Anything);
            let passage = match passage {
                Passage::Blocked => self.widen(Goal::Anything),
                other => other,
            };
            match passage {
                Passage::Passed => self.commit(&waiting),
                Passage::Blocked => self.lose(&sample),
                Passage::NotYet => {
                    self.history.pop_back();
                    self.travel_mm -= (sample.position - from).norm();
                    return;
                }
            }
        }
    }

    /// Takes over what `replay` left in the scratch.
    fn commit(
        &mut self,
        &Waiting {
            sample,
            ticks,
            rest_ticks,
        }: &Waiting,
    ) {
        let before = self.reach.low;
        core::mem::swap(&mut self.reach, &mut self.scratch[0]);
        if let Some(at) = self.at.replace(sample.position) {
            self.note_rest(at, rest_ticks);
        }
        self.queue.pop_front();
        self.judge_dwells(before, &sample);
        if self.trouble.is_some() {
            if self.count_within_tolerance(&self.reach, &sample.position) > 0 {
                self.settle(Goal::WithinTolerance);
            }
        } else {
            self.judge_feed(&sample, ticks, before);
            self.note_deviation(self.lambda_mm, sample.tick, sample.line);
        }
        if core::mem::take(&mut self.is_history_void) {
            self.restart_history(sample.position);
        }
        self.forget();
    }

    /// The history starts anew: the motion is here, and no retry goes back.
    pub(super) fn restart_history(&mut self, at: AxisVector) {
        let last = self.history.back();
        let (tick, line) = last.map_or((0, 0), |column| (column.tick, column.line));
        self.history.clear();
        self.travel_mm = 0.0;
        let reach = self.reach.clone();
        self.history.push_back(Column {
            from: at,
            to: at,
            tick,
            line,
            reach,
        });
    }

    /// Gives up following the motion.
    fn lose(&mut self, sample: &Sample) {
        self.violations
            .push(sample.tick, sample.line, ViolationKind::Lost);
        self.is_lost = true;
        self.queue.clear();
        self.history.clear();
        self.rows.discard();
    }

    pub(super) fn note_deviation(&mut self, deviation_mm: f64, tick: u64, line: u32) {
        if deviation_mm > self.max_deviation.ratio {
            self.max_deviation = Worst {
                ratio: deviation_mm,
                axis: None,
                tick,
                line,
            };
        }
    }

    /// Drops history that can no longer matter, and chords no matching can go back to.
    fn forget(&mut self) {
        let keep_mm = HISTORY_TOLERANCES * self.cap();
        while self.history.len() > SHORT {
            let is_far = self.trouble.is_none() && self.travel_mm > keep_mm;
            if !is_far && self.history.len() <= MAX_HISTORY {
                break;
            }
            if let Some(column) = self.history.pop_front() {
                self.travel_mm -= (column.to - column.from).norm();
            }
        }
        let oldest = self
            .history
            .front()
            .map_or(self.reach.low, |column| column.reach.low);
        self.rows.forget_before(oldest.min(self.reach.low));
    }

    /// The level above which a larger λ changes nothing.
    pub(super) fn cap(&self) -> f64 {
        self.rows.max_tolerance_mm() * 1.001
    }

    fn level(&self) -> Level {
        match self.trouble {
            None => Level {
                lambda_mm: self.lambda_mm,
                exact_mm: EXACT_MM,
                floor_mm: 0.0,
            },
            Some(Trouble { floor_mm, .. }) => Level {
                lambda_mm: self.cap(),
                exact_mm: EXACT_MM,
                floor_mm,
            },
        }
    }

    /// What is kept, in chords, columns and samples.
    #[cfg(test)]
    pub(super) fn kept(&self) -> usize {
        self.rows.kept() + self.history.len() + self.queue.len() + self.reach.intervals.len()
    }

    /// Number of intervals of `reach` that are within tolerance at a position.
    pub(super) fn count_within_tolerance(&self, reach: &Reach, at: &AxisVector) -> usize {
        (reach.low..reach.end())
            .filter(|&i| !self.within_tolerance(reach, i, at).is_empty())
            .count()
    }

    pub(super) fn within_tolerance(
        &self,
        reach: &Reach,
        index: usize,
        at: &AxisVector,
    ) -> Interval {
        let Some(row) = self.rows.get(index) else {
            return Interval::EMPTY;
        };
        let level = Level {
            lambda_mm: f64::INFINITY,
            exact_mm: EXACT_MM,
            floor_mm: 0.0,
        };
        reach
            .get(index)
            .intersect(near(&row.start, &row.end, at, level.along(row)))
    }
}
