//! Standing at a gate: for what, how long, and what came of it.
//!
//! ```text
//!  motion ──► rest at the frame of the event ──► answered ──► on, when a stop after it is known
//!                                           └──► failed, or nothing in time ──► fault
//! ```

use crate::drives::Drives;
use crate::gates::{Answer, Gate};
use crate::message::Awaited;
use glidepath_link::{EventId, FaultCause};

/// What became of a wait in a tick.
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
}

#[derive(Debug, Clone, Copy)]
struct Standing {
    gate: Gate,
    awaited: Awaited,
    ticks: u64,
    outcome: Option<bool>,
}

impl Wait {
    /// The motion stands at a gate.
    pub(crate) const fn begin(&mut self, gate: Gate, awaited: Awaited) {
        if self.standing.is_none() {
            self.standing = Some(Standing {
                gate,
                awaited,
                ticks: 0,
                outcome: None,
            });
        }
    }

    /// Nothing is waited for any more.
    pub(crate) const fn end(&mut self) {
        self.standing = None;
    }

    /// What is waited for.
    pub(crate) fn awaited(&self) -> Option<Awaited> {
        self.standing.map(|standing| standing.awaited)
    }

    /// Somebody says what came of an event. Without effect if it is not the one that is awaited, or
    /// if that was said before.
    pub(crate) fn acknowledge(&mut self, event: EventId, done: bool) {
        if let Some(standing) = &mut self.standing
            && (standing.awaited.epoch, standing.awaited.sequence) == (event.epoch, event.sequence)
        {
            standing.outcome.get_or_insert(done);
        }
    }

    /// A tick of waiting. Drives that are simulated do at once what they are told.
    /// `has_more` if there are frames behind the event.
    pub(crate) fn watch(&mut self, drives: &Drives, has_more: bool) -> Outcome {
        let Some(standing) = &mut self.standing else {
            return Outcome::Open;
        };
        standing.ticks += 1;
        let (answer, seen) = (standing.gate.answer, drives.seen());
        let waited_ns = u128::from(standing.ticks) * u128::from(drives.period_ns());
        // What drives say before they have heard of the event is not about it.
        let is_given = if answer == Answer::Planner {
            has_more
        } else if drives.are_simulated() {
            answer.needs_feedback()
        } else {
            let has_heard = seen.played >= standing.awaited.told_by;
            has_heard && answer.is_given(seen.digital_in, seen.spindle)
        };
        let is_late = standing
            .gate
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
