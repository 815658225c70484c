//! Sampling: settled motion to frames on the period grid.
//!
//! The grid runs on through every phase, piece and run: each stretch of motion starts a fraction of
//! a period before its first frame, and that fraction is carried, never rounded. Times and positions
//! are kept relative to the stretch, so a long program loses no digits.

use crate::piece::{Piece, Rest, RestKind};
use crate::run::Leg;
use crate::schedule::Settled;
use crate::{Event, Frame, FrameFlags};
use glidepath_geometry::AxisVector;
use std::collections::VecDeque;

/// Makes frames of settled motion, one at a time.
#[derive(Debug)]
pub(crate) struct Sampler {
    period_t: f64,
    sequence: u64,
    /// Time from the start of the stretch at hand to its first frame, 0 < t ≤ period.
    first_frame_t: f64,
    stretch: Option<Stretch>,
    /// Frames still to come at rest.
    rest: Option<Resting>,
    events: VecDeque<Event>,
    /// Where the last stretch ended.
    position: AxisVector,
    path_s: f64,
    line: u32,
    planned_override: f64,
    /// Speed at the end of the last stretch.
    speed_v: f64,
}

/// What comes next.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "nearly every step is a frame")]
pub(crate) enum Step {
    Frame(Frame),
    /// The next stretch; only if asked to stop there.
    Junction,
    /// Nothing more is settled.
    End,
}

#[derive(Debug)]
struct Stretch {
    pieces: Vec<Piece>,
    legs: Vec<Leg>,
    leg: usize,
    piece: usize,
    /// Where the piece at hand starts.
    piece_s: f64,
    /// Frames made since the leg at hand started.
    frames: u32,
}

#[derive(Debug, Clone, Copy)]
struct Resting {
    frames: u64,
    flags: FrameFlags,
    event: Option<Event>,
    line: u32,
}

impl Stretch {
    /// Position and speed of the last frame, if it is in the cruise of a stretch of one piece.
    fn cruise(&self, first_frame_t: f64, period_t: f64) -> Option<(f64, f64)> {
        let ([_], [leg]) = (self.pieces.as_slice(), self.legs.as_slice()) else {
            return None;
        };
        let t = first_frame_t + f64::from(self.frames.checked_sub(1)?) * period_t;
        let is_cruise = leg.profile.cruise_t().contains(&t);
        is_cruise.then(|| (leg.profile.at(t).position_s, leg.profile.peak_v()))
    }
}

impl Sampler {
    pub(crate) fn new(period_t: f64, start: AxisVector) -> Self {
        let first = Resting {
            frames: 1,
            flags: FrameFlags::FIRST,
            event: None,
            line: 0,
        };
        Self {
            period_t,
            sequence: 0,
            first_frame_t: period_t,
            stretch: None,
            rest: Some(first),
            events: VecDeque::new(),
            position: start,
            path_s: 0.0,
            line: 0,
            planned_override: 1.0,
            speed_v: 0.0,
        }
    }

    /// The next frame, as far as the motion is settled. With `pause`, stops at the next junction.
    pub(crate) fn next_frame(&mut self, settled: &mut VecDeque<Settled>, pause: bool) -> Step {
        loop {
            if let Some(resting) = &mut self.rest {
                if resting.frames > 0 {
                    resting.frames -= 1;
                    let resting = *resting;
                    return Step::Frame(self.rest_frame(resting));
                }
                self.rest = None;
            }
            if self.stretch.is_some() {
                if let Some(frame) = self.motion_frame() {
                    return Step::Frame(frame);
                }
                self.stretch = None;
                if pause {
                    return Step::Junction;
                }
            }
            match settled.pop_front() {
                Some(Settled::Motion { pieces, legs }) => {
                    self.stretch = Some(Stretch {
                        pieces,
                        legs,
                        leg: 0,
                        piece: 0,
                        piece_s: 0.0,
                        frames: 0,
                    });
                    self.enter_piece();
                }
                Some(Settled::Rest(rest)) => {
                    self.speed_v = 0.0;
                    self.enter_rest(rest);
                }
                None => return Step::End,
            }
        }
    }

    /// The speed at which the motion can be planned anew from where the last frame is, if it has no
    /// acceleration along the path there: at a junction, at rest, or cruising along a single piece.
    pub(crate) fn steady_v(&self) -> Option<f64> {
        match &self.stretch {
            None => Some(self.speed_v),
            Some(stretch) => stretch
                .cruise(self.first_frame_t, self.period_t)
                .map(|(_, v)| v),
        }
    }

    /// What is left of the stretch at hand after the last frame, where it is cruising.
    pub(crate) fn rest_of_stretch(&self) -> Option<Piece> {
        let stretch = self.stretch.as_ref()?;
        let (s, _) = stretch.cruise(self.first_frame_t, self.period_t)?;
        Some(stretch.pieces.first()?.clone().after(s))
    }

    /// Gives up what [`Sampler::rest_of_stretch`] returned: it was planned anew.
    pub(crate) fn drop_stretch(&mut self) {
        if let Some(stretch) = self.stretch.take()
            && let Some((s, _)) = stretch.cruise(self.first_frame_t, self.period_t)
        {
            self.path_s += s;
            self.first_frame_t = self.period_t;
        }
    }

