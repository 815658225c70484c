//! The judgement of the drive of the spindle.

use super::gears::{GearedDrive, gears};
use super::raw_device::{Optional, RawOrientation, RawSpindle};
use crate::config::{ConfigDiagnostic, Judge, Range};
use glidepath_ethercat::{OrientationSettings, SpindleMode, SpindleSettings};
use toml::Spanned;

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

const ZERO: Range = Range {
    min: -360.0,
    max: 360.0,
    unit: "degrees",
    help: "what the drive counts where the spindle is at angle 0: turn it there by hand, and read 0x6064",
};
const WAY_SPEED: Range = Range {
    min: 0.1,
    max: 1e4,
    unit: "rev/min",
    help: "how fast the spindle turns to its angle: 60 is a turn in a second",
};
const WINDOW: Range = Range {
    min: 1e-3,
    max: 10.0,
    unit: "degrees",
    help: "how near to its angle it has to be: what the tool changer or the bore allows",
};
/// How near to its angle it has to be, if the file does not say, degrees.
const WINDOW_DEG: f64 = 0.1;
/// Counts of a revolution, at most: a drive is told two turns either way.
const MOST_COUNTS: u32 = 1 << 29;

/// Judges how the spindle is turned to an angle, beside its mode and its highest speed.
fn orientation(
    judge: &mut Judge,
    raw: &Optional<RawOrientation>,
    (mode, most_rpm): (Option<SpindleMode>, f64),
) -> Option<OrientationSettings> {
    let table = raw.as_ref()?;
    let raw = table.get_ref();
    let mut tell = |key: &str, message: String, help: &str, span| {
        judge.diagnostics.push(ConfigDiagnostic {
            key: format!("device.spindle.{key}"),
            message,
            help: Some(help.to_owned()),
            span: Some(span),
        });
    };
    if mode.is_some_and(|mode| mode != SpindleMode::CyclicVelocity) {
        tell(
            "orientation",
            "a spindle is turned to an angle by SYNC0 alone".to_owned(),
            "give it mode = \"cyclic-velocity\", or leave orientation out",
            table.span(),
        );
    }
    let counts = *raw.counts_per_rev.get_ref();
    let whole = u32::try_from(counts).ok();
    let counts_per_rev =
        whole.filter(|counts| counts.is_power_of_two() && (4..=MOST_COUNTS).contains(counts));
    if counts_per_rev.is_none() {
        tell(
            "orientation.counts_per_rev",
            format!(
                "device.spindle.orientation.counts_per_rev = {counts} is no power of two from 4 to 2^29"
            ),
            "its counter goes round at 32 bits, and an angle is the same in the next round only where a turn is a \
             power of two: set the drive's gear (0x6091, 0x608F) so",
            raw.counts_per_rev.span(),
        );
    }
    let zero_deg = judge.number_or("device.spindle.orientation.zero", &raw.zero, &ZERO, 0.0);
    let key = "device.spindle.orientation.max_rpm";
    let max_rpm = judge.number(key, &raw.max_rpm, &WAY_SPEED);
    too_fast(judge, &raw.max_rpm, most_rpm);
    let window_deg = judge.number_or(
        "device.spindle.orientation.window",
        &raw.window,
        &WINDOW,
        WINDOW_DEG,
    );
    Some(OrientationSettings {
        counts_per_rev: counts_per_rev?,
        zero_deg,
        max_rpm,
        window_deg,
    })
}

/// Refuses a way that is faster than the spindle.
fn too_fast(judge: &mut Judge, max_rpm: &Spanned<f64>, most_rpm: f64) {
    if *max_rpm.get_ref() <= most_rpm {
        return;
    }
    judge.diagnostics.push(ConfigDiagnostic {
        key: "device.spindle.orientation.max_rpm".to_owned(),
        message: format!(
            "device.spindle.orientation.max_rpm = {} rev/min is more than max_rpm of the spindle, {most_rpm}",
            max_rpm.get_ref()
        ),
        help: Some(WAY_SPEED.help.to_owned()),
        span: Some(max_rpm.span()),
    });
}

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
    if raw.gears.is_none() && max_rpm * units_per_rpm > most {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "device.spindle.max_rpm".to_owned(),
            message: format!(
                "device.spindle.max_rpm = {max_rpm} rev/min is more than its drive can be told"
            ),
            help: Some(format!("units_per_rpm times max_rpm is {most} at most")),
            span: Some(raw.max_rpm.span()),
        });
    }
    let orientation = orientation(judge, &raw.orientation, (mode, max_rpm));
    let drive = GearedDrive {
        units_per_rpm,
        max_rpm,
        ramp: ramp_rpm_per_s,
        most,
    };
    let gears = gears(judge, raw, &drive);
    Some(SpindleSettings {
        gears,
        orientation,
        tells_load: raw.load,
        mode: mode?,
        units_per_rpm,
        is_inverted: raw.invert,
        max_rpm,
        ramp_rpm_per_s,
        at_speed_r,
        mapping: raw.map.into(),
    })
}
