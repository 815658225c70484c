//! Tests of FANUC's and Haas' lathes, system A: ends and ways by values computed by hand. X is a
//! radius here.

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, FanucControl, FanucParameters, Machine, Options, Program, Threading,
    Tool, ToolTable, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, Limits, Rate};

use crate::support::listed;

/// A lathe with X and Z; offset 4 is X1 Z5.
fn options() -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=4 {
        tools.set(number, Tool::default());
    }
    let mut long = Tool::default();
    (long.offset[0], long.offset[2]) = (1.0, 5.0);
    tools.set(4, long);
    Options {
        dialect: Dialect::Fanuc,
        connections: Connections::Simulated,
        tools: Some(Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Z]),
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..Options::default()
    }
}

/// Ends of moves in X and Z, and whether each is at rapid.
fn ways(text: &str) -> Vec<([f64; 2], bool)> {
    let items = Program::new(text.as_bytes(), options());
    items
        .filter_map(
            |item| match item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind {
                ItemKind::Move { segment, rate, .. } => {
                    let end = segment.end();
                    let place = [0, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0);
                    Some((place, matches!(rate, Rate::Rapid)))
                }
                _ => None,
            },
        )
        .collect()
}

fn ends(text: &str) -> Vec<[f64; 2]> {
    ways(text).into_iter().map(|(end, _)| end).collect()
}

fn last(text: &str) -> [f64; 2] {
    *ends(text).last().expect("a move")
}

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    assert_eq!(
        listed(&check(text.as_bytes(), options())),
        expected,
        "{text}"
    );
}

#[test]
fn x_is_a_diameter_and_u_and_w_are_increments() {
    assert_eq!(last("G0 X20. Z5."), [10.0, 5.0]);
    let mixed = "G98\nG0 X40 Z2\nG1 X30 W-12 F500\nU4 Z-15\nU0 W-5";
    assert_eq!(
        ends(mixed),
        [[20.0, 2.0], [15.0, -10.0], [17.0, -15.0], [17.0, -20.0]]
    );
    // Radii are radii.
    assert_eq!(
        last("G98\nG0 X20 Z0\nG3 X40 Z-10 I0 K-10 F500"),
        [20.0, -10.0]
    );
    // By way of an increment to the reference position.
    assert_eq!(
        ends("G0 X40 Z10\nG28 U10 W5"),
        [[20.0, 10.0], [25.0, 15.0], [0.0, 0.0]]
    );
    assert_eq!(last("G0 X20 Z5\nG50 X100 Z50\nG0 X80 Z40"), [0.0, -5.0]);
    assert_eq!(
        ends("G10 L2 P1 X40 Z10\nG0 X10 Z0\nG53 X20 Z-4"),
        [[25.0, 10.0], [10.0, -4.0]]
    );
    finds("G0 X5 U1", &["1:7 ambiguous-word"]);
    finds("G98\nG1 X5 F0.2\nG1 Y5", &["3:4 axis-not-configured"]);
}

#[test]
fn the_turret_has_offsets() {
    assert_eq!(last("T0204\nG0 X20 Z0"), [11.0, 5.0]);
    assert_eq!(last("G0 T101\nX20 Z0"), [10.0, 0.0]);
    assert_eq!(last("T0204\nG0 X20 Z0\nT0200\nX20 Z0"), [10.0, 0.0]);
    let events: Vec<_> = Program::new("T0204\nT0200".as_bytes(), options())
        .filter_map(|item| match item.expect("a sound program").kind {
            ItemKind::Event(event) => Some(event),
            _ => None,
        })
        .collect();
    assert_eq!(events, [Event::SelectTool(2), Event::MCode(6)]);
    finds("T0177", &["1:1 unknown-tool"]);
}

