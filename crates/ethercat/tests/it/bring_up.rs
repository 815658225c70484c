//! Tests of the way from a wire to drives in OP, and of what is said where that does not work.

use crate::life::{Day, assert_clean};
use crate::machine::{Setup, run};
use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{
    Cable, ClockKind as EmulatedClock, DriveSettings as Emulated, ImageAccess, OutputWatchdog,
    Segment, SyncType,
};
use glidepath_ethercat::{
    BusError, BusSettings, ClockKind, DriveSettings, Init, Settings, Wire as _, object,
};
use glidepath_link::servo::ServoSettings;

const START_NS: u64 = 9_000_000_000_000;

fn settings(drives: usize) -> Settings {
    Settings {
        bus: BusSettings::default(),
        drives: (0..drives).map(crate::machine::drive).collect(),
        drive_inputs: Vec::new(),
        terminals: Vec::new(),
        servo: ServoSettings::default(),
    }
}

fn wire(drives: &[Emulated]) -> MemoryWire<Quiet> {
    MemoryWire::new(
        Segment::new_at(drives, START_NS - 5_000_000_000),
        Quiet,
        START_NS,
    )
}

fn failure(drives: &[Emulated], settings: &Settings) -> BusError {
    let mut wire = wire(drives);
    let safe_op = Init::find(&mut wire)
        .and_then(Init::into_pre_op)
        .and_then(|bus| bus.into_safe_op(settings));
    safe_op
        .and_then(|bus| bus.into_op(&settings.bus))
        .unwrap_err()
}

#[test]
fn drives_are_found_and_named() {
    let drives = [0, 1, 2].map(|nth| Emulated {
        name: format!("DRIVE {nth}"),
        identity: [0x83, 7 + nth, 2, 99],
        clock: if nth == 1 {
            EmulatedClock::ReceiveTimes
        } else {
            EmulatedClock::Bits64
        },
        ..Emulated::default()
    });
    let mut wire = wire(&drives);
    let found = Init::find(&mut wire).unwrap();
    let names: Vec<_> = found
        .devices()
        .iter()
        .map(|device| device.name.as_str())
        .collect();
    assert_eq!(names, ["DRIVE 0", "DRIVE 1", "DRIVE 2"]);
    let second = &found.devices()[1];
    assert_eq!((second.identity.vendor, second.identity.product), (0x83, 8));
    assert_eq!(
        (second.identity.serial, second.clock, second.open_ports),
        (99, ClockKind::ReceiveTimes, [true, true, false, false])
    );
    assert!(second.may_be_drive());
    let mut bus = found.into_pre_op().unwrap();
    assert_eq!(bus.read(2, object(0x1018, 2, 4)).unwrap(), 9);
    let refused = bus.read(2, object(0x2345, 0, 4)).unwrap_err();
    assert!(
        refused
            .to_string()
            .contains("0x2345:0 was refused: abort code 0x06020000"),
        "{refused}"
    );
}

#[test]
fn drives_come_to_op_with_clocks_that_agree() {
    for (drift, period_ns) in [(0.0, 1_000_000), (100.0, 2_000_000), (-100.0, 4_000_000)] {
        come_to_op([EmulatedClock::Bits64; 3], drift, period_ns);
    }
}

#[test]
fn a_clock_of_32_bits_goes_round_and_on() {
    let (short, long) = (EmulatedClock::Bits32, EmulatedClock::Bits64);
    for kinds in [[short; 3], [short, long, long], [long, short, long]] {
        come_to_op(kinds, 60.0, 2_000_000);
    }
}

/// Brings drives to OP, the last state there is; by then the wire has this time.
fn come_up(line: &[Emulated], settings: &Settings) -> Result<MemoryWire<Quiet>, BusError> {
    let mut wire = wire(line);
    let bus = Init::find(&mut wire)?.into_pre_op()?;
    bus.into_safe_op(settings)?.into_op(&settings.bus)?;
    Ok(wire)
}

