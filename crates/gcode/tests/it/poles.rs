//! Directions of the tool by the pole, where it is along the axis of C, and at the ends of travel.
//!
//! The table tilts about x (A) and carries one that turns about z (C): the tool stands along (sin A sin C, sin A cos C,
//! cos A) on the work, which is written out here.

use core::fmt::Write as _;
use glidepath_gcode::{
    AxisTravel, Dialect, Machine, Options, PoleTurns, Program, Tool, ToolTable, check,
};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::{DirectionTolerance, ItemKind, Rate};
use nalgebra::Vector3;
use std::sync::Arc;

use crate::five_axes::{at, near, options};

const AXES: [Axis; 5] = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C];

/// The machine with ends of travel of A and C.
fn machine(a: [f64; 2], c: [f64; 2]) -> Options {
    let travel = |[min, max]: [f64; 2]| AxisTravel { min, max };
    Options {
        machine: Machine::new(&AXES)
            .with_travel(Axis::A, travel(a))
            .with_travel(Axis::C, travel(c)),
        ..options(Dialect::Siemens)
    }
}

fn tool(place: &AxisVector) -> Vector3<f64> {
    let (sa, ca) = place[Axis::A.index()].to_radians().sin_cos();
    let (sc, cc) = place[Axis::C.index()].to_radians().sin_cos();
    Vector3::new(sa * sc, sa * cc, ca)
}

fn angle_deg(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b)).to_degrees()
}

/// A move: from where to where, and whether it is a rapid.
type Moved = (AxisVector, AxisVector, bool);

fn moves(options: &Options, text: &str) -> Result<Vec<Moved>, String> {
    let mut moves = Vec::new();
    for item in Program::new(text.as_bytes(), options.clone()) {
        let item = item.map_err(|refusal| format!("{refusal}\n{refusal:?}"))?;
        if let ItemKind::Move { segment, rate, .. } = item.kind {
            moves.push((segment.start(), segment.end(), rate == Rate::Rapid));
        }
    }
    Ok(moves)
}

/// True for a turn of C while the tip rests.
fn is_turn((start, end, is_rapid): &Moved) -> bool {
    let by = end - start;
    *is_rapid && by.fixed_rows::<3>(0).norm() < 1e-9 && by[Axis::C.index()].abs() > 1e-9
}

/// The tool leans from one side to the other, half a degree a block, by the pole, so many degrees beside it. The
/// directions, and the text.
fn passage(beside_deg: f64) -> (Vec<Vector3<f64>>, String) {
    let mut text = String::from("TRAORI\nG64 F600\n");
    let mut directions = Vec::new();
    for k in -6..=6 {
        let lean = (0.5 * f64::from(k)).to_radians();
        let way = Vector3::new(beside_deg.to_radians().sin(), lean.sin(), lean.cos()).normalize();
        let code = if k == -6 { "G0" } else { "G1" };
        writeln!(
            text,
            "{code} X{k} Z20 A3={:.12} B3={:.12} C3={:.12}",
            way.x, way.y, way.z
        )
        .expect("a line");
        directions.push(way);
    }
    (directions, text)
}

/// With a tolerance of the direction, degrees.
fn tolerant(options: Options, deg: f64) -> Options {
    Options {
        tolerance_mm: 0.02,
        direction: DirectionTolerance {
            angle_deg: Some(deg),
            turn_r: 1.0,
        },
        ..options
    }
}

const WIDE: [f64; 2] = [-120.0, 120.0];
const ROUNDS: [f64; 2] = [-720.0, 720.0];

