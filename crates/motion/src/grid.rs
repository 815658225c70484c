//! The period grid: what every frame has besides the state of the axes.
//!
//! Frames are numbered without gaps. An event that does not stop the motion is told with the frame
//! that ends its period, and with the time in it at which the motion is at its place: path positions
//! and speeds of both frames give that. Of more than a period carries, the others follow in the next
//! one; a rest lasts until all of them are told. Where the motion comes to rest, one frame still belongs to the block that led there: who stops at the
//! end of every block stops there by the plan itself, and what the next block tells has not been
//! told. Engines say what they pass and where they rest; the frames are made here, so that they
//! tell the same story whoever planned them.

use super::due_event::{Beside, DueEvent, PathPoint};
use super::rest::{Rest, RestKind};
use super::step::Step;
use glidepath_geometry::AxisVector;
use glidepath_program::{EVENTS_MOST, Event, Frame, FrameEvents, FrameFlags, ProgramLine};
use std::collections::VecDeque;

/// Makes frames, one for each period.
#[derive(Debug, Clone)]
pub(crate) struct FrameGrid {
    period_t: f64,
    sequence: u64,
    passing: Passing,
    /// Events that the motion comes to in this period.
    events: VecDeque<DueEvent>,
    /// Path position and speed of the last frame.
    before: PathPoint,
    /// Where the machine was then, and its velocity.
    last: [AxisVector; 2],
    /// Frames still to come at rest.
    rest: Option<Resting>,
    /// The motion has come to rest, and no frame has told it yet.
    arrives: bool,
    /// Where the machine rests, or was at rest last.
    position: AxisVector,
    path_s: f64,
}

/// What part of the program the motion is on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passing {
    pub line: ProgramLine,
    pub rapid: bool,
    /// It follows the spindle.
    pub synchronised: bool,
    /// Its feed is one per revolution.
    pub per_revolution: bool,
    /// The feed that the program asks for, mm/s; 0 in rapids.
    pub programmed_v: f64,
    /// The override it was planned with.
    pub planned_override: f64,
}

impl Passing {
    /// Before the first move.
    pub(crate) const NONE: Self = Self {
        line: ProgramLine::NONE,
        rapid: false,
        synchronised: false,
        per_revolution: false,
        programmed_v: 0.0,
        planned_override: 1.0,
    };
}

/// The motion at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moving {
    pub path_v: f64,
    pub path_s: f64,
    pub position: AxisVector,
    pub velocity: AxisVector,
    pub acceleration: AxisVector,
}

#[derive(Debug, Clone, Copy)]
struct Resting {
    frames: u64,
    /// How many of them still belong to the motion before.
    of_motion: u64,
    flags: FrameFlags,
    event: Option<Event>,
    line: ProgramLine,
}

impl FrameGrid {
    /// The grid of a machine at rest at `start`; the first frame says so.
    pub(crate) fn new(period_t: f64, start: AxisVector) -> Self {
        let first = Resting {
            frames: 1,
            of_motion: 0,
            flags: FrameFlags::FIRST,
            event: None,
            line: ProgramLine::NONE,
        };
        Self {
            period_t,
            sequence: 0,
            passing: Passing::NONE,
            events: VecDeque::new(),
            before: PathPoint { s: 0.0, v: 0.0 },
            last: [start, AxisVector::zeros()],
            rest: Some(first),
            arrives: false,
            position: start,
            path_s: 0.0,
        }
    }

    /// The motion comes to another part of the program, whose events happen at a path position.
    pub(crate) fn enter(&mut self, passing: Passing, events: &[Event], at_s: f64) {
        self.extend(events, at_s, None);
        self.passing = passing;
    }

    /// Events that happen where the motion is nearest to a place, about a path position.
    pub(crate) fn announce(&mut self, events: &[Event], at_s: f64, beside: Beside) {
        self.extend(events, at_s, Some(beside));
    }

    fn extend(&mut self, events: &[Event], at_s: f64, beside: Option<Beside>) {
        let due = events.iter().map(|event| DueEvent {
            event: *event,
            at_s,
            beside,
        });
        self.events.extend(due);
    }

    /// The motion goes on within that part, at a place with another line or override.
    pub(crate) const fn pass(&mut self, passing: Passing) {
        self.passing = passing;
    }

    /// The line passed last.
    pub(crate) const fn line(&self) -> ProgramLine {
        self.passing.line
    }

    /// A frame of another grid as the next of this one; its path position is kept.
    pub(crate) const fn relay(&mut self, frame: Frame) -> Frame {
        self.passing.line = frame.program_line();
        self.passing.planned_override = frame.planned_override;
        self.arrives = false;
        self.last = [frame.position, frame.velocity];
        self.before = PathPoint {
            s: frame.path_s,
            v: frame.path_v,
        };
        let sequence = self.sequence;
        self.sequence += 1;
        Frame { sequence, ..frame }
    }

    /// The motion comes to rest.
    pub(crate) const fn leave(&mut self, position: AxisVector, path_s: f64) {
        self.position = position;
        self.path_s = path_s;
        self.arrives = true;
    }

    /// Where the machine rests is 0 from now on.
    pub(crate) fn count_from_here(&mut self) {
        for due in &mut self.events {
            due.at_s = 0.0;
        }
        self.path_s = 0.0;
        self.before = PathPoint { s: 0.0, v: 0.0 };
    }

