//! Tests of planning on all cores: it gives what planning on one gives, step by step, to the bit.
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

use glidepath_gcode::Options;
use glidepath_geometry::AxisVector;
use glidepath_motion::parts::Cutter;
use glidepath_planner::{ItemSource, ParallelPipeline, Pipeline, ProgramSource, Statistics, Step};
use glidepath_program::{Effort, Frame, Item, Limits, Settings, Smoothing};
use proptest::prelude::*;

pub(crate) fn settings(effort: Effort) -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
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
        events,
        ..
    } = frame;
    let told = format!("{sequence} {line} {block} {flags:?} {events:?}");
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
pub(crate) fn same<S: ItemSource + Send + 'static>(
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