    fn enter_rest(&mut self, rest: Rest) {
        let resting = |frames, flags, event| Resting {
            frames,
            flags,
            event,
            line: rest.line,
        };
        let at_rest = FrameFlags::EXACT_STOP;
        let resting = match rest.kind {
            RestKind::Corner => return,
            RestKind::ExactStop => resting(1, at_rest, None),
            RestKind::Dwell(dwell_t) => resting(1 + self.periods(dwell_t), FrameFlags::DWELL, None),
            RestKind::Event(event @ (Event::ProgramStop(_) | Event::OptionalStop)) => {
                resting(1, at_rest.with(FrameFlags::PROGRAM_STOP), Some(event))
            }
            RestKind::Event(event) => resting(1, at_rest, Some(event)),
            RestKind::End => resting(1, FrameFlags::LAST, None),
        };
        // Events of the motion that still wait happen first.
        let frames = resting.frames + self.events.len() as u64;
        self.rest = Some(Resting { frames, ..resting });
        self.first_frame_t = self.period_t;
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

    fn rest_frame(&mut self, resting: Resting) -> Frame {
        let last = resting.frames == 0;
        let queued = self.events.pop_front();
        let event = queued.or(if last { resting.event } else { None });
        // The end and the wait for the operator come when nothing is left to happen before them.
        let is_final = FrameFlags::PROGRAM_STOP.with(FrameFlags::LAST).0;
        let flags = if queued.is_some() && resting.flags.0 & is_final != 0 {
            FrameFlags::EXACT_STOP
        } else {
            resting.flags
        };
        if resting.line > 0 {
            self.line = resting.line;
        }
        let frame = Frame {
            sequence: self.sequence,
            line: self.line,
            flags,
            event,
            planned_override: self.planned_override,
            path_v: 0.0,
            path_s: self.path_s,
            position: self.position,
            velocity: AxisVector::zeros(),
            acceleration: AxisVector::zeros(),
        };
        self.sequence += 1;
        frame
    }

    /// The next frame of the stretch, or `None` after setting up for the next one.
    fn motion_frame(&mut self) -> Option<Frame> {
        loop {
            let stretch = self.stretch.as_ref()?;
            let Some(leg) = stretch.legs.get(stretch.leg).copied() else {
                self.leave_stretch();
                return None;
            };
            let t = self.first_frame_t + f64::from(stretch.frames) * self.period_t;
            if t < leg.profile.duration_t() {
                return self.frame_at(leg, t);
            }
            self.first_frame_t = (t - leg.profile.duration_t()).min(self.period_t);
            if let Some(stretch) = &mut self.stretch {
                stretch.leg += 1;
                stretch.frames = 0;
            }
        }
    }

    fn frame_at(&mut self, leg: Leg, t: f64) -> Option<Frame> {
        let state = leg.profile.at(t);
        let s = leg.from_s + state.position_s;
        loop {
            let stretch = self.stretch.as_ref()?;
            let piece = stretch.pieces.get(stretch.piece)?;
            let last = stretch.piece + 1 == stretch.pieces.len();
            if last || s < stretch.piece_s + piece.length_s {
                break;
            }
            self.leave_piece();
        }
        let stretch = self.stretch.as_mut()?;
        stretch.frames += 1;
        let piece = stretch.pieces.get(stretch.piece)?;
        let jet = piece.jet(s - stretch.piece_s);
        let (v, a) = (state.speed_v, state.accel_a);
        let frame = Frame {
            sequence: self.sequence,
            line: piece.line,
            flags: if piece.rapid {
                FrameFlags::RAPID
            } else {
                FrameFlags::default()
            },
            event: self.events.pop_front(),
            planned_override: piece.planned_override(),
            path_v: v,
            path_s: self.path_s + (s - stretch.piece_s),
            position: jet.position,
            velocity: jet.d1 * v,
            acceleration: jet.d2 * (v * v) + jet.d1 * a,
        };
        self.sequence += 1;
        Some(frame)
    }

    /// Goes on to the next piece of the stretch.
    fn leave_piece(&mut self) {
        if let Some(stretch) = &mut self.stretch
            && let Some(piece) = stretch.pieces.get(stretch.piece)
        {
            stretch.piece_s += piece.length_s;
            stretch.piece += 1;
            self.path_s += piece.length_s;
        }
        self.enter_piece();
    }

    fn enter_piece(&mut self) {
        if let Some(stretch) = &self.stretch
            && let Some(piece) = stretch.pieces.get(stretch.piece)
        {
            self.events.extend(piece.events.iter().copied());
            self.line = piece.line;
            self.planned_override = piece.planned_override();
        }
    }

    /// Passes the pieces that no frame fell on, and notes where the stretch ends.
    fn leave_stretch(&mut self) {
        while let Some(stretch) = &self.stretch
            && stretch.piece + 1 < stretch.pieces.len()
        {
            self.leave_piece();
        }
        if let Some(stretch) = &self.stretch
            && let Some(piece) = stretch.pieces.last()
        {
            self.speed_v = stretch.legs.last().map_or(0.0, |leg| leg.profile.exit_v());
            self.position = piece.jet(piece.length_s).position;
            self.path_s += piece.length_s;
        }
    }
}
