//! Tests of refused blocks: behind one everything is as in a program that never had it.
//!
//! Each table has what may be in force or open in front of a block, and blocks of every kind, nearly all of
//! which are wrong in front of some of it. Every block is tried behind all of it. Where it is refused, all that
//! the program has is compared with the same program without the block, there and behind a series of others.

mod fanuc;
mod linuxcnc;
mod printers;
mod siemens;

use std::collections::BTreeSet;
use std::sync::Arc;

use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{FiveAxis, Rotaries, Tilt};
use glidepath_program::{Item, Limits};
use nalgebra::Vector3;

use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::setup::machine::{AxisTravel, Machine};
use crate::setup::options::{Connections, Options};
use crate::setup::threading::Threading;
use crate::setup::tool_table::{Tool, ToolTable};
use crate::syntax::dialect::Dialect;

/// More lines than any of the programs has.
const MOST_LINES: u32 = 2_000;
/// A travel that `X9999` is beyond, mm or degrees.
const TRAVEL: f64 = 500.0;

/// What is tried on one machine.
struct Table {
    options: fn() -> Options,
    /// What is in force or open in front of the block, one of these at a time.
    before: &'static [&'static str],
    /// Words that mean something, each alone and with what is wrong behind it; ` | ` between them.
    words: &'static str,
    /// What makes a block wrong that has other words, too: the motion first, then what is found earlier.
    wrong: &'static str,
    /// Blocks that are wrong by themselves, or behind some of `before`.
    blocks: &'static str,
    /// The blocks behind it.
    behind: &'static str,
}

/// What a program came to.
struct Played {
    /// All that it has behind the line in question.
    there: String,
    /// All that it has at the end.
    at_end: String,
    items: Vec<Item>,
    /// Lines with what is wrong in them.
    found: Vec<(u32, String)>,
    has_ended: bool,
}

/// All of a program that a block may change, and nothing of where its text is read.
fn all_of(program: &Program<&[u8]>) -> String {
    let Program {
        interpreter,
        parameters,
        flow,
        tape,
        finishing,
        modal_macro,
        siemens,
        awaited,
        lathe_cycle,
        sequence,
        // Where and how its text is read, and what was counted.
        source: _,
        origin: _,
        block: _,
        straight: _,
        was_straight: _,
        items: _,
        given: _,
        totals: _,
        idle_lines: _,
        kept_lines: _,
        percent: _,
        begun: _,
        ended: _,
        ran_out: _,
        is_typed: _,
        keeps_remarks: _,
        remarks: _,
    } = program;
    let Interpreter {
        state,
        spline_log,
        // Why these are none of the state stands there.
        options: _,
        lacking: _,
        soft_limits: _,
        thread_goes_on: _,
        zero_length: _,
        only_judges: _,
        has_judged: _,
        judged_time_s: _,
        plain_run: _,
        mapped_items: _,
        doubts: _,
        line: _,
        pole_turns: _,
    } = interpreter;
    let open = state.open.spline;
    let curve = open.map(|open| {
        let (points, weights) = (spline_log.points(&open), spline_log.weights(&open));
        (points, weights, spline_log.knots(&open))
    });
    format!(
        "{state:?} {curve:?} {parameters:?} {flow:?} {finishing:?} {modal_macro:?} {siemens:?} {awaited:?} \
         {lathe_cycle:?} {sequence:?} {:?} {:?} {:?}",
        tape.place(),
        tape.calls,
        tape.repetitions,
    )
}

/// Executes a program of lines that are typed; `line` is the one in question.
fn play(options: Options, text: &str, line: u32) -> Played {
    let mut program = Program::new(text.as_bytes(), options).typed();
    let mut played = Played {
        there: String::new(),
        at_end: String::new(),
        items: Vec::new(),
        found: Vec::new(),
        has_ended: false,
    };
    for _ in 0..MOST_LINES {
        let Some(result) = program.next_line() else {
            break;
        };
        played.items.extend_from_slice(program.items());
        let here = program.here().number;
        if let Err(diagnostic) = result {
            let what = format!("{} {}", diagnostic.code, diagnostic.message);
            played.found.push((here, what));
        }
        if here == line {
            played.there = all_of(&program);
            played.has_ended = program.has_ended();
        }
    }
    played.at_end = all_of(&program);
    played
}

