//! The auxiliary record, which spindle, coolant, tools and outputs obey: what the events of
//! setpoints have come to.

use crate::ports::code_words::CodeWordsBook;
use crate::ports::tool_change::ToolChange;
use crate::shared::config::stops::{StopCause, StopSettings};
use crate::shared::m_code_waits::MCodeWaits;
use crate::shared::message::{Awaited, TickReport};
use glidepath_link::{Auxiliary, CodeWords, EndOfEpoch, EventId, EventRecord};
use glidepath_program::Event;

/// The change of a tool.
const CHANGE: Event = Event::MCode(6);

/// M48 and M49: a program lets the operator have the overrides, or does not.
const ALLOW: u32 = 48;
const LOCK: u32 = 49;

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
    /// What the operator makes of the speed of the spindle, and whether a program allows that (M48, M49).
    spindle_override: f64,
    is_locked: bool,
    /// The program that ran last.
    program: u64,
}

impl AuxiliaryBook {
    pub(crate) fn new(boot_id: u64, m_code_waits: MCodeWaits, stops: StopSettings) -> Self {
        Self {
            record: Auxiliary {
                boot_id,
                ..Auxiliary::default()
            },
            published: None,
            m_code_waits,
            words: CodeWordsBook::default(),
            tool_change: None,
            stops,
            spindle_override: 1.0,
            is_locked: false,
            program: 0,
        }
    }

    /// There are no more setpoints to tell what stops with the motion.
    pub(crate) fn stop(&mut self, cause: StopCause) {
        if self.stops.is_by(cause) {
            self.record.take(Event::MCode(5));
            self.record.take(Event::MCode(9));
        }
    }

    /// The operator sets the override of the spindle.
    pub(crate) fn set_spindle_override(&mut self, ratio: f64) {
        self.spindle_override = ratio;
        self.put_override();
    }

    /// The override of the spindle as the operator has set it.
    pub(crate) const fn spindle_override(&self) -> f64 {
        self.spindle_override
    }

    /// A program keeps the override from the operator until its end, or until another one runs.
    pub(crate) fn watch_program(&mut self, program: u64, end: EndOfEpoch) {
        let is_broken_off = matches!(end, EndOfEpoch::Aborted | EndOfEpoch::Faulted);
        if self.is_locked && (is_broken_off || self.program != program) {
            self.is_locked = false;
            self.put_override();
        }
        self.program = program;
    }

    fn put_override(&mut self) {
        self.record.spindle_override_locked = self.is_locked.into();
        self.record.spindle_override = if self.is_locked {
            1.0
        } else {
            self.spindle_override
        };
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
            if let Event::PassingCode(code @ (ALLOW | LOCK)) | Event::MCode(code @ (ALLOW | LOCK)) =
                event
            {
                self.is_locked = code == LOCK;
                self.put_override();
            }
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
