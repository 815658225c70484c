//! The frames that hold the motion.
//!
//! There are four kinds of them: the next program stop, and the end of a block where the plan rests, until
//! the operator lets it pass, the next *M-code wait*, whose event is to be answered first, and the
//! *barrier*, the latest frame at rest, until it is known how to stop after it. Program time stands
//! there: everything later is evaluated as that frame.

use super::Track;
use crate::real_time::program_time::ProgramTime;
use crate::shared::m_code_waits::{MCodeWait, MCodeWaits};
use crate::shared::rest::is_at_rest;
use glidepath_link::SetpointFrame;
use glidepath_program::FrameFlags;

impl Track {
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
}
