//! The feedback record, from a servo stack to the interpolator: where the joints are, and what the
//! drives know besides.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{ALL_JOINTS, Record};
use glidepath_geometry::AXES;
use iceoryx2::prelude::ZeroCopySend;

/// Inputs that can be latched at a time.
pub const LATCHES: usize = 4;

coded! {
    /// The state of a drive, by the states of CiA 402.
    pub enum DriveState {
        /// Nothing is known of it; also that of joints which the record does not claim.
        Unknown = 0,
        /// Not ready to switch on.
        NotReady = 1,
        /// Switch on disabled.
        SwitchOnDisabled = 2,
        /// Ready to switch on.
        Ready = 3,
        /// Switched on.
        SwitchedOn = 4,
        /// Operation enabled: it follows setpoints.
        OperationEnabled = 5,
        /// Quick stop active.
        QuickStop = 6,
        /// Fault reaction active.
        FaultReaction = 7,
        /// Fault.
        Fault = 8,
    }
}

coded! {
    /// The way in which a latched position was found.
    pub enum LatchKind {
        /// None yet.
        None = 0,
        /// By the drive, at the moment of the edge.
        Drive = 1,
        /// Between two samples, by the time stamp of the edge.
        Interpolated = 2,
        /// The next sample after the edge.
        Sampled = 3,
        /// Not yet: this record has the edge among its inputs, and a later one has the position, or any
        /// other kind if there is none to come.
        Awaited = 4,
    }
}

coded! {
    /// What a servo stack has lost, for which it does not obey any more: joints that it was to lead stand,
    /// and outputs that it works are at rest.
    pub enum Loss {
        /// Nothing.
        None = 0,
        /// Setpoints stayed away for longer than its patience.
        Setpoints = 1,
        /// A device on its bus.
        Device = 2,
        /// Its bus, which came up again since.
        Bus = 3,
        /// The drive of its spindle, which reports a fault or has no power.
        Spindle = 4,
        /// The gear of its spindle: it is not in.
        Gear = 5,
    }
}

/// The state of the spindle, one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SpindleFlags(pub u32);

impl SpindleFlags {
    /// It turns as fast as it was told to.
    pub const AT_SPEED: Self = Self(1);
    /// It stands.
    pub const STOPPED: Self = Self(1 << 1);
    /// It stands at the angle it was told to.
    pub const ORIENTED: Self = Self(1 << 2);
    /// Its drive reports a fault.
    pub const FAULT: Self = Self(1 << 3);
    /// [`Feedback::spindle_angle`] is measured. Without it nothing follows the spindle.
    pub const ANGLE: Self = Self(1 << 4);
    /// [`Feedback::spindle_index_count`] is counted, and the angle is whole at the index.
    pub const INDEX: Self = Self(1 << 5);

    /// [`Feedback::spindle_v`] is measured.
    pub const SPEED: Self = Self(1 << 6);

    /// [`Feedback::spindle_load`] is measured.
    pub const LOAD: Self = Self(1 << 7);

    /// The gear that it was told is in (M41 to M45).
    pub const IN_GEAR: Self = Self(1 << 8);

    pub(super) const KNOWN: u32 = (1 << 9) - 1;

    /// True if all of `other` are set.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

/// The positions at the last edge of an input.
#[repr(C)]
#[derive(
    Debug, Clone, Copy, PartialEq, Default, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend,
)]
pub struct Latch {
    /// Counts the edges from 0.
    pub count: u64,
    /// When the last one was, ns of `CLOCK_MONOTONIC`.
    pub latch_ns: u64,
    /// Joint positions then, as the drives count them, mm or degrees.
    pub position: [f64; AXES],
    /// Which input: a bit of [`Feedback::digital_in`] by its index.
    pub input: u32,
    /// 1 for a rising edge, 0 for a falling one.
    pub rising: u32,
    /// Code of a [`LatchKind`].
    pub kind: u32,
    /// Must be zero.
    pub reserved: u32,
}

