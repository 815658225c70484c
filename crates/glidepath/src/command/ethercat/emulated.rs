//! The bridge to emulated drives, together with them.

use super::bridge;
use super::desk;
use super::emulated_drives::{MAP_STEP, as_they_are, desk_drives};
use super::emulated_inputs::{Level, Pins};
use super::emulated_terminals;
use super::input_file::InputFile;
use super::namespace::{self, DRIVES, MASTER};
use super::timed_wire::TimedWire;
use crate::cli::EthercatArgs;
use crate::command::failure::Failure;
use crate::command::servo;
use crate::config::MachineConfig;
use crate::drives::{self, DrivesSource};
use crate::exit::Exit;
use crate::file_error::FileError;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use glidepath_emulator::{DriveSettings as Emulated, Segment};
use glidepath_ethercat::{
    BusSettings, Demand, DigitalInput, DriveSettings, MAX_FRAME, PacketWire, Settings,
    TerminalSettings, TouchProbe, Wire as _,
};
use glidepath_realtime::{Mode, Request, enter};
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::sync::mpsc::{Receiver, channel};

/// The drives do what they are asked to after the bus, and before nobody.
const PRIORITY: i32 = 60;
/// How late setpoints may be, ns.
const LATE_NS: u64 = 2_000_000;
/// The same on a host that promises nothing.
const DESK_LATE_NS: u64 = 12_000_000;
/// Between two looks whether it is over.
const POLL_NS: u64 = 50_000_000;

/// Runs both until interrupted.
///
/// # Errors
/// The interfaces cannot be made, or what the bridge fails by.
pub(super) fn drive(args: &EthercatArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = bridge::interrupt(args)?;
    namespace::make_interfaces()?;
    let Machine {
        drives,
        drive_inputs,
        terminals,
        emulated,
        source,
        pins,
    } = machine(args, config)?;
    let period_ns = u64::from(args.emulated_period_us) * 1000;
    let mut settings = Settings {
        bus: BusSettings {
            period_ns,
            shift_ns: period_ns / 2,
            delay_ns: period_ns / 2 + LATE_NS,
            ..BusSettings::default()
        },
        drives,
        drive_inputs,
        terminals,
        servo: servo::settings(config),
    };
    if args.best_effort {
        settings.servo.patience_ns = servo::best_effort_patience_ns(config);
        settings.bus.delay_ns = period_ns / 2 + DESK_LATE_NS;
        (settings.bus.lost_frames, settings.bus.watchdog_ns) = (50, 200_000_000);
    }
    let sent_ns = AtomicU64::new(0);
    let mut master = TimedWire::new(PacketWire::open(MASTER)?, &sent_ns);
    let mut there = PacketWire::open(DRIVES)?;
    let mut segment = Segment::new_at(&emulated, master.now_ns());
    add_mechanics(&mut segment, &settings);
    let record = args.emulated_record.as_deref();
    if record.is_some() {
        segment.keep_records();
    }
    let is_over = AtomicBool::new(false);
    let mut demanded = Vec::new();
    let (changed, changes) = channel();
    let file = args.emulated_inputs.as_deref();
    let mut file = match file.map(|path| InputFile::open(path, pins)).transpose()? {
        Some((file, levels)) => {
            put(&mut segment, &levels);
            Some(file)
        }
        None => None,
    };
    let counts = std::thread::scope(|scope| {
        let (wire, devices) = ((&mut there, &sent_ns), &mut segment);
        let over = &is_over;
        let answers = scope.spawn(move || answer(wire, devices, &changes, over));
        if let Some(file) = &mut file {
            scope.spawn(|| file.watch(&changed, &is_over));
        }
        let mut note = |demand: Demand| demanded.push(demand);
        let demands = record.map(|_| &mut note as &mut dyn FnMut(Demand));
        let counts = bridge::bridge(args, config, &mut master, &settings, &interrupt, demands);
        is_over.store(true, Ordering::Relaxed);
        answers
            .join()
            .map_err(|_| Failure::Thread("the emulated drives"))?;
        counts.map_err(|failure| bridge::in_file(failure, &source))
    })?;
    if let Some(path) = record {
        write(path, &settings, &mut segment, &demanded).map_err(|source| {
            Failure::File(FileError::Use {
                action: "write",
                path: path.to_owned(),
                source,
            })
        })?;
    }
    bridge::report(args, &counts);
    Ok(interrupt.exit())
}

/// Puts encoders and gearbox of the file on what turns them.
fn add_mechanics(segment: &mut Segment, settings: &Settings) {
    if let Some(encoder) = emulated_terminals::encoder(&settings.terminals) {
        segment.add_encoder(encoder);
    }
    if let Some(gearbox) = emulated_terminals::gearbox(&settings.terminals) {
        segment.add_gearbox(gearbox);
    }
    for encoder in emulated_terminals::load_encoders(&settings.drives, &settings.terminals) {
        segment.add_load_encoder(encoder);
    }
}

