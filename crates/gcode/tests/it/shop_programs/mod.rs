//! Programs as shops have them: written by the habits of posts and of people, for many controls, each
//! with what has to come of it.
//!
//! They are in `tests/data/gcode/shop`, several to a file. A line `=== NAME DIALECT MACHINE` begins one. A
//! line that begins with `>>` belongs to the line of the program before it, and is no part of it; what
//! it can say is in [`expected`]. The values are those of the drawing, computed by hand.

mod expected;
mod machines;

use std::collections::BTreeMap;
use std::fmt::Write;

use glidepath_gcode::{Dialect, Options, Program, check};
use glidepath_geometry::AxisVector;
use glidepath_program::{Item, ItemKind};

use expected::{Claim, Expected, Frame, ShopProgram};

/// Place: how far from the written one a place may be, mm or degrees. They are written to a micrometre
/// and less.
const NEAR: f64 = 2e-6;

/// Moves that are shown of a line whose claim is not met.
const SHOWN: usize = 8;

const FILES: [(&str, &str); 10] = [
    (
        "fanuc-mill",
        include_str!("../../../../../tests/data/gcode/shop/fanuc-mill.txt"),
    ),
    (
        "haas-mill",
        include_str!("../../../../../tests/data/gcode/shop/haas-mill.txt"),
    ),
    (
        "fanuc-lathe",
        include_str!("../../../../../tests/data/gcode/shop/fanuc-lathe.txt"),
    ),
    (
        "haas-lathe",
        include_str!("../../../../../tests/data/gcode/shop/haas-lathe.txt"),
    ),
    (
        "siemens-mill",
        include_str!("../../../../../tests/data/gcode/shop/siemens-mill.txt"),
    ),
    (
        "siemens-lathe",
        include_str!("../../../../../tests/data/gcode/shop/siemens-lathe.txt"),
    ),
    (
        "five-axis",
        include_str!("../../../../../tests/data/gcode/shop/five-axis.txt"),
    ),
    (
        "linuxcnc",
        include_str!("../../../../../tests/data/gcode/shop/linuxcnc.txt"),
    ),
    (
        "printers",
        include_str!("../../../../../tests/data/gcode/shop/printers.txt"),
    ),
    (
        "other",
        include_str!("../../../../../tests/data/gcode/shop/other.txt"),
    ),
];

/// What a program does, as far as it is judged here: its moves and dwells, by line.
fn items(program: &ShopProgram, options: &Options) -> Vec<Item> {
    Program::new(program.text.as_bytes(), options.clone())
        .map_while(Result::ok)
        .filter(|item| !matches!(item.kind, ItemKind::Event(_)))
        .collect()
}

/// The place a claim names, in coordinates of the machine's axes, where it names one.
fn place(frame: &Frame, end: &AxisVector, claim: &Claim) -> bool {
    let found = match frame {
        Frame::Axes { .. } => *end,
        Frame::Joints { .. } => machines::joints(end),
    };
    let shift = frame.shift(end);
    claim
        .words
        .iter()
        .all(|(axis, value)| (found[*axis] - value - shift[*axis]).abs() < NEAR)
}

/// True if an item is what a claim says.
fn is_met(claim: &Claim, item: &Item) -> bool {
    match (&item.kind, claim.dwell_s) {
        (ItemKind::Dwell(seconds), Some(right)) => (seconds - right).abs() < 1e-9,
        (ItemKind::Move { segment, rate, .. }, None) => {
            let is_rate = match claim.feed {
                None => true,
                Some(None) => rate.is_rapid(),
                Some(Some(feed)) => rate
                    .feed_v()
                    .is_some_and(|feed_v| (feed_v * 60.0 - feed).abs() < 1e-6 * feed),
            };
            let at = if claim.is_middle {
                segment.jet(segment.length() / 2.0).position
            } else {
                segment.end()
            };
            is_rate && place(&claim.frame, &at, claim)
        }
        _ => false,
    }
}

