//! The track: the frames that the real-time thread owns, and the motion through them
//! ([`between_frames`]).
//!
//! ```text
//! kept │ oldest … now … newest │ free              a ring over sequence numbers
//! ```
//!
//! Frames that were given back are kept as long as there is room: the motion may come back to them.
//!
//! Some of them hold the motion ([`holding_frames`]).

mod between_frames;
mod holding_frames;

use crate::real_time::limited_joints::{JointTrack, LimitedJoints};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::quintic::Quintic;
use crate::real_time::stop_time::{StopLimits, StopTime};
use crate::shared::m_code_waits::MCodeWaits;
use crate::shared::rest::is_at_rest;
use crate::shared::track_capacity::TRACK_CAPACITY;
use glidepath_link::SetpointFrame;
use glidepath_program::{FrameFlags, Limits};

/// The owned frames of one epoch. Sequences are consecutive.
#[derive(Debug)]
pub(crate) struct Track {
    /// Also those before the oldest that were not yet written over: a power of two.
    frames: Box<[SetpointFrame]>,
    /// In the slot of a frame: the motion from it to the next.
    quintics: Box<[Quintic]>,
    stop_times: Box<[StopTime]>,
    oldest: u64,
    len: usize,
    /// The first program stop not yet passed.
    program_stop: Option<u64>,
    /// The first frame not yet passed whose event is to be answered before the motion goes on.
    m_code_wait: Option<u64>,
    /// A frame at rest that motion may not pass.
    barrier: Option<u64>,
    /// The end of a block, at rest, at which the operator wants to stand.
    block_end: Option<u64>,
    period_t: f64,
    limits: StopLimits,
    /// Where joints are not the axes, these along the frames, and what limits their stops.
    joints: Option<(JointTrack, StopLimits)>,
    m_code_waits: MCodeWaits,
}

impl Track {
    /// An empty track that keeps at least so many frames. Allocates all it will ever use.
    pub(crate) fn new(
        period_t: f64,
        (limits, joints): (&Limits, Option<LimitedJoints>),
        m_code_waits: MCodeWaits,
        kept: usize,
    ) -> Self {
        let kept = kept.max(TRACK_CAPACITY).next_power_of_two();
        let blank = <SetpointFrame as bytemuck::Zeroable>::zeroed();
        let quintic = Quintic::zeros();
        Self {
            frames: vec![blank; kept].into_boxed_slice(),
            quintics: vec![quintic; TRACK_CAPACITY].into_boxed_slice(),
            stop_times: vec![StopTime::default(); TRACK_CAPACITY].into_boxed_slice(),
            oldest: 0,
            len: 0,
            program_stop: None,
            m_code_wait: None,
            barrier: None,
            block_end: None,
            period_t,
            limits: StopLimits::new(limits),
            joints: joints.map(|joints| {
                let limits = StopLimits::new(&joints.limits);
                (JointTrack::new(joints, TRACK_CAPACITY), limits)
            }),
            m_code_waits,
        }
    }

    #[allow(clippy::cast_possible_truncation, reason = "the capacity is small")]
    const fn slot(sequence: u64) -> usize {
        (sequence % TRACK_CAPACITY as u64) as usize
    }

    /// Where a frame is, in the ring of those that are kept, too.
    #[allow(clippy::cast_possible_truncation, reason = "it is masked")]
    const fn place(&self, sequence: u64) -> usize {
        sequence as usize & (self.frames.len() - 1)
    }

    /// Most frames that are kept.
    pub(crate) const fn kept(&self) -> u64 {
        self.frames.len() as u64
    }

    /// Owns nothing any more.
    pub(crate) const fn clear(&mut self) {
        self.len = 0;
        self.program_stop = None;
        self.m_code_wait = None;
        self.barrier = None;
        self.block_end = None;
    }

