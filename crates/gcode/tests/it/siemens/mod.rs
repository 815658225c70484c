//! Tests of SINUMERIK's programs: structures, jumps, variables, frames, cycles.

mod arc_planes;
mod boring;
mod corners;
mod cycle_depths;
mod cycles;
mod edges;
mod face_milling;
mod flow;
mod frames;
mod increments;
mod kept_data;
mod lathe_start;
mod lathes;
mod m_functions;
mod motion;
mod older_pockets;
mod pockets;
mod program_frame;
mod programs;
mod references;
mod spigots;
mod stock_removal;
mod subprograms;
mod texts;
mod thread_cutting;
mod words_of_x;

use std::sync::Arc;

use glidepath_gcode::{Dialect, Options, Program, Tool, ToolTable, check};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind, PathMode, Rate};

use crate::support::listed;

/// Tools 1 to 9, each with its number as diameter.
pub(crate) fn options() -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=9_u8 {
        let tool = Tool {
            diameter_mm: f64::from(number),
            ..Tool::default()
        };
        tools.set(number.into(), tool);
    }
    Options {
        dialect: Dialect::Siemens,
        connections: glidepath_gcode::Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        tools: Some(Arc::new(tools)),
        ..Options::default()
    }
}

pub(crate) fn items(text: &str) -> Vec<Item> {
    let items = Program::new(text.as_bytes(), options());
    items
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .collect()
}

/// The moves, each with its rate and path mode.
pub(crate) fn moves(text: &str) -> Vec<(Segment, Rate, PathMode)> {
    let all = items(text).into_iter();
    all.filter_map(|item| match item.kind {
        ItemKind::Move {
            segment,
            rate,
            mode,
        } => Some((segment, rate, mode)),
        _ => None,
    })
    .collect()
}

/// Ends of moves in X, Y, Z, to the nanometre.
pub(crate) fn ends(text: &str) -> Vec<[f64; 3]> {
    let round = |end: AxisVector, axis: usize| (end[axis] * 1e6).round() / 1e6 + 0.0;
    let all = moves(text).into_iter();
    all.map(|(segment, ..)| [0, 1, 2].map(|axis| round(segment.end(), axis)))
        .collect()
}

/// X of every end.
pub(crate) fn xs(text: &str) -> Vec<f64> {
    ends(text).into_iter().map(|[x, ..]| x).collect()
}

#[track_caller]
pub(crate) fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), expected, "{text}");
    for diagnostic in &report.diagnostics {
        let says_how = !diagnostic.help.is_empty() || !diagnostic.reason.is_empty();
        assert!(says_how, "{diagnostic}");
    }
}

/// Ends in X, Y and Z, with `r` for rapids, `+` for arcs counterclockwise, `-` for those clockwise.
pub(super) fn ways(text: &str) -> Vec<String> {
    let all = moves(text).into_iter();
    all.map(|(segment, rate, _)| {
        let [x, y, z] = [0, 1, 2].map(|axis| (segment.end()[axis] * 1e3).round() / 1e3 + 0.0);
        let mark = match segment {
            Segment::Arc(arc) if arc.sweep_rad > 0.0 => "+",
            Segment::Arc(_) => "-",
            _ if rate == Rate::Rapid => "r",
            _ => "",
        };
        format!("{x} {y} {z}{mark}")
    })
    .collect()
}
