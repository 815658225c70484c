//! The setpoint record, from the interpolator to the servo: what the drives are to do at one tick.

use super::check::{Fields, RecordError};
use super::{
    ALL_JOINTS, EventRecord, MachineState, OVERRIDE_MAX, PERIOD_NS_MAX, Record, event,
    frame::FRAME_FLAGS,
};
use glidepath_geometry::AXES;
use glidepath_program::{EVENTS_MOST, Event, FrameFlags};
use iceoryx2::prelude::ZeroCopySend;

/// Properties of a setpoint, one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SetpointMarks(pub u32);

impl SetpointMarks {
    /// Computed late, but within its period.
    pub const LATE: Self = Self(1);
    /// One or more ticks before it were missed.
    pub const AFTER_MISSED: Self = Self(1 << 1);
}

/// A setpoint: what the drives are to do at `apply_ns`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.Setpoint.v6")]
pub struct Setpoint {
    /// Identifies one life of the interpolator: all counts start again with a new one.
    pub boot_id: u64,
    /// Counts how often the position was taken from the drives, or given a new meaning, instead of
    /// continuing the one before. Whoever plays setpoints begins anew at a new one, at rest, and
    /// never goes from the position before to the one after.
    pub reference: u64,
    /// Counts the setpoints of this life from 0, without gaps. A gap seen by a subscriber is loss.
    pub number: u64,
    /// Index on the interpolator's time grid. A gap where `number` has none is a missed tick.
    pub tick: u64,
    /// When the tick was due, ns of `CLOCK_MONOTONIC`.
    pub scheduled_ns: u64,
    /// When the setpoint is to be applied, ns of `CLOCK_MONOTONIC`: one period after
    /// `scheduled_ns`, so that the time of delivery does not matter.
    pub apply_ns: u64,
    /// How late the tick began, ns.
    pub lateness_ns: u64,
    /// Missed ticks of this life so far.
    pub missed_ticks: u64,
    /// The trajectory, 0 before the first.
    pub epoch: u64,
    /// Last frame at or before the present program time, which falls while the motion goes back.
    pub sequence: u64,
    /// Program time past that frame, in periods, 0 ≤ f < 1.
    pub fraction: f64,
    /// Source line, 0 before the first.
    pub line: u32,
    /// Bits of [`FrameFlags`] of the frame `sequence`.
    pub flags: u32,
    /// Bits of [`SetpointMarks`].
    pub marks: u32,
    /// Code of a [`MachineState`].
    pub state: u32,
    /// How many of `events` are used.
    pub event_count: u32,
    /// Block of the program being executed, 0 before the first: see
    /// [`super::SetpointFrame::block`].
    pub block: u32,
    /// The joints whose drives are to have power, one bit each, J0 lowest.
    pub enable: u32,
    /// The joints whose drives are to find their home by themselves, one bit each. Their positions
    /// here are those they report, and nothing to be followed: having found it, they stay there
    /// until their bit is 0.
    pub home: u32,
    /// Path position since the start of the program, mm.
    pub path_s: f64,
    /// Rate of path position as executed, mm/s; below 0 while the motion goes back.
    pub feed_v: f64,
    /// Override as executed, 0 to [`OVERRIDE_MAX`]: that of the plan times the rate of program
    /// time.
    pub effective_override: f64,
    /// Axis positions, mm or degrees.
    pub position: [f64; AXES],
    /// Axis velocities, mm/s or °/s.
    pub velocity: [f64; AXES],
    /// Axis accelerations, mm/s² or °/s².
    pub acceleration: [f64; AXES],
    /// Joint positions as the drives count them, mm or degrees.
    pub joint_position: [f64; AXES],
    /// Joint velocities, mm/s or °/s.
    pub joint_velocity: [f64; AXES],
    /// Joint accelerations, mm/s² or °/s².
    pub joint_acceleration: [f64; AXES],
    /// How far the axes are from the path, mm or degrees, because they were jogged while the
    /// program was held: the positions above are those of the path and this together.
    pub away: [f64; AXES],
    /// What happens in the period from `scheduled_ns` to `apply_ns`, in order: each event so many ns
    /// after `scheduled_ns`. What is not used is zero.
    pub events: [EventRecord; EVENTS_MOST],
    /// How far the axes are from the positions above, mm or degrees, by a superposition: those are what program and
    /// hand ask for, the joints do both.
    pub superposed: [f64; AXES],
    /// The joints whose drives are to keep where they are at the next index pulse of their encoder, one bit each:
    /// see [`super::Feedback::index_armed`]. What was kept before counts no more while the bit is 0.
    pub index: u32,
    /// Must be zero.
    pub reserved: u32,
}

impl Setpoint {
    /// The state of the machine.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn state(&self) -> Result<MachineState, RecordError> {
        Fields(Self::NAME).code("state", self.state)
    }

    /// Whether it lies between two frames, or begins there: a jog away from a held path sets out from
    /// wherever the motion was held.
    #[must_use]
    pub fn is_between_frames(&self) -> bool {
        self.fraction > 0.0 || self.state() == Ok(MachineState::Jogging)
    }

    /// What happens in the period from `scheduled_ns` to `apply_ns`, in order.
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

    /// Removes the events: nothing happens.
    pub fn silence(&mut self) {
        for event in self.events.iter_mut().take(self.event_count as usize) {
            *event = EventRecord::default();
        }
        self.event_count = 0;
    }

    /// One more event happens, if there is room for it.
    pub fn tell(&mut self, event: EventRecord) -> bool {
        let slot = self.events.get_mut(self.event_count as usize);
        let has_room = slot.is_some();
        if let Some(slot) = slot {
            *slot = event;
            self.event_count += 1;
        }
        has_room
    }

    /// Whether all of `flags` are set.
    #[must_use]
    pub const fn has(&self, flags: FrameFlags) -> bool {
        FrameFlags(self.flags).contains(flags)
    }
}

impl Record for Setpoint {
    const NAME: &'static str = "glidepath.Setpoint.v6";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        fields.all_finite("position", &self.position)?;
        fields.all_finite("velocity", &self.velocity)?;
        fields.all_finite("acceleration", &self.acceleration)?;
        fields.all_finite("joint_position", &self.joint_position)?;
        fields.all_finite("joint_velocity", &self.joint_velocity)?;
        fields.all_finite("joint_acceleration", &self.joint_acceleration)?;
        fields.all_finite("away", &self.away)?;
        fields.all_finite("superposed", &self.superposed)?;
        fields.range("fraction", self.fraction, 0.0, 1.0)?;
        fields.finite("path_s", self.path_s)?;
        fields.finite("feed_v", self.feed_v)?;
        fields.range(
            "effective_override",
            self.effective_override,
            0.0,
            OVERRIDE_MAX,
        )?;
        fields.flags("flags", self.flags, FRAME_FLAGS)?;
        let marks = SetpointMarks::LATE.0 | SetpointMarks::AFTER_MISSED.0;
        fields.flags("marks", self.marks, marks)?;
        fields.flags("enable", self.enable, ALL_JOINTS)?;
        fields.flags("home", self.home, ALL_JOINTS)?;
        fields.flags("index", self.index, ALL_JOINTS)?;
        fields.zero("reserved", self.reserved)?;
        self.state()?;
        event::check(Self::NAME, (&self.events, self.event_count), PERIOD_NS_MAX)
    }
}
