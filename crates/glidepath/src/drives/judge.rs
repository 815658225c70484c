//! The judgement of `drives.toml`, [`RawDrives`] to [`DrivesConfig`]: every value by its range, and
//! the whole against the machine.

use super::bus::bus;
use super::config::DrivesConfig;
use super::device;
use super::feed_forward::feed_forward;
use super::gears;
use super::raw::{RawDrive, RawDrives, RawHoming};
use super::source::{DrivesSource, Place};
use super::touch_probe;
use crate::config::{ConfigDiagnostic, HomingBy, Judge, MachineConfig, Range};
use core::mem::take;
use core::ops::Range as Span;
use glidepath_ethercat::{DEVICE_AXES, DriveSettings, HomingSettings, Mapping, RefusedPart};
use glidepath_geometry::AXES;
use toml::Spanned;

/// How far the maps of an axis are from those of the one before, as a rule.
const MAP_STEP: u16 = 0x10;

const COUNTS: Range = Range {
    min: 1e-3,
    max: 1e9,
    unit: "counts",
    help: "counts of a revolution of the encoder, over the way of the joint in that time",
};
const PLACE: Range = Range {
    min: -1e6,
    max: 1e6,
    unit: "mm or °",
    help: "where the joint is when the drive counts zero",
};
const ERROR: Range = Range {
    min: 1e-6,
    max: 1e3,
    unit: "mm or °",
    help: "more than the drive is behind at full speed, and less than what breaks something",
};
const WINDOW: Range = Range {
    min: 1e-6,
    max: 1e3,
    unit: "mm or °",
    help: "what the joint may sink when its brake opens",
};
const SPEED: Range = Range {
    min: 1e-3,
    max: 1e5,
    unit: "mm/s or °/s",
    help: "slow enough for the switch to stop it in time",
};
const RATE: Range = Range {
    min: 1e-1,
    max: 1e7,
    unit: "mm/s² or °/s²",
    help: "what the joint can do without its own mechanics",
};

const TORQUE: Range = Range {
    min: 0.1,
    max: 1000.0,
    unit: "% of the rated torque",
    help: "the most torque in this direction of the joint (0x60E0, 0x60E1); leave it out for what the drive has",
};

/// The highest speed of each joint, mm/s or °/s.
pub(crate) fn joint_velocities(machine: &MachineConfig) -> Vec<f64> {
    let limits = joint_limits(machine).into_iter();
    limits.map(|(velocity, _)| velocity).collect()
}

/// The highest speed and acceleration of each joint, mm or degrees and s.
fn joint_limits(machine: &MachineConfig) -> Vec<(f64, f64)> {
    if machine.joints() > 0 {
        let own = machine.joint_limits.0.iter().take(machine.joints());
        return own
            .map(|limits| (limits.velocity, limits.acceleration))
            .collect();
    }
    let axes = machine.axis_of_joints().into_iter();
    let of = |name| machine.axes.iter().find(|axis| axis.axis == name);
    let limits = |name| {
        let axis = of(name)?;
        Some((axis.max_velocity, axis.max_acceleration))
    };
    axes.filter_map(limits).collect()
}

/// Judges every value.
///
/// # Errors
/// All diagnostics.
pub(super) fn judge(
    raw: RawDrives,
    found: Vec<ConfigDiagnostic>,
    machine: &MachineConfig,
) -> Result<DrivesConfig, Vec<ConfigDiagnostic>> {
    let mut judge = Judge { diagnostics: found };
    let interface = raw.bus.interface.clone();
    let bus = bus(&mut judge, &raw.bus);
    let limits = joint_limits(machine);
    let mut tables = raw.drive;
    let inputs = tables
        .iter_mut()
        .map(|drive| take(&mut drive.as_mut().inputs));
    let inputs: Vec<_> = inputs.collect();
    let drives = drives(&mut judge, tables, machine, &limits);
    let missing = (0..limits.len()).find(|joint| !drives.iter().any(|(d, _)| d.joint == *joint));
    if let Some(joint) = missing {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "drive".to_owned(),
            message: format!("J{joint} of the machine has no drive"),
            help: Some(format!("add a table [[drive]] with joint = {joint}")),
            span: None,
        });
    }
    let mut places: Vec<Place> = drives
        .iter()
        .map(|(drive, span)| Place {
            part: RefusedPart {
                position: drive.position,
                at: None,
            },
            span: span.clone(),
        })
        .collect();
    let tables = (inputs, raw.device);
    let (drive_inputs, terminals, of_devices) =
        device::devices(&mut judge, tables, &drives, limits.len());
    let of_terminals = terminals.iter().flat_map(|device| &device.inputs);
    let all_inputs = of_terminals.chain(drive_inputs.iter().map(|(_, input)| input));
    let numbers: Vec<usize> = all_inputs.filter_map(|input| input.number).collect();
    touch_probe::together(&mut judge, &drives, &numbers, machine);
    gears::together(&mut judge, &terminals, machine);
    let reads = |nth: usize| drive_inputs.iter().any(|(of, _)| *of == nth);
    let drives = drives
        .into_iter()
        .enumerate()
        .map(|(nth, (drive, _))| DriveSettings {
            has_inputs: reads(nth),
            ..drive
        });
    let drives: Vec<_> = drives.collect();
    places.extend(of_devices);
    if judge.diagnostics.is_empty() {
        Ok(DrivesConfig {
            interface,
            bus,
            drives,
            drive_inputs,
            terminals,
            source: DrivesSource {
                places,
                ..DrivesSource::default()
            },
        })
    } else {
        Err(judge.diagnostics)
    }
}

