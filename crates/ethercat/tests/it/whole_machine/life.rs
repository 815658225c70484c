//! A whole life of the machine: home, probe, cut, thread, abort; and what is left of it without a cable.

use super::work::{Part, Work};
use super::{
    DRIVES, EDGES, FIFTH, FLOOD, FORWARD, HOME_EDGE, INDEX_AT, INPUTS, LAMP, NEAR, OUTPUTS, PART_Z,
    RAMP, SPINDLE, segment, setup,
};
use crate::judge::{commanded, output_changes};
use crate::machine::{COUNTS, Outcome, START_NS, Setup, run_on};
use crate::terminals::assert_fell_by_watchdogs;
use glidepath_ethercat::Event;
use glidepath_link::{ContactKind, Setpoint};
use glidepath_program::FrameFlags;

const TOUCH: &str = "G21 G90 F300\nG38.2 Z-20\n";
const CUT: &str =
    "G21 G90 G64 P0.02 F3000\nS6000 M3\nM8\nM62 P5\nG1 X10\nM63 P5\nG1 X0\nM5\nM9\nM2\n";
const PITCH_MM: f64 = 1.5;
const THREAD: &str = "G21 G90 G97 F3000\nS600 M3\nG0 Z8\nG33 Z-5 K1.5\nM5\nG0 Z8\nM2\n";
const LONG: &str = "G21 G90 G64 P0.02 F3000\nS6000 M3\nM8\nM62 P5\nG1 X50\nG1 X0\nM2\n";
/// The numbers of the programs of a whole life.
const TOUCHED: u64 = 1;
const CUTS: u64 = 2;
const THREADS: u64 = 3;

/// How fast the spindle turns at a time, rev/min.
fn rpm_at(turned: &[(u64, f64)], at_ns: u64) -> f64 {
    let after = turned.partition_point(|(ns, _)| *ns < at_ns);
    let after = after.clamp(1, turned.len() - 1);
    let [(from_ns, from), (to_ns, to)] = [turned[after - 1], turned[after]];
    60.0 * (to - from) / ((to_ns - from_ns) as f64 * 1e-9)
}

/// How far it has turned.
fn turned_at(turned: &[(u64, f64)], at_ns: u64) -> f64 {
    let after = turned.partition_point(|(ns, _)| *ns < at_ns);
    let (from_ns, from) = turned[after - 1];
    from + rpm_at(turned, at_ns) / 60.0 * (at_ns - from_ns) as f64 * 1e-9
}

fn moves(setpoint: &&Setpoint) -> bool {
    setpoint.velocity.iter().any(|v| v.abs() > 0.0)
}

fn of_program(outcome: &Outcome, epoch: u64) -> impl Iterator<Item = &Setpoint> + Clone {
    let setpoints = outcome.setpoints.iter();
    setpoints.filter(move |setpoint| setpoint.epoch == epoch)
}

/// Home, probe, and speed before the feed.
fn assert_began(setup: &Setup, work: &Work, outcome: &Outcome) {
    let first = of_program(outcome, TOUCHED).next().unwrap();
    for (joint, edge) in EDGES.iter().enumerate() {
        let off = first.joint_position[joint] - first.position[joint];
        assert!((off - (edge - HOME_EDGE)).abs() < 0.02, "J{joint}: {off}");
    }
    // The probe touched to the count, wherever a tick found it.
    let (kind, z) = work.contact.unwrap();
    assert_eq!(kind, ContactKind::Made.code());
    let off = first.joint_position[2] - first.position[2];
    let counts = (z + off - PART_Z) * COUNTS;
    assert!(counts.abs() < 1.5, "{counts} counts beside the part");
    let mut seen = 0;
    for setpoint in of_program(outcome, CUTS).filter(moves) {
        let rpm = rpm_at(&work.turned, setpoint.apply_ns + setup.bus.delay_ns);
        assert!((rpm - 6000.0).abs() < 6000.0 * NEAR + 10.0, "{rpm}");
        seen += 1;
    }
    assert!(seen > 60, "{seen}");
}

/// A thread is where the index has it, all along.
fn assert_threaded(setup: &Setup, work: &Work, outcome: &Outcome) {
    let sync = |setpoint: &&Setpoint| setpoint.has(FrameFlags::SYNC);
    let mut off_turns = Vec::new();
    for setpoint in of_program(outcome, THREADS).filter(sync) {
        let way_mm = 8.0 - setpoint.position[2];
        // Between run-in and run-out.
        if (2.0..11.0).contains(&way_mm) {
            let at_ns = setpoint.apply_ns + setup.bus.delay_ns;
            let turns = turned_at(&work.turned, at_ns) - INDEX_AT - way_mm / PITCH_MM;
            off_turns.push(turns - turns.round());
        }
    }
    assert!(off_turns.len() > 100, "{}", off_turns.len());
    let worst_mm = off_turns
        .iter()
        .fold(0.0_f64, |worst, off| worst.max(off.abs()))
        * PITCH_MM;
    // A count of the encoder, and what the spindle turns while a frame is on its way there.
    let allowed_mm = PITCH_MM * (1.5 / 4096.0 + 10.0 * 50e-6);
    eprintln!(
        "thread: {:.2} µm, {:.2} allowed",
        worst_mm * 1e3,
        allowed_mm * 1e3
    );
    assert!(worst_mm < allowed_mm, "{worst_mm} {allowed_mm}");
}

