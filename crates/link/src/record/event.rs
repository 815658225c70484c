//! Events on the wire: a code and one number.
//!
//! The lowest byte of the code is the kind; what is above it is the number of an output or the phase
//! of a thread, and zero for every other kind.

use super::check::{Fields, RecordError};
use super::code::coded;
use glidepath_geometry::AXES;
use glidepath_program::{CodeWord, Event};

coded! {
    /// What the lowest byte of `event_kind` says; `event_value` is the speed, tool, M code or
    /// value.
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
        /// Digital output; the value is 1 for on, 0 for off.
        DigitalOutput = 6,
        /// Analog output.
        AnalogOutput = 7,
        /// What follows looks for a contact; the value is 1 if it looks for the end of one.
        Probe = 8,
        /// What follows goes with the spindle; the value is the way of a revolution, mm, and above
        /// the lowest byte of the code stands the angle it begins at, in 2⁻²⁴ of a revolution.
        Synchronise = 9,
        /// The P word of the M code that comes next.
        CodeWordP = 10,
        /// The Q word of the M code that comes next.
        CodeWordQ = 11,
        /// The motion waits until an M code is answered that was told before; the value is the code.
        Await = 12,
        /// A hole is tapped; the value is the way of a revolution, mm, with the sign of the axis'
        /// direction. Above the lowest byte of the code stand the axis, in four bits, and the depth
        /// in µm.
        Tap = 13,
    }
}

/// Bits of the kind; the number of an output, or a phase, is above them.
const KIND_BITS: u32 = 8;
/// Bits of the number of an event that are an axis.
const AXIS_BITS: u32 = 4;
/// The longest way of a revolution, mm: beyond any machine.
const PITCH_MOST_MM: f64 = 1e6;

/// Code and value of an event.
pub(crate) fn encode(event: Option<Event>) -> (u32, f64) {
    let mut output = 0;
    let (kind, value) = match event {
        None => (EventKind::None, 0.0),
        Some(Event::SpindleSpeed(speed)) => (EventKind::SpindleSpeed, speed),
        Some(Event::SelectTool(tool)) => (EventKind::SelectTool, f64::from(tool)),
        Some(Event::MCode(code)) => (EventKind::MCode, f64::from(code)),
        Some(Event::ProgramStop(code)) => (EventKind::ProgramStop, f64::from(code)),
        Some(Event::OptionalStop) => (EventKind::OptionalStop, 0.0),
        Some(Event::Probe { release }) => (EventKind::Probe, f64::from(u8::from(release))),
        Some(Event::Synchronise { pitch_mm, phase }) => {
            output = phase;
            (EventKind::Synchronise, pitch_mm)
        }
        Some(Event::CodeWord { word, value }) => match word {
            CodeWord::P => (EventKind::CodeWordP, value),
            CodeWord::Q => (EventKind::CodeWordQ, value),
        },
        Some(Event::Await(code)) => (EventKind::Await, f64::from(code)),
        Some(Event::Tap {
            axis,
            pitch_mm,
            depth_um,
        }) => {
            output = axis | depth_um << AXIS_BITS;
            (EventKind::Tap, pitch_mm)
        }
        Some(Event::DigitalOutput { number, on }) => {
            output = number;
            (EventKind::DigitalOutput, f64::from(u8::from(on)))
        }
        Some(Event::AnalogOutput { number, value }) => {
            output = number;
            (EventKind::AnalogOutput, value)
        }
    };
    (kind.code() | output << KIND_BITS, value)
}

/// The event of a code and value.
pub(crate) fn decode(
    record: &'static str,
    kind: u32,
    value: f64,
) -> Result<Option<Event>, RecordError> {
    let fields = Fields(record);
    fields.finite("event_value", value)?;
    let number = kind >> KIND_BITS;
    let has_number = |kind: u32| {
        kind == EventKind::DigitalOutput.code()
            || kind == EventKind::AnalogOutput.code()
            || kind == EventKind::Synchronise.code()
            || kind == EventKind::Tap.code()
    };
    let lowest = kind & ((1 << KIND_BITS) - 1);
    // A number beside a kind that has none makes a code that does not exist.
    let kind = if has_number(lowest) { lowest } else { kind };
    Ok(match fields.code::<EventKind>("event_kind", kind)? {
        EventKind::None => None,
        EventKind::SpindleSpeed => Some(Event::SpindleSpeed(value)),
        EventKind::SelectTool => Some(Event::SelectTool(fields.whole("event_value", value)?)),
        EventKind::MCode => Some(Event::MCode(fields.whole("event_value", value)?)),
        EventKind::ProgramStop => Some(Event::ProgramStop(fields.whole("event_value", value)?)),
        EventKind::OptionalStop => Some(Event::OptionalStop),
        EventKind::DigitalOutput => Some(Event::DigitalOutput {
            number,
            on: yes_or_no(&fields, value)?,
        }),
        EventKind::Probe => Some(Event::Probe {
            release: yes_or_no(&fields, value)?,
        }),
        EventKind::CodeWordP => Some(Event::CodeWord {
            word: CodeWord::P,
            value,
        }),
        EventKind::CodeWordQ => Some(Event::CodeWord {
            word: CodeWord::Q,
            value,
        }),
        EventKind::Await => Some(Event::Await(fields.whole("event_value", value)?)),
        EventKind::AnalogOutput => Some(Event::AnalogOutput { number, value }),
        EventKind::Synchronise => {
            fields.range("event_value", value, f64::MIN_POSITIVE, PITCH_MOST_MM)?;
            Some(Event::Synchronise {
                pitch_mm: value,
                phase: number,
            })
        }
        EventKind::Tap => {
            fields.range("event_value", value.abs(), f64::MIN_POSITIVE, PITCH_MOST_MM)?;
            let axis = number & ((1 << AXIS_BITS) - 1);
            #[allow(clippy::cast_precision_loss, reason = "the number of axes")]
            fields.range("event_kind", f64::from(axis), 0.0, (AXES - 1) as f64)?;
            Some(Event::Tap {
                axis,
                pitch_mm: value,
                depth_um: number >> AXIS_BITS,
            })
        }
    })
}

/// A value that is 1 for yes and 0 for no.
fn yes_or_no(fields: &Fields, value: f64) -> Result<bool, RecordError> {
    fields.range("event_value", value, 0.0, 1.0)?;
    Ok(fields.whole("event_value", value)? == 1)
}
