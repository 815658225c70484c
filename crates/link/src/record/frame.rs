//! Planner to interpolator: the state of the machine on the grid of program time.

use super::check::{Fields, RecordError};
use super::{OVERRIDE_MAX, Record, event};
use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::{Event, Frame, FrameFlags};
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
#[type_name("glidepath.SetpointFrame.v2")]
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
    /// Code of the event at this instant, 0 for none.
    pub event_kind: u32,
    /// Which block of the program this belongs to: the number of its item, from 1, counted through
    /// loops and subprograms; 0 before the first.
    pub block: u32,
    /// The event's number (speed, tool, M code), 0 without an event.
    pub event_value: f64,
    /// Rate of path position, mm/s.
    pub path_v: f64,
    /// Path position since the start of the program, mm.
    pub path_s: f64,
    /// The override this was planned with, > 0, up to [`OVERRIDE_MAX`].
    pub planned_override: f64,
    /// Identifies the text of the program, 0 if it has none that could be read again.
    pub program: u64,
    /// Position, mm or degrees.
    pub position: [f64; AXES],
    /// Velocity, mm/s or °/s.
    pub velocity: [f64; AXES],
    /// Acceleration, mm/s² or °/s².
    pub acceleration: [f64; AXES],
}

impl SetpointFrame {
    /// The record of a planned frame, bit for bit, of an unknown program.
    #[must_use]
    pub fn from_frame(frame: &Frame, epoch: u64, period_ns: u64) -> Self {
        let (event_kind, event_value) = event::encode(frame.event);
        Self {
            epoch,
            sequence: frame.sequence,
            period_ns,
            line: frame.line,
            flags: frame.flags.0,
            event_kind,
            block: frame.block,
            event_value,
            path_v: frame.path_v,
            path_s: frame.path_s,
            planned_override: frame.planned_override,
            program: 0,
            position: frame.position.into(),
            velocity: frame.velocity.into(),
            acceleration: frame.acceleration.into(),
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
            event: self.event()?,
            planned_override: self.planned_override,
            path_v: self.path_v,
            path_s: self.path_s,
            position: AxisVector::from(self.position),
            velocity: AxisVector::from(self.velocity),
            acceleration: AxisVector::from(self.acceleration),
        })
    }

    /// The event at this instant.
    ///
    /// # Errors
    ///
    /// An unknown code, or a number that does not fit it.
    pub fn event(&self) -> Result<Option<Event>, RecordError> {
        event::decode(Self::NAME, self.event_kind, self.event_value)
    }

    /// Whether all of `flags` are set.
    #[must_use]
    pub const fn has(&self, flags: FrameFlags) -> bool {
        FrameFlags(self.flags).contains(flags)
    }
}

impl Record for SetpointFrame {
    const NAME: &'static str = "glidepath.SetpointFrame.v2";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        fields.all_finite("position", &self.position)?;
        fields.all_finite("velocity", &self.velocity)?;
        fields.all_finite("acceleration", &self.acceleration)?;
        fields.finite("path_v", self.path_v)?;
        fields.finite("path_s", self.path_s)?;
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
        self.event().map(|_| ())
    }
}