#[test]
fn the_pole_is_passed_straight_where_the_tolerance_allows() {
    // A twentieth of a degree is .05 here, and the program passes by .02.
    let (directions, text) = passage(0.02);
    let all = moves(&tolerant(machine(WIDE, ROUNDS), 1.0), &text).expect("a program");
    assert_eq!(all.len(), directions.len());
    assert!(!all.iter().any(is_turn));
    let c = |place: &AxisVector| place[Axis::C.index()];
    let turned: f64 = all
        .iter()
        .skip(1)
        .map(|(a, b, _)| (c(b) - c(a)).abs())
        .sum();
    assert!(turned < 10.0, "{turned}");
    for ((_, end, _), wanted) in all.iter().zip(&directions) {
        let off_deg = angle_deg(&tool(end), wanted);
        assert!(off_deg <= 0.05, "{end} {off_deg}");
    }
    // On the way from one to the next, too, the tool is as near to the straight way.
    for (pair, ends) in all.iter().skip(1).zip(directions.windows(2)) {
        let middle = (pair.0 + pair.1) * 0.5;
        let wanted = (ends[0] + ends[1]).normalize();
        let off_deg = angle_deg(&tool(&middle), &wanted);
        assert!(off_deg <= 0.1, "{off_deg}");
    }
    // To the letter C goes round by half, as before.
    let exact = moves(&machine(WIDE, ROUNDS), &text).expect("a program");
    for ((_, end, _), wanted) in exact.iter().filter(|of| !is_turn(of)).zip(&directions) {
        assert!(angle_deg(&tool(end), wanted) < 1e-9);
    }
}

#[test]
fn a_tilt_to_one_side_has_c_turn_at_the_pole() {
    let (directions, text) = passage(0.02);
    let options = tolerant(machine([0.0, 120.0], ROUNDS), 1.0);
    let all = moves(&options, &text).expect("a program");
    let turns: Vec<_> = all.iter().filter(|of| is_turn(of)).collect();
    assert_eq!(turns.len(), 1, "{all:?}");
    let (start, end, _) = turns[0];
    let by = (end - start)[Axis::C.index()].abs();
    assert!((160.0..=180.0).contains(&by), "{by}");
    // While it turns, the tool stays where it is to a tenth of the tolerance.
    assert!(angle_deg(&tool(start), &tool(end)) <= 0.1);
    for (_, end, _) in &all {
        assert!((0.0..=120.0).contains(&end[Axis::A.index()]), "{end}");
    }
    let feeds: Vec<_> = all.iter().filter(|of| !is_turn(of)).collect();
    assert_eq!(feeds.len(), directions.len());
    for ((_, end, _), wanted) in feeds.iter().zip(&directions) {
        assert!(angle_deg(&tool(end), wanted) <= 0.05);
    }
}

#[test]
fn one_block_over_the_pole_has_c_turn_on_its_way() {
    let text = "TRAORI\nG0 X0 Y0 Z20 A30 C0\nG1 X10 A3=0 B3=-1 C3=1 F600";
    // With the tilt to both sides, C stays.
    let all = moves(&machine(WIDE, ROUNDS), text).expect("a program");
    near(all.last().expect("it").1, at(10.0, 0.0, 20.0, -45.0, 0.0));
    // With the tilt to one side: to the pole in 30 of 75 degrees, half a round, and on.
    let all = moves(&machine([0.0, 120.0], ROUNDS), text).expect("a program");
    let [.., first, turn, last] = &all[..] else {
        panic!("{all:?}")
    };
    near(first.1, at(4.0, 0.0, 20.0, 0.0, 0.0));
    assert!(is_turn(turn));
    near(turn.1, at(4.0, 0.0, 20.0, 0.0, 180.0));
    near(last.1, at(10.0, 0.0, 20.0, 45.0, 180.0));
    // Where C cannot turn by half a round, either, it is refused with its place.
    let refused = moves(&machine([0.0, 120.0], [-90.0, 90.0]), text).expect_err("a refusal");
    assert!(refused.contains("A would go to -45.000°"), "{refused}");
    assert!(refused.starts_with("3:"), "{refused}");
}

#[test]
fn from_the_pole_c_turns_before_the_tool_leans() {
    let text = "TRAORI\nG0 X0 Y0 Z20 A0 C0\nG1 X10 A3=1 B3=0 C3=1 F600";
    let all = moves(&machine(WIDE, ROUNDS), text).expect("a program");
    let [.., turn, lean] = &all[..] else {
        panic!("{all:?}")
    };
    assert!(is_turn(turn));
    near(turn.1, at(0.0, 0.0, 20.0, 0.0, 90.0));
    near(lean.1, at(10.0, 0.0, 20.0, 45.0, 90.0));
    // It is told with its line.
    let turns = |text: &str| {
        let report = check(text.as_bytes(), machine(WIDE, ROUNDS));
        let PoleTurns {
            count,
            line,
            angle_deg,
        } = report.survey.pole_turns;
        (count, line, angle_deg.round())
    };
    assert_eq!(turns(text), (1, 3, 90.0));
    assert_eq!(turns(&text.replace("G1 X10", "G0 X10")), (0, 0, 0.0));
    // A rapid goes all at once; in G93 a block has one time.
    for text in [
        text.replace("G1 X10", "G0 X10"),
        text.replace("G1 X10", "G93 G1 X10").replace("F600", "F2"),
    ] {
        let all = moves(&machine(WIDE, ROUNDS), &text).expect("a program");
        assert!(!all.iter().any(is_turn), "{text}");
        near(all.last().expect("it").1, at(10.0, 0.0, 20.0, 45.0, 90.0));
    }
}

