//! Planning on all cores gives what planning on one gives, step by step, to the bit.
//!
//! `GLIDEPATH_PARALLEL` is the number of random programs; a few without.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::mpsc::{Sender, channel};
use std::time::Duration;

use glidepath_gcode::Options;
use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::PlanError;
use glidepath_motion::parts::Cutter;
use glidepath_planner::{
    ItemSource, ParallelPipeline, Pipeline, ProgramSource, Refusal, Statistics, Step, Supply,
};
use glidepath_program::{
    Effort, Frame, Item, ItemKind, Limits, PathMode, Rate, Settings, Smoothing,
};
use proptest::prelude::*;

fn settings(effort: Effort) -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        smoothing: Smoothing::Auto,
        period_t: 0.004,
        effort,
    }
}

/// A step, by the bits of its numbers.
#[derive(Debug, PartialEq)]
enum Seen {
    Item(Box<Item>),
    Frame(String, Vec<u64>),
}

fn seen(frame: &Frame) -> Seen {
    let vectors = [&frame.position, &frame.velocity, &frame.acceleration];
    let numbers = [frame.planned_override, frame.path_v, frame.path_s];
    let bits = vectors
        .iter()
        .flat_map(|vector| vector.iter().copied())
        .chain(numbers)
        .map(f64::to_bits);
    let Frame {
        sequence,
        line,
        block,
        flags,
        event,
        ..
    } = frame;
    let told = format!("{sequence} {line} {block} {flags:?} {event:?}");
    Seen::Frame(told, bits.collect())
}

/// All that came of a program.
#[derive(Debug)]
struct Plan {
    steps: Vec<Seen>,
    refusal: Option<String>,
    statistics: Statistics,
}

macro_rules! run {
    ($pipeline:expr) => {{
        let mut pipeline = $pipeline;
        let mut steps = Vec::new();
        let refusal = loop {
            match pipeline.step() {
                Ok(Step::Item) => steps.push(Seen::Item(Box::new(*pipeline.item()))),
                Ok(Step::Frame) => steps.push(seen(pipeline.frame())),
                Ok(Step::Pending) => {}
                Ok(Step::End) => break None,
                Err(refusal) => break Some(refusal.to_string()),
            }
        };
        assert!(matches!(pipeline.step(), Ok(Step::End)), "told once");
        Plan {
            steps,
            refusal,
            statistics: pipeline.statistics(),
        }
    }};
}

/// The parts a plan was cut into.
fn parts(plan: &Plan, settings: &Settings) -> usize {
    let (mut cutter, mut placed) = (Cutter::new(settings, AxisVector::zeros()), Vec::new());
    for step in &plan.steps {
        if let Seen::Item(item) = step {
            cutter.take(**item, &mut placed).expect("planned before");
        }
    }
    cutter.finish(&mut placed);
    1 + placed.iter().filter(|item| item.begins.is_some()).count()
}

/// Plans a program on one core and on some, and compares; returns how many parts it has.
fn same<S: ItemSource + Send + 'static>(
    name: &str,
    make: impl Fn() -> S,
    effort: Effort,
    threads: &[usize],
) -> usize {
    let (settings, start) = (settings(effort), AxisVector::zeros());
    let alone = run!(Pipeline::new(make(), settings, start));
    for threads in threads {
        let workers = NonZeroUsize::new(*threads).expect("some");
        let cores = ParallelPipeline::start(make(), settings, start, None, workers);
        let cores = run!(cores.expect("threads"));
        for (i, (alone, cores)) in alone.steps.iter().zip(&cores.steps).enumerate() {
            assert_eq!(
                alone, cores,
                "{name}, {effort:?}, {threads} threads: step {i}"
            );
        }
        assert_eq!(alone.steps.len(), cores.steps.len(), "{name}, {effort:?}");
        assert_eq!(alone.refusal, cores.refusal, "{name}, {effort:?}");
        assert_eq!(alone.statistics, cores.statistics, "{name}, {effort:?}");
    }
    parts(&alone, &settings)
}

fn source(text: &str) -> ProgramSource<std::io::Cursor<Vec<u8>>> {
    let options = Options {
        default_feed_mm_min: Some(3000.0),
        ..Options::default()
    };
    ProgramSource::new(std::io::Cursor::new(text.as_bytes().to_vec()), options)
}

/// Lines that rest, or nearly, or change what a rest is.
const RESTS: [&str; 10] = [
    "M8",
    "G4 P0.02",
    "M5\nG4 P0\nS2000 T2",
    "M0",
    "S1000",
    "G61.1",
    "G64 P0.02",
    "M9\nM1\nT7",
    "G61",
    "G64 P0.02\nM8",
];

