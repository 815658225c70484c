//! The retrace: going back along the path, and onward again over what was passed.
//!
//! A plan that keeps the limits keeps them when it is played from its end to its beginning:
//! velocity and jerk change their signs, acceleration does not. So there is no second way of
//! playing. The way back is a track of its own, of frames that were passed, in the reverse order
//! and with the signs changed; the rate of program time, its ramps and its stop in reserve know
//! nothing of it.
//!
//! ```text
//!              kept                        window
//!  floor ───────────────────── now ───────────────── taken     the program's frames
//!    ▲                          │
//!    └──────────────────────────┘  mirrored, as far as is needed: the way back
//! ```
//!
//! The motion turns at rest only. Program time t of the program is M - t on the way back, with M
//! larger than any number of a frame, so that no number means two things.
//!
//! **How far.** Not past what cannot be done again or taken back: the beginning of the epoch, a
//! pass of a thread, a search for a contact, a code that was waited for, a change of tools, a code
//! of the machine's own ([`is_barrier`]). And not further than the frames that are kept.
//!
//! **What happens on the way.** Nothing: spindle, coolant and outputs stay as they are. Onward
//! again, what has happened does not happen again, up to where the motion turned first; from there
//! on all is as if it had never turned. In particular the setpoints of a steady rate of 1 are the
//! frames, bit for bit, on all three ways.

use crate::real_time::limited_joints::LimitedJoints;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::track::Track;
use crate::shared::m_code_waits::MCodeWaits;
use crate::shared::track_capacity::TRACK_CAPACITY;
use glidepath_link::SetpointFrame;
use glidepath_program::{Event, FrameFlags, Limits};

/// Frames that are taken in one tick, as from a planner.
const FRAMES_PER_TICK: usize = 8;

/// Program time M of the program is 0 on the way back.
const MIRROR: u64 = 1 << 62;

/// A time of the program on the way back, and the other way round.
pub(crate) fn mirrored(time: ProgramTime) -> ProgramTime {
    if time.fraction > 0.0 {
        ProgramTime {
            sequence: MIRROR - time.sequence - 1,
            fraction: 1.0 - time.fraction,
        }
        .normal()
    } else {
        ProgramTime::at(MIRROR - time.sequence)
    }
}

/// The frames of the way back, while the motion goes there.
#[derive(Debug)]
pub(crate) struct Retrace {
    /// The track that is not played: that of the way back while the motion goes onward, that of the
    /// program while it goes back.
    other: Track,
    /// The first frame to which the motion may come back.
    floor: u64,
    /// After the last frame that was taken from the planner; means something while the motion goes
    /// through frames that are kept.
    taken: u64,
    /// What happens at the frames before this has happened.
    happened: u64,
    /// The next frame of the way back; none if it ends with the one before.
    next: Option<u64>,
}

impl Retrace {
    pub(crate) fn new(period_t: f64, limits: (&Limits, Option<LimitedJoints>)) -> Self {
        Self {
            other: Track::new(period_t, limits, MCodeWaits::NONE, TRACK_CAPACITY),
            floor: 0,
            taken: 0,
            happened: 0,
            next: None,
        }
    }

    /// An epoch begins at a frame.
    pub(crate) const fn begin_at(&mut self, sequence: u64) {
        self.floor = sequence;
        self.happened = sequence;
    }

    /// The motion turns back, at rest at a time of the program. Returns the time on the way back;
    /// none, and nothing is changed, if there is no way.
    pub(crate) fn turn_back(
        &mut self,
        track: &mut Track,
        now: ProgramTime,
        is_again: bool,
    ) -> Option<ProgramTime> {
        if !is_again {
            self.taken = track.end();
        }
        self.floor = self.floor.max(self.taken.saturating_sub(track.kept()));
        let first = now.sequence + u64::from(now.fraction > 0.0);
        let ends_here = |track: &Track| {
            let frame = track.kept_frame(now.sequence);
            frame.is_none_or(|frame| is_barrier(frame, track.m_code_waits()))
        };
        if now.fraction <= 0.0 && (now.sequence <= self.floor || ends_here(track)) {
            return None;
        }
        let stands_at_stop = track.program_stop() == Some(now.sequence);
        let happened = now.sequence + u64::from(!stands_at_stop);
        self.happened = self.happened.max(happened);
        core::mem::swap(track, &mut self.other);
        track.clear();
        self.push(track, first);
        self.next = Some(first - 1);
        Some(mirrored(now))
    }