#[test]
fn a_drive_whose_sync_type_is_fixed_is_asked_whether_it_is_right() {
    let drive = |sync_type| {
        [Emulated {
            name: "FIXED".to_owned(),
            sync_type,
            ..Emulated::default()
        }]
    };
    for right in [SyncType::Follows, SyncType::Fixed(2), SyncType::Fixed(3)] {
        come_up(&drive(right), &settings(1)).unwrap();
    }
    for wrong in [0, 1] {
        let refused = failure(&drive(SyncType::Fixed(wrong)), &settings(1)).to_string();
        let why = format!(
            "device 0 (FIXED): it does not take its targets over at SYNC0 (0x1C32:1 is {wrong}, and it \
             was to be 2): switch it to distributed clocks with its manufacturer's tool"
        );
        assert_eq!(refused, why);
    }
}

#[test]
fn a_drive_that_does_not_know_lrw_gets_what_it_knows() {
    for image in [ImageAccess::NoLrwByFeatures, ImageAccess::NoLrwByEeprom] {
        let mut setup = Setup::absolute(2_000_000);
        setup.emulated[1].image = image;
        let outcome = run(&setup, &mut Day::default());
        assert_clean(&setup, &outcome);
        let end = outcome.setpoints.last().unwrap();
        assert!((end.position[0] - 5.0).abs() < 1e-3, "{}", end.position[0]);
    }
}

#[test]
fn no_two_messages_in_a_row_have_the_same_number() {
    let drive = |drops_repeats| {
        let drive = Emulated {
            drops_repeats,
            ..Emulated::default()
        };
        let wire = come_up(&[drive.clone(), drive], &settings(2)).unwrap();
        wire.now_ns() - START_NS
    };
    // A message that is dropped is waited for, and sent again.
    assert_eq!(drive(true), drive(false));
}

#[test]
fn every_drive_notices_that_frames_stay_away() {
    let drive = |watchdog| {
        [Emulated {
            name: "AKD".to_owned(),
            watchdog,
            ..Emulated::default()
        }]
    };
    // A watchdog that is shorter than the period does not let anybody stay in OP.
    let mut hasty = settings(1);
    hasty.bus.watchdog_ns = 100_000;
    for watchdog in [OutputWatchdog::Told, OutputWatchdog::Untold] {
        come_up(&drive(watchdog), &settings(1)).unwrap();
        let refused = failure(&drive(watchdog), &hasty).to_string();
        assert!(
            refused.contains("AL status 0x001b, watchdog"),
            "{watchdog:?}: {refused}"
        );
    }
    let refused = failure(&drive(OutputWatchdog::Never), &settings(1)).to_string();
    let why = "device 0 (AKD): it does not let the watchdog of its outputs be switched on";
    assert!(refused.starts_with(why), "{refused}");
}

#[test]
fn a_drive_whose_eeprom_does_not_say_where_its_data_is_is_told_by_the_file() {
    let drive = [Emulated {
        name: "ROVIX".to_owned(),
        tells_managers: false,
        ..Emulated::default()
    }];
    let refused = failure(&drive, &settings(1)).to_string();
    let why =
        "device 0 (ROVIX): its EEPROM does not say where its process data is: give outputs_at";
    assert!(refused.starts_with(why), "{refused}");
    let mut told = settings(1);
    told.drives[0].process_at = Some((0x1100, 0x1180));
    come_up(&drive, &told).unwrap();
}

/// Three drives come to OP, and what was demanded for a time takes effect at that time.
fn come_to_op(kinds: [EmulatedClock; 3], drift: f64, period_ns: u64) {
    let mut drives = [drift, -drift, 20.0].map(|drift_ppm| Emulated {
        drift_ppm,
        ..Emulated::default()
    });
    for (drive, clock) in drives.iter_mut().zip(kinds) {
        drive.clock = clock;
    }
    let mut wire = wire(&drives);
    wire.segment.keep_records();
    let mut settings = settings(3);
    (settings.bus.period_ns, settings.bus.shift_ns) = (period_ns, period_ns / 2);
    let bus = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    let mut op = bus
        .into_safe_op(&settings)
        .unwrap()
        .into_op(&settings.bus)
        .unwrap();
    let mut clock = op.take_clock().unwrap();
    let mut inputs = [glidepath_ethercat::Inputs::default(); 3];
    let mut demanded = Vec::new();
    for _ in 0..4000 {
        let beat = clock.next(op.wire().now_ns());
        op.wire().sleep_until(beat.send_ns);
        op.send(&[glidepath_ethercat::Outputs::default(); 3])
            .unwrap();
        demanded.push((op.index(), beat.sync_ns));
        let reception = op.receive(beat.give_up_ns, &mut inputs).unwrap();
        let glidepath_ethercat::Reception::Good(times) = reception else {
            panic!("{reception:?}");
        };
        clock.hear(times);
    }
    // What was demanded for a time took effect at that time, in every drive.
    let quartz = clock.rate() * 1e6;
    assert!((quartz - drift).abs() < 2.0, "{quartz} ppm");
    let tail = &demanded[2000..];
    for drive in 0..3 {
        let records = wire.segment.take_records(drive);
        let worst = phase_errors(tail, &records).fold(0, u64::max);
        assert!(worst < 1_000, "drive {drive}: {worst} ns");
    }
}