/// A program with such a line after every so many.
fn with_rests(text: &str, every: usize) -> String {
    let mut rested = String::new();
    for (i, line) in text.lines().enumerate() {
        let _ = writeln!(rested, "{line}");
        if i > 3 && i % every == 0 && !line.contains("M2") && !line.contains('%') {
            let _ = writeln!(rested, "{}", RESTS[i / every % RESTS.len()]);
        }
    }
    rested
}

fn data(folder: &str, name: &str) -> (String, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data");
    let path = root.join(folder).join(format!("{name}.ngc"));
    let text = std::fs::read_to_string(&path).expect("a program");
    (name.to_owned(), text)
}

#[test]
fn programs_of_the_bench_are_planned_alike_on_one_core_and_on_several() {
    for name in ["butterfly_g1_mill", "circle_g1_0.1_seed", "zigzag_mill"] {
        let (name, text) = data("bench", name);
        for every in [usize::MAX, 23] {
            let text = with_rests(&text, every);
            let parts = same(&name, || source(&text), Effort::Fast, &[1, 2, 4]);
            assert!(
                (parts > 1) == (every < text.lines().count()),
                "{name}: {parts}"
            );
        }
    }
    for (name, every) in [("seed5_mill", 2), ("zigzag_mill", 9), ("star_mill", 3)] {
        let (name, text) = data("bench", name);
        let text = with_rests(&text, every);
        let parts = same(&name, || source(&text), Effort::Optimal, &[2]);
        assert!(parts > 1 || name != "zigzag_mill", "{parts}");
    }
}

#[test]
fn families_are_planned_alike_on_one_core_and_on_several() {
    for name in [
        "helix_r3",
        "sawarc_r2",
        "noisy_r5",
        "letters_ab3",
        "teeth_z20",
    ] {
        let (name, text) = data("families", name);
        let rested = with_rests(&text, 19);
        let parts = same(&name, || source(&rested), Effort::Fast, &[1, 2, 4]);
        assert!(
            parts > 1 || name.contains("aw") || name.contains("teeth"),
            "{name}: {parts}"
        );
    }
    for name in ["letters_ab3", "noisy_r5", "sawarc_r2"] {
        let (name, text) = data("families", name);
        let text = with_rests(&text, 19);
        same(&name, || source(&text), Effort::Optimal, &[1, 4]);
    }
}

/// A block of a random program.
#[derive(Debug, Clone, Copy)]
struct Block {
    kind: u8,
    /// In steps of half a millimetre.
    to: (i8, i8),
    rest: usize,
}

fn blocks(most: usize) -> impl Strategy<Value = Vec<Block>> {
    let block = (0_u8..40, (-12_i8..12, -12_i8..12), 0..RESTS.len());
    let block = block.prop_map(|(kind, to, rest)| Block { kind, to, rest });
    prop::collection::vec(block, 1..most)
}

/// `has_others`: curves, too, and moves of other axes than X, Y, Z.
fn program(blocks: &[Block], has_others: bool) -> String {
    let mut text = "G21 G90 G17 G64 P0.02 F2400\n".to_owned();
    let mut at = (0.0, 0.0);
    for (i, block) in blocks.iter().enumerate() {
        let to = (0.5 * f64::from(block.to.0), 0.5 * f64::from(block.to.1));
        let moved = (to.0 - at.0, to.1 - at.1);
        let (x, y) = to;
        let _ = match block.kind {
            0..=9 => writeln!(text, "{}", RESTS[block.rest]),
            10..=13 => writeln!(text, "G0 X{x} Y{y}"),
            // Below the resolution of programs, and none at all.
            14 => writeln!(text, "G1 X{:.9} Y{:.9}", at.0 + 4e-8, at.1),
            15 => writeln!(text, "G1 X{:.9} Y{:.9}", at.0, at.1),
            16..=19 if moved != (0.0, 0.0) => {
                let centre = (0.5 * moved.0, 0.5 * moved.1);
                writeln!(text, "G2 X{x} Y{y} I{} J{}", centre.0, centre.1)
            }
            20 if has_others => writeln!(text, "G1 X{x} Y{y} A{}", i % 7),
            21 if has_others => writeln!(text, "G5 X{x} Y{y} I0.5 J0.5 P-0.5 Q0.5"),
            22 => writeln!(text, "G1 X{x} Y{y} Z{}", 0.25 * f64::from(block.to.0)),
            23 => writeln!(text, "F{}", 600 + 300 * block.rest),
            _ => writeln!(text, "G1 X{x} Y{y}"),
        };
        if !matches!(block.kind, 0..=9 | 14 | 15 | 23) {
            at = to;
        }
    }
    text + "M2\n"
}

fn cases(few: u32) -> ProptestConfig {
    let wanted = std::env::var("GLIDEPATH_PARALLEL").ok();
    let cases = wanted.map_or(few, |text| text.parse().expect("a number"));
    ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(cases)
    }
}

