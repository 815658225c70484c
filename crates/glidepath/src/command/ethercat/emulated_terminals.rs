//! Emulated devices that are no drives: each has what the file names, and nothing to set.

use glidepath_emulator::{
    Channels, ClockKind, DriveSettings as Emulated, Encoder, GearPins, Gearbox, LoadEncoder,
    SpindleMotor,
};
use glidepath_ethercat::{
    At, DriveSettings, Gear, JointEncoderSettings, Mapping, Signal, SpindleMode, SpindleSettings,
    TerminalSettings,
};

/// Bits of an entry at most.
const MOST_BITS: u32 = 248;
/// Counts of a revolution, where nobody is told.
const COUNTS_PER_REV: f64 = 10_000.0;
/// Where in a revolution the index of an encoder is.
const INDEX_AT: f64 = 0.25;
/// How long an emulated gearbox takes to change a gear, ns, and how fast its motor may turn meanwhile, rev/s.
const GEAR_NS: u64 = 300_000_000;
const GEAR_MOST_V: f64 = 20.0;
/// Counts of a number of 16 bits.
const SHORT: u32 = 0xffff;

/// A device that has what a file names.
pub(super) fn emulated(settings: &TerminalSettings) -> Emulated {
    let inputs = input_maps(settings);
    let outputs = output_maps(settings);
    if let Some(spindle) = &settings.spindle {
        return emulated_spindle(settings, spindle);
    }
    if settings.encoder.is_some() {
        let like = Emulated::encoder(32);
        return Emulated {
            identity: identity(settings, &like),
            ..like
        };
    }
    let like = Emulated::terminal("EMULATED", ClockKind::ReceiveTimes);
    Emulated {
        identity: identity(settings, &like),
        channels: Some(Channels {
            output_windows: 1,
            outputs,
            inputs,
            assigned: None,
        }),
        ..like
    }
}

/// Who the file says that it is.
fn identity(settings: &TerminalSettings, like: &Emulated) -> [u32; 4] {
    let or = |id: u32, other: u32| if id == 0 { other } else { id };
    let [vendor, product, revision, serial] = like.identity;
    [
        or(settings.vendor, vendor),
        or(settings.product, product),
        revision,
        serial,
    ]
}

/// The drive of a spindle that is twice as strong as its ramp takes, and runs out within seconds.
fn emulated_spindle(settings: &TerminalSettings, spindle: &SpindleSettings) -> Emulated {
    let like = Emulated::default();
    let gears = spindle.gears.iter().flat_map(|gears| gears.all());
    let of_motor = gears.map(|(_, gear)| gear.ratio * gear.ramp_rpm_per_s);
    let ramp = of_motor.fold(spindle.ramp_rpm_per_s, f64::max);
    let counts_per_rev = match spindle.mode {
        SpindleMode::CyclicVelocity | SpindleMode::ProfileVelocity => 60.0 * spindle.units_per_rpm,
        SpindleMode::Velocity => COUNTS_PER_REV,
    };
    Emulated {
        identity: identity(settings, &like),
        name: "SPINDLE".to_owned(),
        spindle: Some(SpindleMotor {
            counts_per_rev,
            torque_rpm_per_s: 2.0 * ramp,
            coast_t: 2.0,
        }),
        ..like
    }
}

/// The spindle's encoder of a file, if its spindle is on a drive, which turns it.
pub(super) fn encoder(terminals: &[TerminalSettings]) -> Option<Encoder> {
    let place = |is_it: &dyn Fn(&TerminalSettings) -> bool| {
        let mut devices = terminals.iter();
        devices
            .find(|device| is_it(device))
            .map(|device| device.position)
    };
    let settings = terminals.iter().find_map(|device| device.encoder)?;
    Some(Encoder {
        device: place(&|device| device.encoder.is_some())?,
        spindle: (place(&|device| device.spindle.is_some())?, 0),
        counts_per_rev: f64::from(settings.counts_per_rev),
        index_at: INDEX_AT,
    })
}

/// The gearbox of the spindle of a file, where each gear has an output and an input. The first gear is in.
pub(super) fn gearbox(terminals: &[TerminalSettings]) -> Option<Gearbox> {
    let spindle = terminals.iter().find(|device| device.spindle.is_some())?;
    let gears = spindle.spindle?.gears?;
    let pins = |(number, gear): (u32, &Gear)| {
        let output = terminals.iter().find_map(|device| {
            let mut outputs = device.outputs.iter();
            let output = outputs.find(|output| output.from == Signal::SpindleGear(number))?;
            Some((device.position, output_place(device, output.at)?))
        });
        let input = terminals.iter().find_map(|device| {
            let mut inputs = device.inputs.iter();
            let input = inputs.find(|input| input.number == Some(gear.input))?;
            Some((device.position, input_place(device, input.at)?))
        });
        Some(GearPins {
            ratio: if gear.is_inverted {
                -gear.ratio
            } else {
                gear.ratio
            },
            output: output?,
            input: input?,
        })
    };
    let gears: Option<Vec<GearPins>> = gears.all().map(pins).collect();
    Some(Gearbox {
        spindle: (spindle.position, 0),
        gears: gears?,
        first: Some(0),
        change_ns: GEAR_NS,
        most_v: GEAR_MOST_V,
        needs_motion: false,
    })
}

