//! The search for the level at which the last columns match, where the motion cannot be matched at
//! the present one.

use crate::column::{EXACT_MM, Level, Passage, step};
use crate::matching::{Matching, SHORT};
use crate::out_of_tolerance::{Goal, OutOfTolerance};
use crate::violation::ViolationKind;

/// Most chords the motion may be near to while it is out of tolerance.
const MAX_REACH: usize = 20_000;
/// Out of tolerance by more than this, the motion is lost, mm.
const MAX_FLOOR_MM: f64 = 1e4;

/// Cells worth spending, in all, on a motion that is out of tolerance; then it is lost.
const MAX_TROUBLE_CELLS: usize = 20_000_000;

/// Result of a search for a level.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Found {
    At(f64),
    Nowhere,
    NotYet,
}

/// How finely a level is searched, mm.
fn resolution(level_mm: f64) -> f64 {
    1e-7 + 2e-6 * level_mm
}

impl Matching {
    /// Runs through the history from column `from` on; what can be reached in the end is left in
    /// `scratch[0]`, and what could be at the start of the last column in `scratch[1]`.
    pub(crate) fn replay(&mut self, from: usize, level: &Level, goal: Goal) -> Passage {
        let [mut now, mut next] = core::mem::take(&mut self.scratch);
        let start = self.history.get(from).map(|column| &column.reach);
        now.clone_from(start.unwrap_or(&self.reach));
        let mut passage = Passage::Passed;
        for index in from..self.history.len() {
            if level.floor_mm > 0.0 {
                self.trouble_cells += now.intervals.len();
                if self.trouble_cells > MAX_TROUBLE_CELLS {
                    passage = Passage::Blocked;
                    break;
                }
            }
            let column = &self.history[index];
            passage = step(&mut self.rows, &now, &column.chord, level, &mut next);
            if passage != Passage::Passed {
                break;
            }
            core::mem::swap(&mut now, &mut next);
        }
        if passage == Passage::Passed && !self.is_reached(goal, &now) {
            passage = Passage::Blocked;
        }
        self.scratch = [now, next];
        passage
    }

    /// Runs through the history like [`Matching::replay`] and keeps what it finds on the way.
    fn replay_and_keep(&mut self, from: usize, level: &Level) {
        let [mut now, mut next] = core::mem::take(&mut self.scratch);
        if let Some(column) = self.history.get(from) {
            now.clone_from(&column.reach);
        }
        for index in from..self.history.len() {
            self.history[index].reach.clone_from(&now);
            let column = &self.history[index];
            if step(&mut self.rows, &now, &column.chord, level, &mut next) != Passage::Passed {
                break;
            }
            core::mem::swap(&mut now, &mut next);
        }
        self.scratch = [now, next];
    }

    /// The last column is blocked: finds what it takes to pass. On success the new state is in
    /// `scratch[0]`.
    pub(crate) fn widen(&mut self, goal: Goal) -> Passage {
        if let Some(out_of_tolerance) = self.out_of_tolerance {
            return self.widen_floor(out_of_tolerance.floor_mm, goal);
        }
        match self.widen_lambda(goal) {
            Found::At(lambda_mm) => {
                self.lambda_mm = lambda_mm;
                return Passage::Passed;
            }
            Found::NotYet => return Passage::NotYet,
            Found::Nowhere => {}
        }
        let cap = self.cap();
        let relaxed = |exact_mm| Level {
            exact_mm,
            ..Level::up_to(cap)
        };
        match self.search(0, EXACT_MM, cap, goal, relaxed) {
            Found::At(deviation_mm) => {
                self.replay_and_keep(0, &relaxed(deviation_mm));
                if let Some(column) = self.history.back() {
                    let (tick, line) = (column.tick, column.line);
                    let kind = ViolationKind::ExactStop { deviation_mm };
                    self.violations.push(tick, line, kind);
                    self.note_deviation(deviation_mm, tick, line);
                }
                // The stop counts as passed: no retry goes back beyond it.
                self.is_history_void = true;
                return Passage::Passed;
            }
            Found::NotYet => return Passage::NotYet,
            Found::Nowhere => {}
        }
        self.widen_floor(cap, goal)
    }

    /// The smallest λ that passes, over the last few columns if they suffice.
    fn widen_lambda(&mut self, goal: Goal) -> Found {
        let cap = self.cap();
        let level = Level::up_to;
        let short = self.history.len().saturating_sub(SHORT);
        let from = self.lambda_mm;
        let (mut start, mut found) = (short, self.search(short, from, cap, goal, level));
        // A slow motion needs more than the last columns. The full history is searched whenever the
        // level has risen by some percent since that was last done.
        let worth = 1.02 * self.searched_mm + 8.0 * resolution(self.searched_mm);
        let better = match found {
            Found::NotYet => return found,
            Found::At(lambda) => (lambda > worth).then(|| lambda - 2.0 * resolution(lambda)),
            Found::Nowhere => Some(cap),
        };
        if let Some(better) = better.filter(|&better| short > 0 && better > from) {
            match self.replay(0, &level(better), goal) {
                Passage::Passed => {
                    (start, found) = (0, self.search(0, from, better, goal, level));
                }
                Passage::Blocked => {}
                Passage::NotYet => return Found::NotYet,
            }
            self.searched_mm = better;
        }
        if let Found::At(lambda_mm) = found {
            self.replay_and_keep(start, &level(lambda_mm));
        }
        found
    }