#[test]
fn terminals_without_a_system_time_stop_nobody() {
    let terminal = |name, clock| Emulated::terminal(name, clock);
    let line = [
        terminal("COUPLER", EmulatedClock::Bits64),
        terminal("INPUTS", EmulatedClock::ReceiveTimes),
        Emulated::default(),
        terminal("OLD", EmulatedClock::None),
        Emulated::default(),
    ];
    let mut wire = wire(&line);
    wire.segment.keep_records();
    let found = Init::find(&mut wire).unwrap();
    let kinds: Vec<_> = found.devices().iter().map(|device| device.clock).collect();
    let (none, times, clock) = (ClockKind::None, ClockKind::ReceiveTimes, ClockKind::Bits64);
    assert_eq!(kinds, [clock, times, clock, none, clock]);
    let mut settings = settings(2);
    (settings.drives[0].position, settings.drives[1].position) = (2, 4);
    let bus = found.into_pre_op().unwrap();
    let op = bus.into_safe_op(&settings).unwrap();
    op.into_op(&settings.bus).unwrap();
    let [first, second] = [2, 4].map(|drive| wire.segment.take_records(drive));
    assert!(first.len() > 50);
    for (one, other) in first.iter().zip(&second) {
        assert!(one.at_ns.abs_diff(other.at_ns) < 1_000, "{one:?} {other:?}");
    }
}

fn cable(from: usize, port: u8, way_ns: u64) -> Cable {
    Cable {
        from,
        port,
        into: 0,
        way_ns,
    }
}

fn branched(line: &[Emulated], cables: &[Cable]) -> MemoryWire<Quiet> {
    let segment = Segment::branched(line, cables, START_NS - 5_000_000_000).unwrap();
    MemoryWire::new(segment, Quiet, START_NS)
}

#[test]
fn drives_behind_junctions_take_their_targets_at_the_same_moment() {
    let terminal = |clock| Emulated::terminal("TERMINAL", clock);
    let (clock, times) = (EmulatedClock::Bits64, EmulatedClock::ReceiveTimes);
    // A coupler with two terminals at port 3 and a cable onwards at port 2; there a drive that passes on
    // by port 2, and a junction with drives at three ports.
    let line = [
        terminal(clock),
        terminal(times),
        terminal(EmulatedClock::None),
        Emulated::default(),
        terminal(times),
        Emulated::default(),
        Emulated::default(),
        Emulated::default(),
    ];
    let cables = [
        cable(0, 3, 150),
        cable(1, 1, 150),
        cable(0, 2, 9_000),
        cable(3, 2, 700),
        cable(4, 3, 12_000),
        cable(4, 1, 300),
        cable(4, 2, 25_000),
    ];
    let mut wire = branched(&line, &cables);
    wire.segment.keep_records();
    let mut settings = settings(4);
    let places = [3, 5, 6, 7];
    for (drive, position) in settings.drives.iter_mut().zip(places) {
        drive.position = position;
    }
    let bus = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    let op = bus.into_safe_op(&settings).unwrap();
    op.into_op(&settings.bus).unwrap();
    let records = places.map(|drive| wire.segment.take_records(drive));
    assert!(records[0].len() > 50);
    for others in &records[1..] {
        for (one, other) in records[0].iter().zip(others) {
            assert!(one.at_ns.abs_diff(other.at_ns) < 50, "{one:?} {other:?}");
        }
    }
}

