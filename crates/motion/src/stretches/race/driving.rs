//! The frames of a race, as they are given out.

use super::state::Race;
use crate::PlanError;
use crate::stretches::way::Way;
use glidepath_program::Frame;
use std::collections::VecDeque;

impl Race {
    /// The next frame, as far as the stretch is known.
    pub(in crate::stretches) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        loop {
            if let Some(frame) = self.joint.pop_front() {
                return Ok(Some(frame));
            }
            let driven = &mut self.ways[self.on];
            if driven.first() < self.release
                && let Some(mut frame) = driven.take()
            {
                frame.path_s += self.shift_s;
                return Ok(Some(frame));
            }
            if self.is_decided && driven.is_over() {
                return driven.failure().map_or(Ok(None), Err);
            }
            if !self.look() {
                return Ok(None);
            }
            self.forget();
        }
    }

    /// How long the way is, mm, once all frames on it are taken.
    pub(in crate::stretches) fn length_s(&self) -> Option<f64> {
        let driven = &self.ways[self.on];
        let is_over = self.is_decided && self.joint.is_empty() && driven.first() == driven.end();
        driven
            .length_s()
            .filter(|_| is_over)
            .map(|length_s| length_s + self.shift_s)
    }

    /// What is left of a joint, and the way that follows it, to be gone on differently; and what is
    /// added to path positions of that.
    pub(in crate::stretches) fn resumed(&self) -> Result<(VecDeque<Frame>, Way, f64), PlanError> {
        let way = self.ways[self.on].resumed(&self.log)?;
        Ok((self.joint.clone(), way, self.shift_s))
    }
}
