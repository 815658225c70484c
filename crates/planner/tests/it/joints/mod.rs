//! Tests of machines whose joints are not their axes, and weaker than what programs ask for: whatever the program,
//! no joint does more than it can, and no plan takes longer than one that stops exactly at every corner.
//!
//! A program of each mechanism runs by default, and those that failed once; hours, for many of them, each told of:
//!
//! ```text
//! GLIDEPATH_JOINTS=100 cargo test --release -p glidepath-planner --test it joints -- --nocapture
//! ```
//!
//! `GLIDEPATH_JOINTS=40..50` are those of these numbers, `GLIDEPATH_JOINTS_SEED` chooses others, `GLIDEPATH_JOINTS_ONLY`
//! is the name of a machine, and `GLIDEPATH_JOINTS_TEXT` prints the programs that fail.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stderr,
    reason = "a test that fails may panic, and tells why"
)]

mod closed_forms;
pub(crate) mod judge;
pub(crate) mod machines;
mod programs;
pub(crate) mod tool;

use crate::support::random::Random;
use core::ops::Range;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::Kinematics as _;
use glidepath_program::{
    Corners, DirectionTolerance, Effort, Limits, Override, Settings, Smoothing,
};
use judge::{Verdict, Way, judged};
use machines::{Machine, machines};
use std::time::Instant;

/// What axes can do whose limits nobody gives, as configurations have it.
const MOST_OF_AXES: [f64; 3] = [1e5, 1e7, 1e10];
/// The programs that run by default, by their numbers: one of each machine, which take little work.
const SAMPLE: [(&str, u32); 13] = [
    ("corexy", 7),
    ("linear delta", 20),
    ("rotary delta", 19),
    ("scara", 4),
    ("scara with a tool aside", 0),
    ("five-bar", 15),
    ("hexapod", 11),
    ("6-UPU", 34),
    ("table-table", 7),
    ("table-table, offset", 0),
    ("head-head", 3),
    ("table-head", 0),
    ("table-head, skewed", 1),
];
/// Programs that failed once, by machine, seed and number: near a stretched arm and a flat rod they took from eleven to
/// two hundred times as long as they do.
const KEPT: [(&str, u64, u32); 3] = [
    ("five-bar", 1, 22),
    ("five-bar", 1, 37),
    ("linear delta", 1, 32),
];
/// With those no plan takes so long, s.
const KEPT_T: f64 = 3.0;
/// Rests end on periods: so many more than exact stops a plan may take.
const SPARE_PERIODS: f64 = 2.0;

/// The plans of a program.
struct Plans {
    optimal: Verdict,
    fast: Verdict,
    /// With an exact stop at every corner, where no override is changed.
    stops: Option<Verdict>,
    period_t: f64,
}

/// What is found of a machine.
#[derive(Default)]
struct Tally {
    programs: u32,
    faulty: u32,
    refused: u32,
    tremors: u32,
    /// Slower than stops: with effort optimal, and fast.
    slower: [u32; 2],
    worst_of_stops_r: [f64; 2],
    /// Optimal slower than fast, and by which factor at most.
    slower_than_fast: u32,
    worst_r: f64,
    optimal_t: f64,
    fast_t: f64,
    stops_t: f64,
}

fn settings(machine: &Machine, random: &mut Random) -> (Settings, &'static str) {
    let [velocity, acceleration, jerk] = random.of(&[
        MOST_OF_AXES,
        MOST_OF_AXES,
        MOST_OF_AXES,
        [250.0, 2500.0, 50_000.0],
    ]);
    let mut limits = Limits::uniform(Limits::UNLIMITED, Limits::UNLIMITED, Limits::UNLIMITED);
    for (axis, low, high) in &machine.travel {
        let k = axis.index();
        (limits.velocity[k], limits.acceleration[k], limits.jerk[k]) =
            (velocity, acceleration, jerk);
        (limits.travel.lowest[k], limits.travel.highest[k]) = (*low, *high);
    }
    let settings = Settings {
        limits,
        tolerance_mm: random.of(&[0.005, 0.02, 0.05, 0.2]),
        direction: DirectionTolerance {
            angle_deg: None,
            turn_r: machine
                .mechanism
                .direction_gain(&limits.travel.lowest, &limits.travel.highest),
        },
        smoothing: Smoothing::Auto,
        corners: random.of(&[Corners::Inner, Corners::Inner, Corners::Either]),
        period_t: random.of(&[0.001, 0.002, 0.004, 0.004, 0.008]),
        effort: Effort::Optimal,
    };
    let mode = random.of(&["G64", "G64", "G64", "G64", "G64 P0.01", "G64 P0.1", "G61"]);
    (settings, mode)
}