    /// The motion turns onward again, at rest at a time of the way back. Returns that of the
    /// program.
    pub(crate) fn turn_onward(&mut self, track: &mut Track, now: ProgramTime) -> ProgramTime {
        let time = mirrored(now);
        core::mem::swap(track, &mut self.other);
        track.clear();
        self.take_again(track, time.sequence);
        time
    }

    /// The epoch ends, on the way back: the program's track is the one that is played again.
    pub(crate) fn leave(&mut self, track: &mut Track) {
        core::mem::swap(track, &mut self.other);
    }

    /// Takes frames of the way back. Returns whether it ends with those that were taken.
    pub(crate) fn go_back(&mut self, track: &mut Track) -> bool {
        for _ in 0..FRAMES_PER_TICK {
            let Some(next) = self.next.filter(|_| !track.is_full()) else {
                break;
            };
            let frame = self.other.kept_frame(next);
            let is_end = next <= self.floor
                || frame.is_none_or(|frame| is_barrier(frame, self.other.m_code_waits()));
            if is_end {
                self.floor = next;
            }
            self.push(track, next);
            self.next = (!is_end).then(|| next - 1);
        }
        self.next.is_none()
    }

    fn push(&self, track: &mut Track, sequence: u64) {
        if let Some(frame) = self.other.kept_frame(sequence) {
            track.push_at(MIRROR - sequence, &back(frame));
        }
    }

    /// Takes frames of the way onward that were taken before. Returns whether that was all of them.
    pub(crate) fn go_onward(&self, track: &mut Track) -> bool {
        for _ in 0..FRAMES_PER_TICK {
            if track.is_full() || track.end() >= self.taken {
                break;
            }
            self.take_again(track, track.end());
        }
        track.end() >= self.taken
    }

    fn take_again(&self, track: &mut Track, sequence: u64) {
        if sequence < self.happened {
            track.silence(sequence);
        }
        track.own(sequence);
    }

    /// The program's frame at or before a time of the way back.
    pub(crate) fn frame_at(&self, now: ProgramTime) -> Option<&SetpointFrame> {
        self.other.kept_frame(mirrored(now).sequence)
    }
}

/// A frame as it is on the way back.
fn back(frame: &SetpointFrame) -> SetpointFrame {
    let flags = FrameFlags::FIRST
        .with(FrameFlags::LAST)
        .with(FrameFlags::PROGRAM_STOP);
    SetpointFrame {
        flags: frame.flags & !flags.0,
        event_count: 0,
        // Not negated: what is zero has no sign.
        path_v: 0.0 - frame.path_v,
        velocity: frame.velocity.map(|v| 0.0 - v),
        ..*frame
    }
}

/// Whether the motion does not go back past a frame, because what happened there cannot be done
/// again, or taken back.
fn is_barrier(frame: &SetpointFrame, m_code_waits: &MCodeWaits) -> bool {
    if frame.has(FrameFlags::FIRST) || frame.has(FrameFlags::SYNC) {
        return true;
    }
    match frame.event() {
        Ok(Some(Event::MCode(code))) => !is_plain(code) || m_code_waits.of(code).is_some(),
        Ok(Some(
            Event::Probe { .. } | Event::Synchronise { .. } | Event::Tap { .. } | Event::Await(_),
        ))
        | Err(_) => true,
        Ok(_) => false,
    }
}

/// Codes of the spindle and of coolant, which leave things as the program wants them.
const fn is_plain(code: u32) -> bool {
    matches!(code, 3..=5 | 7..=9 | 52)
}
