//! Tests of cycles, tools, cutter radius, spindle and outputs: what a block gives out, item by
//! item.

#![allow(clippy::expect_used, reason = "a test")]

use std::fmt::Write;
use std::sync::Arc;

use crate::support::listed;
use glidepath_gcode::{
    AxisTravel, Connections, Machine, Options, Program, Threading, ToolTable, WorkOffsets, check,
};
use glidepath_geometry::{Axis, Segment};
use glidepath_program::{Event, ItemKind, Limits, Rate};

fn options() -> Options {
    let table = b"T1 D2 Z10\nT2 D4 Z5 Q2\nT3 D-2\n";
    Options {
        tools: Some(Arc::new(ToolTable::parse(table).expect("a tool table"))),
        connections: Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        ..Options::default()
    }
}

/// Items as short text: `r` rapid, `f` feed, `a` arc, with the end of each move.
fn items(text: &str) -> String {
    let mut all = String::new();
    for item in Program::new(text.as_bytes(), options()) {
        match item.expect("a sound program").kind {
            ItemKind::Move { segment, rate, .. } => {
                let kind = match (&segment, rate) {
                    (Segment::Arc(_), _) => 'a',
                    (_, Rate::Rapid) => 'r',
                    _ => 'f',
                };
                // A sum with zero has no sign.
                let [x, y, z] =
                    [0, 1, 2].map(|axis| (segment.end()[axis] * 1e3).round() / 1e3 + 0.0);
                write!(all, "{kind}({x},{y},{z}) ").expect("a string");
            }
            ItemKind::Dwell(seconds) => write!(all, "dwell{seconds} ").expect("a string"),
            ItemKind::Event(event) => match event {
                Event::MCode(code) | Event::PassingCode(code) => {
                    write!(all, "M{code} ").expect("a string");
                }
                Event::SpindleSpeed(speed) => write!(all, "S{speed:.0} ").expect("a string"),
                other => write!(all, "{other:?} ").expect("a string"),
            },
        }
    }
    all.trim_end().to_owned()
}

#[track_caller]
fn finds(text: &str, place_and_code: &str) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), [place_and_code], "{text}");
    let diagnostic = &report.diagnostics[0];
    assert!(!diagnostic.reason.is_empty(), "{diagnostic}");
}

#[test]
fn pecks_go_out_to_r_or_back_a_little() {
    assert_eq!(
        items("G0 Z2\nG83 Z-4 R1 Q2"),
        "r(0,0,2) r(0,0,1) f(0,0,-1) r(0,0,1) r(0,0,-0.746) f(0,0,-3) r(0,0,1) r(0,0,-2.746) \
         f(0,0,-4) r(0,0,2)"
    );
    assert_eq!(
        items("G0 Z1\nG99 G73 Z-2 R1 Q2"),
        "r(0,0,1) f(0,0,-1) r(0,0,-0.746) f(0,0,-2) r(0,0,1)"
    );
}

#[test]
fn cycles_rise_before_they_go_across() {
    let program = "G0 Z9\nG99 G81 X1 Z-1 R2\nG98 X5\nG80 G0 X0";
    assert_eq!(
        items(program),
        "r(0,0,9) r(1,0,9) r(1,0,2) f(1,0,-1) r(1,0,2) r(1,0,9) r(5,0,9) r(5,0,2) f(5,0,-1) \
         r(5,0,9) r(0,0,9)"
    );
}

#[test]
fn cycles_command_the_spindle() {
    assert_eq!(
        items("M3 S100\nG84 Z-1 R1 P0.5"),
        "S100 M3 r(0,0,1) M49 f(0,0,-1) M4 dwell0.5 f(0,0,1) M3 M48"
    );
    assert_eq!(
        items("M4\nG0 Z1\nG86 Z-1 R1 P2"),
        "M4 r(0,0,1) f(0,0,-1) dwell2 M5 r(0,0,1) M4"
    );
    finds("G84 Z-1 R1", "1:1 spindle");
    finds("M4\nG84 Z-1 R1", "2:1 spindle");
}

