//! The track: the frames that the real-time thread owns, and the motion through them.
//!
//! Between two frames the motion of every axis is the quintic polynomial that has their position,
//! velocity and acceleration at both ends.
//!
//! ```text
//! kept │ oldest … now … newest │ free              a ring over sequence numbers
//! ```
//!
//! Frames that were given back are kept as long as there is room: the motion may come back to them.
//!
//! Four kinds of frames hold the motion: the next program stop, and the end of a block where the
//! plan rests, until the operator lets it pass, the next *M-code wait*, whose event is to be answered
//! first, and the *barrier*, the latest frame at rest, until it is known how to stop after it.
//! Program time stands there: everything later is evaluated as that frame.

use crate::differences::{Allowed, Differences, MachinePosition};
use crate::limited_joints::{JointTrack, LimitedJoints};
use crate::m_code_waits::{MCodeWait, MCodeWaits};
use crate::pairs::{larger, smaller};
use crate::program_time::ProgramTime;
use crate::quintic::{Kinematic, Quintic};
use crate::rest::is_at_rest;
use crate::stop_time::{StopLimits, StopTime};
use glidepath_geometry::AxisVector;
use glidepath_kinematics::JointVector;
use glidepath_link::SetpointFrame;
use glidepath_program::{FrameFlags, Limits};

/// Most frames that are owned at a time.
pub(crate) const TRACK_CAPACITY: usize = 512;

