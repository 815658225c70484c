//! The part of a tick for events that are to be answered before the motion goes on.

use super::state::Interpolator;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::wait::{Outcome, kind_and_value};
use crate::shared::m_code_waits::AnswerSource;
use crate::shared::message::Awaited;

impl Interpolator<'_> {
    /// Looks whether what the motion stands for was answered.
    pub(super) fn watch_wait(&mut self) {
        let Some(awaited) = self.wait.awaited() else {
            return;
        };
        let has_more = self.track.end() > awaited.sequence + 1;
        match self.wait.watch(&self.drives, has_more) {
            Outcome::Open => {}
            Outcome::Answered => {
                self.wait.end();
                self.track.pass_m_code_wait();
            }
            Outcome::Failed(cause) => self.fail(cause),
        }
    }

    /// Whether the motion is where an event is to be answered.
    pub(super) fn is_at_m_code_wait(&self) -> bool {
        let now = self.rate.now().time;
        self.track
            .m_code_wait()
            .is_some_and(|(frame, _)| ProgramTime::at(frame.sequence) == now)
    }

    /// Begins to wait where the motion stands at an event that is to be answered.
    pub(super) fn stand_at_m_code_wait(&mut self, scheduled_ns: u64, number: u64) {
        if !self.track.has_m_code_wait() {
            return;
        }
        if let Some((frame, m_code_wait)) = self.track.m_code_wait()
            && self.is_at_m_code_wait()
            && !self.requests.is_stopping()
            && self.tap.is_none()
        {
            let (event_kind, event_value) = kind_and_value(frame.rest_event());
            let awaited = Awaited {
                epoch: frame.epoch,
                sequence: frame.sequence,
                line: frame.line,
                event_kind,
                event_value,
                since_ns: scheduled_ns,
                told_by: number,
                by_feedback: m_code_wait.answer != AnswerSource::Acknowledgement,
            };
            if m_code_wait.answer == AnswerSource::SpindleAngle && self.wait.awaited().is_none() {
                self.pass.wait();
            }
            self.wait.begin(m_code_wait, awaited);
        }
    }
}