#[test]
fn cycles_that_cannot_be_made_are_refused() {
    finds("G81 X1 R1", "1:1 missing-word");
    finds("G81 X1 Z-1", "1:1 missing-word");
    finds("G82 X1 Z-1 R1", "1:1 missing-word");
    finds("G81", "1:1 missing-word");
    finds("G81 X1 Z2 R1", "1:11 canned-cycle");
    finds("G81 X1 Z-1 R1 L0", "1:15 canned-cycle");
    finds("G81 X1 A1 Z-1 R1", "1:8 canned-cycle");
    finds("G83 X1 Z-1 R1 Q0", "1:15 canned-cycle");
    finds("G83 X1 Z-1 R1 Q0.00001", "1:15 canned-cycle");
    finds("G93 G81 X1 Z-1 R1 F1", "1:5 canned-cycle");
    finds("G41.1 D1\nG81 X9 Z-1 R1", "2:1 cutter-radius");
}

#[test]
fn tool_lengths_move_nothing_and_count_from_then_on() {
    assert_eq!(
        items("G0 Z5\nG43 H1\nX1\nZ5\nG49\nX2\nZ5"),
        "r(0,0,5) r(1,0,5) r(1,0,15) r(2,0,15) r(2,0,5)"
    );
    assert_eq!(
        items("T2 M6 G43\nG43.2 H1\nG0 Z0"),
        "SelectTool(2) M6 r(0,0,15)"
    );
    assert_eq!(items("G10 L1 P1 Z3 R4\nG43 H1\nG0 Z0"), "r(0,0,3)");
    finds("G43 H9", "1:5 unknown-tool");
    finds("T9", "1:1 unknown-tool");
}

#[test]
fn the_tool_rolls_round_convex_corners_and_stops_in_concave_ones() {
    let square = "G41 D1\nG1 X10 Y0\nM8\nG1 Y10\nX20\nG40 X30 Y20";
    assert_eq!(
        items(square),
        "f(9,1,0) M8 f(9,10,0) a(10,11,0) f(20,11,0) f(30,20,0)"
    );
    let inner = "G42 D1\nG1 X10 Y0\nZ-1\nY-10\nX0\nG40 X0 Y0";
    assert_eq!(
        items(inner),
        "f(9,-1,0) f(9,-1,-1) f(9,-9,-1) f(0,-9,-1) f(0,0,-1)"
    );
    // A negative diameter is the other side.
    assert_eq!(
        items(&square.replace("D1", "D3")),
        items(&square.replace("G41 D1", "G42 D1"))
    );
    // The program may end without G40.
    assert_eq!(items("G41 D1\nG1 X10\nX20"), "f(10,1,0) f(20,1,0)");
}

#[test]
fn a_flat_convex_corner_is_extended() {
    assert_eq!(
        items("G41 D1\nG1 X10 Y0\nX20 Y-0.4\nX30 Y-1.2\nG40"),
        "f(10.02,1,0) f(20.06,0.598,0) f(30.08,-0.203,0)"
    );
}

#[test]
fn a_tool_that_does_not_fit_is_refused() {
    finds("G41 D1\nG1 X10 Y0\nX20\nY0.5\nX10", "4:1 gouge");
    finds("G41 D2\nG1 X10 Y0\nG3 X10 Y2 J1", "3:1 gouge");
    finds("G41 D1\nG1 X0.5", "2:1 cutter-radius");
    finds("G41 D1\nG1 X10\nG42 D1", "3:1 cutter-radius");
    finds("G41 D1\nG1 X10\nG28", "3:1 cutter-radius");
    finds("G19 G41 D1", "1:5 cutter-radius");
    finds("G41 D1\nG1 X10\nY10\nG40\nG2 X20 I5", "5:1 cutter-radius");
}

