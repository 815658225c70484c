//! The auxiliary record, which spindle, coolant, tools and outputs obey: what the events of
//! setpoints have come to.

use crate::ports::code_words::CodeWordsBook;
use crate::ports::tool_change::ToolChange;
use crate::shared::config::stops::{StopCause, StopSettings};
use crate::shared::m_code_waits::MCodeWaits;
use crate::shared::message::{Awaited, TickReport};
use glidepath_link::{Auxiliary, CodeWords, EventId, EventRecord};
use glidepath_program::Event;

/// The change of a tool.
const CHANGE: Event = Event::MCode(6);

/// The record, and what it was when it was published last.
#[derive(Debug)]
pub(crate) struct AuxiliaryBook {
    record: Auxiliary,
    published: Option<Auxiliary>,
    m_code_waits: MCodeWaits,
    words: CodeWordsBook,
    /// The tool change that is not answered yet.
    tool_change: Option<ToolChange>,
    stops: StopSettings,
}

impl AuxiliaryBook {
    pub(crate) fn new(boot_id: u64, m_code_waits: MCodeWaits, stops: StopSettings) -> Self {
        Self {
            record: Auxiliary {
                boot_id,
                ..bytemuck::Zeroable::zeroed()
            },
            published: None,
            m_code_waits,
            words: CodeWordsBook::default(),
            tool_change: None,
            stops,
        }
    }

    /// There are no more setpoints to tell what stops with the motion.
    pub(crate) fn stop(&mut self, cause: StopCause) {
        if self.stops.is_by(cause) {
            self.record.take(Event::MCode(5));
            self.record.take(Event::MCode(9));
        }
    }

    /// Takes up what happens with a setpoint.
    pub(crate) fn note(&mut self, report: &TickReport) {
        let setpoint = &report.setpoint;
        for event in setpoint.events().iter().flat_map(EventRecord::event) {
            if event == CHANGE && self.m_code_waits.of(6).is_some() {
                let change = ToolChange::new(&self.record, self.tool_change.as_ref());
                self.tool_change = Some(change);
            }
            self.record.take(event);
            self.words.note(setpoint, event);
            (self.record.epoch, self.record.sequence) = (setpoint.epoch, setpoint.sequence);
            self.record.line = setpoint.line;
        }
        self.await_event(report.awaited);
        if let Some(change) = self.tool_change {
            self.tool_change = change.follow(report, &mut self.record);
        }
    }

    fn await_event(&mut self, awaited: Option<Awaited>) {
        let record = &mut self.record;
        let Some(awaited) = awaited else {
            record.awaited = EventId::default();
            (record.awaited_since_ns, record.awaited_until_ns) = (0, 0);
            (record.awaited_kind, record.awaited_value) = (0, 0.0);
            record.awaited_words = CodeWords::default();
            return;
        };
        record.awaited = awaited.id(record.boot_id);
        (record.awaited_kind, record.awaited_value) = (awaited.event_kind, awaited.event_value);
        record.awaited_words = self.words.of(&awaited);
        record.awaited_since_ns = awaited.since_ns;
        record.awaited_until_ns = self.m_code_waits.deadline_ns(record, awaited.since_ns);
    }

    /// The words of the M code that is awaited.
    pub(crate) const fn awaited_words(&self) -> CodeWords {
        self.record.awaited_words
    }

    /// The record, with a new generation, if it has changed since it was asked for last.
    pub(crate) fn changed(&mut self) -> Option<&Auxiliary> {
        if self.published == Some(self.record) {
            return None;
        }
        self.record.generation += 1;
        self.published = Some(self.record);
        self.published.as_ref()
    }
}