#[test]
fn cycles_of_one_pass_are_repeated_from_the_same_place() {
    let pass = |x: f64, z: f64| [[x, 2.0], [x, z], [31.0, z], [31.0, 2.0]];
    let text = "G98\nG0 X62 Z2\nG90 X56 Z-30 F300\nX52 Z-25\nW-17\nG0 X70";
    let expected = [
        vec![[31.0, 2.0]],
        pass(28.0, -30.0).to_vec(),
        pass(26.0, -25.0).to_vec(),
        pass(26.0, -15.0).to_vec(),
        vec![[35.0, 2.0]],
    ]
    .concat();
    assert_eq!(ends(text), expected);
    let rapid: Vec<_> = ways(text)[1..5].iter().map(|(_, rapid)| *rapid).collect();
    assert_eq!(rapid, [true, false, false, true]);
    // R is the beginning less the end, along Z for a face.
    let face = "G98\nG0 X62 Z2\nG94 X20 Z-5 R-3 F300";
    assert_eq!(
        ends(face)[1..],
        [[31.0, -8.0], [10.0, -5.0], [10.0, 2.0], [31.0, 2.0]]
    );
    // A thread runs out over one lead.
    let thread = ends("G97 S600 M3\nG0 X34 Z6\nG92 X29.4 Z-20 F1.5\nX28.8");
    assert_eq!(thread[1..4], [[14.7, 6.0], [14.7, -18.5], [16.2, -20.0]]);
    assert_eq!(thread[6], [14.4, 6.0]);
    finds("G90", &[]);
    finds("G94", &["1:1 missing-word"]);
    finds("G98\nG0 X62 Z2\nG90 X56 F300", &["3:1 missing-word"]);
}

const PROFILE: &str = "N10 G0 X20\nN20 G1 Z-20 F100\nN30 X40\nN40 Z-40\nN50 X60\n";

#[test]
fn roughing_leaves_the_allowances_and_goes_on_behind_the_profile() {
    let text =
        format!("G98\nG0 X62 Z2\nG71 U2.5 R0.5\nG71 P10 Q50 U0.6 W0.3 F300\n{PROFILE}G0 X80\n");
    let ways = ways(&text);
    let corners = [[10.3, -19.7], [20.3, -19.7], [20.3, -39.7]];
    for corner in corners {
        assert!(ways.iter().any(|(end, _)| *end == corner), "{corner:?}");
    }
    // Nothing is cut deeper than the profile with its allowances.
    let depth = |z: f64| if z > -19.7 - 1e-9 { 10.3 } else { 20.3 };
    let too_deep = ways.iter().find(|(end, _)| end[0] < depth(end[1]) - 1e-6);
    assert_eq!(too_deep, None);
    // The passes are 2.5 deep.
    let level = ways
        .iter()
        .filter(|(_, rapid)| !rapid)
        .map(|(end, _)| end[0]);
    assert!(level.clone().any(|x| (x - 28.5).abs() < 1e-9));
    assert_eq!(ways[ways.len() - 2].0, [31.0, 2.0]);
    assert_eq!(ways[ways.len() - 1].0, [40.0, 2.0]);
    let one_block = format!("G98\nG0 X62 Z2\nG71 P10 Q50 U0.6 W0.3 D2500 F300\n{PROFILE}G0 X80\n");
    assert_eq!(self::ways(&one_block), ways);
}

#[test]
fn finishing_executes_the_profile_and_comes_back() {
    let text = format!(
        "G98\nG0 X62 Z2\nG71 U2.5 R0.5\nG71 P10 Q50 U0.6 W0.3 F300\n{PROFILE}G70 P10 Q50\nG0 X80\n"
    );
    let ends = ends(&text);
    let finish = [
        [10.0, 2.0],
        [10.0, -20.0],
        [20.0, -20.0],
        [20.0, -40.0],
        [30.0, -40.0],
        [31.0, 2.0],
        [40.0, 2.0],
    ];
    assert_eq!(ends[ends.len() - 7..], finish);
    finds(
        "G98\nG71 P10 Q50 U0.6 F300\nN10 G0 X1\nN50 G1 Z-1",
        &["2:1 missing-word"],
    );
    finds("G98\nG70 P10 Q50", &["2:5 flow-structure"]);
}

#[test]
fn what_a_cycle_along_a_profile_would_leave_undone_is_refused() {
    finds("G98\nG71 U2.5 R0.5 M8", &["2:1 not-supported"]);
    finds("G98\nG71 P10 Q50 U0.6 F300 T0101", &["2:23 not-supported"]);
    finds("G98\nG70 P10 Q50 M8", &["2:1 not-supported"]);
    // A corner in front of it has no second move.
    finds(
        "G98\nG0 X62 Z2\nG1 X60 F300 ,R2\nG71 U2 R1",
        &["4:1 not-supported"],
    );
    // The passes would be those of the values from before the profile.
    finds(
        "G98\nG0 X62 Z2\nG71 U2 R1\nG71 P10 Q50 U0 F300\nN10 G0 X20\n#1=40\nN50 G1 X#1 F100",
        &["6:1 not-supported"],
    );
}

