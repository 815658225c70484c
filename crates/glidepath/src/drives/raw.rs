//! The raw `drives.toml`, as it is written, before any value is judged.

use super::raw_device::{Optional, RawDevice, RawInput, RawMap};
use serde::Deserialize;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawDrives {
    pub(super) bus: RawBus,
    #[serde(default)]
    pub(super) drive: Vec<Spanned<RawDrive>>,
    #[serde(default)]
    pub(super) device: Vec<Spanned<RawDevice>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawBus {
    pub(super) interface: String,
    pub(super) period_us: Optional<i64>,
    pub(super) shift_us: Optional<i64>,
    pub(super) delay_us: Optional<i64>,
    pub(super) lost_frames: Optional<i64>,
    pub(super) watchdog_ms: Optional<i64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawDrive {
    pub(super) joint: Spanned<i64>,
    pub(super) position: Spanned<i64>,
    pub(super) axis: Optional<i64>,
    pub(super) map_step: Optional<i64>,
    pub(super) vendor: Optional<i64>,
    pub(super) product: Optional<i64>,
    pub(super) alias: Optional<i64>,
    pub(super) outputs_at: Optional<i64>,
    pub(super) inputs_at: Optional<i64>,
    #[serde(default)]
    pub(super) map: RawMap,
    pub(super) counts_per_mm: Optional<f64>,
    pub(super) counts_per_deg: Optional<f64>,
    #[serde(default)]
    pub(super) modulo: bool,
    #[serde(default)]
    pub(super) invert: bool,
    pub(super) home_offset: Optional<f64>,
    pub(super) following_error: Spanned<f64>,
    pub(super) following_ms: Optional<i64>,
    pub(super) enable_window: Optional<f64>,
    pub(super) quick_stop: Spanned<f64>,
    pub(super) torque_positive: Optional<f64>,
    pub(super) torque_negative: Optional<f64>,
    pub(super) feed_forward: Optional<RawFeedForward>,
    pub(super) homing: Optional<RawHoming>,
    pub(super) probe: Option<RawTouchProbe>,
    pub(super) index: Optional<i64>,
    #[serde(default)]
    pub(super) inputs: Vec<Spanned<RawInput>>,
}

/// What a drive is told of the motion beside its targets.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFeedForward {
    #[serde(default)]
    pub(super) velocity: bool,
    pub(super) velocity_units: Optional<f64>,
    pub(super) inertia: Optional<f64>,
    pub(super) rated_torque: Optional<f64>,
    pub(super) revolution: Optional<f64>,
    pub(super) acceleration_torque: Optional<f64>,
    pub(super) viscous: Optional<f64>,
    pub(super) coulomb: Optional<f64>,
    pub(super) friction_from: Optional<f64>,
    pub(super) most: Optional<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawTouchProbe {
    pub(super) number: Spanned<i64>,
    pub(super) unit: Optional<i64>,
    pub(super) source: Optional<i64>,
    #[serde(default)]
    pub(super) invert: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawHoming {
    pub(super) method: Spanned<i64>,
    pub(super) fast: Spanned<f64>,
    pub(super) slow: Spanned<f64>,
    pub(super) acceleration: Spanned<f64>,
    pub(super) sequence: Optional<i64>,
}