/// The encoders of joints of a file, which the drives of the joints turn.
pub(super) fn load_encoders(
    drives: &[DriveSettings],
    terminals: &[TerminalSettings],
) -> Vec<LoadEncoder> {
    let encoders = terminals.iter().flat_map(|device| {
        let encoders = device.joint_encoders.iter();
        encoders.map(move |encoder| (device.position, encoder))
    });
    let of_drive = |(device, encoder): (usize, &JointEncoderSettings)| {
        let drive = drives.iter().find(|drive| drive.joint == encoder.joint)?;
        let At::Object { index, sub } = encoder.at else {
            return None;
        };
        let sign = |is_inverted: bool| if is_inverted { -1.0 } else { 1.0 };
        let counts = sign(encoder.is_inverted) * encoder.counts_per_unit;
        let from = encoder.home_offset.unwrap_or(0.0);
        Some(LoadEncoder {
            device,
            counter: (index, sub),
            drive: (drive.position, drive.axis.into()),
            ratio: counts * sign(drive.is_inverted) / drive.counts_per_unit,
            offset: counts * (drive.home_offset - from),
        })
    };
    encoders.filter_map(of_drive).collect()
}

/// Where a device that has what a file names has an input, bits.
pub(super) fn input_place(settings: &TerminalSettings, at: At) -> Option<usize> {
    let (index, sub) = match at {
        At::Bit(bit) => return Some(bit as usize),
        At::Object { index, sub } => (u32::from(index), u32::from(sub)),
    };
    place_in(&input_maps(settings), (index, sub))
}

/// Where it has an output, bits.
fn output_place(settings: &TerminalSettings, at: At) -> Option<usize> {
    match at {
        At::Bit(bit) => Some(bit as usize),
        At::Object { index, sub } => place_in(&output_maps(settings), (index.into(), sub.into())),
    }
}

/// Where an object is in maps, bits.
fn place_in(entries: &[Vec<u32>], (index, sub): (u32, u32)) -> Option<usize> {
    let mut bits = 0;
    for entry in entries.iter().flatten() {
        if entry >> 8 == index << 8 | sub {
            return Some(bits);
        }
        bits += (entry & 0xff) as usize;
    }
    None
}

fn output_maps(settings: &TerminalSettings) -> Vec<Vec<u32>> {
    let digital = settings.outputs.iter().map(|output| output.at);
    let analog = settings.analog_outputs.iter().map(|output| {
        let bits = if output.full_counts > SHORT { 32 } else { 16 };
        (output.at, bits)
    });
    maps(digital.collect(), analog.collect())
}

fn input_maps(settings: &TerminalSettings) -> Vec<Vec<u32>> {
    let digital = settings.inputs.iter().map(|input| input.at);
    let analog = settings.analog_inputs.iter().map(|input| (input.at, 16));
    let counters = settings
        .joint_encoders
        .iter()
        .map(|encoder| (encoder.at, 32));
    maps(digital.collect(), analog.chain(counters).collect())
}

/// The settings without what an emulated device does not have: other maps, and parameters.
pub(super) fn plain(settings: &TerminalSettings) -> TerminalSettings {
    TerminalSettings {
        parameters: Vec::new(),
        assign_outputs: None,
        assign_inputs: None,
        spindle: settings.spindle.map(|spindle| SpindleSettings {
            mapping: Mapping::Written,
            ..spindle
        }),
        ..settings.clone()
    }
}

/// Bits without a name.
fn gap(entries: &mut Vec<u32>, bits: u32) {
    entries.extend((0..bits / MOST_BITS).map(|_| MOST_BITS));
    entries.extend(Some(bits % MOST_BITS).filter(|rest| *rest > 0));
}

/// One map: bits that have no name, bits that have, and numbers where a byte begins.
fn maps(digital: Vec<At>, analog: Vec<(At, u32)>) -> Vec<Vec<u32>> {
    let nameless = digital.iter().filter_map(|at| match at {
        At::Bit(bit) => Some(bit + 1),
        At::Object { .. } => None,
    });
    let mut bits = nameless.max().unwrap_or(0);
    let mut entries = Vec::new();
    gap(&mut entries, bits);
    let of = |at: At, bits: u32| match at {
        At::Object { index, sub } => Some(u32::from(index) << 16 | u32::from(sub) << 8 | bits),
        At::Bit(_) => None,
    };
    for at in digital {
        let entry = of(at, 1).filter(|entry| !entries.contains(entry));
        bits += u32::from(entry.is_some());
        entries.extend(entry);
    }
    gap(&mut entries, bits.next_multiple_of(8) - bits);
    entries.extend(analog.into_iter().filter_map(|(at, bits)| of(at, bits)));
    if entries.is_empty() {
        Vec::new()
    } else {
        vec![entries]
    }
}