#[test]
fn grooves_and_holes_go_by_depths() {
    let drill = ends("G98\nG0 X0 Z2\nG74 R1\nG74 Z-10 Q5000 F300");
    assert_eq!(
        drill,
        [
            [0.0, 2.0],
            [0.0, -3.0],
            [0.0, -2.0],
            [0.0, -8.0],
            [0.0, -7.0],
            [0.0, -10.0],
            [0.0, 2.0]
        ]
    );
    let groove = ends("G98\nG0 X22 Z-5\nG75 R0.5\nG75 X16 P2000 F100");
    assert_eq!(
        groove,
        [
            [11.0, -5.0],
            [9.0, -5.0],
            [9.5, -5.0],
            [8.0, -5.0],
            [11.0, -5.0]
        ]
    );
    // R is the way from the initial level, to which the tool comes back.
    let hole = ends("G98\nG97 S600 M3\nG0 X0 Z10\nG83 Z-30 R-8 Q20000 F200");
    assert_eq!(hole[1], [0.0, 2.0]);
    assert_eq!(hole[2], [0.0, -18.0]);
    assert_eq!(hole[hole.len() - 2..], [[0.0, -30.0], [0.0, 10.0]]);
}

#[test]
fn the_speed_of_the_spindle_is_limited() {
    let speeds: Vec<_> = Program::new(
        "G50 S4000\nG96 S150 M3\nG0 X40 Z0\nX0".as_bytes(),
        options(),
    )
    .filter_map(|item| match item.expect("a sound program").kind {
        ItemKind::Event(Event::SpindleSpeed(speed)) => Some(speed.round()),
        _ => None,
    })
    .collect();
    // 150 m/min on 40 mm, then at the centre.
    assert_eq!(speeds[speeds.len() - 2..], [1194.0, 4000.0]);
}

#[test]
fn what_is_in_doubt_or_of_another_system_is_refused() {
    finds("G1 X5 F0.2", &["1:7 ambiguous-word"]);
    finds("G77 X5", &["1:1 not-supported"]);
    finds("G91 G0 X5", &["1:1 not-supported"]);
    finds("G34 Z-5 F1", &["1:1 not-supported"]);
    finds("G92 S2000", &["1:1 missing-word"]);
    // A mill with X and Z alone.
    let mill = Options {
        fanuc: FanucParameters {
            control: Some(FanucControl::Mill),
            ..FanucParameters::default()
        },
        ..options()
    };
    let report = check("G91 G0 X5".as_bytes(), mill);
    assert!(report.is_accepted() && report.final_position[0] == 5.0);
}

#[test]
fn a_program_that_may_be_of_two_lathes_is_refused_before_it_moves() {
    let text = "G21\nG0 X52 Z2\n  G90 X48 Z-30 F200\nM2\n";
    let machine = Machine::new(&[Axis::X, Axis::Z]);
    let found = Dialect::detect(text.as_bytes(), &machine);
    let options = |question| Options {
        dialect: found.dialect,
        question,
        machine,
        ..Options::default()
    };
    let report = check(text.as_bytes(), options(found.question.clone()));
    let told: Vec<_> = report
        .diagnostics
        .iter()
        .map(|d| (d.line, d.column, d.length, d.code.as_str()))
        .collect();
    assert_eq!(told, [(3, 3, 17, "undecided-dialect")]);
    assert!(report.diagnostics[0].help.contains("--dialect fanuc"));
    let mut program = Program::new(text.as_bytes(), options(found.question));
    assert!(program.next().is_some_and(|item| item.is_err()));
    assert!(program.next().is_none());
    // Somebody has said whose it is.
    assert!(check(text.as_bytes(), options(None)).is_accepted());
}

#[test]
fn a_lathe_tells_itself() {
    for text in [
        "G50 S3000\n",
        "T0101\n",
        "G71 U2. R1.\n",
        "%\nO1002\nG0 Z5.\nG83 Z-6. R2. Q3. P500\n",
    ] {
        assert_eq!(
            Dialect::detect(text.as_bytes(), &Machine::unlimited()).dialect,
            Dialect::Fanuc,
            "{text}"
        );
    }
    for text in [
        "G71 Q100 D1\n",
        "T1 M6\n",
        "G83 Z-6 R2 Q3 P500\n",
        "%\nO1\nG4 P2\n",
    ] {
        assert_eq!(
            Dialect::detect(text.as_bytes(), &Machine::unlimited()).dialect,
            Dialect::LinuxCnc,
            "{text}"
        );
    }
}