#[test]
fn cables_in_the_wrong_port_are_told_by_the_device() {
    let drives = [0, 1, 2].map(|nth| Emulated {
        name: format!("DRIVE {nth}"),
        ..Emulated::default()
    });
    let failed = |cables: &[Cable]| {
        let mut wire = branched(&drives, cables);
        let failed = Init::find(&mut wire).and_then(Init::into_pre_op);
        failed.map(|_| ()).unwrap_err().to_string()
    };
    let swapped = |from, port, way_ns| Cable {
        into: 1,
        ..cable(from, port, way_ns)
    };
    let last = failed(&[cable(0, 1, 500), swapped(1, 1, 500)]);
    let remedy = "frames do not come in by its IN port: swap the cables of its IN and OUT";
    assert_eq!(last, format!("device 2 (DRIVE 2): {remedy}"));
    // The one that hangs between the others reads after the one behind it.
    let between = failed(&[cable(2, 0, 500), swapped(0, 1, 500)]);
    assert_eq!(between, format!("device 2 (DRIVE 2): {remedy}"));
}

#[test]
fn a_junction_that_notes_no_times_is_told_by_its_name() {
    let line = [
        Emulated::terminal("JUNCTION", EmulatedClock::None),
        Emulated::default(),
        Emulated::default(),
    ];
    let mut wire = branched(&line, &[cable(0, 3, 500), cable(0, 1, 500)]);
    let failed = Init::find(&mut wire).and_then(Init::into_pre_op);
    let failed = failed.map(|_| ()).unwrap_err().to_string();
    assert!(
        failed.starts_with("device 0 (JUNCTION): it joins several cables"),
        "{failed}"
    );
}

/// How far each demand's time is from the SYNC0 at which it took effect, ns.
fn phase_errors<'a>(
    demanded: &'a [(u8, u64)],
    records: &'a [glidepath_emulator::SyncRecord],
) -> impl Iterator<Item = u64> + 'a {
    demanded.iter().filter_map(|(index, sync_ns)| {
        let at = records.partition_point(|record| record.at_ns + 500_000 < *sync_ns);
        let near = records.get(at)?;
        assert_eq!(near.index, *index);
        Some(near.at_ns.abs_diff(*sync_ns))
    })
}

#[test]
fn what_is_wrong_is_said_with_its_remedy() {
    let good = [Emulated::default(), Emulated::default()];
    let nobody = failure(&[], &settings(2));
    assert!(matches!(nobody, BusError::Nobody), "{nobody}");
    let missing = failure(&good, &settings(3));
    assert!(
        matches!(
            missing,
            BusError::Missing {
                position: 2,
                found: 2
            }
        ),
        "{missing}"
    );
    let mut other = settings(2);
    other.drives[1].product = 0x403;
    let other = failure(&good, &other);
    let is_told = matches!(
        other,
        BusError::Other {
            position: 1,
            what: "product",
            wanted: 0x403,
            found: 0x402
        }
    );
    assert!(is_told, "{other}");
    let mut clockless = good.clone();
    clockless[1].clock = EmulatedClock::ReceiveTimes;
    let unfit = failure(&clockless, &settings(2));
    assert!(
        unfit.to_string().contains("no distributed clock"),
        "{unfit}"
    );
    let mut twice = settings(2);
    // A drive that is not told its sync type refuses SYNC0; one that has another process data size,
    // SAFE-OP. Neither happens with what this master writes, so the watchdog has to do.
    twice.bus.watchdog_ns = 100_000;
    let refused = failure(&good, &twice);
    assert!(
        refused.to_string().contains("AL status 0x001b, watchdog"),
        "{refused}"
    );
}

#[test]
fn drives_count_in_their_own_way() {
    let drive = DriveSettings {
        counts_per_unit: 1000.0,
        is_inverted: true,
        home_offset: 10.0,
        ..crate::machine::drive(0)
    };
    assert_eq!(drive.counts(12.5), Some(-2500));
    assert!((drive.place(-2500) - 12.5).abs() < 1e-12);
    assert_eq!(drive.counts(-3e6), None);
    assert_eq!(drive.counts(f64::NAN), None);
}
