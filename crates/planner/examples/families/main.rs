//! The comparison of families of programs, planned with both efforts and with a stop at every
//! corner, and compared: with each other, with the least times that are known to be possible, and
//! in smoothness.
//!
//! ```text
//! cargo run --release -p glidepath-planner --example families -- bench
//! cargo run --release -p glidepath-planner --example families -- bench --period 0.001 --period 0.004
//! cargo run --release -p glidepath-planner --example families -- generate 2000 --machine mill --machine seed
//! cargo run --release -p glidepath-planner --example families -- generate 1 --family circles --seed 17 --write /tmp/drawn
//! ```
//!
//! `bench` takes the programs of a folder, `tests/data/families` if none is named, whose reference
//! optima stand in `families.json` beside them; those hold for the milling machine and 0.02 mm.
//! `generate` draws programs: the same seed always gives the same programs, whatever else is drawn.
//! It prints those with violations or slower than a rival with the command that plans each again,
//! then the families with their medians and worst.
//!
//! Motion and verdicts are the same on every run; processor times are not. They are those of the
//! planner alone, without reading and judging: as a share of the time of the motion, and the
//! longest single call, which puts in one item or makes one period. Jerk and ringing (acceleration
//! above 30 Hz) are rms values of all axes together, in mm/s³ and mm/s² (degrees for rotary axes).
//! The auditor's judgement of the figure stands beside that: violations and, of effort "optimal" and
//! "fast", *broken rules* (an axis beyond its travel, a straight move beside its line, a tremor, an event
//! lost or off its place), then what the tolerance was used for. `--walls` puts ends of travel
//! where the program itself ends on every axis.
//! The exit code is 1 if there was a violation or a broken rule, or a program was not planned.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "tables")]

mod arguments;
mod bench;
mod family;
#[path = "../judged/figure.rs"]
mod figure;
mod figures;
mod generate;
mod machine;
mod plan;
mod random;
mod statistics;
mod text;
mod trial;
#[path = "../judged/walls.rs"]
mod walls;
mod workers;

use arguments::{Arguments, Task};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::read() {
        Ok(arguments) => arguments,
        Err(usage) => {
            eprintln!("{usage}");
            return ExitCode::from(2);
        }
    };
    let done = match &arguments.task {
        Task::Bench(folder) => bench::run(folder, &arguments),
        Task::Generate(count) => generate::run(*count, &arguments),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