#[test]
fn a_whole_life_over_one_line() {
    let setup = setup();
    let mut work = Work::new(&[
        Part::Program(TOUCH),
        Part::Program(CUT),
        Part::Program(THREAD),
        Part::Aborted(LONG, 60),
    ]);
    let mut outcome = run_on(&setup, &mut work, segment(&setup), START_NS);
    let counts = &outcome.counts;
    let bad = (counts.lost, counts.short, counts.stale, counts.missed);
    assert_eq!(bad, (0, 0, 0, 0));
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    assert_eq!(work.faults, [None, None, None, None]);
    assert_eq!(work.gauge, Some(2.5));
    assert_began(&setup, &work, &outcome);
    // M62 and M63 are in place to the period of the bus: half of it before to half of it after.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let seen = output_changes(&records, FIFTH);
    let meant = commanded(&outcome, 5);
    for (at_ns, on) in &meant[..2] {
        let due_ns = at_ns + setup.bus.delay_ns;
        let is_there = seen.iter().any(|(seen_ns, seen_on)| {
            seen_on == on && seen_ns.abs_diff(due_ns) <= setup.bus.period_ns / 2 + 50_000
        });
        assert!(is_there, "{due_ns} {on}: {seen:?}");
    }
    assert_threaded(&setup, &work, &outcome);
    // The abort stops the spindle along its ramp when the axes rest, and leaves outputs of programs alone.
    assert_eq!(work.after[1..3], [(0, 0), (0, 0)]);
    assert_eq!(work.after[3], (FIFTH, 0));
    let aborted_ns = work.aborted_ns.unwrap();
    let rests = of_program(&outcome, 4)
        .filter(moves)
        .last()
        .unwrap()
        .apply_ns;
    assert!(rests > aborted_ns);
    let rpm = |at_ns| rpm_at(&work.turned, at_ns);
    assert!((rpm(rests + setup.bus.delay_ns) - 6000.0).abs() < 200.0);
    let ramp_ns = (6000.0 / RAMP * 1e9) as u64;
    assert!(rpm(rests + setup.bus.delay_ns + ramp_ns + 100_000_000).abs() < 45.0);
    // At the end of the bridge all is off.
    assert_eq!(outcome.left.0.outputs(OUTPUTS), [0]);
}

#[test]
fn without_the_terminals_behind_the_coupler_outputs_are_safe() {
    let setup = setup();
    let terminals = INPUTS..6;
    let mut work = Work::new(&[
        Part::Unplugged(LONG, 60, terminals.clone()),
        Part::Plugged(terminals),
        Part::Reset,
    ]);
    let mut outcome = run_on(&setup, &mut work, segment(&setup), START_NS);
    // By their own watchdogs.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let unplugged_ns = work.unplugged_ns.unwrap();
    let before = records.iter().rfind(|record| record.at_ns <= unplugged_ns);
    assert_eq!(before.unwrap().outputs, [FORWARD | FLOOD | FIFTH]);
    let fell = records
        .iter()
        .find(|record| record.at_ns > unplugged_ns)
        .unwrap();
    // The drives come to rest on the path, and the spindle along its ramp.
    assert_fell_by_watchdogs((&setup, &outcome), fell, (INPUTS, unplugged_ns));
    let fault = work.faults[0].clone().unwrap();
    assert!(
        fault.starts_with("a device on the bus of the drives is lost: the one at position 1"),
        "{fault}"
    );
    let ramp_ns = (6000.0 / RAMP * 1e9) as u64;
    let rests_ns = unplugged_ns + 500_000_000 + ramp_ns;
    assert!(rpm_at(&work.turned, rests_ns).abs() < 45.0);
    assert!(outcome.counts.restarts > 0, "the bus comes up again");
    // Nothing turns by itself when all is there again.
    assert_eq!(work.after[1], (LAMP, 0));
    assert_eq!(work.after[2], (FIFTH, 0));
    assert!(rpm_at(&work.turned, u64::MAX).abs() < 1.0);
}

#[test]
fn without_the_cable_to_the_drives_outputs_are_safe() {
    let setup = setup();
    let behind = 6..SPINDLE + 1;
    let mut work = Work::new(&[
        Part::Unplugged(LONG, 60, behind.clone()),
        Part::Plugged(behind),
        Part::Reset,
    ]);
    let mut outcome = run_on(&setup, &mut work, segment(&setup), START_NS);
    let unplugged_ns = work.unplugged_ns.unwrap();
    let gone = |joint| outcome.events.contains(&Event::Gone(joint));
    assert_eq!([0, 1, 2].map(gone), [true; 3], "{:?}", outcome.events);
    // As soon as it is known that nothing moves that is led: two tenths of a second at the most.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let forward = output_changes(&records, FORWARD);
    let (off_ns, _) = forward
        .iter()
        .find(|(ns, on)| *ns > unplugged_ns && !on)
        .unwrap();
    assert!(
        off_ns - unplugged_ns < 200_000_000,
        "{}",
        off_ns - unplugged_ns
    );
    assert!(
        !forward.iter().any(|(ns, on)| ns > off_ns && *on),
        "{forward:?}"
    );
    // Every drive stops by its own watchdog, the spindle, too.
    for (joint, position) in DRIVES.iter().enumerate() {
        let records = &outcome.records[joint];
        let watched = records.iter().rfind(|record| record.follows);
        let late_ns = watched.unwrap().at_ns.saturating_sub(unplugged_ns);
        let most_ns = setup.bus.watchdog_ns + 2 * setup.bus.period_ns;
        assert!(late_ns <= most_ns, "device {position}: {late_ns}");
    }
    assert!(rpm_at(&work.turned, unplugged_ns + 2_000_000_000).abs() < 45.0);
    assert!(work.faults[0].is_some());
    assert!(outcome.counts.restarts > 0, "the bus comes up again");
    assert_eq!(work.after[1].0 & (FORWARD | FLOOD), 0);
}
