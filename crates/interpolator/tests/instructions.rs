//! The instructions that a tick takes: a figure that other load on the host does not change.
//!
//! The test runs itself under callgrind, which writes down what each tick took, one after the
//! other: on average and at most. It counts optimised code only, and is skipped without valgrind:
//!
//! ```text
//! cargo test --release -p glidepath-interpolator --test instructions -- --nocapture
//! ```
#![allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    clippy::indexing_slicing,
    clippy::print_stdout,
    clippy::unwrap_used,
    unreachable_pub,
    dead_code,
    reason = "a test, with numbers that are small, and what it shares with others"
)]

#[path = "../../../tests/counted/mod.rs"]
mod counted;
mod synthetic;

use counted::cannot_count;
use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, Stepped, stepped};
use glidepath_link::{Command, JogDemand, JogMode, Setpoint};
use std::hint::black_box;
use std::process::Command as Process;
use synthetic::{hexapod, lines, mill, plan, records};

/// In the environment of the process that is counted: the case.
const CASE: &str = "GLIDEPATH_COUNTED_CASE";
/// Frames a planner keeps ahead.
const HORIZON: u64 = 150;
const AXES: usize = 9;
/// Ticks that are counted, and those before them.
const TICKS: usize = 2_000;
const BEFORE: usize = 300;

/// What the operator does.
#[derive(Clone, Copy, PartialEq)]
enum Operator {
    /// One command, carried out before counting begins; or nothing.
    Once(Option<Command>),
    /// Every 0.4 s a hold, a resume, or an override: far more than anybody.
    Busy,
}

/// What is counted, and the most instructions of a tick on average and of any.
struct Case {
    name: &'static str,
    operator: Operator,
    /// Every axis at limits of its own, instead of along lines.
    is_hard: bool,
    has_joints: bool,
    /// The axes are jogged, with another velocity, step or wheel every 0.16 s, and no program runs.
    is_jogged: bool,
    average: u64,
    most: u64,
}

const fn case(name: &'static str, operator: Operator, average: u64, most: u64) -> Case {
    Case {
        name,
        operator,
        is_hard: false,
        has_joints: false,
        is_jogged: false,
        average,
        most,
    }
}

// A hundredth above what was measured. Of a tick at rate 1 some 50 instructions copy the sixteen events that a
// setpoint has room for, and 50 the joints' share of what a search for a stop takes along, which machines
// whose joints are axes do not use; with "hard" that copying is a tenth. Some 25 are the room for what is superposed, which
// setpoints have on every machine. With a hexapod one more inverse a
// frame is in it, by which ramps and stops are played through in joints, too.
const CASES: [Case; 9] = [
    case("rate 1", Operator::Once(None), 3_905, 25_500),
    case("rate 0.5", HALF, 2_935, 25_200),
    case("held", Operator::Once(Some(Command::Hold)), 2_500, 2_500),
    case("operator", Operator::Busy, 5_150, 90_900),
    Case {
        is_hard: true,
        ..case("hard", Operator::Once(None), 21_080, 113_700)
    },
    Case {
        is_hard: true,
        ..case("hard, operator", Operator::Busy, 33_560, 175_200)
    },
    Case {
        has_joints: true,
        ..case("hexapod", Operator::Once(None), 7_910, 30_600)
    },
    Case {
        is_jogged: true,
        ..case("jog", Operator::Once(None), 5_270, 10_870)
    },
    Case {
        is_jogged: true,
        has_joints: true,
        // Every tick plays the stop through, with what the build of the mechanism forbids.
        ..case("jog, hexapod", Operator::Once(None), 76_300, 126_300)
    },
];
const HALF: Operator = Operator::Once(Some(Command::FeedOverride(0.5)));

impl Operator {
    fn command(self, tick: usize) -> Option<Command> {
        match self {
            Self::Once(command) => command.filter(|_| tick == BEFORE / 2),
            Self::Busy if tick.is_multiple_of(100) => Some(match tick / 100 % 4 {
                0 => Command::Hold,
                1 => Command::Resume,
                2 => Command::FeedOverride(0.4),
                _ => Command::FeedOverride(1.0),
            }),
            Self::Busy => None,
        }
    }
}

/// A tick that is counted. A function of its own, so that the counting finds it.
#[inline(never)]
fn one_counted_tick(stepped: &mut Stepped<'_>) -> Setpoint {
    black_box(stepped.tick())
}

