//! The record of an event.
//!
//! In frames and setpoints an event is an [`EventRecord`], with a field for each of its numbers. Where
//! a record has room for one event alone (an item of a stream, what is awaited), it is a code and one
//! number: the lowest byte of the code is the kind; what is above it is the number of an output or the
//! phase of a thread, and zero for every other kind.

use super::check::{Fields, RecordError};
use super::code::coded;
use glidepath_geometry::AXES;
use glidepath_program::{
    CodeWord, EVENTS_MOST, Event, OrientWay, PHASE_STEPS, TAP_DEPTHS_UM, TimedEvent,
};
use iceoryx2::prelude::ZeroCopySend;

/// Gears of a spindle, as many as there are words for them.
pub const MOST_GEARS: u32 = 5;

coded! {
    /// The kind of an event; its value is the speed, tool, M code or value.
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
        /// What follows goes with the spindle; the value is the way of a revolution, mm, and the
        /// phase the angle it begins at, in 2⁻²⁴ of a revolution.
        Synchronise = 9,
        /// The P word of the M code that comes next.
        CodeWordP = 10,
        /// The Q word of the M code that comes next.
        CodeWordQ = 11,
        /// The motion waits until an M code is answered that was told before; the value is the code.
        Await = 12,
        /// A hole is tapped by an axis, so deep; the value is the way of a revolution, mm, with the
        /// sign of the axis' direction.
        Tap = 13,
        /// An M code that the motion passes without a rest.
        PassingCode = 14,
        /// The angle of the spindle for the M19 that comes next; the value is the angle, degrees, and
        /// the number the way there: 0 the shorter one, 1 clockwise, 2 counterclockwise.
        SpindleAngle = 15,
        /// The gear that the spindle is to have, 1 to 5; the M code of that gear comes next.
        SpindleGear = 16,
    }
}

/// An event of a frame or of a setpoint.
#[repr(C)]
#[derive(
    Debug, Clone, Copy, PartialEq, Default, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend,
)]
pub struct EventRecord {
    /// Speed, tool, M code, value of an output, way of a revolution.
    pub value: f64,
    /// When it happens: ns after the beginning of the period that ends with the frame or setpoint, up
    /// to a period. Of program time in a frame, of `CLOCK_MONOTONIC` in a setpoint, after its
    /// `scheduled_ns`.
    pub offset_ns: u32,
    /// Code of an [`EventKind`].
    pub kind: u32,
    /// Of an output: which; of an angle of the spindle: the way there; else 0.
    pub number: u32,
    /// Of a tapped hole: index of the axis; else 0.
    pub axis: u32,
    /// Of a tapped hole: µm; else 0.
    pub depth_um: u32,
    /// Of a pass of a thread: the angle it begins at, in 2⁻²⁴ of a revolution; else 0.
    pub phase: u32,
}

impl EventRecord {
    /// The record of an event, so many ns after the beginning of its period.
    #[must_use]
    pub fn new(event: Event, offset_ns: u32) -> Self {
        let (kind, value) = kind_and_value(event);
        let (mut number, mut axis, mut depth_um, mut phase) = (0, 0, 0, 0);
        match event {
            Event::DigitalOutput { number: of, .. } | Event::AnalogOutput { number: of, .. } => {
                number = of;
            }
            Event::SpindleAngle { way, .. } => number = number_of(way),
            Event::Tap {
                axis: of,
                depth_um: deep,
                ..
            } => (axis, depth_um) = (of, deep),
            Event::Synchronise { phase: of, .. } => phase = of,
            _ => {}
        }
        Self {
            value,
            offset_ns,
            kind: kind.code(),
            number,
            axis,
            depth_um,
            phase,
        }
    }

    /// The event.
    ///
    /// # Errors
    ///
    /// An unknown code, a number that does not fit it, or one that it does not have.
    pub fn event(&self) -> Result<Event, RecordError> {
        let fields = Fields("glidepath.Event");
        fields.finite("value", self.value)?;
        let kind = fields.code::<EventKind>("kind", self.kind)?;
        let is_output = matches!(kind, EventKind::DigitalOutput | EventKind::AnalogOutput);
        let has_way = kind == EventKind::SpindleAngle;
        let most_number = if has_way { WAYS_MOST } else { u32::MAX };
        let fits = [
            ("number", self.number, is_output || has_way, most_number),
            ("axis", self.axis, kind == EventKind::Tap, AXES_MOST),
            (
                "depth_um",
                self.depth_um,
                kind == EventKind::Tap,
                TAP_DEPTHS_UM - 1,
            ),
            (
                "phase",
                self.phase,
                kind == EventKind::Synchronise,
                PHASE_STEPS - 1,
            ),
        ];
        for (field, found, has_it, most) in fits {
            let most = if has_it { most } else { 0 };
            fields.range(field, f64::from(found), 0.0, f64::from(most))?;
        }
        event_of(&fields, ("value", self.value), kind, self)
    }