#[test]
fn beside_a_contour_that_is_left_no_turn_moves_the_tip() {
    let mut tools = ToolTable::new();
    tools.set(
        1,
        Tool {
            diameter_mm: 10.0,
            ..Tool::default()
        },
    );
    let options = Options {
        tools: Some(Arc::new(tools)),
        ..machine(WIDE, ROUNDS)
    };
    let text = "T1 M6\nD1\nTRAORI\nG0 X0 Y-10 Z0 A0 C0\nG41 G1 X0 Y0 F600\nX10\nG40\nG1 X20 Y5 A3=1 B3=0 C3=1 F600";
    let all = moves(&options, text).expect("a program");
    let last = all.last().expect("it");
    // From beside the contour, a radius of 5 from where the program has the tip, in one move at feed.
    assert!((last.0[1] - 5.0).abs() < 1e-9, "{all:?}");
    assert!(!last.2, "{all:?}");
    near(last.1, at(20.0, 5.0, 0.0, 45.0, 90.0));
    let feeds = all.iter().skip(1);
    assert!(feeds.into_iter().all(|of| !of.2), "{all:?}");
}

#[test]
fn what_is_near_the_pole_follows_the_ratio_of_tolerances() {
    // Without a tolerance of its own, a direction has as many degrees as the tip has mm: .05 of it here, and .02 beside.
    let options = |ratio: f64| Options {
        tolerance_ratio: ratio,
        ..machine(WIDE, ROUNDS)
    };
    let text = passage(0.02).1.replace("G64", "G641 ADIS=1");
    for (ratio, is_passed) in [(1.0, true), (0.1, false)] {
        let all = moves(&options(ratio), &text).expect("a program");
        let turn = |(start, end, _): &Moved| (end - start)[Axis::C.index()].abs();
        let turned: f64 = all.iter().skip(1).map(turn).sum();
        // Half a round else.
        assert_eq!(turned < 10.0, is_passed, "{ratio}: {turned}");
    }
}

/// The tool goes round the axis of C at 45 degrees, an eighth of a round a block.
fn winding(blocks: u32, code: &str) -> String {
    let mut text = String::from("TRAORI\nG0 X0 Y0 Z20 A45 C0 F600\n");
    for k in 1..=blocks {
        let (sin, cos) = (45.0 * f64::from(k)).to_radians().sin_cos();
        writeln!(text, "{code} X{k} A3={sin:.12} B3={cos:.12} C3=1").expect("a line");
    }
    text
}

#[test]
fn c_is_unwound_only_where_it_is_told_so() {
    let limited = machine([0.0, 120.0], [-180.0, 360.0]);
    let told = Options {
        unwinds_at_rapid: true,
        ..limited.clone()
    };
    // Up to the end of its travel, and not beyond.
    assert!(moves(&limited, &winding(8, "G1")).is_ok());
    for (options, code) in [(&limited, "G1"), (&told, "G1"), (&limited, "G0")] {
        let refused = moves(options, &winding(9, code)).expect_err("a refusal");
        assert!(refused.starts_with("11:"), "{refused}");
        for part in [
            "C would go to 405.000°, which is above 360°",
            "C 45.000°",
            "unwind",
        ] {
            assert!(refused.contains(part), "{code}: {part}: {refused}");
        }
    }
    let all = moves(&told, &winding(9, "G0")).expect("a program");
    near(all.last().expect("it").1, at(9.0, 0.0, 20.0, 45.0, 45.0));
    // Told by the program, too.
    let text = winding(8, "G1") + "G0 C45\nG1 X9 A3=1 B3=1 C3=1.414213562373\n";
    let all = moves(&limited, &text).expect("a program");
    near(all.last().expect("it").1, at(9.0, 0.0, 20.0, 45.0, 45.0));
}