    pub(crate) const fn is_full(&self) -> bool {
        self.len == TRACK_CAPACITY
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Between two frames, s.
    pub(crate) const fn period_t(&self) -> f64 {
        self.period_t
    }

    /// The next frame at rest, of the two behind a time.
    pub(crate) fn rest_behind(&self, time: ProgramTime) -> Option<u64> {
        (time.sequence + 1..=time.sequence + 2).find(|&s| self.frame(s).is_some_and(is_at_rest))
    }

    /// Appends a frame. Only called with room, and with the sequence after the newest.
    pub(crate) fn push(&mut self, frame: &SetpointFrame) {
        self.push_at(frame.sequence, frame);
    }

    /// Appends a frame under another sequence: the one after the newest.
    pub(crate) fn push_at(&mut self, sequence: u64, frame: &SetpointFrame) {
        let place = self.place(sequence);
        if let Some(slot) = self.frames.get_mut(place) {
            slot.copy_used(frame);
            self.own(sequence);
        }
    }

    /// Appends a frame that is kept: the one after the newest, or any if there is none.
    pub(crate) fn own(&mut self, sequence: u64) {
        let (place, before) = (self.place(sequence), self.place(sequence.wrapping_sub(1)));
        let Some(frame) = self.frames.get(place) else {
            return;
        };
        let is_first = self.is_empty();
        if is_first {
            self.oldest = sequence;
        } else if let (Some(previous), Some(quintic)) = (
            self.frames.get(before),
            self.quintics.get_mut(Self::slot(sequence.wrapping_sub(1))),
        ) {
            quintic.set_between(previous, frame, self.period_t);
        }
        self.len += 1;
        let mut stop_time = self.limits.stop_time(&frame.velocity, self.period_t);
        if let Some((joints, limits)) = &mut self.joints {
            let before = (!is_first).then(|| Self::slot(sequence.wrapping_sub(1)));
            let velocity = joints.own(frame, Self::slot(sequence), before, self.period_t);
            let of_joints = limits.stop_time(velocity.as_slice(), self.period_t);
            stop_time = stop_time.longer(of_joints);
        }
        if let Some(slot) = self.stop_times.get_mut(Self::slot(sequence)) {
            *slot = stop_time;
        }
        if is_at_rest(frame) {
            self.barrier = Some(sequence);
        }
        if self.program_stop.is_none() && frame.has(FrameFlags::PROGRAM_STOP) {
            self.program_stop = Some(sequence);
        }
        if self.m_code_wait.is_none() && self.m_code_waits.of_frame(frame).is_some() {
            self.m_code_wait = Some(sequence);
        }
    }

    /// A frame that is kept, if nothing was written over it, and for whoever knows that it is.
    pub(crate) fn kept_frame(&self, sequence: u64) -> Option<&SetpointFrame> {
        self.frames.get(self.place(sequence))
    }

    /// What happened at a frame that is kept does not happen again.
    pub(crate) fn silence(&mut self, sequence: u64) {
        let place = self.place(sequence);
        if let Some(frame) = self.frames.get_mut(place) {
            frame.event_count = 0;
            frame.flags &= !FrameFlags::PROGRAM_STOP.0;
        }
    }

    /// Gives the slots of all frames before one back.
    pub(crate) fn release_before(&mut self, sequence: u64) {
        while self.len > 1 && self.oldest < sequence {
            self.oldest += 1;
            self.len -= 1;
        }
    }

    pub(crate) fn frame(&self, sequence: u64) -> Option<&SetpointFrame> {
        let offset = sequence.checked_sub(self.oldest)?;
        if offset < self.len as u64 {
            self.frames.get(self.place(sequence))
        } else {
            None
        }
    }

    pub(crate) fn newest(&self) -> Option<&SetpointFrame> {
        self.frame(self.oldest + (self.len as u64).checked_sub(1)?)
    }

    /// Sequence after the newest frame's.
    pub(crate) const fn end(&self) -> u64 {
        self.oldest + self.len as u64
    }

    /// The longest of the stop times of up to `count` frames from one on.
    pub(crate) fn longest_stop(&self, from: u64, count: u64) -> StopTime {
        (from.max(self.oldest)..self.end().min(from + count))
            .filter_map(|sequence| self.stop_times.get(Self::slot(sequence)))
            .fold(StopTime::default(), |longest, at| longest.longer(*at))
    }
}

#[cfg(test)]
mod tests;
