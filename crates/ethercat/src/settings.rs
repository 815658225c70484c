//! The settings of the bus and of its drives.

use crate::entry::Mapping;
use crate::feed_forward::{FeedForward, Offsets};
use crate::probe::TouchProbe;
use crate::terminal::{DigitalInput, TerminalSettings};
use glidepath_geometry::AXES;
use glidepath_link::servo::ServoSettings;

/// The bus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BusSettings {
    /// Time between two frames, which is that between two SYNC0, ns: 1, 2 or 4 ms as drives like it.
    pub period_ns: u64,
    /// From the sending of a frame to the SYNC0 at which it takes effect, ns; less than the period.
    pub shift_ns: u64,
    /// How much later than they say setpoints are played, ns. They come a period of the interpolator
    /// before they apply, and are asked for a shift before they take effect, so that this has to be
    /// more than the shift, by what they may be late. Positions are stamped earlier by it.
    pub delay_ns: u64,
    /// Frames lost in a row after which the bus counts as lost, ≥ 1.
    pub lost_frames: u32,
    /// How long a drive goes on without outputs, ns; its own watchdog then takes it out of OP.
    pub watchdog_ns: u64,
}

impl Default for BusSettings {
    /// 2 ms, in the middle, setpoints that may be 2 ms late, three frames, 10 ms.
    fn default() -> Self {
        Self {
            period_ns: 2_000_000,
            shift_ns: 1_000_000,
            delay_ns: 3_000_000,
            lost_frames: 3,
            watchdog_ns: 10_000_000,
        }
    }
}

/// The homing of a drive by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HomingSettings {
    /// Homing method by CiA 402, or the manufacturer's if negative.
    pub method: i8,
    /// How fast the switch is looked for, mm/s or °/s.
    pub fast_v: f64,
    /// How fast its edge or the index is looked for, mm/s or °/s.
    pub slow_v: f64,
    /// mm/s² or °/s².
    pub acceleration_a: f64,
    /// Joints of a lower number are home before those of a higher one begin.
    pub sequence: u32,
}

/// Axes that a device has at most: their objects are from 0x6000 to 0x9FFF.
pub const DEVICE_AXES: u16 = 8;
/// Counts of a drive that turns on and on: 2⁵³.
const MOST_COUNTS: f64 = 9_007_199_254_740_992.0;
/// How far the objects of an axis are from those of the one before.
const OBJECT_STEP: u16 = 0x800;

/// A drive, and the joint that it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveSettings {
    /// The joint, from 0.
    pub joint: usize,
    /// The place in the line, from 0.
    pub position: usize,
    /// Which of the axes of a device it is, from 0.
    pub axis: u16,
    /// How far the maps of an axis are from those of the one before.
    pub map_step: u16,
    /// What it is to be; nothing is compared with 0.
    pub vendor: u32,
    /// The vendor's number of the product.
    pub product: u32,
    /// The number given by hand.
    pub alias: u16,
    /// Where its outputs and its inputs are in its memory, if its EEPROM does not say.
    pub process_at: Option<(u16, u16)>,
    /// Who says what is in its process data.
    pub mapping: Mapping,
    /// Counts a mm or a degree, > 0.
    pub counts_per_unit: f64,
    /// It turns on and on: its counter goes round and begins anew, by its range (0x607B) or by 32 bits.
    pub is_modulo: bool,
    /// It counts the other way.
    pub is_inverted: bool,
    /// Where the joint is when the drive counts zero, mm or degrees.
    pub home_offset: f64,
    /// How it finds its home; `None` for an absolute encoder, which knows.
    pub homing: Option<HomingSettings>,
    /// How far it may be from its target, mm or degrees; watched by the drive.
    pub following_error: f64,
    /// How long it may be further away, ms.
    pub following_ms: u16,
    /// How far the first demand may be from where the joint stands, mm or degrees.
    pub enable_window: f64,
    /// Deceleration of the drive's own stop, mm/s² or °/s².
    pub quick_stop_a: f64,
    /// The most torque in the positive and in the negative direction of the joint, thousandths of the rated one
    /// (0x60E0, 0x60E1); `None` leaves what the drive has.
    pub torque_limits: [Option<u16>; 2],
    /// What of the motion is told beside its targets; `None` for nothing.
    pub feed_forward: Option<FeedForward>,
    /// Its touch probe; of all drives or of none.
    pub probe: Option<TouchProbe>,
    /// Which touch probe keeps the index pulse of its encoder while the joint looks for its home by that; the one that
    /// `probe` has, where there is one.
    pub index: Option<u8>,
    /// Its digital inputs (0x60FD) are to be read.
    pub has_inputs: bool,
    /// The joint's highest speed, mm/s or °/s. A target a fifth further away than that is not sent.
    pub max_v: f64,
}

