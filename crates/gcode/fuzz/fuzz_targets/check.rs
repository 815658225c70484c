//! The fuzz target: any program, in any dialect, is judged without a panic, and what is given out
//! is sound.
#![no_main]

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, LoopLimits, Machine, Options, Program, Tool, ToolTable, AxisTravel, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{ItemKind, Rate};
use libfuzzer_sys::fuzz_target;

fn options() -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=4_u8 {
        let mut tool = Tool {
            diameter_mm: f64::from(number),
            orientation: number,
            ..Tool::default()
        };
        tool.offset[2] = 10.0 * f64::from(number);
        tools.set(number.into(), tool);
    }
    let travel = AxisTravel {
        min: -500.0,
        max: 500.0,
    };
    Options {
        machine: Machine::unlimited().with_travel(Axis::X, travel),
        default_feed_mm_min: Some(1000.0),
        tools: Some(Arc::new(tools)),
        extruder: Some(Axis::U),
        connections: Connections::Simulated,
        loops: LoopLimits {
            idle_lines: 2_000,
            checked_lines: 4_000,
            may_run_unchecked: false,
        },
        ..Options::default()
    }
}

fuzz_target!(|bytes: &[u8]| {
    let dialect = Dialect::detect(bytes, &Machine::unlimited()).dialect;
    let options = Options {
        dialect,
        ..options()
    };
    let report = check(bytes, options.clone());
    let mut end = options.start;
    // A loop of the program may have no end.
    for item in Program::new(bytes, options).take(2_000) {
        match item {
            Ok(item) => match item.kind {
                ItemKind::Move { segment, rate, .. } => {
                    assert_eq!(segment.start(), end);
                    end = segment.end();
                    assert!(end.iter().all(|p| p.is_finite()));
                    assert!(end[0].abs() <= 500.001);
                    assert!(segment.length() > 0.0);
                    assert!(rate == Rate::Rapid || matches!(rate, Rate::Feed(v) if v > 0.0));
                }
                ItemKind::Dwell(seconds) => assert!(seconds >= 0.0),
                ItemKind::Event(_) => {}
            },
            Err(diagnostic) if report.is_complete() => {
                assert_eq!(report.diagnostics.first(), Some(&diagnostic));
            }
            Err(_) => {}
        }
    }
});
