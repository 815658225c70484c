//! The acknowledgements of events: which may be answered now, the one that is awaited or those that
//! were told and are waited for later.

use crate::shared::m_code_waits::{AnswerSource, MCodeWaits, MOST_TOLD};
use crate::shared::message::TickReport;
use glidepath_link::{EndOfEpoch, EventId, UnmetPrecondition};

/// An event that was told, and its M code.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Told {
    event: EventId,
    code: f64,
    /// The drives' feedback answers it.
    by_feedback: bool,
}

/// The events that were told, and those that were answered.
#[derive(Debug)]
pub(crate) struct Acknowledgements {
    boot_id: u64,
    m_code_waits: MCodeWaits,
    told: [Option<Told>; MOST_TOLD],
    answered: [Option<EventId>; MOST_TOLD],
}

impl Acknowledgements {
    pub(crate) const fn new(boot_id: u64, m_code_waits: MCodeWaits) -> Self {
        Self {
            boot_id,
            m_code_waits,
            told: [None; MOST_TOLD],
            answered: [None; MOST_TOLD],
        }
    }

    /// Takes note of the event at rest of a setpoint.
    pub(crate) fn note(&mut self, report: &TickReport) {
        let setpoint = &report.setpoint;
        let Some(m_code_wait) = self.m_code_waits.late(setpoint) else {
            return;
        };
        self.tell(Told {
            event: EventId {
                boot_id: self.boot_id,
                epoch: setpoint.epoch,
                sequence: setpoint.sequence,
            },
            code: setpoint.rest_event().map_or(0.0, |event| event.value),
            by_feedback: m_code_wait.answer != AnswerSource::Acknowledgement,
        });
    }

    /// What is told again takes the place of what was told before: nobody waits for that any more.
    #[allow(clippy::float_cmp, reason = "both are whole numbers")]
    fn tell(&mut self, told: Told) {
        let is_it = |other: &Option<Told>| other.is_some_and(|other| other.code == told.code);
        let place = self.told.iter().position(is_it).unwrap_or(MOST_TOLD - 1);
        self.told[..=place].rotate_right(1);
        self.told[0] = Some(told);
    }

    /// An event was answered.
    pub(crate) fn answer(&mut self, event: EventId) {
        self.answered.rotate_right(1);
        self.answered[0] = Some(event);
    }

    /// Whether an event may be acknowledged now.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn judge(
        &self,
        event: EventId,
        done: bool,
        report: &TickReport,
    ) -> Result<(), UnmetPrecondition> {
        if event.boot_id != self.boot_id {
            return Err(UnmetPrecondition::OtherLife);
        }
        if self.answered.contains(&Some(event)) {
            return Err(UnmetPrecondition::Answered);
        }
        let is_open =
            event.epoch == report.setpoint.epoch && report.end_of_epoch == EndOfEpoch::Open;
        let awaited = report.awaited.filter(|it| it.id(self.boot_id) == event);
        let told = self.told.iter().flatten().find(|told| told.event == event);
        let told = told.filter(|_| is_open);
        let by_feedback = awaited
            .map(|awaited| awaited.by_feedback)
            .or(told.map(|told| told.by_feedback));
        match by_feedback {
            Some(true) if done => {
                return Err(UnmetPrecondition::ByFeedback);
            }
            Some(_) => return Ok(()),
            None => {}
        }
        Err(match report.awaited {
            None if is_open && event.sequence > report.setpoint.sequence => {
                UnmetPrecondition::TooEarly
            }
            None => UnmetPrecondition::NoEvent,
            Some(awaited) if (event.epoch, event.sequence) > (awaited.epoch, awaited.sequence) => {
                UnmetPrecondition::EarlierEvent
            }
            Some(_) => UnmetPrecondition::AnotherEvent,
        })
    }
}
