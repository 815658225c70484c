//! The judgement of the gears of the spindle.

use super::raw_device::{RawGear, RawShift, RawSpindle};
use crate::config::{ConfigDiagnostic, Judge, MachineConfig, Range};
use core::ops::Range as Span;
use glidepath_ethercat::{DIGITAL_INPUTS, Gear, GearSettings, MOST_GEARS, Swing, TerminalSettings};
use toml::Spanned;

const RATIO: Range = Range {
    min: 1e-3,
    max: 1e3,
    unit: "",
    help: "turns of the motor in a turn of the spindle: 4 where the spindle turns at a quarter of the motor's speed",
};
const SPEED: Range = Range {
    min: 1.0,
    max: 1e6,
    unit: "rev/min",
    help: "the highest speed of the spindle in this gear",
};
const RAMP: Range = Range {
    min: 1.0,
    max: 1e7,
    unit: "rev/min per s",
    help: "what the drive can follow in this gear with the heaviest tool, up and down",
};
const SWING: Range = Range {
    min: 0.1,
    max: 1000.0,
    unit: "rev/min",
    help: "how fast the motor turns to and fro while a gear is changed: slow enough for the teeth",
};
const WAY: Range = Range {
    min: 0.02,
    max: 10.0,
    unit: "s",
    help: "how long the motor turns one way while a gear is changed",
};
/// The same if the file does not say, s.
const WAY_S: f64 = 0.5;
const WITHIN: Range = Range {
    min: 0.1,
    max: 120.0,
    unit: "s",
    help: "how long a gear may take to be in, from where the spindle stands; later is a fault",
};
/// The same if the file does not say, s.
const WITHIN_S: f64 = 10.0;

/// What the drive of the spindle is, by which its gears are judged.
#[derive(Debug, Clone, Copy)]
pub(super) struct GearedDrive {
    pub(super) units_per_rpm: f64,
    pub(super) max_rpm: f64,
    pub(super) ramp: f64,
    /// The most of its unit that it can be told.
    pub(super) most: f64,
}

/// Judges the gears of a spindle; `None` if it has none.
pub(super) fn gears(
    judge: &mut Judge,
    raw: &RawSpindle,
    drive: &GearedDrive,
) -> Option<GearSettings> {
    let Some(list) = &raw.gears else {
        if let Some(shift) = &raw.shift {
            let help = "give it gears, or leave shift out";
            tell(
                judge,
                "shift",
                "a spindle without gears changes none",
                help,
                shift.span(),
            );
        }
        return None;
    };
    let count = list.get_ref().len();
    if !(1..=MOST_GEARS).contains(&count) {
        let message = format!("device.spindle.gears has {count} gears");
        let help = "give one to five of them: the first is M41, the fifth M45";
        tell(judge, "gears", &message, help, list.span());
        return None;
    }
    if let Some(orientation) = &raw.orientation {
        let help = "a motor behind gears does not know the angle of the spindle: leave orientation or gears out";
        let message = "a spindle with gears is not turned to an angle by its drive";
        tell(judge, "orientation", message, help, orientation.span());
    }
    let mut gears = [None; MOST_GEARS];
    for (place, raw) in gears.iter_mut().zip(list.get_ref()) {
        *place = Some(gear(judge, raw, drive));
    }
    let inputs: Vec<usize> = gears.iter().flatten().map(|gear| gear.input).collect();
    let twice = (1..inputs.len()).find(|nth| inputs[..*nth].contains(&inputs[*nth]));
    if let Some(nth) = twice {
        let message = format!("input {} says that two gears are in", inputs[nth]);
        let help = "give each gear an input of its own";
        tell(
            judge,
            "gears.input",
            &message,
            help,
            list.get_ref()[nth].span(),
        );
    }
    let (swing, within_ns) = shift(judge, raw.shift.as_ref());
    Some(GearSettings {
        gears,
        swing,
        within_ns,
    })
}