/// The feedback of a servo stack: what it knows of the joints it drives, at one moment. Several
/// stacks may each send theirs, for joints of which no two are the same.
///
/// To be sent once a period or more often; 1 kHz is good.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.Feedback.v5")]
pub struct Feedback {
    /// Identifies one life of the stack: another stack, or the same started again, has another.
    pub boot_id: u64,
    /// Counts the records of this life, without gaps. A gap seen by a reader is loss.
    pub number: u64,
    /// When the positions were measured, ns of `CLOCK_MONOTONIC`.
    pub sample_ns: u64,
    /// The reference of the setpoint that the stack plays: see [`super::Setpoint::reference`]; 0
    /// before the first.
    pub reference: u64,
    /// The number of that setpoint.
    pub setpoint_number: u64,
    /// The joints that this is about, one bit each, J0 lowest. What is said below of others means
    /// nothing.
    pub joints: u32,
    /// The joints that have power and follow setpoints.
    pub enabled: u32,
    /// The joints that know where they are: absolute encoders, or those that found their home.
    pub homed: u32,
    /// The joints that look for their home by themselves.
    pub homing: u32,
    /// The joints whose drives report a fault.
    pub fault: u32,
    /// The joints that stand at their lower limit switch.
    pub limit_low: u32,
    /// The joints that stand at their upper limit switch.
    pub limit_high: u32,
    /// The joints that stand at their home switch.
    pub home_switch: u32,
    /// Joint positions as the drives count them, mm or degrees.
    pub position: [f64; AXES],
    /// Joint velocities, mm/s or °/s.
    pub velocity: [f64; AXES],
    /// Codes of [`DriveState`].
    pub drive_state: [u32; AXES],
    /// The drives' own numbers of their faults, 0 for none.
    pub fault_code: [u32; AXES],
    /// Digital inputs, one bit each.
    pub digital_in: u64,
    /// Analog inputs, in whatever unit they have.
    pub analog_in: [f64; 8],
    /// Angle of the spindle at `sample_ns` since some start, in revolutions, never wrapped, falling
    /// if it turns backwards. Where there is an index it is whole at every pulse.
    pub spindle_angle: f64,
    /// Speed of the spindle, rev/s, negative if it turns backwards.
    pub spindle_v: f64,
    /// Index pulses of the spindle so far, in either direction.
    pub spindle_index_count: u64,
    /// Bits of [`SpindleFlags`].
    pub spindle_flags: u32,
    /// Code of a [`Loss`]: what the stack has lost. What it stopped for that it tells until a fault of the
    /// interpolator is reset, or another interpolator is there; nothing that stopped by it begins again before.
    pub loss: u32,
    /// Of setpoints, how long none came, s. Of a device, its place in the line from 0, or -1 where none
    /// says that it is missing. Of a spindle the number of its fault, 0 without power. Of
    /// a gear its number, 0 where nobody said which one is to be in. 0 otherwise.
    pub loss_value: f64,
    /// The inputs that are latched.
    pub latch: [Latch; LATCHES],
    /// The joints whose drives are ready to keep where they are at the next index pulse, one bit each: of those in
    /// [`super::Setpoint::index`] alone, and not before they have forgotten what they kept. One that was ready and is not
    /// any more is not ready again before its bit there was 0.
    pub index_armed: u32,
    /// Those of them that have kept it since.
    pub index_kept: u32,
    /// Where these were at the index pulse, as the drives count, mm or degrees.
    pub index_position: [f64; AXES],
    /// Load of the spindle: the magnitude of its torque as a part of its rated one.
    pub spindle_load: f64,
}

impl Feedback {
    /// The state of the spindle.
    #[must_use]
    pub const fn spindle(&self) -> SpindleFlags {
        SpindleFlags(self.spindle_flags)
    }
}

impl Record for Feedback {
    const NAME: &'static str = "glidepath.Feedback.v5";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        for (field, mask) in [
            ("joints", self.joints),
            ("enabled", self.enabled),
            ("homed", self.homed),
            ("homing", self.homing),
            ("fault", self.fault),
            ("limit_low", self.limit_low),
            ("limit_high", self.limit_high),
            ("home_switch", self.home_switch),
            ("index_armed", self.index_armed),
            ("index_kept", self.index_kept),
        ] {
            fields.flags(field, mask, ALL_JOINTS)?;
        }
        fields.all_finite("position", &self.position)?;
        fields.all_finite("velocity", &self.velocity)?;
        fields.all_finite("index_position", &self.index_position)?;
        fields.finite("spindle_load", self.spindle_load)?;
        for code in self.drive_state {
            fields.code::<DriveState>("drive_state", code)?;
        }
        fields.all_finite("analog_in", &self.analog_in)?;
        fields.finite("spindle_angle", self.spindle_angle)?;
        fields.finite("spindle_v", self.spindle_v)?;
        fields.flags("spindle_flags", self.spindle_flags, SpindleFlags::KNOWN)?;
        fields.code::<Loss>("loss", self.loss)?;
        fields.finite("loss_value", self.loss_value)?;
        for latch in &self.latch {
            fields.all_finite("latch.position", &latch.position)?;
            fields.range("latch.input", f64::from(latch.input), 0.0, 63.0)?;
            fields.flags("latch.rising", latch.rising, 1)?;
            fields.code::<LatchKind>("latch.kind", latch.kind)?;
            fields.zero("latch.reserved", latch.reserved)?;
        }
        Ok(())
    }
}