/// The program of a number: its text, and the plans of it.
fn planned(machine: &Machine, seed: u64, number: u32) -> (String, String, Plans) {
    let of_machine = machine.name.bytes().fold(0, |hash: u64, byte| {
        hash.wrapping_mul(31).wrapping_add(u64::from(byte))
    });
    let mut random = Random(of_machine << 40 ^ seed << 20 ^ u64::from(number));
    let (settings, mode) = settings(machine, &mut random);
    let change = (random.share() < 0.15).then(|| {
        let (feed_r, rapid_r) = random.of(&[(0.3, 0.3), (0.6, 1.0), (1.8, 1.0)]);
        (random.of(&[20, 100, 300]), Override { feed_r, rapid_r })
    });
    let text = programs::program(machine, random, mode);
    let way = |effort, smoothing| Way {
        settings: Settings {
            effort,
            smoothing,
            ..settings
        },
        change,
    };
    let began = Instant::now();
    let optimal = judged(machine, &text, &way(Effort::Optimal, Smoothing::Auto));
    let thought_t = began.elapsed().as_secs_f64();
    let fast = judged(machine, &text, &way(Effort::Fast, Smoothing::Auto));
    let stopping = way(Effort::Fast, Smoothing::ExactStop);
    let stops = change.is_none().then(|| judged(machine, &text, &stopping));
    let what = format!(
        "{}, {number} of seed {seed}, {} ms, {} mm, {mode}, {:?}, axes {}, override {}; thought {thought_t:.1} s",
        machine.name,
        settings.period_t * 1e3,
        settings.tolerance_mm,
        settings.corners,
        settings.limits.velocity[machine.travel[0].0.index()],
        change.is_some(),
    );
    let plans = Plans {
        optimal,
        fast,
        stops,
        period_t: settings.period_t,
    };
    (what, text, plans)
}

impl Tally {
    /// Counts the plans of a program; tells what is wrong with them, and what is to be noted.
    fn take(&mut self, plans: &Plans) -> [Vec<String>; 2] {
        self.programs += 1;
        let (mut wrong, mut noted) = (Vec::new(), Vec::new());
        let all = [
            ("optimal", Some(&plans.optimal)),
            ("fast", Some(&plans.fast)),
            ("stops", plans.stops.as_ref()),
        ];
        let (mut is_faulty, mut is_refused) = (false, false);
        for (effort, verdict) in all {
            let Some(verdict) = verdict else { continue };
            for fault in verdict.faults.iter().take(3) {
                wrong.push(format!("{effort}: {fault}"));
            }
            if let Some(refusal) = &verdict.refusal {
                wrong.push(format!("{effort}: refused: {refusal}"));
            }
            is_faulty |= !verdict.faults.is_empty();
            is_refused |= verdict.refusal.is_some();
        }
        self.faulty += u32::from(is_faulty);
        self.refused += u32::from(is_refused);
        if let Some(tremor) = plans.optimal.tremors.first() {
            self.tremors += 1;
            noted.push(format!("optimal: {tremor}"));
        }
        if !is_refused {
            self.compare(plans, (&mut wrong, &mut noted));
        }
        [wrong, noted]
    }

    /// Compares the times of plans, where that is fair.
    fn compare(&mut self, plans: &Plans, (wrong, noted): (&mut Vec<String>, &mut Vec<String>)) {
        let Some(stops) = &plans.stops else { return };
        let times = [plans.optimal.cycle_t, plans.fast.cycle_t];
        let ([optimal_t, fast_t], stops_t) = (times, stops.cycle_t);
        self.optimal_t += optimal_t;
        self.fast_t += fast_t;
        self.stops_t += stops_t;
        let is_slower = |one: f64, other: f64| one > other + (SPARE_PERIODS + 0.5) * plans.period_t;
        for (k, effort) in ["optimal", "fast"].into_iter().enumerate() {
            if is_slower(times[k], stops_t) {
                self.slower[k] += 1;
                self.worst_of_stops_r[k] = self.worst_of_stops_r[k].max(times[k] / stops_t);
                let told = format!("{effort} takes {:.3} s, stops {stops_t:.3} s", times[k]);
                // What is fast has a setpoint at each stop between blocks, and is not compared with stops where blocks
                // are many.
                let kind = if k == 0 { &mut *wrong } else { &mut *noted };
                kind.push(told);
            }
        }
        if is_slower(optimal_t, fast_t) {
            self.slower_than_fast += 1;
            self.worst_r = self.worst_r.max(optimal_t / fast_t);
            noted.push(format!(
                "optimal takes {optimal_t:.3} s, fast {fast_t:.3} s"
            ));
        }
    }

    fn tell(&self, name: &str) {
        let Self {
            programs,
            faulty,
            refused,
            tremors,
            slower,
            worst_of_stops_r,
            slower_than_fast,
            worst_r,
            optimal_t,
            fast_t,
            stops_t,
        } = self;
        eprintln!(
            "{name:26} {programs} programs, {faulty} faulty, {refused} refused, {tremors} with tremors; slower than stops \
             {slower:?} ({worst_of_stops_r:.3?}), than fast {slower_than_fast} ({worst_r:.3}); {optimal_t:.2} s, fast \
             {fast_t:.2} s, stops {stops_t:.2} s"
        );
    }
}

/// Numbers from "100" (the first so many) or "40..50".
fn numbers() -> Option<Range<u32>> {
    let text = std::env::var("GLIDEPATH_JOINTS").ok()?;
    let (first, end) = text.split_once("..").unwrap_or(("0", &text));
    Some(first.parse().unwrap()..end.parse().unwrap())
}