/// Path position and its rate by program time in periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathState {
    pub(crate) path_s: f64,
    pub(crate) path_v: f64,
}

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

    /// The first program stop that was not passed yet.
    pub(crate) const fn program_stop(&self) -> Option<u64> {
        self.program_stop
    }

    /// Where the motion is to wait next, for the operator or for an answer.
    pub(crate) fn waits_at(&self) -> Option<u64> {
        [self.program_stop, self.m_code_wait]
            .into_iter()
            .flatten()
            .min()
    }

    /// The frame at rest that motion may not pass.
    pub(crate) const fn barrier(&self) -> Option<u64> {
        self.barrier
    }

    /// Motion, at rest at a frame, may not pass it, or the barrier after it if there is one.
    pub(crate) fn bar(&mut self, sequence: u64) {
        self.barrier.get_or_insert(sequence);
    }

    /// Motion may pass the barrier.
    pub(crate) const fn unbar(&mut self) {
        self.barrier = None;
    }

    /// The first frame that holds the motion: program time stands there by itself.
    pub(crate) fn holding_frame(&self) -> Option<u64> {
        [
            self.program_stop,
            self.m_code_wait,
            self.barrier,
            self.block_end,
        ]
        .into_iter()
        .flatten()
        .min()
    }

    /// Holds the motion at a frame at rest because a block ends there, or nowhere for that.
    pub(crate) const fn hold_at_block_end(&mut self, block_end: Option<u64>) {
        self.block_end = block_end;
    }

    /// True where the plan itself is at rest.
    pub(crate) fn rests_at(&self, time: ProgramTime) -> bool {
        time.fraction <= 0.0 && self.frame(time.sequence).is_some_and(is_at_rest)
    }

    /// True if the motion comes to rest by itself on the frames at hand.
    pub(crate) fn ends_at_rest(&self) -> bool {
        self.program_stop.is_some()
            || self.m_code_wait.is_some()
            || self.newest().is_some_and(is_at_rest)
    }

    /// True if the last frame of the program is here.
    pub(crate) fn ends_at_last(&self) -> bool {
        self.newest()
            .is_some_and(|frame| frame.has(FrameFlags::LAST))
    }

    /// Lets motion pass the program stop it stands at, once it is known how to stop after it.
    pub(crate) fn pass_stop(&mut self) {
        let Some(passed) = self.program_stop else {
            return;
        };
        self.program_stop = (passed + 1..self.end()).find(|&s| {
            self.frame(s)
                .is_some_and(|f| f.has(FrameFlags::PROGRAM_STOP))
        });
        self.bar_from(passed);
    }

    /// The latest frame at rest, from one on, is the barrier.
    fn bar_from(&mut self, first: u64) {
        self.barrier = (first..self.end())
            .rev()
            .find(|&s| self.frame(s).is_some_and(is_at_rest));
    }

    /// What is waited for.
    pub(crate) const fn m_code_waits(&self) -> &MCodeWaits {
        &self.m_code_waits
    }

    /// Whether there is a frame whose event is to be answered. Every tick asks.
    pub(crate) const fn has_m_code_wait(&self) -> bool {
        self.m_code_wait.is_some()
    }

    /// The first frame whose event is to be answered, and by what.
    pub(crate) fn m_code_wait(&self) -> Option<(&SetpointFrame, MCodeWait)> {
        let frame = self.frame(self.m_code_wait?)?;
        Some((frame, self.m_code_waits.of_frame(frame)?))
    }

    /// Lets motion pass the M-code wait it stands at, once it is known how to stop after it.
    pub(crate) fn pass_m_code_wait(&mut self) {
        let Some(passed) = self.m_code_wait else {
            return;
        };
        let waits = |s: &u64| {
            self.frame(*s)
                .is_some_and(|f| self.m_code_waits.of_frame(f).is_some())
        };
        self.m_code_wait = (passed + 1..self.end()).find(waits);
        self.bar_from(passed);
    }

    /// The motion does not pass the M-code wait that it stands at, after all.
    pub(crate) fn take_m_code_wait_back(&mut self, sequence: u64) {
        self.m_code_wait = Some(sequence);
        self.bar_from(sequence);
    }

    /// The longest of the stop times of up to `count` frames from one on.
    pub(crate) fn longest_stop(&self, from: u64, count: u64) -> StopTime {
        (from.max(self.oldest)..self.end().min(from + count))
            .filter_map(|sequence| self.stop_times.get(Self::slot(sequence)))
            .fold(StopTime::default(), |longest, at| longest.longer(*at))
    }

    /// Planned position at a time; `None` outside the owned frames.
    pub(crate) fn position(&self, time: ProgramTime) -> Option<AxisVector> {
        let frame = self.frame(time.sequence)?;
        if time.fraction <= 0.0 {
            return Some(AxisVector::from(frame.position));
        }
        Some(self.quintic(time.sequence)?.position(time.fraction))
    }

    /// Whether joints that are not the axes are known along the frames.
    pub(crate) const fn has_joints(&self) -> bool {
        self.joints.is_some()
    }

    /// Planned position at a time with that of joints that are not the axes; `None` outside the owned
    /// frames.
    pub(crate) fn whereabouts(&self, time: ProgramTime) -> Option<MachinePosition> {
        let axes = self.position(time)?;
        let joints = match (&self.joints, time.fraction <= 0.0) {
            (None, _) => JointVector::zeros(),
            (Some((joints, _)), true) => *joints.position(Self::slot(time.sequence))?,
            (Some(_), false) => self.joint_quintic(time.sequence)?.position(time.fraction),
        };
        Some(MachinePosition { axes, joints })
    }

    /// The motion from a frame to the next; `None` outside the owned frames.
    fn quintic(&self, sequence: u64) -> Option<&Quintic> {
        let offset = sequence.checked_sub(self.oldest)?;
        if offset + 1 < self.len as u64 {
            self.quintics.get(Self::slot(sequence))
        } else {
            None
        }
    }

    /// The joints from a frame to the next, where they are not the axes; for whoever knows that both are
    /// owned.
    fn joint_quintic(&self, sequence: u64) -> Option<&Quintic> {
        let (joints, _) = self.joints.as_ref()?;
        joints.quintic(Self::slot(sequence))
    }

    /// Appends the planned position at a time to others; returns whether it is within the limits,
    /// and within the owned frames.
    pub(crate) fn append_to(
        &self,
        published: &mut Differences,
        time: ProgramTime,
        allowed: &Allowed,
    ) -> bool {
        if let Some(quintic) = self.quintic(time.sequence) {
            let is_inside = published.append_at(quintic, time.fraction, allowed);
            return match self.joint_quintic(time.sequence) {
                None => is_inside,
                Some(joints) => {
                    is_inside & published.append_joints_at(joints, time.fraction, allowed)
                }
            };
        }
        let position = self.position(time);
        let is_inside = position.is_some_and(|position| published.append(&position, allowed));
        let joints = self.joints.as_ref();
        match joints.and_then(|(joints, _)| joints.position(Self::slot(time.sequence))) {
            None => is_inside,
            Some(joints) => is_inside && published.append_joints(joints, allowed),
        }
    }

    /// By how much the planned position at a time may be moved along the path: see
    /// [`Differences::room`]. Up to the newest frame but one; `None` outside the owned frames.
    pub(crate) fn room(
        &self,
        time: ProgramTime,
        published: &Differences,
        allowed: &Allowed,
    ) -> Option<(f64, f64)> {
        let quintic = self.quintic(time.sequence)?;
        let room = published.room(quintic, time.fraction, allowed);
        let Some(joints) = self.joint_quintic(time.sequence) else {
            return Some(room);
        };
        let of_joints = published.joint_room(joints, time.fraction, allowed);
        Some((larger(room.0, of_joints.0), smaller(room.1, of_joints.1)))
    }

    /// Position and derivatives between frames; `None` outside the owned frames.
    pub(crate) fn kinematic(&self, time: ProgramTime) -> Option<Kinematic> {
        let frame = self.frame(time.sequence)?;
        if time.fraction <= 0.0 {
            return Some(Kinematic {
                position: AxisVector::from(frame.position),
                velocity: AxisVector::from(frame.velocity) * self.period_t,
                acceleration: AxisVector::from(frame.acceleration)
                    * (self.period_t * self.period_t),
            });
        }
        Some(self.quintic(time.sequence)?.kinematic(time.fraction))
    }

    /// Path position and rate, by the cubic through both frames; `None` outside the owned frames.
    pub(crate) fn path(&self, time: ProgramTime) -> Option<PathState> {
        let from = self.frame(time.sequence)?;
        let (u, v0) = (time.fraction, from.path_v * self.period_t);
        if u <= 0.0 {
            return Some(PathState {
                path_s: from.path_s,
                path_v: v0,
            });
        }
        let to = self.frame(time.sequence + 1)?;
        let (step, v1) = (to.path_s - from.path_s, to.path_v * self.period_t);
        let c2 = 3.0 * step - 2.0 * v0 - v1;
        let c3 = v0 + v1 - 2.0 * step;
        Some(PathState {
            path_s: ((c3 * u + c2) * u + v0) * u + from.path_s,
            path_v: (3.0 * c3 * u + 2.0 * c2) * u + v0,
        })
    }
}

#[cfg(test)]
mod tests;