fn threads() -> impl Strategy<Value = usize> {
    prop::sample::select(vec![1, 2, 4])
}

proptest! {
    #![proptest_config(cases(30))]

    #[test]
    fn random_programs_are_planned_alike_along_the_path(
        blocks in blocks(150),
        has_others in any::<bool>(),
        threads in threads(),
    ) {
        let text = program(&blocks, has_others);
        same(&text, || source(&text), Effort::Fast, &[threads]);
    }
}

proptest! {
    #![proptest_config(cases(6))]

    #[test]
    fn random_programs_are_planned_alike_in_the_tube(
        blocks in blocks(70),
        has_others in any::<bool>(),
        threads in threads(),
    ) {
        let text = program(&blocks, has_others);
        same(&text, || source(&text), Effort::Optimal, &[threads]);
    }
}

/// Items, and how they end.
struct Listed(std::vec::IntoIter<Item>, Option<Refusal>);

impl ItemSource for Listed {
    fn next_item(&mut self) -> Supply {
        match (self.0.next(), self.1.take()) {
            (Some(item), refusal) => {
                self.1 = refusal;
                Supply::Item(item)
            }
            (None, Some(refusal)) => Supply::Refused(refusal),
            (None, None) => Supply::End,
        }
    }

    fn lines_read(&self) -> u64 {
        0
    }
}

/// Moves of half a millimetre, a dwell after every tenth.
fn listed(count: u32) -> Vec<Item> {
    let at = |number: u32| {
        let mut at = AxisVector::zeros();
        at[0] = 0.5 * f64::from(number);
        at
    };
    let mut items = Vec::new();
    for number in 0..count {
        let kind = ItemKind::Move {
            segment: Segment::line(at(number), at(number + 1)),
            rate: Rate::Feed(50.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        let item = |kind| Item {
            block: 0,
            line: number + 1,
            kind,
        };
        items.push(item(kind));
        if number % 10 == 9 {
            items.push(item(ItemKind::Dwell(0.01)));
        }
    }
    items
}

#[test]
fn what_ends_a_program_early_is_told_after_its_motion() {
    for effort in [Effort::Fast, Effort::Optimal] {
        // A move that does not begin where the last one ended, right after a rest and elsewhere.
        for wrong in [20, 22, 44, 45, 58] {
            let mut items = listed(60);
            items.remove(wrong);
            let make = || Listed(items.clone().into_iter(), None);
            let parts = same("a gap", make, effort, &[1, 3]);
            assert!(parts > 1 || wrong < 44, "{wrong}: {parts}");
        }
        for count in [0, 10, 37] {
            let refusal = || Some(Refusal::Plan(PlanError::NotFinite { line: 7 }));
            let make = || Listed(listed(count).into_iter(), refusal());
            same("a source that fails", make, effort, &[1, 3]);
        }
    }
}

#[test]
fn a_plan_that_nobody_takes_ends_its_threads() {
    let make = || Listed(listed(20_000).into_iter(), None);
    for taken in [0, 1, 5000] {
        let workers = NonZeroUsize::new(2).expect("two");
        let (settings, start) = (settings(Effort::Fast), AxisVector::zeros());
        let mut cores =
            ParallelPipeline::start(make(), settings, start, None, workers).expect("threads");
        for _ in 0..taken {
            cores.step().expect("a step");
        }
        // Returns when they have ended.
        drop(cores);
    }
}

/// Items, and where it is told that all of them were read.
struct Told(Listed, Sender<()>);

impl ItemSource for Told {
    fn next_item(&mut self) -> Supply {
        let supply = self.0.next_item();
        if matches!(supply, Supply::End) {
            self.1.send(()).expect("somebody waits");
        }
        supply
    }

    fn lines_read(&self) -> u64 {
        self.0.lines_read()
    }
}

/// Otherwise a second thread would have nothing to do until the first part is nearly planned.
#[test]
fn a_part_is_read_to_its_end_however_far_its_plan_is() {
    // 33 minutes of motion without a rest: more frames than wait for their taker.
    let mut items = listed(2000);
    items.retain(|item| matches!(item.kind, ItemKind::Move { .. }));
    for item in &mut items {
        if let ItemKind::Move { rate, .. } = &mut item.kind {
            *rate = Rate::Feed(0.5);
        }
    }
    let (sender, read) = channel();
    let source = Told(Listed(items.into_iter(), None), sender);
    let workers = NonZeroUsize::new(2).expect("two");
    let (settings, start) = (settings(Effort::Optimal), AxisVector::zeros());
    let cores = ParallelPipeline::start(source, settings, start, None, workers).expect("threads");
    read.recv_timeout(Duration::from_secs(60))
        .expect("all of it is read while nothing is taken");
    drop(cores);
}
