//! The frame record, from planner to interpolator: the state of the machine on the grid of program
//! time.

use super::check::{Fields, RecordError};
use super::{EventRecord, OVERRIDE_MAX, Record, event};
use core::mem::offset_of;
use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::{EVENTS_MOST, Event, Frame, FrameEvents, FrameFlags};
use iceoryx2::prelude::ZeroCopySend;

/// Longest interpolation period, ns.
pub const PERIOD_NS_MAX: u64 = 1_000_000_000;

/// Every flag of a frame that this version knows.
pub(crate) const FRAME_FLAGS: u32 = FrameFlags::FIRST
    .with(FrameFlags::LAST)
    .with(FrameFlags::RAPID)
    .with(FrameFlags::EXACT_STOP)
    .with(FrameFlags::DWELL)
    .with(FrameFlags::PROGRAM_STOP)
    .with(FrameFlags::SYNC)
    .with(FrameFlags::PER_REV)
    .0;

/// The state of the machine at program time `sequence · period`. Between two frames the motion is
/// the quintic Hermite polynomial through both.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.SetpointFrame.v4")]
pub struct SetpointFrame {
    /// Which trajectory this belongs to: a new one for every start from rest, > 0, rising. Planners
    /// take the number after that of the last; one that is more than 65 536 above it is refused.
    pub epoch: u64,
    /// Index on the grid of program time, from 0, without gaps inside an epoch.
    pub sequence: u64,
    /// The period the trajectory was sampled with, ns, 1 to [`PERIOD_NS_MAX`].
    pub period_ns: u64,
    /// Source line, 0 before the first.
    pub line: u32,
    /// Bits of [`FrameFlags`].
    pub flags: u32,
    /// How many of `events` are used.
    pub event_count: u32,
    /// Which block of the program this belongs to: the number of its item, from 1, counted through
    /// loops and subprograms; 0 before the first.
    pub block: u32,
    /// Rate of path position, mm/s.
    pub path_v: f64,
    /// Path position since the start of the program, mm.
    pub path_s: f64,
    /// The override this was planned with, > 0, up to [`OVERRIDE_MAX`].
    pub planned_override: f64,
    /// Identifies the text of the program, 0 if it has none that could be read again.
    pub program: u64,
    /// The feed that the program asks for there, mm/s, which limits and corners may not let it reach; 0 at rest and in
    /// rapids.
    pub programmed_v: f64,
    /// Position, mm or degrees.
    pub position: [f64; AXES],
    /// Velocity, mm/s or °/s.
    pub velocity: [f64; AXES],
    /// Acceleration, mm/s² or °/s².
    pub acceleration: [f64; AXES],
    /// The events of the period that ends here, in order. An event at rest is the last of them, and
    /// happens at its end; the others do not stop the motion. What is not used is zero.
    pub events: [EventRecord; EVENTS_MOST],
}

impl SetpointFrame {
    /// The record of a planned frame, bit for bit, of an unknown program.
    #[must_use]
    pub fn from_frame(frame: &Frame, epoch: u64, period_ns: u64) -> Self {
        let mut events = [EventRecord::default(); EVENTS_MOST];
        let event_count = event::put(frame.events.as_slice(), &mut events);
        Self {
            epoch,
            sequence: frame.sequence,
            period_ns,
            line: frame.line,
            flags: frame.flags.0,
            event_count,
            block: frame.block,
            path_v: frame.path_v,
            path_s: frame.path_s,
            planned_override: frame.planned_override,
            program: 0,
            position: frame.position.into(),
            velocity: frame.velocity.into(),
            acceleration: frame.acceleration.into(),
            events,
            programmed_v: frame.programmed_v,
        }
    }

    /// The planned frame, after [`Record::check`].
    ///
    /// # Errors
    ///
    /// The first field that is out of range.
    pub fn to_frame(&self) -> Result<Frame, RecordError> {
        self.check()?;
        Ok(Frame {
            sequence: self.sequence,
            line: self.line,
            block: self.block,
            flags: FrameFlags(self.flags),
            events: self.frame_events()?,
            planned_override: self.planned_override,
            path_v: self.path_v,
            path_s: self.path_s,
            programmed_v: self.programmed_v,
            position: AxisVector::from(self.position),
            velocity: AxisVector::from(self.velocity),
            acceleration: AxisVector::from(self.acceleration),
        })
    }

    /// The events of the period that ends here.
    #[must_use]
    pub fn events(&self) -> &[EventRecord] {
        event::used(&self.events, self.event_count)
    }

    /// The event that the machine rests for, if there is one.
    #[must_use]
    pub fn rest_event(&self) -> Option<&EventRecord> {
        event::at_rest(self.events())
    }

    /// The same as an event.
    ///
    /// # Errors
    ///
    /// A number that does not fit it.
    pub fn event(&self) -> Result<Option<Event>, RecordError> {
        self.rest_event().map(EventRecord::event).transpose()
    }

    fn frame_events(&self) -> Result<FrameEvents, RecordError> {
        let mut events = FrameEvents::NONE;
        for record in self.events() {
            let offset_ns = record.offset_ns;
            let _has_room = events.push(record.event()?, offset_ns);
        }
        Ok(events)
    }

    /// No events.
    pub fn silence(&mut self) {
        self.events = [EventRecord::default(); EVENTS_MOST];
        self.event_count = 0;
    }

    /// Becomes another frame. What is not used of the events may stay as it was: for whoever looks
    /// at those that are used alone, and has little time.
    pub fn copy_used(&mut self, other: &Self) {
        let used = offset_of!(Self, events) + size_of_val(other.events());
        let (to, from) = (bytemuck::bytes_of_mut(self), bytemuck::bytes_of(other));
        if let (Some(to), Some(from)) = (to.get_mut(..used), from.get(..used)) {
            to.copy_from_slice(from);
        }
    }

    /// Whether all of `flags` are set.
    #[must_use]
    pub const fn has(&self, flags: FrameFlags) -> bool {
        FrameFlags(self.flags).contains(flags)
    }
}

impl Record for SetpointFrame {
    const NAME: &'static str = "glidepath.SetpointFrame.v4";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        fields.all_finite("position", &self.position)?;
        fields.all_finite("velocity", &self.velocity)?;
        fields.all_finite("acceleration", &self.acceleration)?;
        fields.finite("path_v", self.path_v)?;
        fields.finite("path_s", self.path_s)?;
        fields.range("programmed_v", self.programmed_v, 0.0, f64::MAX)?;
        fields.range(
            "planned_override",
            self.planned_override,
            f64::MIN_POSITIVE,
            OVERRIDE_MAX,
        )?;
        #[allow(
            clippy::cast_precision_loss,
            reason = "a range check needs no exact integer"
        )]
        fields.range(
            "period_ns",
            self.period_ns as f64,
            1.0,
            PERIOD_NS_MAX as f64,
        )?;
        fields.flags("flags", self.flags, FRAME_FLAGS)?;
        if self.epoch == 0 {
            let (record, field) = (Self::NAME, "epoch");
            let (low, high) = (1.0, f64::INFINITY);
            return Err(RecordError::OutOfRange {
                record,
                field,
                value: 0.0,
                low,
                high,
            });
        }
        event::check(Self::NAME, (&self.events, self.event_count), self.period_ns)?;
        let before_last = self
            .events()
            .split_last()
            .map_or(&[][..], |(_, before)| before);
        if event::at_rest(before_last).is_some() {
            let record = Self::NAME;
            let field = "what follows an event at rest";
            return Err(RecordError::NotZero { record, field });
        }
        Ok(())
    }
}
