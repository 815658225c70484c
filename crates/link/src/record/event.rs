//! Events on the wire: a code and one number.

use super::check::{Fields, RecordError};
use super::code::coded;
use glidepath_motion::Event;

coded! {
    /// What `event_kind` says; `event_value` is the speed, tool or M code.
    pub enum EventKind {
        /// No event.
        None = 0,
        /// Spindle speed, rev/min.
        SpindleSpeed = 1,
        /// Tool number.
        SelectTool = 2,
        /// M code.
        MCode = 3,
        /// M0 or M60; the value is the M code.
        ProgramStop = 4,
        /// M1.
        OptionalStop = 5,
    }
}

/// Code and value of an event.
pub(crate) fn encode(event: Option<Event>) -> (u32, f64) {
    let (kind, value) = match event {
        None => (EventKind::None, 0.0),
        Some(Event::SpindleSpeed(speed)) => (EventKind::SpindleSpeed, speed),
        Some(Event::SelectTool(tool)) => (EventKind::SelectTool, f64::from(tool)),
        Some(Event::MCode(code)) => (EventKind::MCode, f64::from(code)),
        Some(Event::ProgramStop(code)) => (EventKind::ProgramStop, f64::from(code)),
        Some(Event::OptionalStop) => (EventKind::OptionalStop, 0.0),
    };
    (kind.code(), value)
}

/// The event of a code and value.
pub(crate) fn decode(
    record: &'static str,
    kind: u32,
    value: f64,
) -> Result<Option<Event>, RecordError> {
    let fields = Fields(record);
    fields.finite("event_value", value)?;
    Ok(match fields.code::<EventKind>("event_kind", kind)? {
        EventKind::None => None,
        EventKind::SpindleSpeed => Some(Event::SpindleSpeed(value)),
        EventKind::SelectTool => Some(Event::SelectTool(fields.whole("event_value", value)?)),
        EventKind::MCode => Some(Event::MCode(fields.whole("event_value", value)?)),
        EventKind::ProgramStop => Some(Event::ProgramStop(fields.whole("event_value", value)?)),
        EventKind::OptionalStop => Some(Event::OptionalStop),
    })
}