    /// Whether the machine rests while it happens.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        self.event().is_ok_and(|event| event.is_at_rest())
    }
}

/// The highest index of an axis.
#[allow(clippy::cast_possible_truncation, reason = "nine")]
const AXES_MOST: u32 = AXES as u32 - 1;

/// The events of a record, of which only so many are used.
pub(crate) fn used(events: &[EventRecord; EVENTS_MOST], count: u32) -> &[EventRecord] {
    let count = usize::try_from(count).unwrap_or(EVENTS_MOST);
    events.get(..count).unwrap_or(events)
}

/// The event at rest among those of a record, if there is one.
pub(crate) fn at_rest(events: &[EventRecord]) -> Option<&EventRecord> {
    events.iter().find(|event| event.is_at_rest())
}

/// Whether the events of a record, of a period no longer than this, can be meant: in order.
pub(crate) fn check(
    record: &'static str,
    (events, count): (&[EventRecord; EVENTS_MOST], u32),
    period_ns: u64,
) -> Result<(), RecordError> {
    if count == 0 {
        return Ok(());
    }
    let fields = Fields(record);
    #[allow(
        clippy::cast_precision_loss,
        reason = "a range check needs no exact integer"
    )]
    let (most, period_ns) = (EVENTS_MOST as f64, period_ns as f64);
    fields.range("event_count", f64::from(count), 0.0, most)?;
    let events = used(events, count);
    let mut from_ns = 0.0;
    for event in events {
        let offset_ns = f64::from(event.offset_ns);
        fields.range("events.offset_ns", offset_ns, from_ns, period_ns)?;
        from_ns = offset_ns;
        event.event()?;
    }
    Ok(())
}

/// Puts the events of a frame into a record. Returns how many there are.
pub(crate) fn put(from: &[TimedEvent], to: &mut [EventRecord; EVENTS_MOST]) -> u32 {
    let mut count = 0;
    for (to, from) in to.iter_mut().zip(from) {
        *to = EventRecord::new(from.event, from.offset_ns);
        count += 1;
    }
    count
}

/// Bits of the kind; the number of an output, or a phase, is above them.
const KIND_BITS: u32 = 8;
/// Bits of the number of an event that are an axis.
const AXIS_BITS: u32 = 4;
/// The longest way of a revolution, mm: beyond any machine.
const PITCH_MOST_MM: f64 = 1e6;

/// The highest number of a way to an angle.
const WAYS_MOST: u32 = 2;
/// An angle of the spindle, at most, degrees.
const ANGLE_MOST: f64 = 360.0;

/// The number of a way to an angle.
const fn number_of(way: OrientWay) -> u32 {
    match way {
        OrientWay::Shortest => 0,
        OrientWay::Clockwise => 1,
        OrientWay::Counterclockwise => 2,
    }
}

/// Kind and value of an event.
fn kind_and_value(event: Event) -> (EventKind, f64) {
    match event {
        Event::SpindleSpeed(speed) => (EventKind::SpindleSpeed, speed),
        Event::SpindleAngle { deg, .. } => (EventKind::SpindleAngle, deg),
        Event::SpindleGear(gear) => (EventKind::SpindleGear, f64::from(gear)),
        Event::SelectTool(tool) => (EventKind::SelectTool, f64::from(tool)),
        Event::MCode(code) => (EventKind::MCode, f64::from(code)),
        Event::PassingCode(code) => (EventKind::PassingCode, f64::from(code)),
        Event::ProgramStop(code) => (EventKind::ProgramStop, f64::from(code)),
        Event::OptionalStop => (EventKind::OptionalStop, 0.0),
        Event::Probe { release } => (EventKind::Probe, f64::from(u8::from(release))),
        Event::Synchronise { pitch_mm, .. } => (EventKind::Synchronise, pitch_mm),
        Event::CodeWord { word, value } => match word {
            CodeWord::P => (EventKind::CodeWordP, value),
            CodeWord::Q => (EventKind::CodeWordQ, value),
        },
        Event::Await(code) => (EventKind::Await, f64::from(code)),
        Event::Tap { pitch_mm, .. } => (EventKind::Tap, pitch_mm),
        Event::DigitalOutput { on, .. } => (EventKind::DigitalOutput, f64::from(u8::from(on))),
        Event::AnalogOutput { value, .. } => (EventKind::AnalogOutput, value),
    }
}

/// Code and value of an event.
pub(crate) fn encode(event: Option<Event>) -> (u32, f64) {
    let Some(event) = event else {
        return (EventKind::None.code(), 0.0);
    };
    let (kind, value) = kind_and_value(event);
    let above = match event {
        Event::Synchronise { phase, .. } => phase,
        Event::Tap { axis, depth_um, .. } => axis | depth_um << AXIS_BITS,
        Event::DigitalOutput { number, .. } | Event::AnalogOutput { number, .. } => number,
        Event::SpindleAngle { way, .. } => number_of(way),
        _ => 0,
    };
    (kind.code() | above << KIND_BITS, value)
}

