//! Lines that come through a pipe as time goes, faster or slower than they are driven.

use std::process::Stdio;
use std::time::{Duration, Instant};

use glidepath_link::Setpoint;
use glidepath_testing::{is_crowded, leave_out, skip};
use glidepath_tests::{Instance, Process, Services, Tape, Watchdog};

use crate::faults::Chance;

const PATIENCE: Duration = Duration::from_secs(240);
/// A way of so many moves along X, 0.4 s each.
const MOVES: u32 = 12;
const MOVE_MM: f64 = 40.0;
const START_MM: f64 = -240.0;
/// So many are more than what effort "optimal" looks ahead (1.25 s), what is published ahead (0.6 s), and what the rest
/// of them may take to come (0.8 s).
const LEAD: u32 = 8;
/// How soon what has come is done if nothing more comes: 50 ms of silence, planning, and 0.2 s of motion, on a busy host.
const SOON: Duration = Duration::from_millis(1200);

fn end_mm(number: u32) -> f64 {
    MOVE_MM.mul_add(f64::from(number), START_MM)
}

/// A pipe in front of a planner that has read its first lines, with the axes at the start of the way.
fn pipe(instance: &Instance, services: &Services<'_>, effort: &str) -> Process {
    let arguments = ["planner", "-", "--effort", effort];
    let planner = Process::join_with(instance, &arguments, Stdio::piped());
    let mut planner = planner;
    planner.write(&format!("G21 G90 G64 F6000\nG0 X{START_MM}\n"));
    let _there = services.wait(|status| (status.position[0] - START_MM).abs() < 1e-9);
    planner
}

fn line(number: u32) -> String {
    format!("G1 X{}\n", end_mm(number))
}

/// Where X rested under way, for a period and more.
fn rests(told: &[Setpoint]) -> Vec<f64> {
    let along = told.iter().map(|setpoint| setpoint.position[0]);
    let along: Vec<f64> = along.collect();
    let last = along.last().copied().unwrap_or_default();
    let begun = along.iter().rposition(|x| *x <= START_MM);
    let under_way = along.iter().skip(begun.unwrap_or_default());
    let under_way: Vec<f64> = under_way.copied().take_while(|x| *x < last).collect();
    let still = |pair: &&[f64]| pair[0].total_cmp(&pair[1]).is_eq();
    let pairs = under_way.windows(2).filter(still);
    pairs
        .map(|pair| pair[0])
        .filter(|x| *x > START_MM)
        .collect()
}

/// Writes the moves behind pauses; returns where X rested.
fn driven(
    (instance, services, tape): (&Instance, &Services<'_>, &Tape),
    effort: &str,
    mut pause: impl FnMut(u32) -> Duration,
) -> Vec<f64> {
    let mut planner = pipe(instance, services, effort);
    let place = tape.length();
    for number in 1..=MOVES {
        std::thread::sleep(pause(number));
        planner.write(&line(number));
    }
    planner.close();
    let _done = planner.wait().expect(0);
    let last_mm = end_mm(MOVES);
    let _there = services.wait(|status| (status.position[0] - last_mm).abs() < 1e-9);
    // What was published is on the tape a moment later.
    std::thread::sleep(Duration::from_millis(50));
    rests(&tape.since(place))
}

/// True, and told, if frames ran out on a host that let the planner wait: the motion then slows where it would not.
fn kept_waiting(services: &Services<'_>) -> bool {
    let is_kept = services.wait(|_| true).starved_ticks > 0 && is_crowded();
    if is_kept {
        skip(
            "lines that come in time",
            "the host had other things to do, and frames ran out",
        );
    }
    is_kept
}

#[test]
fn what_comes_in_time_is_driven_without_a_rest_and_what_is_there_moves() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let tape = Tape::start(&instance);
    drive((&instance, &services, &tape));
    drop(services.end());
    assert_eq!(tape.judge(), Vec::<String>::new());
}

/// Drives the lines, with all pauses.
fn drive(machine: (&Instance, &Services<'_>, &Tape)) {
    let (instance, services, _) = machine;
    let mut chance = Chance::new(1);
    for effort in ["optimal", "fast"] {
        let rests = driven(machine, effort, |_| Duration::ZERO);
        if kept_waiting(services) {
            return;
        }
        assert_eq!(rests, [] as [f64; 0], "{effort}");

        // From the first line on: it may rest until there is a lead, and no more.
        let rests = driven(machine, effort, |_| chance.millis(10, 200));
        if kept_waiting(services) {
            return;
        }
        let late: Vec<_> = rests.iter().filter(|x| **x > end_mm(LEAD)).collect();
        assert!(late.is_empty(), "{effort}: it rests at {late:?}");

        // Slower than it is driven: what has come is done, each line by itself.
        let mut planner = pipe(instance, services, effort);
        for number in 1..=MOVES {
            std::thread::sleep(chance.millis(10, 200));
            planner.write(&line(number));
            let written = Instant::now();
            let _there = services.wait(|status| (status.position[0] - end_mm(number)).abs() < 1e-9);
            let took = written.elapsed();
            if is_crowded() {
                leave_out(
                    "how soon a line is driven that comes late",
                    "the host had other things to do",
                );
            } else {
                assert!(took < SOON, "{effort}: line {number} took {took:?}");
            }
        }
        planner.close();
        let _done = planner.wait().expect(0);
    }
}
