//! The judgement of the drive of the spindle.

use super::raw_device::RawSpindle;
use crate::config::{ConfigDiagnostic, Judge, Range};
use glidepath_ethercat::{SpindleMode, SpindleSettings};

const UNITS: Range = Range {
    min: 1e-6,
    max: 1e9,
    unit: "units",
    help: "what a rev/min is in the drive's unit of velocity: counts of a revolution / 60 where that is \
           counts/s",
};
const SPEED: Range = Range {
    min: 1.0,
    max: 1e6,
    unit: "rev/min",
    help: "the highest speed of the spindle; a higher S is not reached, and M3 is not done",
};
const RAMP: Range = Range {
    min: 1.0,
    max: 1e7,
    unit: "rev/min per s",
    help: "what the drive can follow with the heaviest tool, up and down",
};
pub(super) const NEAR: Range = Range {
    min: 1e-3,
    max: 0.5,
    unit: "of the speed",
    help: "how far it may be from its speed at speed: 0.03 is 3 %",
};
/// How near it is at speed, if the file does not say.
pub(super) const NEAR_R: f64 = 0.03;
const MODES: &str = "give \"cyclic-velocity\" (0x6060 = 9, by SYNC0), \"profile-velocity\" (3), or \
                     \"velocity\" (2, an inverter)";

/// Judges the drive of the spindle; `None` if its mode is not known.
pub(super) fn spindle(judge: &mut Judge, raw: &RawSpindle) -> Option<SpindleSettings> {
    let mode = match raw.mode.as_ref().as_str() {
        "cyclic-velocity" => Some(SpindleMode::CyclicVelocity),
        "profile-velocity" => Some(SpindleMode::ProfileVelocity),
        "velocity" => Some(SpindleMode::Velocity),
        _ => None,
    };
    let mut tell = |key: &str, message: String, help: &str| {
        judge.diagnostics.push(ConfigDiagnostic {
            key: key.to_owned(),
            message,
            help: Some(help.to_owned()),
            span: Some(raw.mode.span()),
        });
    };
    if mode.is_none() {
        let message = format!(
            "device.spindle.mode = \"{}\" is not known",
            raw.mode.as_ref()
        );
        tell("device.spindle.mode", message, MODES);
    }
    // An inverter counts rev/min by the standard, and what a servo counts is its own.
    let is_told = mode.is_none_or(|mode| mode == SpindleMode::Velocity);
    if !is_told && raw.units_per_rpm.is_none() {
        let key = "device.spindle.units_per_rpm";
        tell(key, "units_per_rpm is missing".to_owned(), UNITS.help);
    }
    let units_per_rpm = judge.number_or(
        "device.spindle.units_per_rpm",
        &raw.units_per_rpm,
        &UNITS,
        1.0,
    );
    let max_rpm = judge.number("device.spindle.max_rpm", &raw.max_rpm, &SPEED);
    let ramp_rpm_per_s = judge.number("device.spindle.ramp", &raw.ramp, &RAMP);
    let at_speed_r = judge.number_or("device.spindle.at_speed", &raw.at_speed, &NEAR, NEAR_R);
    let most = if mode == Some(SpindleMode::Velocity) {
        f64::from(i16::MAX)
    } else {
        f64::from(i32::MAX)
    };
    if max_rpm * units_per_rpm > most {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "device.spindle.max_rpm".to_owned(),
            message: format!(
                "device.spindle.max_rpm = {max_rpm} rev/min is more than its drive can be told"
            ),
            help: Some(format!("units_per_rpm times max_rpm is {most} at most")),
            span: Some(raw.max_rpm.span()),
        });
    }
    Some(SpindleSettings {
        mode: mode?,
        units_per_rpm,
        is_inverted: raw.invert,
        max_rpm,
        ramp_rpm_per_s,
        at_speed_r,
        mapping: raw.map.into(),
    })
}
