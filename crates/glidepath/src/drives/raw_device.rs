//! The raw tables of devices that move no joint.

use glidepath_ethercat::Mapping;
use serde::Deserialize;
use toml::Spanned;

pub(super) type Optional<T> = Option<Spanned<T>>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawDevice {
    pub(super) position: Spanned<i64>,
    pub(super) vendor: Optional<i64>,
    pub(super) product: Optional<i64>,
    pub(super) alias: Optional<i64>,
    #[serde(default)]
    pub(super) parameters: Vec<RawParameter>,
    pub(super) assign_outputs: Option<Vec<Spanned<i64>>>,
    pub(super) assign_inputs: Option<Vec<Spanned<i64>>>,
    #[serde(default)]
    pub(super) inputs: Vec<Spanned<RawInput>>,
    #[serde(default)]
    pub(super) analog_inputs: Vec<RawAnalogInput>,
    #[serde(default)]
    pub(super) outputs: Vec<Spanned<RawOutput>>,
    #[serde(default)]
    pub(super) analog_outputs: Vec<RawAnalogOutput>,
    pub(super) spindle: Optional<RawSpindle>,
    pub(super) encoder: Optional<RawEncoder>,
    #[serde(default)]
    pub(super) joint_encoders: Vec<Spanned<RawJointEncoder>>,
}

/// An encoder of a joint.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawJointEncoder {
    pub(super) joint: Spanned<i64>,
    #[serde(rename = "use")]
    pub(super) used: Spanned<String>,
    pub(super) at: Optional<String>,
    pub(super) counts_per_mm: Optional<f64>,
    pub(super) counts_per_deg: Optional<f64>,
    #[serde(default)]
    pub(super) invert: bool,
    pub(super) home_offset: Optional<f64>,
    pub(super) signed: Optional<bool>,
    pub(super) apart: Spanned<f64>,
}

/// The spindle's encoder.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawEncoder {
    pub(super) counts_per_rev: Spanned<i64>,
    #[serde(default = "yes")]
    pub(super) index: bool,
    #[serde(default)]
    pub(super) invert: bool,
    pub(super) at_speed: Optional<f64>,
}

/// The drive of the spindle.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSpindle {
    pub(super) mode: Spanned<String>,
    pub(super) units_per_rpm: Optional<f64>,
    pub(super) max_rpm: Spanned<f64>,
    pub(super) ramp: Spanned<f64>,
    pub(super) at_speed: Optional<f64>,
    #[serde(default)]
    pub(super) invert: bool,
    #[serde(default)]
    pub(super) map: RawMap,
    #[serde(default)]
    pub(super) load: bool,
    pub(super) orientation: Optional<RawOrientation>,
    pub(super) gears: Optional<Vec<Spanned<RawGear>>>,
    pub(super) shift: Optional<RawShift>,
}

/// A gear between the motor of the spindle and the spindle.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGear {
    pub(super) ratio: Spanned<f64>,
    pub(super) max_rpm: Optional<f64>,
    pub(super) ramp: Optional<f64>,
    #[serde(default)]
    pub(super) invert: bool,
    pub(super) input: Spanned<i64>,
}

/// How gears are changed.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawShift {
    pub(super) swing_rpm: Optional<f64>,
    pub(super) swing_s: Optional<f64>,
    pub(super) within_s: Optional<f64>,
}

/// How the spindle is turned to an angle.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOrientation {
    pub(super) counts_per_rev: Spanned<i64>,
    pub(super) zero: Optional<f64>,
    pub(super) max_rpm: Spanned<f64>,
    pub(super) window: Optional<f64>,
}

/// Who says what is in the process data of a drive.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum RawMap {
    #[default]
    Write,
    Keep,
}

impl From<RawMap> for Mapping {
    fn from(raw: RawMap) -> Self {
        match raw {
            RawMap::Write => Self::Written,
            RawMap::Keep => Self::Kept,
        }
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawParameter {
    pub(super) object: Spanned<String>,
    pub(super) bytes: Spanned<i64>,
    pub(super) value: Spanned<i64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawInput {
    pub(super) at: Optional<String>,
    pub(super) bit: Optional<i64>,
    pub(super) number: Optional<i64>,
    pub(super) home: Optional<i64>,
    pub(super) limit_low: Optional<i64>,
    pub(super) limit_high: Optional<i64>,
    #[serde(default)]
    pub(super) invert: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAnalogInput {
    pub(super) at: Spanned<String>,
    pub(super) number: Spanned<i64>,
    pub(super) scale: Spanned<f64>,
    pub(super) offset: Optional<f64>,
    #[serde(default = "yes")]
    pub(super) signed: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOutput {
    pub(super) at: Optional<String>,
    pub(super) bit: Optional<i64>,
    pub(super) from: Spanned<String>,
    #[serde(default)]
    pub(super) invert: bool,
    pub(super) rest: Option<bool>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAnalogOutput {
    pub(super) at: Spanned<String>,
    pub(super) from: Spanned<String>,
    pub(super) full: Spanned<f64>,
    pub(super) counts: Spanned<i64>,
    pub(super) rest: Optional<f64>,
}

const fn yes() -> bool {
    true
}
