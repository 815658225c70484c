//! The instructions that a line takes: figures that other load on the host does not change.
//!
//! The test runs itself under callgrind, reading a program once and twice; the difference is what
//! its lines took. It counts optimised code only, and is skipped without valgrind:
//!
//! ```text
//! cargo test --release -p glidepath-gcode --test instructions -- --nocapture
//! ```
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test, and a measurement"
)]

#[path = "../../../tests/counted/mod.rs"]
mod counted;

use counted::{cannot_count, counted, number};
use glidepath_gcode::{AxisTravel, Machine, Options, Program, check, diagnostics};
use glidepath_geometry::Axis;
use std::hint::black_box;

/// The test that is counted.
const TEST: &str = "a_line_takes_few_instructions";
/// In the environment of the process that is counted: the case, and how often the program is read.
const CASE: &str = "GLIDEPATH_COUNTED_CASE";
const TIMES: &str = "GLIDEPATH_COUNTED_TIMES";
/// Lines of the program.
const COUNTED: u32 = 10_000;

/// What is counted: a line by its number, what is done with the program, and the most instructions
/// of a line on average.
struct Case {
    name: &'static str,
    line: fn(u32) -> String,
    read: fn(&str),
    most: u64,
}

const CASES: [Case; 6] = [
    Case {
        name: "plain line, read",
        line: plain,
        read: run,
        most: 1_200,
    },
    Case {
        name: "plain line, checked",
        line: plain,
        read: judge,
        most: 1_390,
    },
    Case {
        name: "plain line, found right",
        line: plain,
        read: find,
        most: 870,
    },
    Case {
        name: "two words, checked",
        line: short,
        read: judge,
        most: 890,
    },
    Case {
        name: "arc, checked",
        line: arc,
        read: judge,
        most: 13_600,
    },
    Case {
        name: "line with a comment, checked",
        line: commented,
        read: judge,
        most: 5_050,
    },
];

/// A line of a hundredth of a millimetre round a circle that slowly sinks.
fn plain(k: u32) -> String {
    let angle = 2e-4 * f64::from(k);
    let (x, y, z) = (50.0 * angle.cos() - 50.0, 50.0 * angle.sin(), -1e-4 * angle);
    format!("G1 X{x:.4} Y{y:.4} Z{z:.4}\n")
}

/// The same as a CAM system writes it that leaves out what does not change.
fn short(k: u32) -> String {
    let angle = 2e-4 * f64::from(k);
    let (x, y) = (50.0 * angle.cos() - 50.0, 50.0 * angle.sin());
    format!("X{x:.3}Y{y:.3}\n")
}

fn arc(k: u32) -> String {
    let x = 4.0 * f64::from(k % 2);
    format!("G2 X{x:.3} Y0. I{:.3} J0.\n", x - 2.0)
}

fn commented(k: u32) -> String {
    format!("{} (cut)\n", plain(k).trim_end())
}

/// A mill with soft limits.
fn options() -> Options {
    let travel = AxisTravel {
        min: -500.0,
        max: 500.0,
    };
    let axes = [Axis::X, Axis::Y, Axis::Z];
    let machine = axes.into_iter().fold(Machine::new(&[]), |machine, axis| {
        machine.with_travel(axis, travel)
    });
    Options {
        machine,
        ..Options::default()
    }
}

/// Gives out the moves. They are looked at where they are put: to hand them on would copy each of them twice more,
/// and a copy takes 52 to 64 instructions, as the addresses are.
fn run(text: &str) {
    let mut program = Program::new(text.as_bytes(), options());
    while let Some(item) = black_box(&program.next()) {
        assert!(item.is_ok());
    }
}

fn judge(text: &str) {
    assert!(black_box(check(text.as_bytes(), options())).is_accepted());
}

fn find(text: &str) {
    assert_eq!(
        black_box(diagnostics(text.as_bytes(), options())).diagnostics,
        []
    );
}

/// Reads a program of this many lines so many times.
fn work(case: &Case, lines: u32, times: u32) {
    let mut text = String::from("G21 G90 F6000\nG0 X4 Y0 Z0\n");
    (0..lines).for_each(|k| text.push_str(&(case.line)(k)));
    (0..times).for_each(|_| (case.read)(&text));
}

#[test]
fn a_line_takes_few_instructions() {
    if let (Some(case), Some(times)) = (number(CASE), number(TIMES)) {
        work(&CASES[case as usize], COUNTED, times);
        return;
    }
    if cannot_count() {
        return;
    }
    for (k, case) in CASES.iter().enumerate() {
        let case_number = u32::try_from(k).unwrap();
        let total = |times| counted(TEST, &[(CASE, case_number), (TIMES, times)]);
        let each = (total(2) - total(1)) / u64::from(COUNTED);
        println!("{}: {each} instructions", case.name);
        assert!(each <= case.most, "{}: {each} > {}", case.name, case.most);
    }
}