/// Judges a gear.
fn gear(judge: &mut Judge, table: &Spanned<RawGear>, drive: &GearedDrive) -> Gear {
    let raw = table.get_ref();
    let ratio = judge.number("device.spindle.gears.ratio", &raw.ratio, &RATIO);
    let key = "device.spindle.gears.max_rpm";
    let max_rpm = judge.number_or(key, &raw.max_rpm, &SPEED, drive.max_rpm);
    if max_rpm > drive.max_rpm {
        let message = format!(
            "device.spindle.gears.max_rpm = {max_rpm} rev/min is more than max_rpm of the spindle, {}",
            drive.max_rpm
        );
        tell(judge, "gears.max_rpm", &message, SPEED.help, table.span());
    }
    if max_rpm * ratio * drive.units_per_rpm > drive.most {
        let message = format!(
            "at {max_rpm} rev/min of the spindle its motor turns at {} rev/min, which is more than its drive can be told",
            max_rpm * ratio
        );
        let help = format!(
            "units_per_rpm times ratio times max_rpm is {} at most",
            drive.most
        );
        tell(judge, "gears.max_rpm", &message, &help, table.span());
    }
    let ramp_rpm_per_s = judge.number_or("device.spindle.gears.ramp", &raw.ramp, &RAMP, drive.ramp);
    let number = *raw.input.get_ref();
    let input = usize::try_from(number)
        .ok()
        .filter(|input| *input < DIGITAL_INPUTS);
    if input.is_none() {
        let message = format!("device.spindle.gears.input = {number} is no number of an input");
        let help = "give 0 to 63: the number that the input has in its own table";
        tell(judge, "gears.input", &message, help, raw.input.span());
    }
    Gear {
        ratio,
        is_inverted: raw.invert,
        max_rpm,
        ramp_rpm_per_s,
        input: input.unwrap_or(0),
    }
}

/// Judges how gears are changed: how the motor turns meanwhile, and how long it may take, ns.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "their ranges are far inside"
)]
fn shift(judge: &mut Judge, raw: Option<&Spanned<RawShift>>) -> (Option<Swing>, u64) {
    let ns = |t: f64| (t * 1e9) as u64;
    let Some(raw) = raw.map(Spanned::get_ref) else {
        return (None, ns(WITHIN_S));
    };
    let key = "device.spindle.shift.within_s";
    let within_s = judge.number_or(key, &raw.within_s, &WITHIN, WITHIN_S);
    let way_s = judge.number_or("device.spindle.shift.swing_s", &raw.swing_s, &WAY, WAY_S);
    let rpm = &raw.swing_rpm;
    let swing = rpm.as_ref().map(|rpm| Swing {
        rpm: judge.number("device.spindle.shift.swing_rpm", rpm, &SWING),
        way_ns: ns(way_s),
    });
    if let (Some(way), None) = (&raw.swing_s, &raw.swing_rpm) {
        let help = "give swing_rpm, too, or leave swing_s out";
        let message = "the motor does not turn while a gear is changed";
        tell(judge, "shift.swing_s", message, help, way.span());
    }
    (swing, ns(within_s))
}

/// Judges the gears of all devices against the machine, and against its inputs.
pub(super) fn together(judge: &mut Judge, terminals: &[TerminalSettings], machine: &MachineConfig) {
    let spindle = terminals.iter().find_map(|device| device.spindle);
    let Some(gears) = spindle.and_then(|spindle| spindle.gears) else {
        return;
    };
    let mut tell = |message: String, help: &str| {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "device.spindle.gears".to_owned(),
            message,
            help: Some(help.to_owned()),
            span: None,
        });
    };
    let (own, count) = (gears.all().count(), machine.gears.count());
    if own != count {
        tell(
            format!("the spindle has {own} gears here, and {count} in the machine's configuration"),
            "give `gears` in [spindle] the speeds of each of them, in the same order",
        );
    }
    for (number, gear) in gears.all() {
        let inputs = terminals.iter().flat_map(|device| &device.inputs);
        let is_there = inputs
            .filter_map(|input| input.number)
            .any(|input| input == gear.input);
        if !is_there {
            tell(
                format!(
                    "no device has input {}, which says that gear {number} is in",
                    gear.input
                ),
                "give that number to an input of a [[device]]",
            );
        }
        let most = machine.gears.most_rpm(number);
        if let Some(most) = most.filter(|most| *most > gear.max_rpm) {
            tell(
                format!(
                    "gear {number} turns at {} rev/min at most, and programs may turn it at {most}",
                    gear.max_rpm
                ),
                "give the gear no higher speed in [spindle] of the machine's configuration",
            );
        }
    }
}

fn tell(judge: &mut Judge, key: &str, message: &str, help: &str, span: Span<usize>) {
    judge.diagnostics.push(ConfigDiagnostic {
        key: format!("device.spindle.{key}"),
        message: message.to_owned(),
        help: Some(help.to_owned()),
        span: Some(span),
    });
}
