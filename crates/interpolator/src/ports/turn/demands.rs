//! The demands for jogs: read, and passed on.

use super::Ports;
use crate::ports::told_by_hand;
use glidepath_link::{LinkError, UnmetPrecondition};

/// Demands for a jog passed on in one turn.
const DEMANDS_PER_TURN: usize = 16;

impl Ports<'_> {
    /// Passes demands for a jog on, in the order in which they came.
    pub(super) fn pass_on_demands(&mut self) -> Result<(), LinkError> {
        let Some(report) = self.report else {
            return Ok(());
        };
        for _ in 0..DEMANDS_PER_TURN {
            let Some(record) = self.links.demands.take()? else {
                return Ok(());
            };
            match self.reader.read(&record) {
                Ok(mut demand) => {
                    demand.is_outdated = self.jobs.was_stopped_after(record.asked_ns);
                    let caller = (demand.client, demand.number);
                    let is_new = self.demanded_by.replace(caller) != Some(caller);
                    if demand.is_outdated && demand.wants_motion() {
                        // What was followed before the stop is told to have ended by it.
                        if is_new {
                            self.tell(UnmetPrecondition::StoppedSince.text());
                        }
                    } else if told_by_hand::may_begin(&report, &demand) {
                        self.book.last_error("");
                    }
                    self.demanded_after = Some(report.setpoint.number);
                    // A full ring is a real-time thread that hangs: nothing begins then.
                    self.ends.demand(demand);
                }
                Err(error) => {
                    if self.refused_jogger != Some(record.client) {
                        self.refused_jogger = Some(record.client);
                        self.tell(&error.to_string());
                    }
                }
            }
        }
        Ok(())
    }
}