/// The event of a code and value.
pub(crate) fn decode(
    record: &'static str,
    kind: u32,
    value: f64,
) -> Result<Option<Event>, RecordError> {
    let fields = Fields(record);
    fields.finite("event_value", value)?;
    let above = kind >> KIND_BITS;
    let has_number = |kind: u32| {
        kind == EventKind::DigitalOutput.code()
            || kind == EventKind::AnalogOutput.code()
            || kind == EventKind::Synchronise.code()
            || kind == EventKind::Tap.code()
            || kind == EventKind::SpindleAngle.code()
    };
    let lowest = kind & ((1 << KIND_BITS) - 1);
    // A number beside a kind that has none makes a code that does not exist.
    let kind = if has_number(lowest) { lowest } else { kind };
    let kind = fields.code::<EventKind>("event_kind", kind)?;
    if kind == EventKind::None {
        return Ok(None);
    }
    let (axis, depth_um) = (above & ((1 << AXIS_BITS) - 1), above >> AXIS_BITS);
    if kind == EventKind::Tap {
        fields.range("event_kind", f64::from(axis), 0.0, f64::from(AXES_MOST))?;
    }
    let numbers = EventRecord {
        number: above,
        axis,
        depth_um,
        phase: above,
        ..EventRecord::default()
    };
    event_of(&fields, ("event_value", value), kind, &numbers).map(Some)
}

/// The event of a kind, a value with the name of its field, and the numbers it may have.
fn event_of(
    fields: &Fields,
    (field, value): (&'static str, f64),
    kind: EventKind,
    numbers: &EventRecord,
) -> Result<Event, RecordError> {
    let whole = || fields.whole(field, value);
    let pitch = |pitch_mm: f64| fields.range(field, pitch_mm, f64::MIN_POSITIVE, PITCH_MOST_MM);
    let &EventRecord {
        number,
        axis,
        depth_um,
        phase,
        ..
    } = numbers;
    Ok(match kind {
        EventKind::None => {
            let (record, code) = (fields.0, kind.code());
            let field = "kind";
            return Err(RecordError::UnknownCode {
                record,
                field,
                code,
            });
        }
        EventKind::SpindleSpeed => Event::SpindleSpeed(value),
        EventKind::SpindleAngle => Event::SpindleAngle {
            deg: fields
                .range(field, value, 0.0, ANGLE_MOST)
                .map(|()| value)?,
            way: way_of(fields, number)?,
        },
        EventKind::SpindleGear => {
            fields.range(field, value, 1.0, MOST_GEARS.into())?;
            Event::SpindleGear(whole()?)
        }
        EventKind::SelectTool => Event::SelectTool(whole()?),
        EventKind::MCode => Event::MCode(whole()?),
        EventKind::PassingCode => Event::PassingCode(whole()?),
        EventKind::ProgramStop => Event::ProgramStop(whole()?),
        EventKind::OptionalStop => Event::OptionalStop,
        EventKind::DigitalOutput => Event::DigitalOutput {
            number,
            on: yes_or_no(fields, (field, value))?,
        },
        EventKind::Probe => Event::Probe {
            release: yes_or_no(fields, (field, value))?,
        },
        EventKind::CodeWordP => Event::CodeWord {
            word: CodeWord::P,
            value,
        },
        EventKind::CodeWordQ => Event::CodeWord {
            word: CodeWord::Q,
            value,
        },
        EventKind::Await => Event::Await(whole()?),
        EventKind::AnalogOutput => Event::AnalogOutput { number, value },
        EventKind::Synchronise => {
            pitch(value)?;
            Event::Synchronise {
                pitch_mm: value,
                phase,
            }
        }
        EventKind::Tap => {
            pitch(value.abs())?;
            Event::Tap {
                axis,
                pitch_mm: value,
                depth_um,
            }
        }
    })
}

/// The way to an angle that has a number.
fn way_of(fields: &Fields, number: u32) -> Result<OrientWay, RecordError> {
    fields.range("number", f64::from(number), 0.0, f64::from(WAYS_MOST))?;
    Ok(match number {
        0 => OrientWay::Shortest,
        1 => OrientWay::Clockwise,
        _ => OrientWay::Counterclockwise,
    })
}

/// A value that is 1 for yes and 0 for no.
fn yes_or_no(fields: &Fields, (field, value): (&'static str, f64)) -> Result<bool, RecordError> {
    fields.range(field, value, 0.0, 1.0)?;
    Ok(fields.whole(field, value)? == 1)
}