/// The first parts that are not the same.
fn difference(with: &str, without: &str) -> String {
    let pairs = with.split(", ").zip(without.split(", "));
    let unlike = pairs.filter(|(with, without)| with != without).take(4);
    unlike
        .map(|(with, without)| format!("\n      {with} / {without}"))
        .collect()
}

/// What was different from the program without the block; `None`: nothing.
fn left_behind(with: &Played, without: &Played) -> Option<String> {
    // Behind an end nothing follows.
    if with.has_ended {
        None
    } else if with.there != without.there {
        Some(difference(&with.there, &without.there))
    } else if with.found != without.found {
        let found = (&with.found, &without.found);
        Some(format!("findings {found:?}"))
    } else if with.items != without.items {
        Some("other items".to_owned())
    } else if with.at_end != without.at_end {
        Some(difference(&with.at_end, &without.at_end))
    } else {
        None
    }
}

fn parts(text: &'static str) -> impl Iterator<Item = &'static str> {
    text.split(" | ").filter(|part| !part.is_empty())
}

/// All blocks of a table.
fn blocks_of(table: &Table) -> impl Iterator<Item = String> {
    let combined = parts(table.words).flat_map(|words| {
        let wrong = parts(table.wrong).map(move |wrong| format!("{words} {wrong}"));
        core::iter::once(words.to_owned()).chain(wrong)
    });
    combined.chain(parts(table.blocks).map(str::to_owned))
}

/// Tries all of a table.
fn try_all(table: &Table) {
    let (mut left, mut count) = (Vec::new(), 0);
    let mut refused = BTreeSet::new();
    for before in table.before {
        let found = play((table.options)(), &format!("{before}\n"), 0).found;
        assert_eq!(found, [], "{before}");
        let line = u32::try_from(before.lines().count()).unwrap_or_default() + 1;
        let played = |block: &str| {
            let text = format!("{before}\n{block}\n{}\n", table.behind);
            play((table.options)(), &text, line)
        };
        let without = played("");
        for block in blocks_of(table) {
            let mut with = played(&block);
            let Some(at) = with.found.iter().position(|(found, _)| *found == line) else {
                continue;
            };
            let (_, why) = with.found.remove(at);
            if let Some(what) = left_behind(&with, &without) {
                left.push(format!("{before:?} {block:?} ({why}): {what}"));
            }
            count += 1;
            refused.insert(block);
        }
    }
    assert!(
        left.is_empty(),
        "{} of {count}:\n{}",
        left.len(),
        left.join("\n")
    );
    let fine: Vec<&str> = parts(table.blocks)
        .filter(|block| !refused.contains(*block))
        .collect();
    assert_eq!(fine, [""; 0], "refused nowhere");
}

/// Tools 1 to 3, which differ in everything.
fn tools() -> Option<Arc<ToolTable>> {
    let mut tools = ToolTable::new();
    for number in 1..=3_u8 {
        let size = f64::from(number);
        let mut tool = Tool {
            diameter_mm: 2.0 * size,
            ..Tool::default()
        };
        tool.offset[2] = 10.0 * size;
        tools.set(number.into(), tool);
    }
    Some(Arc::new(tools))
}

/// A machine with these axes, on which everything is there.
fn machine(dialect: Dialect, axes: &[Axis]) -> Options {
    let travel = AxisTravel {
        min: -TRAVEL,
        max: TRAVEL,
    };
    let machine = axes.iter().fold(Machine::new(axes), |machine, axis| {
        machine.with_travel(*axis, travel)
    });
    Options {
        dialect,
        machine,
        tools: tools(),
        connections: Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        orients: true,
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        start: AxisVector::zeros(),
        ..Options::default()
    }
}

fn mill(dialect: Dialect) -> Options {
    machine(dialect, &[Axis::X, Axis::Y, Axis::Z])
}

fn lathe(dialect: Dialect) -> Options {
    machine(dialect, &[Axis::X, Axis::Z])
}

/// A table that tilts about X and turns about Z.
fn five_axes(dialect: Dialect) -> Options {
    Options {
        five_axis: Some(FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::zeros(),
                rotary_point: Vector3::zeros(),
            },
            tilt: Tilt::A,
            tilt_reversed: false,
            rotary_reversed: false,
            tool_mm: 50.0,
        }),
        ..machine(dialect, &[Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C])
    }
}
