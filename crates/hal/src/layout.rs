//! The layout of lines and rows: their columns.
//!
//! | | line, to `streamer` | row, from `sampler` |
//! |---|---|---|
//! | `u` | tick | tick of the line played in that period |
//! | `s` | | lines that were left in the FIFO |
//! | `b` | the drives are to have power | all drives have power |
//! | `b` | | a drive or the enable chain has a fault |
//! | `f` × joints | position, mm or degrees | position, mm or degrees |
//! | `f` × joints | velocity, per second | |
//! | `b` × joints | | home switch |

use crate::error::HalError;
use glidepath_link::servo::JointStates;
use std::fmt::Write as _;

/// The most joints: HAL's FIFOs have 20 columns at most.
pub const HAL_JOINTS: usize = 8;

/// Ticks are numbers of 31 bits: HAL's own are of 32, with and without a sign.
const TICKS: u64 = 1 << 31;

/// A row: what HAL says of one of its periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row {
    pub(crate) tick: u32,
    /// Lines left in the FIFO.
    pub(crate) depth: i64,
    pub(crate) has_power: bool,
    pub(crate) has_fault: bool,
    /// mm or degrees.
    pub(crate) position: [f64; 9],
    /// One bit each.
    pub(crate) home_switch: u32,
}

/// The columns for a number of joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    joints: usize,
}

impl Layout {
    /// The columns for so many joints.
    ///
    /// # Errors
    ///
    /// [`HalError::Joints`], if there is none, or more than [`HAL_JOINTS`].
    pub const fn new(joints: usize) -> Result<Self, HalError> {
        if joints == 0 || joints > HAL_JOINTS {
            return Err(HalError::Joints {
                joints,
                most: HAL_JOINTS,
            });
        }
        Ok(Self { joints })
    }

    /// What `streamer` is loaded with.
    #[must_use]
    pub fn streamer_cfg(&self) -> String {
        format!("ub{}", "f".repeat(2 * self.joints))
    }

    /// What `sampler` is loaded with.
    #[must_use]
    pub fn sampler_cfg(&self) -> String {
        format!("usbb{}{}", "f".repeat(self.joints), "b".repeat(self.joints))
    }

    /// One bit for each joint.
    pub(crate) const fn mask(&self) -> u32 {
        (1 << self.joints) - 1
    }

    /// Writes a line. Positions are finite: the servo library has seen to that.
    pub(crate) fn write(&self, out: &mut String, tick: u32, has_power: bool, joints: &JointStates) {
        // Writing to a string never fails.
        let _ = write!(out, "{tick} {}", u8::from(has_power));
        let joints = || joints.iter().take(self.joints);
        for joint in joints() {
            let _ = write!(out, " {}", joint.position);
        }
        for joint in joints() {
            let _ = write!(out, " {}", joint.velocity);
        }
        out.push('\n');
    }

    /// Reads a row; `None` if it is none of this layout.
    pub(crate) fn read(&self, text: &str) -> Option<Row> {
        let mut words = text.split_ascii_whitespace();
        let bit = |word: Option<&str>| match word? {
            "0" => Some(false),
            "1" => Some(true),
            _ => None,
        };
        let tick = words.next()?.parse().ok()?;
        let depth = words.next()?.parse().ok()?;
        let (has_power, has_fault) = (bit(words.next())?, bit(words.next())?);
        let mut position = [0.0; 9];
        for position in position.iter_mut().take(self.joints) {
            let read: f64 = words.next()?.parse().ok()?;
            *position = read.is_finite().then_some(read)?;
        }
        let mut home_switch = 0;
        for joint in 0..self.joints {
            home_switch |= u32::from(bit(words.next())?) << joint;
        }
        words.next().is_none().then_some(Row {
            tick,
            depth,
            has_power,
            has_fault,
            position,
            home_switch,
        })
    }
}

/// The tick of a period of HAL, counted from the start of `CLOCK_MONOTONIC`.
#[allow(clippy::cast_possible_truncation, reason = "31 bits are left")]
pub(crate) const fn tick_of(index: u64) -> u32 {
    (index % TICKS) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::servo::JointState;

    fn layout() -> Layout {
        Layout::new(3).unwrap()
    }

    #[test]
    fn lines_and_rows_have_the_columns_that_they_say() {
        let (layout, mut joints) = (layout(), [JointState::default(); 9]);
        joints[0].position = 1.5;
        joints[1].position = 1e-7;
        joints[2].velocity = -2e10;
        let mut line = String::new();
        layout.write(&mut line, 7, true, &joints);
        // Without exponents, whatever the size.
        assert_eq!(line, "7 1 1.5 0.0000001 0 0 0 -20000000000\n");
        assert_eq!(layout.streamer_cfg(), "ubffffff");
        assert_eq!(
            line.split_ascii_whitespace().count(),
            layout.streamer_cfg().len()
        );
        let text = "7 12 1 0 1.500000 -0.000001 0.000000 0 1 1 ";
        assert_eq!(layout.sampler_cfg(), "usbbfffbbb");
        assert_eq!(
            text.split_ascii_whitespace().count(),
            layout.sampler_cfg().len()
        );
        let row = layout.read(text).unwrap();
        assert_eq!((row.tick, row.depth, row.home_switch), (7, 12, 0b110));
        assert_eq!((row.has_power, row.has_fault), (true, false));
        assert_eq!(row.position[..4], [1.5, -1e-6, 0.0, 0.0]);
    }

    #[test]
    fn a_row_of_another_layout_is_none() {
        let good = "7 12 1 0 1.5 0.1 0.0 0 1 1";
        assert!(layout().read(good).is_some());
        for bad in [
            "",
            "overrun",
            "7 12 1 0 1.5 0.1 0.0 0 1",
            "7 12 1 0 1.5 0.1 0.0 0 1 1 1",
            "7 12 1 2 1.5 0.1 0.0 0 1 1",
            "7 12 1 0 nan 0.1 0.0 0 1 1",
            "7 12 1 0 inf 0.1 0.0 0 1 1",
            "-7 12 1 0 1.5 0.1 0.0 0 1 1",
        ] {
            assert_eq!(layout().read(bad), None, "{bad}");
        }
    }

    #[test]
    fn joints_are_as_many_as_there_are_columns_for() {
        assert!(Layout::new(0).is_err());
        let most = Layout::new(HAL_JOINTS).unwrap();
        assert!(most.streamer_cfg().len() <= 20 && most.sampler_cfg().len() <= 20);
        assert!(Layout::new(HAL_JOINTS + 1).is_err());
    }

    #[test]
    fn ticks_begin_again_where_hal_would_see_a_sign() {
        assert_eq!(tick_of(TICKS - 1), 0x7fff_ffff);
        assert_eq!(tick_of(TICKS), 0);
    }
}
