//! The gathering of items: items in, checked; stretches and rests out, in order.

use super::tight_arcs::has_tight_arcs;
use crate::PlanError;
use crate::intake::{Intake, check_dwell};
use crate::on_path::is_exact_corner;
use crate::programmed_rate::{ProgrammedRate, axes_speed};
use crate::rest::{Rest, RestKind};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Event, Item, ItemKind, Override, PathMode, ProgramLine, Settings};
use std::collections::VecDeque;

/// The most moves of a stretch that is planned as a whole, with effort "optimal": so many may go in
/// before its first frame comes out.
pub const MOST_MOVES_AT_ONCE: usize = 32_768;
/// The longest such stretch, s at its rates: all of it is planned before its first frame is known.
const MOST_T: f64 = 5.0;
/// The same where moves come while the motion waits for them.
const MOST_OF_STREAM_T: f64 = 1.25;

/// What comes next.
#[derive(Debug, Clone)]
#[allow(
    clippy::large_enum_variant,
    reason = "most of them are items, as large as they are"
)]
pub(crate) enum Task {
    /// A stretch from rest to rest, time of its moves at their rates, s, and where the program is at
    /// its end.
    Whole {
        items: Vec<Item>,
        at_rates_t: f64,
        end: AxisVector,
    },
    /// A stretch that is planned as it comes begins, with tight arcs: its first items, and time of its moves at their
    /// rates, s.
    Begin {
        items: Vec<Item>,
        at_rates_t: f64,
    },
    /// The next item of a stretch that is planned as it comes.
    Part(Item),
    /// Such a stretch ends, where the program is.
    End(AxisVector),
    Rest(Rest),
}

/// Takes items and keeps what they ask for until it is done.
#[derive(Debug, Clone)]
pub(crate) struct Gathering {
    settings: Settings,
    intake: Intake,
    tasks: VecDeque<Task>,
    /// The stretch at hand, as long as it is short.
    gathered: Vec<Item>,
    /// Time of its moves at their rates, s, and the most.
    gathered_t: f64,
    most_t: f64,
    /// The stretch at hand is given on as it comes.
    is_long: bool,
    /// Events that wait for the move they happen on.
    events: Vec<(ProgramLine, Event)>,
    /// The last move, if it is to be passed exactly, and its rate, mm/s.
    exact: Option<(Segment, f64)>,
    last: ProgramLine,
    finished: bool,
}

impl Gathering {
    pub(crate) const fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            settings,
            intake: Intake::new(start),
            tasks: VecDeque::new(),
            gathered: Vec::new(),
            gathered_t: 0.0,
            most_t: MOST_T,
            is_long: false,
            events: Vec::new(),
            exact: None,
            last: ProgramLine::NONE,
            finished: false,
        }
    }

    /// Moves come while the motion waits for them.
    pub(crate) const fn set_stream(&mut self) {
        self.most_t = MOST_OF_STREAM_T;
    }

    /// What comes next, if it is known.
    pub(crate) fn next(&mut self) -> Option<Task> {
        self.tasks.pop_front()
    }

    /// Takes an item; changes nothing if it is refused.
    pub(crate) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        let line = item.program_line();
        match item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => {
                self.intake.check_move(line.number, &segment, rate, mode)?;
                let axes_v = axes_speed(&segment, &self.settings.limits);
                let rate_v = ProgrammedRate { rate, axes_v }.under(Override::NONE);
                let start = *self.intake.program_position();
                if let Some(taken) = self.intake.take(segment) {
                    self.stop_at_exact_corner(start, &taken, rate_v, mode);
                }
                let tolerance_mm = Some(mode.tolerance_mm(self.settings.tolerance_mm));
                let stops = mode == PathMode::ExactStop;
                let mode = if stops {
                    PathMode::Continuous { tolerance_mm }
                } else {
                    mode
                };
                let move_t = segment.length() / rate_v;
                let kind = ItemKind::Move {
                    segment,
                    rate,
                    mode,
                };
                self.push_move(line.item(kind), move_t);
                if stops {
                    self.end_stretch_here();
                    self.put_rest(RestKind::ExactStop, line);
                }
            }
            ItemKind::Dwell(dwell_t) => {
                check_dwell(line.number, dwell_t)?;
                self.rest(RestKind::Dwell(dwell_t), line);
            }
            ItemKind::Event(event) if event.is_at_rest() => {
                self.rest(RestKind::Event(event), line);
            }
            ItemKind::Event(event) => self.events.push((line, event)),
        }
        self.last = line;
        Ok(())
    }

    /// No more items: the path ends at rest.
    pub(crate) fn finish(&mut self) {
        if !core::mem::replace(&mut self.finished, true) {
            self.rest(RestKind::End, self.last);
        }
    }

    /// Ends the stretch where the path is to be passed exactly and does not go straight on: there
    /// the motion rests, however it is planned.
    fn stop_at_exact_corner(
        &mut self,
        corner: AxisVector,
        next: &Segment,
        rate_v: f64,
        mode: PathMode,
    ) {
        if let Some((last, last_v)) = &self.exact
            && is_exact_corner(last, next, last_v.min(rate_v), &self.settings)
        {
            self.end_stretch(corner);
            self.put_rest(RestKind::ExactStop, self.last);
        }
        self.exact = (mode == PathMode::ExactPath).then_some((*next, rate_v));
    }

    fn push_move(&mut self, item: Item, move_t: f64) {
        for (line, event) in core::mem::take(&mut self.events) {
            self.put(line.item(ItemKind::Event(event)));
        }
        self.put(item);
        self.gathered_t += move_t;
        if !self.is_long
            && (self.gathered.len() > MOST_MOVES_AT_ONCE || self.gathered_t > self.most_t)
        {
            self.is_long = true;
            // What the motion waits for is not tried first.
            let is_stream = self.most_t < MOST_T;
            let is_tried = !is_stream && self.gathered.len() <= MOST_MOVES_AT_ONCE;
            if is_tried && has_tight_arcs(&self.gathered, &self.settings) {
                self.tasks.push_back(Task::Begin {
                    items: core::mem::take(&mut self.gathered),
                    at_rates_t: self.gathered_t,
                });
            } else {
                self.tasks.extend(self.gathered.drain(..).map(Task::Part));
            }
        }
    }

    fn put(&mut self, item: Item) {
        if self.is_long {
            self.tasks.push_back(Task::Part(item));
        } else {
            self.gathered.push(item);
        }
    }

    /// Ends the path at rest.
    fn rest(&mut self, kind: RestKind, line: ProgramLine) {
        self.end_stretch_here();
        for (_, event) in core::mem::take(&mut self.events) {
            self.put_rest(RestKind::Event(event), line);
        }
        self.put_rest(kind, line);
    }

    fn put_rest(&mut self, kind: RestKind, line: ProgramLine) {
        self.tasks.push_back(Task::Rest(Rest { kind, line }));
    }

    fn end_stretch_here(&mut self) {
        self.intake.make_up();
        self.end_stretch(*self.intake.position());
    }

    fn end_stretch(&mut self, end: AxisVector) {
        self.exact = None;
        let at_rates_t = core::mem::take(&mut self.gathered_t);
        if core::mem::replace(&mut self.is_long, false) {
            self.tasks.push_back(Task::End(end));
        } else if !self.gathered.is_empty() {
            let items = core::mem::take(&mut self.gathered);
            self.tasks.push_back(Task::Whole {
                items,
                at_rates_t,
                end,
            });
        }
    }
}