    /// Follows a motion that is out of tolerance, however far.
    fn widen_floor(&mut self, from_mm: f64, goal: Goal) -> Passage {
        let mut floor_mm = from_mm;
        while floor_mm < MAX_FLOOR_MM {
            floor_mm *= 2.0;
            let level = Level {
                floor_mm,
                ..Level::up_to(self.cap())
            };
            match self.replay(0, &level, goal) {
                Passage::Passed if self.scratch[0].intervals.len() > MAX_REACH => break,
                Passage::Passed => {
                    let last = self.history.back();
                    let (tick, line) = last.map_or((0, 0), |column| (column.tick, column.line));
                    let begun = self.out_of_tolerance.unwrap_or(OutOfTolerance {
                        floor_mm,
                        tick,
                        line,
                    });
                    self.out_of_tolerance = Some(OutOfTolerance { floor_mm, ..begun });
                    return Passage::Passed;
                }
                Passage::Blocked => {}
                Passage::NotYet => return Passage::NotYet,
            }
        }
        Passage::Blocked
    }

    /// The smallest value in (`from`, `to`] at which the history from column `start` on can be
    /// passed, to [`resolution`]; `to` must be more than `from`.
    fn search(
        &mut self,
        start: usize,
        from: f64,
        to: f64,
        goal: Goal,
        level: impl Fn(f64) -> Level,
    ) -> Found {
        let mut low = from;
        let mut stride = resolution(from);
        let mut high = loop {
            let probe = (low + stride).min(to);
            match self.replay(start, &level(probe), goal) {
                Passage::Passed => break probe,
                Passage::Blocked if probe >= to => return Found::Nowhere,
                Passage::Blocked => (low, stride) = (probe, 3.0 * stride),
                Passage::NotYet => return Found::NotYet,
            }
        };
        while high - low > resolution(high) {
            let middle = 0.5 * (low + high);
            match self.replay(start, &level(middle), goal) {
                Passage::Passed => high = middle,
                Passage::Blocked => low = middle,
                Passage::NotYet => return Found::NotYet,
            }
        }
        Found::At(high)
    }

    /// What a motion that needed such a width was: off the path with its tip, or with its tool's direction alone.
    fn told_of(&mut self, deviation_mm: f64, goal: Goal) -> ViolationKind {
        let any_way = Level {
            any_way: true,
            ..Level::up_to(self.cap())
        };
        let turn = self.rows.get(self.reach.low).map(|row| row.turn);
        // Where the program has not been fed far enough, the tip has not left it.
        let is_tip = self.replay(0, &any_way, goal) == Passage::Blocked;
        match turn {
            Some(turn) if turn.is_way && !is_tip => ViolationKind::Direction {
                off_deg: deviation_mm / turn.mm_per_deg,
                allowed_deg: turn.along_deg,
            },
            _ => ViolationKind::Deviation { deviation_mm },
        }
    }

    /// The motion is back within tolerance, or at its end: reports how far off it was.
    pub(crate) fn settle(&mut self, goal: Goal) {
        let Some(OutOfTolerance {
            floor_mm,
            tick,
            line,
        }) = self.out_of_tolerance.take()
        else {
            return;
        };
        let cap = self.cap();
        let level = |floor_mm| Level {
            floor_mm,
            ..Level::up_to(cap)
        };
        let deviation_mm = match self.search(0, 0.0, floor_mm, goal, level) {
            Found::At(deviation_mm) => deviation_mm,
            Found::Nowhere | Found::NotYet => floor_mm,
        };
        let kind = self.told_of(deviation_mm, goal);
        self.replay_and_keep(0, &level(deviation_mm));
        self.violations.push(tick, line, kind);
        match kind {
            ViolationKind::Direction { off_deg, .. } => {
                self.max_turn.ratio = self.max_turn.ratio.max(off_deg);
                (self.max_turn.tick, self.max_turn.line) = (tick, line);
            }
            _ => self.note_deviation(deviation_mm, tick, line),
        }
        let Some(at) = self.at else { return };
        core::mem::swap(&mut self.reach, &mut self.scratch[0]);
        if goal == Goal::WithinTolerance {
            let low = self.reach.low;
            let within: Vec<_> = (low..self.reach.end())
                .map(|index| self.within_tolerance(&self.reach, index, &at))
                .collect();
            self.reach.intervals = within;
            self.reach.trim();
        }
        self.restart_history(at);
    }
}
