//! Tests of the touch probes of drives: where a contact was, to the count.
//!
//! ```text
//!  drives 0 1 2 ─── inputs 3
//!       └─ the probe is wired to each of them ─┘
//! ```

mod index;
mod inputs;
mod search;
mod telling;
mod unfit;

use crate::machine::{COUNTS, START_NS, Setup, run_on};
use glidepath_emulator::{DriveSettings as Emulated, Probe, Segment, TouchProbe as Emulates};
use glidepath_ethercat::{At, DigitalInput, Event, TerminalSettings, TouchProbe};
use glidepath_interpolator::ProbeInput;
use search::Search;

/// The terminal with the probe's input.
const INPUTS: usize = 3;
/// Where the part begins, mm.
const PART_Z: f64 = -1.870_31;

/// A search of drives that keep the place.
const TOUCH: TouchProbe = TouchProbe {
    unit: 1,
    number: 0,
    is_inverted: false,
    source: None,
};

/// Three drives and a terminal with the probe, whose input is as slow as those of real ones.
fn setup(period_ns: u64, touch: Option<TouchProbe>) -> Setup {
    let mut setup = Setup::absolute(period_ns);
    let emulated = Emulated {
        touch_probe: Some(Emulates::default()),
        ..Emulated::default()
    };
    setup.emulated = vec![emulated; 3];
    setup.emulated.push(Emulated::inputs(4));
    for drive in &mut setup.drives {
        drive.probe = touch;
    }
    setup.terminals = vec![TerminalSettings {
        position: INPUTS,
        inputs: vec![DigitalInput {
            at: At::Object {
                index: 0x6010,
                sub: 1,
            },
            number: Some(0),
            home: None,
            limit_low: None,
            limit_high: None,
            is_inverted: false,
        }],
        ..TerminalSettings::default()
    }];
    setup.probe = Some(ProbeInput {
        number: 0,
        high: true,
        protects: false,
    });
    setup
}

/// What the probe is wired to.
fn probe() -> Probe {
    Probe {
        drive: (2, 0),
        at_counts: PART_Z * COUNTS,
        is_closed_above: false,
        inputs: vec![(INPUTS, 1)],
        filter_ns: 3_000_000,
        drive_inputs: Vec::new(),
    }
}

/// Runs searches one after the other; what was found, and what happened on the bus.
fn searched(
    setup: &Setup,
    probe: Probe,
    programs: &'static [&'static str],
) -> (Search, Vec<Event>) {
    run_search(setup, probe, Search::new(programs))
}

/// The same, while the second drive sends an emergency after each motion.
fn with_emergency(
    setup: &Setup,
    probe: Probe,
    programs: &'static [&'static str],
) -> (Search, Vec<Event>) {
    let mut search = Search::new(programs);
    search.emergency = Some((1, 0x7380));
    run_search(setup, probe, search)
}

fn run_search(setup: &Setup, probe: Probe, mut search: Search) -> (Search, Vec<Event>) {
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.keep_records();
    segment.add_probe(probe);
    let outcome = run_on(setup, &mut search, segment, START_NS);
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    (search, outcome.events)
}