/// Judges all drives, and whether they go together.
fn drives(
    judge: &mut Judge,
    raw: Vec<Spanned<RawDrive>>,
    machine: &MachineConfig,
    limits: &[(f64, f64)],
) -> Vec<(DriveSettings, Span<usize>)> {
    let mut drives: Vec<(DriveSettings, Span<usize>)> = Vec::new();
    for drive in raw {
        let span = drive.span();
        let settings = self::drive(judge, drive.into_inner(), limits);
        if machine.feedback.homing == HomingBy::Drive {
            // An absolute encoder knows where it is, too.
        } else if settings.homing.is_some() {
            judge.diagnostics.push(ConfigDiagnostic {
                key: "drive.homing".to_owned(),
                message: "the machine's configuration does not have drives find their home"
                    .to_owned(),
                help: Some(
                    "set homing = \"drive\" in its [feedback], or leave this table out".to_owned(),
                ),
                span: Some(span.clone()),
            });
        }
        touch_probe::is_index_known(judge, &settings, machine, &span);
        for (what, is_same) in [
            (
                "joint",
                drives.iter().any(|(d, _)| d.joint == settings.joint),
            ),
            (
                "position",
                drives.iter().any(|(d, _)| place(d) == place(&settings)),
            ),
        ] {
            if is_same {
                judge.diagnostics.push(ConfigDiagnostic {
                    key: format!("drive.{what}"),
                    message: format!("two drives have the same {what}"),
                    help: Some(
                        "each joint has one drive, at a place of its own or with another axis there"
                            .to_owned(),
                    ),
                    span: Some(span.clone()),
                });
            }
        }
        let differs = |(other, _): &(DriveSettings, Span<usize>)| {
            other.position == settings.position && of_device(other) != of_device(&settings)
        };
        if drives.iter().any(differs) {
            judge.diagnostics.push(ConfigDiagnostic {
                key: "drive.position".to_owned(),
                message: "drives of one device differ in what is the device's".to_owned(),
                help: Some(
                    "give them the same vendor, product, alias, map, map_step, outputs_at and inputs_at"
                        .to_owned(),
                ),
                span: Some(span.clone()),
            });
        }
        drives.push((settings, span));
    }
    drives
}

/// Where a drive is.
const fn place(drive: &DriveSettings) -> (usize, u16) {
    (drive.position, drive.axis)
}

/// What is the same of all drives of a device.
#[allow(clippy::type_complexity, reason = "what is compared, as it stands")]
const fn of_device(drive: &DriveSettings) -> ([u32; 2], u16, u16, Option<(u16, u16)>, Mapping) {
    let ids = [drive.vendor, drive.product];
    let (alias, step) = (drive.alias, drive.map_step);
    (ids, alias, step, drive.process_at, drive.mapping)
}

fn drive(judge: &mut Judge, raw: RawDrive, limits: &[(f64, f64)]) -> DriveSettings {
    let most = i64::try_from(limits.len()).unwrap_or(1) - 1;
    let joint: usize = judge
        .whole(
            "drive.joint",
            &raw.joint,
            (0, most),
            "the machine has no more joints",
        )
        .unwrap_or(AXES);
    let position = judge
        .whole(
            "drive.position",
            &raw.position,
            (0, 63),
            "counted from the master on, from 0",
        )
        .unwrap_or(0);
    let (axis, map_step) = axis(judge, &raw);
    let mut id = |key, value: &Option<Spanned<i64>>, most| {
        let help = "as `glidepath ethercat scan INTERFACE` shows it; 0 compares nothing";
        let value = value
            .as_ref()
            .map(|value| judge.whole(key, value, (0, most), help));
        value.flatten().unwrap_or(0_u32)
    };
    let vendor = id("drive.vendor", &raw.vendor, u32::MAX.into());
    let product = id("drive.product", &raw.product, u32::MAX.into());
    let alias = id("drive.alias", &raw.alias, u16::MAX.into());
    let counts = counts(judge, &raw);
    let following_ms = raw.following_ms.as_ref().and_then(|value| {
        judge.whole(
            "drive.following_ms",
            value,
            (1, 10_000),
            "how long it may be further away",
        )
    });
    let own_limits = limits.get(joint).copied().unwrap_or((1.0, 1.0));
    let told = raw.feed_forward.as_ref();
    let feed_forward = told.and_then(|told| feed_forward(judge, told, counts, own_limits));
    let torque_limits = torque_limits(judge, &raw);
    let process_at = process_at(judge, &raw);
    let probe = raw.probe.as_ref();
    let probe = probe.and_then(|probe| touch_probe::touch_probe(judge, probe));
    let index = touch_probe::index(judge, raw.index.as_ref(), probe);
    DriveSettings {
        joint,
        position,
        axis,
        map_step,
        vendor,
        product,
        alias: u16::try_from(alias).unwrap_or(0),
        process_at,
        mapping: raw.map.into(),
        counts_per_unit: counts,
        is_modulo: raw.modulo,
        is_inverted: raw.invert,
        home_offset: judge.number_or("drive.home_offset", &raw.home_offset, &PLACE, 0.0),
        homing: raw
            .homing
            .map(|homing| self::homing(judge, homing.into_inner())),
        following_error: judge.number("drive.following_error", &raw.following_error, &ERROR),
        following_ms: following_ms.unwrap_or(10),
        enable_window: judge.number_or("drive.enable_window", &raw.enable_window, &WINDOW, 0.05),
        quick_stop_a: judge.number("drive.quick_stop", &raw.quick_stop, &RATE),
        torque_limits,
        feed_forward,
        probe,
        index,
        has_inputs: false,
        max_v: own_limits.0,
    }
}