/// What is not as it has to be in a program; empty: nothing.
fn faults(program: &ShopProgram) -> String {
    let mut faults = String::new();
    let (machine, dialect) = (&program.machine, program.dialect.as_str());
    let mut options = machines::options(machine, dialect);
    let told = Dialect::detect(program.text.as_bytes(), &options.machine);
    if dialect == "auto" {
        (options.dialect, options.question) = (told.dialect, told.question);
    } else if told.dialect != options.dialect && told.dialect != Dialect::LinuxCnc {
        let _ = writeln!(faults, "  is taken for {}", told.dialect);
    }
    let report = check(program.text.as_bytes(), options.clone());
    let refused = program
        .expected
        .iter()
        .find_map(|(line, expected)| match expected {
            Expected::Refused(text) => Some((*line, text)),
            _ => None,
        });
    match (refused, report.diagnostics.first()) {
        (None, Some(first)) => {
            let _ = writeln!(faults, "  refused: {first}");
        }
        (Some((line, _)), None) => {
            let _ = writeln!(faults, "  {line}: read, to be refused");
        }
        (Some((line, text)), Some(first)) => {
            let is_told = text == "*" || first.to_string().contains(text.as_str());
            if first.line != line || !is_told {
                let _ = writeln!(
                    faults,
                    "  {line}: to be refused for {text}, and not: {first}"
                );
            }
        }
        (None, None) => {}
    }
    let made = items(program, &options);
    let mut at = BTreeMap::new();
    for (line, expected) in &program.expected {
        let of_line: Vec<&Item> = made.iter().filter(|item| item.line == *line).collect();
        match expected {
            Expected::Refused(_) => {}
            Expected::Nothing => {
                if !of_line.is_empty() {
                    let _ = writeln!(faults, "  {line}: moves");
                }
            }
            Expected::Claim(claim) => {
                let from = at.entry(*line).or_insert(0_usize);
                let found = of_line
                    .iter()
                    .skip(*from)
                    .position(|item| is_met(claim, item));
                match found {
                    // The middle of a move, and then its end.
                    Some(index) => *from += index + usize::from(!claim.is_middle),
                    None => {
                        let _ = writeln!(faults, "  {line}: never {}", claim.text);
                        for item in of_line.iter().skip(*from).take(SHOWN) {
                            let _ = writeln!(faults, "      {}", told_item(item, &claim.frame));
                        }
                    }
                }
            }
        }
    }
    faults
}

/// An item as claims are written.
fn told_item(item: &Item, frame: &Frame) -> String {
    match &item.kind {
        ItemKind::Move { segment, rate, .. } => {
            let end = segment.end();
            let found = match frame {
                Frame::Axes { .. } => end,
                Frame::Joints { .. } => machines::joints(&end),
            } - frame.shift(&end);
            let mut text = rate
                .feed_v()
                .map_or_else(|| "rapid".to_owned(), |v| format!("F{:.3}", v * 60.0));
            for (index, letter) in expected::LETTERS.iter().enumerate() {
                if found[index] != 0.0 || index < 3 {
                    let _ = write!(text, " {letter}{:.6}", found[index]);
                }
            }
            text
        }
        ItemKind::Dwell(seconds) => format!("dwell {seconds}"),
        ItemKind::Event(event) => format!("{event:?}"),
    }
}

#[test]
fn programs_of_shops_are_read_right_or_refused() {
    let (mut all, mut shares) = (String::new(), String::new());
    for (file, text) in FILES {
        let programs = expected::programs(text);
        let is_refused = |program: &&ShopProgram| {
            program
                .expected
                .iter()
                .any(|(_, expected)| matches!(expected, Expected::Refused(_)))
        };
        let refused = programs.iter().filter(is_refused).count();
        let _ = writeln!(
            shares,
            "{file}: {} read, {refused} refused",
            programs.len() - refused
        );
        for program in &programs {
            let faults = faults(program);
            if !faults.is_empty() {
                let _ = write!(all, "{file}: {}\n{faults}", program.name);
            }
        }
    }
    println!("{shares}");
    assert!(all.is_empty(), "\n{all}");
}
