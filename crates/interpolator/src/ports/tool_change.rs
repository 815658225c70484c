//! A tool change that waits for its answer: until then the tool before is the one to go back to.

use crate::shared::message::TickReport;
use glidepath_link::{Auxiliary, EndOfEpoch};
use glidepath_program::Event;

/// A change that was told, and may be waited for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ToolChange {
    /// The tool that was in the spindle.
    before: u32,
    /// The motion stands, or has stood, where the change is to be answered.
    is_awaited: bool,
}

impl ToolChange {
    /// A change that begins with what a record says, behind one that may not have been answered.
    pub(crate) const fn new(record: &Auxiliary, open: Option<&Self>) -> Self {
        Self {
            before: match open {
                Some(open) => open.before,
                None => record.tool,
            },
            is_awaited: false,
        }
    }

    /// Follows the motion. Returns the change while it is open. Where the motion ends before it is
    /// answered, the record has the tool before again.
    pub(crate) fn follow(self, report: &TickReport, record: &mut Auxiliary) -> Option<Self> {
        let awaits = matches!(
            record.awaited_event(),
            Ok(Some(Event::MCode(6) | Event::Await(6)))
        );
        if awaits {
            return Some(Self {
                is_awaited: true,
                ..self
            });
        }
        match report.end_of_epoch {
            EndOfEpoch::Aborted | EndOfEpoch::Faulted => {
                if !self.is_awaited || report.is_unanswered {
                    record.tool = self.before;
                }
                None
            }
            EndOfEpoch::None | EndOfEpoch::Open | EndOfEpoch::Tripped => {
                (!self.is_awaited).then_some(self)
            }
            // It was not waited for to the end.
            EndOfEpoch::Completed => None,
        }
    }
}