/// A jog of several axes that wants something else every 40 ticks, and is alive in between.
fn jog(tick: usize) -> JogDemand {
    let mut demand = JogDemand {
        client: 1,
        number: 1 + (tick / 40) as u64,
        sent_ns: tick as u64 * 4_000_000,
        mask: 0b111_1111,
        scale: 0.05,
        velocity_v: 120.0,
        ..bytemuck::Zeroable::zeroed()
    };
    let side = if (tick / 80).is_multiple_of(2) {
        1.0
    } else {
        -1.0
    };
    let (mode, value) = match tick / 40 % 4 {
        0 => (JogMode::Continuous, 100.0 * side),
        1 => (JogMode::Continuous, -60.0 * side),
        2 => (JogMode::Incremental, 5.0 * side),
        _ => (JogMode::Continuous, 30.0),
    };
    demand.mode = mode.code();
    for (axis, slot) in demand.value.iter_mut().take(6).enumerate() {
        *slot = value * [1.0, -0.5, 0.25, 0.1, 0.05, -0.1][axis];
    }
    demand
}

fn drive(case: &Case) {
    let ticks = BEFORE + TICKS;
    let frames = if case.is_hard {
        plan(1, AXES, ticks, &mill(), 0.004, AxisVector::zeros())
    } else {
        lines(1, AXES, ticks, &mill(), 0.004)
    };
    let frames = if case.is_jogged {
        Vec::new()
    } else {
        records(&frames, 1, 4_000_000)
    };
    let mut config = Config::new(mill(), 4_000_000);
    if case.has_joints {
        config.mechanism = hexapod();
    }
    let (mut sent, mut executed) = (0, 0);
    stepped(&config, |stepped| {
        for tick in 0..ticks {
            while let Some(frame) = frames.get(sent)
                && frame.sequence < executed + HORIZON
                && stepped.offer(frame)
            {
                sent += 1;
            }
            if case.is_jogged {
                stepped.jog(&jog(tick));
            }
            if let Some(command) = case.operator.command(tick) {
                stepped.command(command);
            }
            executed = if tick < BEFORE {
                stepped.tick().sequence
            } else {
                one_counted_tick(stepped).sequence
            };
        }
    });
}

/// Instructions of every tick of a case, in ascending order.
fn counted(case: usize) -> Vec<u64> {
    let folder = std::env::temp_dir().join(format!("glidepath-count-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(case.to_string());
    let output = Process::new("valgrind")
        .args(["--tool=callgrind", "--combine-dumps=yes"])
        // Two patterns: a second option with the same one has no effect.
        .args([
            "--toggle-collect=*one_counted_tick*",
            "--dump-after=*counted_tick*",
        ])
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "a_tick_takes_few_instructions", "--nocapture"])
        .args(["--test-threads", "1"])
        .env(CASE, case.to_string())
        .output()
        .unwrap();
    let text = std::fs::read_to_string(&file).unwrap_or_default();
    std::fs::remove_dir_all(&folder).unwrap();
    let total = |line: &str| line.strip_prefix("totals: ")?.trim().parse().ok();
    let mut ticks: Vec<u64> = text.lines().filter_map(total).filter(|n| *n > 0).collect();
    assert!(ticks.len() >= TICKS, "{} ticks: {output:?}", ticks.len());
    ticks.sort_unstable();
    ticks
}

#[test]
fn a_tick_takes_few_instructions() {
    if let Some(case) = std::env::var(CASE)
        .ok()
        .and_then(|case| case.parse::<usize>().ok())
    {
        drive(&CASES[case]);
        return;
    }
    if cannot_count() {
        return;
    }
    let mut beyond = Vec::new();
    for (k, case) in CASES.iter().enumerate() {
        let ticks = counted(k);
        let average = ticks.iter().sum::<u64>() / ticks.len() as u64;
        let part = |part: usize| ticks[ticks.len() * part / 1_000 - 1];
        let (median, p99, p999, most) = (part(500), part(990), part(999), part(1_000));
        println!(
            "{AXES} axes, {}: {average} instructions a tick, median {median}, p99 {p99}, p99.9 {p999}, at most {most}",
            case.name
        );
        if average > case.average || most > case.most {
            beyond.push(case.name);
        }
    }
    assert!(beyond.is_empty(), "more than allowed: {beyond:?}");
}
