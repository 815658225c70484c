//! The settings of a spindle on a drive in velocity mode (CiA 402).

use super::gear_settings::{Gear, GearSettings};
use super::orienting::{Guide, OrientationSettings};
use crate::entry::Mapping;

/// The mode in which the drive of a spindle takes its speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpindleMode {
    /// Cyclic synchronous velocity (9): 0x60FF at every SYNC0.
    CyclicVelocity,
    /// Profile velocity (3): 0x60FF, with frames.
    ProfileVelocity,
    /// Velocity of inverters (2): 0x6042 in rev/min, with frames.
    Velocity,
}

impl SpindleMode {
    /// As 0x6060 has it.
    pub(crate) const fn code(self) -> i8 {
        match self {
            Self::CyclicVelocity => 9,
            Self::ProfileVelocity => 3,
            Self::Velocity => 2,
        }
    }

    /// The object of the target, and how many bits it has.
    pub(crate) const fn target(self) -> (u16, u32) {
        match self {
            Self::CyclicVelocity | Self::ProfileVelocity => (0x60ff, 32),
            Self::Velocity => (0x6042, 16),
        }
    }

    /// The object of the actual velocity, and how many bits it has.
    pub(crate) const fn actual(self) -> (u16, u32) {
        match self {
            Self::CyclicVelocity | Self::ProfileVelocity => (0x606c, 32),
            Self::Velocity => (0x6044, 16),
        }
    }

    /// What the controlword has besides with power: an inverter stands without the enabling of its ramp.
    pub(crate) const fn ramp_bits(self) -> u16 {
        match self {
            Self::CyclicVelocity | Self::ProfileVelocity => 0,
            Self::Velocity => 0x70,
        }
    }

    /// Whether it works with SYNC0.
    pub(crate) const fn is_cyclic(self) -> bool {
        matches!(self, Self::CyclicVelocity)
    }
}

/// A spindle on a drive in velocity mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpindleSettings {
    /// How it takes its speed.
    pub mode: SpindleMode,
    /// A rev/min in the drive's unit of velocity, > 0: of the motor where it has gears.
    pub units_per_rpm: f64,
    /// It turns clockwise (M3) where the drive counts down.
    pub is_inverted: bool,
    /// The highest speed that is asked for, rev/min, > 0.
    pub max_rpm: f64,
    /// How fast the speed that is asked for changes, rev/min in a second, > 0.
    pub ramp_rpm_per_s: f64,
    /// How near to its speed it is at speed, as a part of it, > 0.
    pub at_speed_r: f64,
    /// The gears between its motor and it; `None` if that turns as fast as it, or always by the same ratio.
    pub gears: Option<GearSettings>,
    /// How it is turned to an angle; `None` if it is not. It takes cyclic velocity, and no gears.
    pub orientation: Option<OrientationSettings>,
    /// Its drive tells its torque (0x6077), thousandths of the rated one.
    pub tells_load: bool,
    /// Who says what is in its process data.
    pub mapping: Mapping,
}

impl SpindleSettings {
    /// The settings of the spindle in a gear, by which its drive is led.
    pub(super) fn in_gear(&self, gear: &Gear) -> Self {
        Self {
            units_per_rpm: self.units_per_rpm * gear.ratio,
            is_inverted: self.is_inverted != gear.is_inverted,
            max_rpm: gear.max_rpm,
            ramp_rpm_per_s: gear.ramp_rpm_per_s,
            ..*self
        }
    }

    fn sign(&self) -> f64 {
        if self.is_inverted { -1.0 } else { 1.0 }
    }

    /// A speed in the drive's unit, as far as its object goes.
    #[allow(clippy::cast_possible_truncation, reason = "it is inside the type")]
    pub(crate) fn counts(&self, rpm: f64) -> i32 {
        let bits = self.mode.target().1;
        let most = f64::from(i32::MAX >> (32 - bits));
        (self.sign() * rpm * self.units_per_rpm)
            .round()
            .clamp(-most, most) as i32
    }

    /// The speed that the drive tells, rev/min.
    pub(crate) fn rpm(&self, counts: i32) -> f64 {
        self.sign() * f64::from(counts) / self.units_per_rpm
    }

    /// How long its ramp takes from its highest speed, ns.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it saturates"
    )]
    pub(crate) fn ramp_ns(&self) -> u64 {
        let gears = self.gears.iter().flat_map(|gears| gears.all());
        let own = self.max_rpm / self.ramp_rpm_per_s;
        let longest = gears.fold(own, |longest, (_, gear)| {
            longest.max(gear.max_rpm / gear.ramp_rpm_per_s)
        });
        (longest * 1e9) as u64
    }

    /// Below this it stands, rev/min: what an inverter's estimate is off.
    pub(crate) fn still_rpm(&self) -> f64 {
        (0.005 * self.max_rpm).max(1.0)
    }

    /// How far it may be from its speed at speed, rev/min.
    pub(crate) fn near_rpm(&self, rpm: f64) -> f64 {
        (self.at_speed_r * rpm.abs()).max(self.still_rpm())
    }

    /// How the way to an angle is led, where it is turned to one.
    pub(super) fn guide(&self) -> Option<Guide> {
        Some(Guide {
            settings: self.orientation?,
            is_inverted: self.is_inverted,
            ramp_rpm_per_s: self.ramp_rpm_per_s,
        })
    }

    /// What is mapped: outputs and inputs, index, subindex and bits of each.
    pub(crate) fn entries(&self) -> (Vec<u32>, Vec<u32>) {
        let entry = |(index, bits): (u16, u32)| u32::from(index) << 16 | bits;
        let mut outputs = vec![0x6040_0010, entry(self.mode.target()), 0x6060_0008];
        let actual = entry(self.mode.actual());
        let mut inputs = vec![0x6041_0010, actual, 0x6061_0008, 0x603f_0010];
        if self.orientation.is_some() {
            outputs.push(0x607a_0020);
            inputs.push(0x6064_0020);
        }
        if self.tells_load {
            inputs.push(0x6077_0010);
        }
        (outputs, inputs)
    }
}