/// Plans the program of a number, and tells what came of it; whether it is as it has to be.
fn is_well(
    (machine, seed, number): (&Machine, u64, u32),
    tally: &mut Tally,
    is_long: bool,
) -> bool {
    let (what, text, plans) = planned(machine, seed, number);
    let [wrong, noted] = tally.take(&plans);
    if wrong.is_empty() && noted.is_empty() {
        if is_long {
            eprintln!("{what}, {:.3} s", plans.optimal.cycle_t);
        }
        return true;
    }
    let verdict = if wrong.is_empty() { "NOTED" } else { "FAILS" };
    let told = [wrong.join("\n  "), noted.join("\n  ")];
    eprintln!("{verdict} {what}:\n  {}", told.join("\n  "));
    if std::env::var_os("GLIDEPATH_JOINTS_TEXT").is_some() {
        let [optimal, fast] = [&plans.optimal, &plans.fast].map(|of| &of.frames_of_line);
        eprintln!("{text}frames of lines, optimal {optimal:?}, fast {fast:?}");
    }
    wrong.is_empty()
}

#[test]
fn joints_keep_their_limits_whatever_the_program() {
    let seed = std::env::var("GLIDEPATH_JOINTS_SEED").map_or(1, |text| text.parse().unwrap());
    let only = std::env::var("GLIDEPATH_JOINTS_ONLY").ok();
    let chosen = numbers();
    let is_long = chosen.is_some();
    let mut failing = Vec::new();
    let is_chosen = |machine: &Machine| only.as_ref().is_none_or(|name| name == machine.name);
    for machine in machines().iter().filter(|machine| is_chosen(machine)) {
        let mut tally = Tally::default();
        let sample = SAMPLE.iter().find(|(name, _)| *name == machine.name);
        let (_, sampled) = sample.expect("a program of each machine");
        for number in chosen.clone().unwrap_or(*sampled..sampled + 1) {
            if !is_well((machine, seed, number), &mut tally, is_long) {
                failing.push((machine.name, seed, number));
            }
        }
        tally.tell(machine.name);
    }
    assert!(failing.is_empty(), "{failing:?}");
}

#[test]
fn where_arms_are_stretched_only_the_way_near_there_is_slow() {
    let machines = machines();
    for (name, seed, number) in KEPT {
        let machine = machines
            .iter()
            .find(|machine| machine.name == name)
            .unwrap();
        let mut tally = Tally::default();
        assert!(
            is_well((machine, seed, number), &mut tally, false),
            "{name}, {number}"
        );
        let longest_t = tally.optimal_t.max(tally.fast_t);
        assert!(longest_t < KEPT_T, "{name}, {number}: {longest_t} s");
    }
}

/// A line of 170 mm that ends a tenth of a millimetre before both arms are stretched: most of it is as fast as
/// anywhere.
#[test]
fn a_line_to_stretched_arms_takes_no_minute() {
    let machines = machines();
    let machine = machines
        .iter()
        .find(|machine| machine.name == "five-bar")
        .unwrap();
    let (mut settings, _) = settings(machine, &mut Random(1));
    (settings.period_t, settings.tolerance_mm) = (0.004, 0.02);
    for axis in 0..3 {
        settings.limits.velocity[axis] = MOST_OF_AXES[0];
        settings.limits.acceleration[axis] = MOST_OF_AXES[1];
        settings.limits.jerk[axis] = MOST_OF_AXES[2];
    }
    let text = "G21 G90 G64\nG1 Y591.5 F60000\nM2\n";
    for effort in [Effort::Optimal, Effort::Fast] {
        let settings = Settings { effort, ..settings };
        let way = Way {
            settings,
            change: None,
        };
        let verdict = judged(machine, text, &way);
        assert!(verdict.faults.is_empty(), "{:?}", verdict.faults);
        assert!(verdict.cycle_t < 3.0, "{effort:?}: {} s", verdict.cycle_t);
    }
}

/// The closed forms that judge joints are those of the mechanisms, told anew.
#[test]
fn closed_forms_are_where_joints_are() {
    for machine in machines() {
        let mut random = Random(7);
        let mut seen = 0;
        for _ in 0..400 {
            let mut place = AxisVector::zeros();
            for (axis, low, high) in &machine.travel {
                place[axis.index()] = random.between(*low, *high);
            }
            if !machine.may_stand(&place) {
                continue;
            }
            seen += 1;
            let theirs = machine.mechanism.inverse(&place).unwrap();
            let ours = closed_forms::joints(&machine.mechanism, &place);
            assert_eq!(ours.len(), machine.joints.len(), "{}", machine.name);
            for (ours, theirs) in ours.iter().zip(theirs.iter()) {
                assert!(
                    (ours - theirs).abs() < 1e-9,
                    "{}: {ours} {theirs} at {place}",
                    machine.name
                );
            }
        }
        assert!(seen > 40, "{}: {seen}", machine.name);
    }
}