#[test]
fn soft_limits_hold_for_the_compensated_path() {
    let travel = AxisTravel {
        min: -5.0,
        max: 10.5,
    };
    let options = Options {
        machine: Machine::unlimited().with_travel(Axis::Y, travel),
        ..options()
    };
    let program = b"G41 D1\nG1 X10 Y0\nY10\nX20\nG40 X30";
    let report = check(program.as_slice(), options);
    assert_eq!(report.diagnostics[0].code.as_str(), "soft-limit");
}

#[test]
fn polar_words_and_diameters() {
    assert_eq!(
        items("G0 @10 ^90\n^0\n@5\nG91 ^90 @1"),
        "r(0,10,0) r(10,0,0) r(5,0,0) r(0,6,0)"
    );
    assert_eq!(
        items("G7 G0 X10\nG91 X4\nG8 X1"),
        "r(5,0,0) r(7,0,0) r(8,0,0)"
    );
    finds("G0 @1", "1:4 polar");
    finds("G0 @1 ^1 X2", "1:4 polar");
}

#[test]
fn feeds_per_revolution_and_cutting_speeds() {
    let rates = |text: &str| -> Vec<f64> {
        Program::new(text.as_bytes(), options())
            .filter_map(|item| match item.expect("a sound program").kind {
                ItemKind::Move {
                    rate: Rate::Feed(v),
                    ..
                } => Some((v * 1e6).round() / 1e6),
                _ => None,
            })
            .collect()
    };
    assert_eq!(rates("G95 S300 F0.2\nG1 X1\nS600\nX2"), [1.0, 2.0]);
    finds("G95 F1\nG1 X1", "2:1 spindle");
    // With an encoder the moves say so, and those of G94 do not.
    let measured = Options {
        threading: Some(Threading::new(Limits::uniform(200.0, 2e3, 4e4), 0.004)),
        ..options()
    };
    let text =
        "G95 S300 F0.2 M3\nG1 X1\nG2 X3 I1\nG0 X9\nG94 F60\nG1 X4\nG96 S100 D300 G95 F0.2\nX9";
    let rates = Program::new(text.as_bytes(), measured).filter_map(|item| {
        match item.expect("a sound program").kind {
            ItemKind::Move { rate, .. } => Some(rate),
            _ => None,
        }
    });
    let per_revolution = Rate::PerRevolution {
        feed_v: 1.0,
        most_v: f64::INFINITY,
    };
    assert_eq!(
        rates.collect::<Vec<_>>(),
        [
            per_revolution,
            per_revolution,
            Rate::Rapid,
            Rate::Feed(1.0),
            per_revolution
        ]
    );
    // 100 m/min at a radius of 50 mm: 318 rev/min; at 100 mm half of it, at most 300.
    assert_eq!(
        items("G0 X50\nG96 S100\nG0 X100\nG96 S100 D100\nG97 S7"),
        "r(50,0,0) S318 r(100,0,0) S159 S100 S7"
    );
}

#[test]
fn a_cutting_speed_is_kept_on_the_way_to_the_middle() {
    // Facing from a radius of 50 mm: of 300 m/min, at most 2000 rev/min.
    let text = "G0 X50\nG96 S300 D2000 M3\nG95 F0.2\nG1 X0\nX10 G97 S100";
    let (mut told, mut at, mut worst, mut changes) = (0.0_f64, 50.0_f64, 0.0_f64, 0);
    for item in Program::new(text.as_bytes(), options()) {
        match item.expect("a sound program").kind {
            ItemKind::Event(Event::SpindleSpeed(speed)) => (told, changes) = (speed, changes + 1),
            ItemKind::Move { segment, rate, .. } if rate != Rate::Rapid => {
                if told <= 100.0 {
                    break;
                }
                // The feed is that of the speed told last.
                let feed_v = rate.feed_v().expect("a feed");
                assert!((feed_v - 0.2 * told / 60.0).abs() < 1e-9);
                let end = segment.end()[0];
                let wanted = |x: f64| (300_000.0 / (core::f64::consts::TAU * x)).min(2_000.0);
                for x in [at, end] {
                    worst = worst.max((told - wanted(x.max(1e-9))).abs() / wanted(x.max(1e-9)));
                }
                at = end;
            }
            _ => {}
        }
    }
    assert_eq!(at, 0.0);
    // 1 % is what is worth telling, and what passes until it is looked at comes on top.
    assert!(worst < 0.015, "{worst}");
    assert!((50..150).contains(&changes), "{changes}");
    // Where the time of the move is given, it stays one.
    assert_eq!(
        items("G0 X50\nG96 S300 D2000\nG93 G1 X10 F1"),
        "r(50,0,0) S955 f(10,0,0) S2000"
    );
}