/// Something else stands at inputs.
fn put(segment: &mut Segment, levels: &[Level]) {
    segment.remove_probes();
    for level in levels {
        match level {
            Level::Passing(probe) => segment.add_probe(probe.clone()),
            Level::OfDrive(device, axis, bit, is_high) => {
                segment.set_drive_input((*device, *axis), *bit, *is_high);
            }
            Level::Bit(device, bit, is_high) => segment.set_input(*device, *bit, *is_high),
            Level::Number(device, from, bytes) => segment.set_input_bytes(*device, *from, bytes),
        }
    }
}

/// The drives answer frames until it is over.
fn answer(
    (wire, sent_ns): (&mut PacketWire, &AtomicU64),
    segment: &mut Segment,
    changes: &Receiver<Vec<Level>>,
    is_over: &AtomicBool,
) {
    let request = Request {
        priority: Some(PRIORITY),
        ..Request::default()
    };
    // Without it they are as slow as anybody.
    let _entered = enter(&request, Mode::BestEffort);
    let mut frame = [0; MAX_FRAME];
    while !is_over.load(Ordering::Relaxed) {
        let until_ns = wire.now_ns() + POLL_NS;
        if let Ok(Some(length)) = wire.receive(&mut frame, until_ns) {
            let frame = &mut frame[..length];
            while let Ok(levels) = changes.try_recv() {
                put(segment, &levels);
            }
            segment.pass(frame, sent_ns.load(Ordering::Acquire));
            // A frame that is lost is lost.
            let _ = wire.send(frame);
        }
    }
}

/// The devices of a machine.
struct Machine {
    /// Drives and other devices as the bridge knows them.
    drives: Vec<DriveSettings>,
    drive_inputs: Vec<(usize, DigitalInput)>,
    terminals: Vec<TerminalSettings>,
    /// All of them as they are.
    emulated: Vec<Emulated>,
    /// Where each is said to be.
    source: DrivesSource,
    /// Their inputs.
    pins: Pins,
}

/// The drives of a machine, as the bridge and as they themselves know them.
fn machine(args: &EthercatArgs, config: &MachineConfig) -> Result<Machine, Failure> {
    let given = args
        .drives
        .as_deref()
        .map(|file| drives::load(file, config))
        .transpose()?;
    let begins = servo::begins(config);
    let (drives, drive_inputs, terminals, source): (Vec<_>, Vec<_>, Vec<_>, _) = given.map_or_else(
        || {
            let joints = drives::joint_velocities(config).len();
            let desk = || desk::desk(joints, joints);
            let terminals = args.emulated_inputs.iter().map(|_| desk()).collect();
            let drives = desk_drives(args.best_effort, config, &begins).collect();
            (drives, Vec::new(), terminals, DrivesSource::default())
        },
        |given| {
            (
                given.drives,
                given.drive_inputs,
                given.terminals,
                given.source,
            )
        },
    );
    let mut emulated = as_they_are(&drives, &terminals, &begins);
    let begun = drives.iter().map(|drive| (*drive, begins[drive.joint]));
    let mut pins = Pins::beside(begun.collect(), &drive_inputs);
    for terminal in &terminals {
        emulated[terminal.position] = emulated_terminals::emulated(terminal);
        pins.add(terminal, &|at| {
            emulated_terminals::input_place(terminal, at)
        });
    }
    let terminals = terminals.iter().map(emulated_terminals::plain).collect();
    let drives = drives.into_iter();
    let drives = drives.map(|drive| DriveSettings {
        map_step: MAP_STEP,
        // What it is wired to by 0x60D0 is its own input.
        probe: drive.probe.map(|probe| TouchProbe {
            source: None,
            ..probe
        }),
        ..drive
    });
    Ok(Machine {
        drives: drives.collect(),
        drive_inputs,
        terminals,
        emulated,
        source,
        pins,
    })
}

/// What the drives recorded, for what time each target was meant, and what had become of the setpoints
/// when it was found.
fn write(
    path: &Path,
    settings: &Settings,
    segment: &mut Segment,
    demanded: &[Demand],
) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(
        file,
        "joint,sync_ns,meant_ns,target,actual,statusword,follows,missed_ticks,lost_setpoints,coasts"
    )?;
    let period_ns = settings.bus.period_ns;
    for drive in &settings.drives {
        for record in segment.take_axis_records(drive.position, drive.axis.into()) {
            // The demand of that number that is nearest in time.
            let from =
                demanded.partition_point(|demand| demand.sync_ns + 64 * period_ns < record.at_ns);
            let near = demanded[from..].iter().take(128);
            let meant = near
                .filter(|demand| demand.index == record.index)
                .min_by_key(|demand| demand.sync_ns.abs_diff(record.at_ns));
            let meant = meant.copied().unwrap_or_default();
            writeln!(
                file,
                "{},{},{},{},{},{:#06x},{},{},{},{}",
                drive.joint,
                record.at_ns,
                meant.sync_ns,
                drive.place(record.target),
                drive.place(record.actual),
                record.status,
                u8::from(record.follows),
                meant.missed_ticks,
                meant.lost_setpoints,
                meant.coasts,
            )?;
        }
    }
    file.flush()
}
