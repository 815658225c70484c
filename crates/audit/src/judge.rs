//! Verdicts that come with the matching: start, end, feed, and tremor.

use crate::column::{EXACT_MM, Level, Passage, Reach};
use crate::end::End;
use crate::feed::FEED_SLACK;
use crate::free_space::Interval;
use crate::matching::{Matching, Spot};
use crate::out_of_tolerance::Goal;
use crate::program::Presence;
use crate::tremor::MatchedSample;
use crate::violation::{ViolationKind, Worst};
use glidepath_geometry::AxisVector;
use glidepath_program::tolerance_norm;

/// Latest rests kept in mind.
const RESTS: usize = 64;

impl Matching {
    /// The first sample must be where the program starts; false if that is not known yet.
    pub(crate) fn judge_start(&mut self, spot: &Spot) -> bool {
        if self.rows.reach(0) != Presence::Here {
            return false;
        }
        if let Some(row) = self.rows.get(0) {
            let deviation_mm = tolerance_norm(&(spot.position - row.chord.from), 1.0);
            if deviation_mm > EXACT_MM {
                let kind = ViolationKind::ExactStop { deviation_mm };
                self.violations.push(spot.tick, spot.line, kind);
            }
        }
        true
    }

    /// The end of the program must have been reached, exactly, unless the motion was ended.
    pub(crate) fn judge_end(&mut self, wanted: End) {
        let must = wanted == End::OfProgram;
        let Some(at) = self.at else {
            self.is_complete = self.rows.reach(0) == Presence::Never;
            if must && !self.is_complete {
                self.violations.push(0, 0, ViolationKind::Incomplete);
            }
            return;
        };
        let Some(end) = self.rows.end_position() else {
            self.is_complete = true;
            return;
        };
        let (tick, line) = self
            .history
            .back()
            .map_or((0, 0), |column| (column.tick, column.line));
        let is_reached =
            self.out_of_tolerance.is_none() && self.includes_end(&self.reach.clone(), &at);
        // Where the motion ends at the right place it is a question of deviation. One that was ended may
        // be at that place before the program's end: where it began, say.
        let is_there = tolerance_norm(&(at - end), 1.0) <= EXACT_MM;
        self.is_complete =
            is_reached || (must && is_there && self.widen(Goal::End) == Passage::Passed);
        if self.out_of_tolerance.is_some() {
            self.settle(if self.is_complete {
                Goal::End
            } else {
                Goal::Anything
            });
        } else if self.is_complete {
            self.note_deviation(self.lambda_mm, tick, line);
        }
        if !must {
            return;
        }
        if let Some(spot) = self.last_fed {
            self.note_rest(at, spot.tick.saturating_sub(self.since_tick));
            if self.is_complete {
                self.judge_dwell(self.reach.end().saturating_sub(1), &spot);
            }
        }
        if !self.is_complete {
            self.judge_missed_end((tick, line), &at, is_there);
        }
    }

    /// The motion rests somewhere, and not at the end of the program.
    fn judge_missed_end(&mut self, (tick, line): (u64, u32), at: &AxisVector, is_there: bool) {
        let last = self.reach.end().saturating_sub(1);
        let is_last = self.rows.reach(self.reach.end()) == Presence::Never;
        let row = self.rows.get(last);
        let line = row.map_or(line, |row| row.line);
        let missed = row.map(|row| (tolerance_norm(&(at - row.chord.to), 1.0), row.tolerance_mm));
        let kind = match missed {
            Some((deviation_mm, tolerance_mm))
                if is_last && !is_there && deviation_mm <= tolerance_mm =>
            {
                self.is_complete = true;
                ViolationKind::ExactStop { deviation_mm }
            }
            _ => ViolationKind::Incomplete,
        };
        self.violations.push(tick, line, kind);
    }

    /// Judges the path speed of the last column against its feed, mm/s, which is infinite on a rapid.
    pub(crate) fn judge_feed(&mut self, spot: &Spot, ticks: u64, feed_v: f64) {
        let Some(column) = self.history.back().filter(|_| feed_v > 0.0) else {
            return;
        };
        let ratio = self.speed_v(&column.chord, ticks) / (feed_v * self.feed_factor);
        if ratio > self.max_feed.ratio {
            self.max_feed = Worst {
                ratio,
                axis: None,
                tick: spot.tick,
                line: spot.line,
            };
        }
        if ratio > FEED_SLACK {
            let kind = ViolationKind::Feed { ratio };
            self.violations.push(spot.tick, spot.line, kind);
        }
    }

