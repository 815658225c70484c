//! The wait for an M code: for what, how long, and what came of it.
//!
//! ```text
//!  motion ──► rest at the frame of the event ──► answered ──► on, when a stop after it is known
//!                                           └──► failed, or nothing in time ──► fault
//! ```
//!
//! Some events are told, and the motion comes to their wait later: what was answered meanwhile is
//! kept ([`Told`]).

use crate::real_time::drives::Drives;
use crate::shared::m_code_waits::MOST_TOLD;
use crate::shared::m_code_waits::{AnswerSource, MCodeWait, ORIENTED};
use crate::shared::message::Awaited;
use glidepath_link::{EventId, EventKind, EventRecord, FaultCause, Setpoint};
use glidepath_program::{CodeWord, Event};

/// The outcome of a wait in a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Nothing yet.
    Open,
    /// The motion may go on.
    Answered,
    /// It must not.
    Failed(FaultCause),
}

/// A wait for the answer to an event. There is none where `standing` is none.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Wait {
    standing: Option<Standing>,
    told: [Option<Told>; MOST_TOLD],
    /// The Q word of the M code that comes next, and that of the last M19: how long it may take, s.
    next_q: Option<f64>,
    oriented_q: Option<f64>,
}

#[derive(Debug, Clone, Copy)]
struct Standing {
    m_code_wait: MCodeWait,
    awaited: Awaited,
    ticks: u64,
    outcome: Option<bool>,
}

/// An event whose wait comes later.
#[derive(Debug, Clone, Copy)]
struct Told {
    awaited: Awaited,
    outcome: Option<bool>,
}

impl Wait {
    /// The motion stands at an M-code wait.
    #[cold]
    #[inline(never)]
    pub(crate) fn begin(&mut self, m_code_wait: MCodeWait, awaited: Awaited) {
        if self.standing.is_some() {
            return;
        }
        let told = (awaited.event_kind == EventKind::Await.code())
            .then(|| self.take_told(awaited.event_value))
            .flatten();
        let (awaited, outcome) = match told {
            Some(told) if told.awaited.epoch == awaited.epoch => {
                let (since_ns, by_feedback) = (awaited.since_ns, awaited.by_feedback);
                let awaited = Awaited {
                    since_ns,
                    by_feedback,
                    ..told.awaited
                };
                (awaited, told.outcome)
            }
            // A probing move has ended the epoch in which it was told.
            Some(told) => (awaited, told.outcome),
            None => (awaited, None),
        };
        // An M code alone has a code for its value: whatever else is awaited is no M19.
        let kind = awaited.event_kind;
        let is_code = kind == EventKind::MCode.code() || kind == EventKind::Await.code();
        let is_oriented = is_code && (awaited.event_value - f64::from(ORIENTED)).abs() < 0.5;
        let q = self.oriented_q.filter(|_| is_oriented);
        self.standing = Some(Standing {
            m_code_wait: m_code_wait.or_within(ORIENTED, q),
            awaited,
            ticks: 0,
            outcome,
        });
    }

    /// Takes note of an M code that is told with a setpoint, and awaited later.
    pub(crate) fn hear(&mut self, setpoint: &Setpoint) {
        let (event_kind, event_value) = kind_and_value(setpoint.rest_event());
        self.tell(Awaited {
            epoch: setpoint.epoch,
            sequence: setpoint.sequence,
            line: setpoint.line,
            event_kind,
            event_value,
            since_ns: 0,
            told_by: setpoint.number,
            by_feedback: false,
        });
    }

    /// Takes note of the Q word of M19.
    pub(crate) fn hear_word(&mut self, event: Event) {
        match event {
            Event::CodeWord {
                word: CodeWord::Q,
                value,
            } => self.next_q = Some(value),
            // Words are of the next code, whether it waits or not.
            Event::MCode(code) | Event::PassingCode(code) => {
                let q = self.next_q.take();
                if code == ORIENTED {
                    self.oriented_q = q;
                }
            }
            _ => {}
        }
    }