#[test]
fn simulated_probing_and_outputs() {
    assert_eq!(
        items("M64 P3\nM63 P0\nM68 E1 Q2.5\nM66 P1 L0\nG38.2 X10 F60\nG0 X[#5061+#5070+#5399]"),
        "DigitalOutput { number: 3, on: true } DigitalOutput { number: 0, on: false } \
         AnalogOutput { number: 1, value: 2.5 } M66 f(10,0,0) r(11,0,0)"
    );
    finds("G38.2 F60", "1:1 missing-word");
    finds("G38.2 X0 F60", "1:1 invalid-value");
    finds("M62", "1:1 missing-word");
    finds("M67 E1", "1:1 missing-word");
    finds("M66 P1 L3", "1:1 missing-word");
}

#[test]
fn a_missing_tool_table_is_one_finding() {
    let mut text = String::from("G43 H1\nG41 D2\nG0 X1.2.3\n");
    for tool in 1..=30 {
        text.push_str(&format!("G43 H{tool}\n"));
    }
    let report = check(text.as_bytes(), Options::default());
    assert_eq!(report.diagnostics.len(), 2, "{:?}", report.diagnostics);
    assert_eq!(report.more, 0);
    let first = &report.diagnostics[0];
    assert_eq!((first.line, first.code.as_str()), (1, "unknown-tool"));
    assert!(
        first.reason.ends_with("; 31 more blocks need it"),
        "{}",
        first.reason
    );
    assert_eq!(report.diagnostics[1].line, 3);
}

#[test]
fn a_program_begins_with_the_offsets_set_up_and_says_what_it_changes() {
    let mut offsets = WorkOffsets::default();
    offsets.systems[1].origin[0] = 10.0;
    offsets.active = 1;
    offsets.saved_shift[1] = 2.0;
    offsets.reference[0][2] = 50.0;
    let options = Options {
        offsets: offsets.clone(),
        ..Options::default()
    };
    let text = "G0 X1\nG92.3\nG0 Y1\nG10 L2 P3 X7 R30\nG49\nG28.1\nG54\nG53 G0 X0\nM2\n";
    let mut program = Program::new(text.as_bytes(), options);
    let mut changes = Vec::new();
    while let Some(item) = program.next() {
        let line = item.expect("a sound program").line;
        changes.push((line, program.changes()));
    }
    // The items come out behind the changes of the lines before them.
    assert_eq!(changes, [(1, 0), (3, 1), (8, 4)]);
    assert_eq!(program.changes(), 4, "M2 chooses G54, which is in force");
    let after = program.work_offsets();
    assert_eq!(after.active, 0);
    assert_eq!(after.systems[1], offsets.systems[1]);
    assert_eq!(after.systems[2].origin[0].to_bits(), 7.0_f64.to_bits());
    assert_eq!(after.systems[2].rotation_deg.to_bits(), 30.0_f64.to_bits());
    assert_eq!(after.shift[1].to_bits(), 2.0_f64.to_bits());
    let reference: Vec<f64> = after.reference[0].iter().copied().take(3).collect();
    assert_eq!(reference, [11.0, 3.0, 0.0]);
}