    /// Motion that the program does not ask for, at a sample that may be on the chords from `first`
    /// on.
    pub(crate) fn judge_tremor(
        &mut self,
        spot: &Spot,
        ticks: u64,
        rested_at: Option<AxisVector>,
        first: usize,
    ) {
        let rows = (first..self.reach.end()).filter_map(|index| self.rows.get(index));
        let mut rows = rows.peekable();
        let (Some(&row), Some(column)) = (rows.peek().copied(), self.history.back()) else {
            return;
        };
        if self.out_of_tolerance.is_some() {
            self.still.lose(spot.tick);
            self.cruise.lose();
            self.slow_down.lose();
            return;
        }
        let speed_v = self.speed_v(&column.chord, ticks);
        let mut place = MatchedSample {
            tick: spot.tick,
            line: spot.line,
            position: spot.position,
            ticks,
            is_between_frames: spot.is_between_frames,
            rested_at,
            still: row.piece.still,
            level: row.chord.from,
            piece: Some(row.piece),
            speed_v,
            feed_v: row.feed_v,
        };
        let mut number = row.piece.number;
        for row in rows {
            if row.piece.number == number {
                continue;
            }
            number = row.piece.number;
            place.piece = None;
            for (still, here) in place.still.iter_mut().zip(row.piece.still) {
                *still &= here;
            }
        }
        self.still.next(&place, &mut self.tremors);
        self.cruise.next(&place, &mut self.tremors);
        self.slow_down.next(&place, &mut self.tremors);
    }

    pub(crate) fn is_reached(&mut self, goal: Goal, reach: &Reach) -> bool {
        let Some(at) = self.history.back().map(|column| column.chord.to) else {
            return true;
        };
        match goal {
            Goal::Anything => true,
            Goal::WithinTolerance => self.count_within_tolerance(reach, &at) > 0,
            Goal::End => self.includes_end(reach, &at),
        }
    }

    fn includes_end(&mut self, reach: &Reach, at: &AxisVector) -> bool {
        let last = reach.end().saturating_sub(1);
        let is_last = self.rows.reach(reach.end()) == Presence::Never;
        let Some(row) = self.rows.get(last) else {
            return false;
        };
        is_last
            && reach.get(last).high >= 1.0
            && tolerance_norm(&(at - row.chord.to), 1.0) <= EXACT_MM
    }

    /// Keeps in mind that the motion rested somewhere.
    pub(crate) fn note_rest(&mut self, at: AxisVector, rest_ticks: u64) {
        if rest_ticks > 0 {
            self.rests.push_back((at, rest_ticks));
        }
        if self.rests.len() > RESTS {
            self.rests.pop_front();
        }
    }

    /// Dwells at the ends of the chords from `first` on that have been left behind.
    pub(crate) fn judge_dwells(&mut self, first: usize, spot: &Spot) {
        for index in first..self.reach.low {
            self.judge_dwell(index, spot);
        }
    }

    /// The dwell at the end of a chord.
    pub(crate) fn judge_dwell(&mut self, index: usize, spot: &Spot) {
        let Some(row) = self.rows.get(index).filter(|row| row.dwell_t > 0.0) else {
            return;
        };
        let is_here = |at: &AxisVector| tolerance_norm(&(at - row.chord.to), 1.0) <= EXACT_MM;
        let ticks = self
            .rests
            .iter()
            .filter(|(at, _)| is_here(at))
            .map(|&(_, ticks)| ticks)
            .max();
        #[expect(
            clippy::cast_precision_loss,
            reason = "exact for two million years of ticks"
        )]
        let rested_t = ticks.unwrap_or(0) as f64 * self.period_t;
        // A dwell need not begin or end on the grid.
        let missing_t = row.dwell_t - rested_t;
        if missing_t > self.period_t {
            let line = row.line;
            self.violations
                .push(spot.tick, line, ViolationKind::Dwell { missing_t });
        }
    }

    /// Number of intervals of `reach` that are within tolerance at a position.
    pub(crate) fn count_within_tolerance(&self, reach: &Reach, at: &AxisVector) -> usize {
        (reach.low..reach.end())
            .filter(|&i| !self.within_tolerance(reach, i, at).is_empty())
            .count()
    }

    pub(crate) fn within_tolerance(
        &self,
        reach: &Reach,
        index: usize,
        at: &AxisVector,
    ) -> Interval {
        let Some(row) = self.rows.get(index) else {
            return Interval::EMPTY;
        };
        let level = Level::up_to(f64::INFINITY);
        let place = self.rows.place(at);
        let near = row.chord.near(&place, &level.along(row));
        reach.get(index).intersect(near)
    }

    /// Takes note of how far the direction of the tool is off.
    pub(crate) fn note_turn(&mut self, spot: &Spot) {
        let off_deg = self.off_way_deg(&spot.position).unwrap_or(0.0);
        if off_deg > self.max_turn.ratio {
            self.max_turn = Worst {
                ratio: off_deg,
                axis: None,
                tick: spot.tick,
                line: spot.line,
            };
        }
    }

    /// How far the direction of the tool is from the nearest of the program's that are in reach, degrees.
    fn off_way_deg(&self, at: &AxisVector) -> Option<f64> {
        let way = self.rows.place(at).way;
        let rows = (self.reach.low..self.reach.end()).filter_map(|index| {
            let (row, part) = (self.rows.get(index)?, self.reach.get(index));
            (row.turn.is_way && !part.is_empty()).then(|| row.chord.part(part).off_way_deg(&way))
        });
        rows.reduce(f64::min)
    }
}