impl DriveSettings {
    /// The touch probe that is used, for whatever.
    pub(crate) fn touch_probe(&self) -> Option<TouchProbe> {
        self.probe.or(self.index.map(TouchProbe::of_index))
    }

    /// Where its axis has an object of CiA 402. Others are the whole device's.
    pub(crate) const fn own(&self, index: u16) -> u16 {
        Self::of_axis(index, self.axis)
    }

    /// Where any axis has it.
    pub(crate) const fn of_axis(index: u16, axis: u16) -> u16 {
        match index {
            0x6000..0x6800 => index + OBJECT_STEP * axis,
            _ => index,
        }
    }

    fn sign(&self) -> f64 {
        if self.is_inverted { -1.0 } else { 1.0 }
    }

    /// Where the joint is when the drive counts `counts`, mm or degrees.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "far below 2⁵³")]
    pub fn place(&self, counts: impl Into<i64>) -> f64 {
        self.sign() * counts.into() as f64 / self.counts_per_unit + self.home_offset
    }

    /// What the drive counts when the joint is at a place; `None` where its counter ends.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "it is inside the type")]
    pub fn counts(&self, place: f64) -> Option<i64> {
        let counts = (self.sign() * (place - self.home_offset) * self.counts_per_unit).round();
        // Up to where every count is a number of its own.
        let range = if self.is_modulo {
            -MOST_COUNTS..=MOST_COUNTS
        } else {
            f64::from(i32::MIN)..=f64::from(i32::MAX)
        };
        range.contains(&counts).then_some(counts as i64)
    }

    /// What is told beside the target of a motion with this velocity and acceleration.
    pub(crate) fn offsets(&self, velocity: f64, acceleration: f64) -> Offsets {
        let (sign, told) = (self.sign(), self.feed_forward);
        told.map_or_else(Offsets::default, |told| {
            told.offsets(sign * velocity, sign * acceleration)
        })
    }

    /// The limits of torque as the drive turns: forwards and backwards.
    pub(crate) const fn own_torque_limits(&self) -> [Option<u16>; 2] {
        let [positive, negative] = self.torque_limits;
        if self.is_inverted {
            [negative, positive]
        } else {
            [positive, negative]
        }
    }

    /// A positive rate or distance in counts, at most what the object can hold.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it saturates"
    )]
    pub(crate) fn unsigned(&self, rate: f64) -> u32 {
        (rate * self.counts_per_unit)
            .round()
            .clamp(1.0, 2_147_483_647.0) as u32
    }

    /// The furthest that a target may be from the one before it, counts.
    #[allow(clippy::cast_precision_loss, reason = "a period")]
    #[must_use]
    pub fn guard_counts(&self, since_ns: u64) -> f64 {
        // A fifth above the top speed, and what rounding to counts makes of two places.
        1.2 * self.max_v * since_ns as f64 * 1e-9 * self.counts_per_unit + 1.0
    }
}

/// The settings of the bus and of all its drives.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// The bus.
    pub bus: BusSettings,
    /// The drives, one for each joint, at most nine, no place and no joint twice.
    pub drives: Vec<DriveSettings>,
    /// Inputs of drives, with the number of the drive among these; `at` is a bit of its 0x60FD.
    pub drive_inputs: Vec<(usize, DigitalInput)>,
    /// All devices besides that are led: none of them at the place of a drive, and none twice.
    pub terminals: Vec<TerminalSettings>,
    /// What the joints' own stop may use.
    pub servo: ServoSettings,
}

impl Settings {
    /// How long the spindle takes along its ramp at most, ns; 0 without one on a drive.
    pub(crate) fn spindle_ramp_ns(&self) -> u64 {
        let spindles = self.terminals.iter().filter_map(|device| device.spindle);
        spindles.map(|spindle| spindle.ramp_ns()).max().unwrap_or(0)
    }

    /// The joints that have a drive, one bit each.
    #[must_use]
    pub fn joints(&self) -> u32 {
        let bits = self
            .drives
            .iter()
            .map(|drive| 1_u32 << drive.joint.min(AXES - 1));
        bits.fold(0, |all, bit| all | bit)
    }
}

#[cfg(test)]
impl DriveSettings {
    /// Those of a drive of 1000 counts a mm with an absolute encoder, for tests.
    pub(crate) const fn of_1000_counts() -> Self {
        Self {
            joint: 0,
            position: 0,
            axis: 0,
            map_step: 0x10,
            vendor: 0,
            product: 0,
            alias: 0,
            process_at: None,
            mapping: Mapping::Written,
            counts_per_unit: 1000.0,
            is_modulo: false,
            is_inverted: false,
            home_offset: 0.0,
            homing: None,
            following_error: 2.0,
            following_ms: 10,
            enable_window: 0.05,
            quick_stop_a: 4000.0,
            torque_limits: [None; 2],
            feed_forward: None,
            probe: None,
            index: Some(1),
            has_inputs: false,
            max_v: 200.0,
        }
    }
}