    fn tell(&mut self, awaited: Awaited) {
        let _before = self.take_told(awaited.event_value);
        let told = Told {
            awaited,
            outcome: None,
        };
        // The newest is the first, and the last one the oldest: that is answered at its wait.
        let place = self.told.iter().position(Option::is_none);
        let place = place.unwrap_or(MOST_TOLD - 1);
        self.told[..=place].rotate_right(1);
        self.told[0] = Some(told);
    }

    #[allow(clippy::float_cmp, reason = "both are whole numbers")]
    fn take_told(&mut self, code: f64) -> Option<Told> {
        let is_it = |told: &&mut Option<Told>| {
            told.as_ref()
                .is_some_and(|told| told.awaited.event_value == code)
        };
        self.told.iter_mut().find(is_it)?.take()
    }

    /// Nothing is waited for any more.
    pub(crate) const fn end(&mut self) {
        self.standing = None;
    }

    /// Nor will be.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }

    /// What is waited for.
    pub(crate) const fn awaited(&self) -> Option<Awaited> {
        match &self.standing {
            Some(standing) => Some(standing.awaited),
            None => None,
        }
    }

    /// Whether anything is.
    pub(crate) const fn is_standing(&self) -> bool {
        self.standing.is_some()
    }

    /// Somebody says what came of an event. Without effect if it is not one that is awaited, or was
    /// told, or if that was said before.
    #[cold]
    #[inline(never)]
    pub(crate) fn acknowledge(&mut self, event: EventId, done: bool) {
        let is_it = |of: &Awaited| (of.epoch, of.sequence) == (event.epoch, event.sequence);
        if let Some(standing) = &mut self.standing
            && is_it(&standing.awaited)
        {
            standing.outcome.get_or_insert(done);
        }
        for told in self.told.iter_mut().flatten() {
            if is_it(&told.awaited) {
                told.outcome.get_or_insert(done);
            }
        }
    }

    /// A tick of waiting. Drives that are simulated do at once what they are told.
    /// `has_more` if there are frames behind the event.
    pub(crate) fn watch(&mut self, drives: &Drives, has_more: bool) -> Outcome {
        let Some(standing) = &mut self.standing else {
            return Outcome::Open;
        };
        standing.ticks += 1;
        let (answer, seen) = (standing.m_code_wait.answer, drives.seen());
        let waited_ns = u128::from(standing.ticks) * u128::from(drives.period_ns());
        // What drives say before they have heard of the event is not about it.
        let is_given = if answer == AnswerSource::Planner {
            has_more
        } else if drives.are_simulated() {
            answer.needs_feedback()
        } else {
            let has_heard = seen.played >= standing.awaited.told_by;
            has_heard && answer.is_given(seen.digital_in, seen.spindle)
        };
        let is_late = standing
            .m_code_wait
            .within
            .is_some_and(|within| waited_ns > within.as_nanos());
        match standing.outcome {
            Some(true) => Outcome::Answered,
            Some(false) => Outcome::Failed(FaultCause::AuxFailed),
            None if is_given => Outcome::Answered,
            None if is_late => Outcome::Failed(FaultCause::AuxTimeout),
            None => Outcome::Open,
        }
    }
}

/// Kind and value of an event, or that there is none.
pub(crate) fn kind_and_value(event: Option<&EventRecord>) -> (u32, f64) {
    event.map_or((EventKind::None.code(), 0.0), |event| {
        (event.kind, event.value)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_q_is_of_its_own_code_alone() {
        let q = |value| Event::CodeWord {
            word: CodeWord::Q,
            value,
        };
        let heard = |events: &[Event]| {
            let mut wait = Wait::default();
            events.iter().for_each(|event| wait.hear_word(*event));
            wait.oriented_q
        };
        let oriented = Event::MCode(ORIENTED);
        assert_eq!(heard(&[q(2.0), oriented]), Some(2.0));
        assert_eq!(heard(&[q(2.0), oriented, oriented]), None);
        for other in [Event::MCode(100), Event::PassingCode(101)] {
            assert_eq!(heard(&[q(3.0), other, oriented]), None, "{other:?}");
        }
    }
}
