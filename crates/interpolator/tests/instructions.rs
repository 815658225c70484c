//! How many instructions a tick takes: a figure that other load on the host does not change.
//!
//! The test runs itself under callgrind, with a number of ticks and with twice as many; the
//! difference is what the ticks took. It counts optimised code only, and is skipped without valgrind:
//!
//! ```text
//! cargo test --release -p glidepath-interpolator --test instructions -- --nocapture
//! ```
#![allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    clippy::panic,
    clippy::print_stdout,
    clippy::unwrap_used,
    unreachable_pub,
    dead_code,
    reason = "a test, with numbers that are small, and what it shares with others"
)]

mod synthetic;

use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, stepped};
use glidepath_kinematics::{Hexapod, Kinematics as _, Mechanism};
use glidepath_link::Command;
use std::hint::black_box;
use std::process::Command as Process;
use synthetic::{lines, mill, records};

/// In the environment of the process that is counted: the case, and the number of ticks.
const CASE: &str = "GLIDEPATH_COUNTED_CASE";
const TICKS: &str = "GLIDEPATH_COUNTED_TICKS";
/// Frames a planner keeps ahead.
const HORIZON: u64 = 150;
const AXES: usize = 9;

/// What is counted: one command at the start, and the most instructions of a tick on average, with
/// the reading of a frame from the ring.
struct Case {
    name: &'static str,
    command: Option<Command>,
    most: u64,
}

const CASES: [Case; 3] = [
    Case {
        name: "rate 1",
        command: None,
        most: 4_600,
    },
    Case {
        name: "rate 0.5",
        command: Some(Command::FeedOverride(0.5)),
        most: 3_000,
    },
    Case {
        name: "held",
        command: Some(Command::Hold),
        most: 2_600,
    },
];

/// Ticks before those that are counted: the command is carried out in them.
const BEFORE: usize = 300;

fn drive(case: &Case, ticks: usize) {
    // Enough for every number of ticks, so that both counts have the same preparations.
    let frames = records(&lines(1, AXES, 12_000, &mill(), 0.004), 1, 4_000_000);
    let (mut sent, mut executed) = (0, 0);
    stepped(&Config::new(mill(), 4_000_000), |stepped| {
        for tick in 0..BEFORE + ticks {
            while let Some(frame) = frames.get(sent)
                && frame.sequence < executed + HORIZON
                && stepped.offer(frame)
            {
                sent += 1;
            }
            if tick == BEFORE / 2 {
                case.command.inspect(|command| {
                    stepped.command(*command);
                });
            }
            executed = black_box(stepped.tick()).sequence;
        }
    });
}

/// Instructions of this test as another process, with so many ticks.
fn counted(test: &str, case: usize, ticks: usize) -> u64 {
    let output = Process::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture"])
        .env(CASE, case.to_string())
        .env(TICKS, ticks.to_string())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    let total = text
        .lines()
        .find_map(|line| line.split_once("Collected :"))
        .and_then(|(_, count)| count.trim().parse().ok());
    total.unwrap_or_else(|| panic!("no count: {text}"))
}

/// What a tick costs beside that where joints are not axes: positions, velocities and accelerations of
/// the six struts of a hexapod. It is done by the thread that owns the ports, once a tick.
const MOST_FOR_JOINTS: u64 = 3_300;

fn turn(times: usize) {
    let hexapod = Mechanism::Hexapod(Hexapod::paired(400.0, 150.0, 15.0));
    let mut position = AxisVector::zeros();
    position[2] = 500.0;
    let (velocity, acceleration) = (AxisVector::repeat(10.0), AxisVector::repeat(100.0));
    for _ in 0..times {
        position[0] += 1e-3;
        let motion = hexapod.motion(black_box(&position), &velocity, &acceleration);
        black_box(motion.unwrap());
    }
}

#[test]
fn joints_take_few_instructions() {
    if let Some(times) = number(TICKS) {
        turn(times);
        return;
    }
    if cannot_count() {
        return;
    }
    let times = 5_000;
    let test = "joints_take_few_instructions";
    let each = (counted(test, 0, 2 * times) - counted(test, 0, times)) / times as u64;
    println!("joints of a hexapod: {each} instructions a tick");
    assert!(each <= MOST_FOR_JOINTS, "{each} > {MOST_FOR_JOINTS}");
}

fn number(name: &str) -> Option<usize> {
    std::env::var(name).ok()?.parse().ok()
}

/// True, and says why, where instructions of optimised code cannot be counted.
fn cannot_count() -> bool {
    if cfg!(debug_assertions) {
        println!("skipped: counts optimised code, use cargo test --release");
        return true;
    }
    let is_missing = Process::new("valgrind").arg("--version").output().is_err();
    if is_missing {
        println!("skipped: valgrind is not installed");
    }
    is_missing
}

#[test]
fn a_tick_takes_few_instructions() {
    if let (Some(case), Some(ticks)) = (number(CASE), number(TICKS)) {
        drive(&CASES[case], ticks);
        return;
    }
    if cannot_count() {
        return;
    }
    let test = "a_tick_takes_few_instructions";
    for (k, case) in CASES.iter().enumerate() {
        let ticks = 5_000;
        let each = (counted(test, k, 2 * ticks) - counted(test, k, ticks)) / ticks as u64;
        println!("{AXES} axes, {}: {each} instructions a tick", case.name);
        assert!(each <= case.most, "{}: {each} > {}", case.name, case.most);
    }
}