/// How much it counts for a mm or a degree.
fn counts(judge: &mut Judge, raw: &RawDrive) -> f64 {
    match (&raw.counts_per_mm, &raw.counts_per_deg) {
        (Some(counts), None) => judge.number("drive.counts_per_mm", counts, &COUNTS),
        (None, Some(counts)) => judge.number("drive.counts_per_deg", counts, &COUNTS),
        _ => {
            judge.diagnostics.push(ConfigDiagnostic {
                key: "drive.counts_per_mm".to_owned(),
                message: "a drive has counts_per_mm, or counts_per_deg".to_owned(),
                help: Some("give one of them".to_owned()),
                span: Some(raw.joint.span()),
            });
            1.0
        }
    }
}

/// The limits of torque in both directions, thousandths of the rated one.
fn torque_limits(judge: &mut Judge, raw: &RawDrive) -> [Option<u16>; 2] {
    let mut limit = |key, value: &Option<Spanned<f64>>| {
        let percent = judge.number(key, value.as_ref()?, &TORQUE);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "judged: 10 000 at most"
        )]
        let thousandths = (10.0 * percent).round() as u16;
        Some(thousandths)
    };
    [
        limit("drive.torque_positive", &raw.torque_positive),
        limit("drive.torque_negative", &raw.torque_negative),
    ]
}

/// Which axis of a device it is, and how far the maps of axes are apart.
fn axis(judge: &mut Judge, raw: &RawDrive) -> (u16, u16) {
    let mut own = |key, value: &Option<Spanned<i64>>, range, help, default| {
        let value = value.as_ref();
        let value = value.map(|value| judge.whole(key, value, range, help));
        value.flatten().unwrap_or(default)
    };
    let most = i64::from(DEVICE_AXES) - 1;
    let help = "which axis of a device with several, from 0";
    let axis = own("drive.axis", &raw.axis, (0, most), help, 0);
    let help = "how far the maps of an axis are from those of the one before: 16 as a rule, or 1";
    let map_step = own("drive.map_step", &raw.map_step, (1, 0x20), help, MAP_STEP);
    (axis, map_step)
}

/// Where outputs and inputs are in the memory of a drive whose EEPROM does not say.
fn process_at(judge: &mut Judge, raw: &RawDrive) -> Option<(u16, u16)> {
    let help = "the start addresses of its sync managers 2 and 3, by the manufacturer's ESI file";
    let mut address = |key, value: &Option<Spanned<i64>>| {
        let value = value.as_ref()?;
        judge.whole(key, value, (0x1000, 0xffff), help)
    };
    let outputs = address("drive.outputs_at", &raw.outputs_at);
    let inputs = address("drive.inputs_at", &raw.inputs_at);
    let alone = match (&raw.outputs_at, &raw.inputs_at) {
        (Some(at), None) | (None, Some(at)) => Some(at.span()),
        _ => None,
    };
    if let Some(span) = alone {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "drive.outputs_at".to_owned(),
            message: "a drive has both outputs_at and inputs_at, or neither".to_owned(),
            help: Some(help.to_owned()),
            span: Some(span),
        });
    }
    outputs.zip(inputs)
}

fn homing(judge: &mut Judge, raw: RawHoming) -> HomingSettings {
    let help = "by CiA 402, 35 or 37 for where it stands; see the drive's manual";
    let sequence = raw.sequence.as_ref().and_then(|value| {
        let help = "joints of a lower number are home before the others begin";
        judge.whole("drive.homing.sequence", value, (0, 8), help)
    });
    HomingSettings {
        method: judge
            .whole("drive.homing.method", &raw.method, (-128, 127), help)
            .unwrap_or(0),
        fast_v: judge.number("drive.homing.fast", &raw.fast, &SPEED),
        slow_v: judge.number("drive.homing.slow", &raw.slow, &SPEED),
        acceleration_a: judge.number("drive.homing.acceleration", &raw.acceleration, &RATE),
        sequence: sequence.unwrap_or(0),
    }
}