    /// Sets up the frames of a rest; false if it has none.
    pub(crate) fn enter_rest(&mut self, rest: Rest) -> bool {
        // Events of the motion that still wait happen first, from its end on.
        let waiting = self.events.len().div_ceil(EVENTS_MOST) as u64;
        let of_motion = waiting.max(u64::from(self.arrives));
        let resting = |frames, flags, event| Resting {
            frames,
            of_motion,
            flags,
            event,
            line: rest.line,
        };
        let at_rest = FrameFlags::EXACT_STOP;
        let resting = match rest.kind {
            RestKind::Corner => return false,
            RestKind::ExactStop => resting(1 + waiting, at_rest, None),
            RestKind::Dwell(dwell_t) => {
                let frames = 1 + waiting + self.periods(dwell_t);
                resting(frames, FrameFlags::DWELL, None)
            }
            RestKind::Event(event @ (Event::ProgramStop(_) | Event::OptionalStop)) => {
                let flags = at_rest.with(FrameFlags::PROGRAM_STOP);
                resting(1 + of_motion, flags, Some(event))
            }
            RestKind::Event(event) => resting(1 + of_motion, at_rest, Some(event)),
            RestKind::End => resting(1 + waiting, FrameFlags::LAST, None),
        };
        self.rest = Some(resting);
        true
    }

    /// Whole periods that a time takes.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a float to integer cast saturates, and the time is not negative"
    )]
    fn periods(&self, time_t: f64) -> u64 {
        (time_t / self.period_t - 1e-9).ceil().max(0.0) as u64
    }

    /// The next frame at rest, if the machine rests.
    pub(crate) fn rest_frame(&mut self) -> Option<Frame> {
        let resting = self.rest.as_mut()?;
        if resting.frames == 0 {
            self.rest = None;
            return None;
        }
        resting.frames -= 1;
        let is_of_motion = resting.of_motion > 0;
        resting.of_motion = resting.of_motion.saturating_sub(1);
        let resting = *resting;
        self.arrives = false;
        let last = resting.frames == 0;
        let to = PathPoint {
            s: self.path_s,
            v: 0.0,
        };
        self.last = [self.position, AxisVector::zeros()];
        let mut events = self.events_up_to(to, None);
        if let Some(event) = resting.event.filter(|_| last) {
            let _has_room = events.push(event, self.period_ns());
        }
        // The end and the wait for the operator come when nothing is left to happen before them.
        let is_final = FrameFlags::PROGRAM_STOP.with(FrameFlags::LAST).0;
        let flags = if !last && resting.flags.0 & is_final != 0 {
            FrameFlags::EXACT_STOP
        } else {
            resting.flags
        };
        if resting.line != ProgramLine::NONE && !is_of_motion {
            self.passing.line = resting.line;
        }
        let at_rest = Moving {
            path_v: 0.0,
            path_s: self.path_s,
            position: self.position,
            velocity: AxisVector::zeros(),
            acceleration: AxisVector::zeros(),
        };
        Some(self.frame(&at_rest, flags, events))
    }

    /// The next frame of a motion.
    pub(crate) fn motion_frame(&mut self, moving: &Moving) -> Frame {
        let flags = if self.passing.rapid {
            FrameFlags::RAPID
        } else if self.passing.synchronised {
            FrameFlags::SYNC
        } else if self.passing.per_revolution {
            FrameFlags::PER_REV
        } else {
            FrameFlags::default()
        };
        self.arrives = false;
        let to = PathPoint {
            s: moving.path_s,
            v: moving.path_v,
        };
        let events = if self.events.is_empty() {
            self.before = to;
            FrameEvents::NONE
        } else {
            let step = Step {
                from: self.last,
                to: [moving.position, moving.velocity],
                period_t: self.period_t,
            };
            self.events_up_to(to, Some(&step))
        };
        self.last = [moving.position, moving.velocity];
        self.frame(moving, flags, events)
    }

    /// The events of the period that ends at a point, as many as it carries; at rest, where there is no step,
    /// those of a place further on, too, which rounding may have left.
    fn events_up_to(&mut self, to: PathPoint, step: Option<&Step>) -> FrameEvents {
        let before = core::mem::replace(&mut self.before, to);
        let mut events = FrameEvents::NONE;
        let period_ns = self.period_ns();
        let mut offset_ns = 0;
        for _ in 0..EVENTS_MOST {
            let Some(due) = self.events.front() else {
                break;
            };
            let Some(part) = due.part(before, to, step, self.period_t) else {
                break;
            };
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a part of the period, which is a second at most"
            )]
            let at_ns = (part * f64::from(period_ns)).round() as u32;
            offset_ns = offset_ns.max(at_ns);
            let _has_room = events.push(due.event, offset_ns);
            self.events.pop_front();
        }
        events
    }

    /// The period, ns.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a second at most"
    )]
    fn period_ns(&self) -> u32 {
        (self.period_t * 1e9).round() as u32
    }

    const fn frame(&mut self, state: &Moving, flags: FrameFlags, events: FrameEvents) -> Frame {
        let sequence = self.sequence;
        self.sequence += 1;
        Frame {
            sequence,
            line: self.passing.line.number,
            block: self.passing.line.block,
            flags,
            events,
            planned_override: self.passing.planned_override,
            path_v: state.path_v,
            path_s: state.path_s,
            programmed_v: if state.path_v > 0.0 {
                self.passing.programmed_v
            } else {
                0.0
            },
            position: state.position,
            velocity: state.velocity,
            acceleration: state.acceleration,
        }
    }
}
