//! The period grid: what every frame has besides the state of the axes.
//!
//! Frames are numbered without gaps. Events are told one a frame, in order, at the place where they
//! happen or as soon after it as there is a frame; a rest lasts until all of them are told. Where
//! the motion comes to rest, one frame still belongs to the block that led there: who stops at the
//! end of every block stops there by the plan itself, and what the next block tells has not been
//! told. Engines say what they pass and where they rest; the frames are made here, so that they
//! tell the same story whoever planned them.

use super::rest::{Rest, RestKind};
use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Frame, FrameFlags, ProgramLine};
use std::collections::VecDeque;

/// Makes frames, one for each period.
#[derive(Debug, Clone)]
pub(crate) struct FrameGrid {
    period_t: f64,
    sequence: u64,
    passing: Passing,
    events: VecDeque<Event>,
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
    pub(crate) const fn new(period_t: f64, start: AxisVector) -> Self {
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
            rest: Some(first),
            arrives: false,
            position: start,
            path_s: 0.0,
        }
    }

    /// The motion comes to another part of the program, whose events happen from now on.
    pub(crate) fn enter(&mut self, passing: Passing, events: &[Event]) {
        self.events.extend(events);
        self.passing = passing;
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
    pub(crate) const fn count_from_here(&mut self) {
        self.path_s = 0.0;
    }

    /// Sets up the frames of a rest; false if it has none.
    pub(crate) fn enter_rest(&mut self, rest: Rest) -> bool {
        // Events of the motion that still wait happen first, from its end on.
        let waiting = self.events.len() as u64;
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
        let queued = self.events.pop_front();
        let event = queued.or(if last { resting.event } else { None });
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
        Some(self.frame(&at_rest, flags, event))
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
        let event = self.events.pop_front();
        self.frame(moving, flags, event)
    }

    const fn frame(&mut self, state: &Moving, flags: FrameFlags, event: Option<Event>) -> Frame {
        let sequence = self.sequence;
        self.sequence += 1;
        Frame {
            sequence,
            line: self.passing.line.number,
            block: self.passing.line.block,
            flags,
            event,
            planned_override: self.passing.planned_override,
            path_v: state.path_v,
            path_s: state.path_s,
            position: state.position,
            velocity: state.velocity,
            acceleration: state.acceleration,
        }
    }
}
