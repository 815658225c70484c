//! The fault matrix: everything that can go wrong, at every kind of moment.
//!
//! Each case runs a program on a machine of real processes, lets one thing go wrong at a moment
//! that chance decides, and follows the machine to its rest. Then
//!
//! * what a subscriber got is audited: limits, deviation both ways as far as the motion went, feed;
//! * the status tells the right cause, or the program has come to its end, where it can;
//! * the planner ends with the right code;
//! * a program from where the machine stands takes it home, after a reset where one is needed;
//! * shared memory holds no more than before.
//!
//! A sample runs by default. `GLIDEPATH_FAULTS=256 cargo test -p glidepath-tests
//! whatever_goes_wrong -- --nocapture` runs so many cases, every cell of the matrix as often as
//! the others, and prints a table; `GLIDEPATH_FAULTS_SEED` chooses other moments. The seed decides
//! what is tried, and when it is meant to happen; what is under way then is up to the machine's
//! clock.

mod bench;
mod case;
mod rogue;
mod script;
mod table;
mod verdict;

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_tests::{Instance, Watchdog, plan};

use bench::Bench;
pub(crate) use case::Chance;
use case::cases;
use script::{HOME, PROGRAM, Programs, waiting};
use table::Table;

/// How many cases run unless the environment says otherwise: one of every fault.
const SAMPLE: usize = 17;

/// How often a case is tried again in which this process, which has no priority, did not get to
/// run for so long that it lost setpoints: then it cannot say what it did not hear.
const TRIES: usize = 3;

#[test]
#[allow(
    clippy::print_stderr,
    reason = "the table is for whoever runs the matrix"
)]
fn whatever_goes_wrong_the_machine_rests_on_the_path_and_recovers() {
    let count = from_environment("GLIDEPATH_FAULTS").unwrap_or(SAMPLE as u64);
    let seed = from_environment("GLIDEPATH_FAULTS_SEED").unwrap_or(1);
    let instance = Instance::alone();
    let _watchdog = Watchdog::new(Duration::from_secs(120 + 30 * count));
    let (frames, items) = plan(PROGRAM, AxisVector::zeros());
    let programs = Programs {
        frames,
        items,
        file: instance.file("program.ngc", PROGRAM),
        home: instance.file("home.ngc", HOME),
        waiting: instance.file("waiting.ngc", &waiting()),
    };
    let mut table = Table::default();
    let mut bench = Bench::start(&instance);
    for case in cases(usize::try_from(count).unwrap(), seed) {
        let mut outcome = script::run(&mut bench, &programs, case);
        for _ in 0..TRIES {
            if !outcome.as_ref().is_ok_and(|verdict| verdict.has_gap) || !bench.was_deaf() {
                break;
            }
            table.note_repetition();
            outcome = script::run(&mut bench, &programs, case);
        }
        if outcome.is_err() {
            // Nobody knows what state the machine is in.
            bench.end();
            bench = Bench::start(&instance);
        }
        table.add(&case, outcome);
    }
    bench.end();
    eprintln!("{table}");
    assert!(table.problems().is_empty(), "{:#?}", table.problems());
}

fn from_environment(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().unwrap())
}
