//! Tests of rigid tapping: G33.1, G84 and G74, M29.

use std::sync::Arc;

use crate::support::listed;
use glidepath_gcode::{
    AxisTravel, Dialect, MCodes, Machine, Options, Program, SpindleAxis, Threading, check,
};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::{Event, ItemKind, Limits, PathMode, Rate};

fn options(dialect: Dialect, rigid_tapping: bool, spindle_a: Option<f64>) -> Options {
    Options {
        dialect,
        threading: Some(Threading {
            rigid_tapping,
            spindle_a,
            ..Threading::new(Limits::uniform(200.0, 2_000.0, 40_000.0), 0.004)
        }),
        ..Options::default()
    }
}

/// What a program gives out: taps with the way of a revolution and the depth in mm, Z of moves.
fn items(text: &str, options: Options) -> String {
    let shown = Program::new(text.as_bytes(), options).map(|item| {
        match item.unwrap_or_else(|found| panic!("{text}\n{found}")).kind {
            ItemKind::Event(Event::Tap {
                axis,
                pitch_mm,
                depth_um,
            }) => {
                assert_eq!(axis, 2);
                format!("tap({pitch_mm},{})", f64::from(depth_um) / 1e3)
            }
            ItemKind::Event(Event::MCode(code)) => format!("M{code}"),
            ItemKind::Event(Event::SpindleSpeed(speed)) => format!("S{speed}"),
            ItemKind::Move { segment, rate, .. } => {
                let kind = if rate == Rate::Rapid { 'r' } else { 'f' };
                format!("{kind}{}", segment.end()[2])
            }
            ItemKind::Dwell(seconds) => format!("dwell{seconds}"),
            other => format!("{other:?}"),
        }
    });
    shown.collect::<Vec<_>>().join(" ")
}

#[track_caller]
fn finds(text: &str, options: Options, expected: &[&str]) {
    let report = check(text.as_bytes(), options);
    assert_eq!(listed(&report), expected, "{text}");
    for found in &report.diagnostics {
        assert!(
            !found.reason.is_empty() && !found.help.is_empty(),
            "{found}"
        );
    }
}

#[test]
fn a_rigid_tap_is_an_event_and_the_machine_is_where_it_was() {
    let of = |text: &str, spindle_a| items(text, options(Dialect::LinuxCnc, false, spindle_a));
    assert_eq!(
        of("S600 M3\nG0 Z2\nG33.1 Z-10 K1.25\nG0 Z3", None),
        "S600 M3 r2 tap(-1.25,12) r3"
    );
    // A spindle that stops from 10 rev/s in a revolution is told a revolution before the bottom.
    assert_eq!(
        of("S600 M4\nG0 Z2\nG33.1 Z-10 K1.25", Some(50.0)),
        "S600 M4 r2 tap(-1.25,10.75)"
    );
    assert_eq!(
        of("G20 S600 M3\nG33.1 Z1 K0.05", None),
        "S600 M3 tap(1.27,25.4)"
    );
}

#[test]
fn what_cannot_be_tapped_is_refused() {
    let plain = || options(Dialect::LinuxCnc, false, None);
    for (words, expected) in [
        ("S600 M3\nG33.1 Z-10", "2:1 missing-word"),
        ("S600 M3\nG33.1 Z-10 K0", "2:1 invalid-value"),
        ("S600 M3\nG33.1 Z-10 K1 F100", "2:1 invalid-value"),
        ("S600 M3\nG33.1 X1 Z-10 K1", "2:1 not-supported"),
        ("S600\nG33.1 Z-10 K1", "2:1 spindle"),
        ("S600 M3\nG33.1 Z-0.3 K1", "2:1 invalid-value"),
        ("S600 M3\nG33.1 Z-1100 K1", "2:1 invalid-value"),
    ] {
        finds(words, plain(), &[expected]);
    }
    // The spindle runs on for 5 mm, and goes with the axis as it cannot.
    let slow = options(Dialect::LinuxCnc, false, Some(10.0));
    finds("S600 M3\nG33.1 Z-5.1 K1", slow, &["2:1 invalid-value"]);
    let stiff = options(Dialect::LinuxCnc, false, Some(3_000.0));
    finds("S600 M3\nG33.1 Z-10 K1", stiff, &["2:1 invalid-value"]);
    finds(
        "S600 M3\nG33.1 Z-10 K1",
        Options::default(),
        &["2:1 not-connected"],
    );
}

#[test]
fn the_deepest_that_a_tap_may_go_is_inside_the_travel() {
    let of = |overtravel: f64, spindle_a, lowest: f64| {
        let mut options = options(Dialect::LinuxCnc, true, spindle_a);
        options.threading = options.threading.map(|threading| Threading {
            overtravel,
            ..threading
        });
        options.machine = Machine::unlimited().with_travel(
            Axis::Z,
            AxisTravel {
                min: lowest,
                max: 50.0,
            },
        );
        options
    };
    // Told at 10 mm, and 10 revolutions of 1.25 mm below: 22.5 mm.
    let tap = "S600 M3\nG0 Z2\nG33.1 Z-10 K1.25";
    finds(tap, of(10.0, None, -22.5), &[]);
    finds(tap, of(10.0, None, -22.49), &["3:7 soft-limit"]);
    finds(tap, of(2.0, None, -12.5), &[]);
    // Told a revolution before.
    finds(tap, of(10.0, Some(50.0), -21.25), &[]);
    finds(tap, of(10.0, Some(50.0), -21.24), &["3:7 soft-limit"]);
    // Upwards there is less room, and the other way round, in a cycle.
    let up = "S600 M3\nG0 Z30\nG33.1 Z40 K1.25";
    finds(up, of(8.0, None, -100.0), &[]);
    finds(up, of(8.01, None, -100.0), &["3:7 soft-limit"]);
    let cycle = "F750 S600 M4\nG0 Z2\nG74 Z-10 R2";
    finds(cycle, of(10.0, None, -22.5), &[]);
    finds(cycle, of(10.0, None, -22.49), &["3:5 soft-limit"]);
    let report = check(tap.as_bytes(), of(10.0, None, -15.0));
    let told = report.diagnostics[0].to_string();
    assert!(
        told.contains("overtravel") && told.contains("-22.5 mm"),
        "{told}"
    );
}

#[test]
fn a_spindle_that_runs_on_for_longer_than_a_tap_may_go_is_refused() {
    let of = |overtravel: f64, spindle_a| {
        let mut options = options(Dialect::LinuxCnc, false, spindle_a);
        options.threading = options.threading.map(|threading| Threading {
            overtravel,
            ..threading
        });
        options
    };
    let tap = "S600 M3\nG33.1 Z-30 K1";
    // A revolution, and 0.28 for the tap: 0.18 to stop, and two periods.
    finds(tap, of(1.3, Some(50.0)), &[]);
    finds(tap, of(1.25, Some(50.0)), &["2:1 invalid-value"]);
    finds(tap, of(0.3, None), &[]);
    finds(tap, of(0.25, None), &["2:1 invalid-value"]);
    finds(tap, of(10.0, Some(5.0)), &["2:1 invalid-value"]);
}

#[test]
fn cycles_tap_rigidly_where_the_machine_does() {
    let right = "F600 S600 M3\nG0 Z5\nG84 Z-10 R2\nX10\nG80";
    assert_eq!(
        items(right, options(Dialect::LinuxCnc, true, None)),
        "S600 M3 r5 r2 tap(-1,12) r5 r5 r2 tap(-1,12) r5"
    );
    // By the way of a revolution, and the other way round.
    assert_eq!(
        items(
            "G95 F1.5 S600 M4\nG0 Z5\nG99 G74 Z-10 R2",
            options(Dialect::LinuxCnc, true, Some(50.0))
        ),
        "S600 M4 r5 r2 tap(-1.5,10.5)"
    );
    // In a holder that gives way.
    assert_eq!(
        items(
            "F600 S600 M3\nG84 Z-10 R2",
            options(Dialect::LinuxCnc, false, None)
        ),
        "S600 M3 r2 M49 f-10 M4 dwell0 f2 M3 M48"
    );
    let rigid = || options(Dialect::LinuxCnc, true, None);
    finds("F600 S600 M4\nG84 Z-10 R2", rigid(), &["2:1 spindle"]);
    finds(
        "F600 S600 M3\nG84 Z-10 R2 P1",
        rigid(),
        &["2:13 not-supported"],
    );
    finds("S600 M3\nG84 Z-10 R2", rigid(), &["2:1 missing-feed"]);
}

#[test]
fn fanuc_s_m29_is_of_the_next_series_of_holes() {
    let fanuc = || options(Dialect::Fanuc, false, None);
    // The spindle stands until it taps, and between the holes.
    let text = "M3 S300\nM29 S600\nG0 Z5\nG99 G84 Z-10 R2 F600\nX10\nG80\nM3\nG84 Z-10 R2";
    assert_eq!(
        items(text, fanuc()),
        "S300 M3 S600 M5 r5 r2 M3 tap(-1,12) M5 r2 M3 tap(-1,12) M5 M3 \
         M49 f-10 M4 dwell0 f2 M3 M48"
    );
    assert_eq!(
        items("S600\nM29\nG99 G74 Z-10 R2 F600", fanuc()),
        "S600 r2 M4 tap(-1,12) M5"
    );
    let deep = "S600\nM29\nG84 Z-10 R2 Q3 F600";
    finds(deep, fanuc(), &["3:13 not-supported"]);
    let unknown = Options {
        dialect: Dialect::Fanuc,
        ..Options::default()
    };
    finds("M29 S600", unknown, &["1:1 not-connected"]);
    // A machine may have an M29 of its own.
    let mut m_codes = MCodes::default();
    m_codes.declare(29, 29);
    let own = Options {
        m_codes: Arc::new(m_codes),
        ..fanuc()
    };
    assert_eq!(items("M29 S600", own), "S600 M29");
    finds(
        "M29",
        options(Dialect::LinuxCnc, false, None),
        &["1:1 unknown-m-code"],
    );
}

/// A machine whose spindle is the axis C, which turns 3000 rev/min at most.
fn with_axis(dialect: Dialect, rigid_tapping: bool) -> Options {
    let mut limits = Limits::uniform(200.0, 2_000.0, 40_000.0);
    limits.velocity[5] = 18_000.0;
    Options {
        dialect,
        spindle_axis: Some(SpindleAxis {
            axis: Axis::C,
            limits,
            rigid_tapping,
        }),
        ..Options::default()
    }
}

/// As [`items`], of moves Z and C where C moves, with the speed in mm/min.
fn moves(text: &str, options: Options) -> String {
    let mut at = AxisVector::zeros();
    let shown = Program::new(text.as_bytes(), options).map(|item| {
        match item.unwrap_or_else(|found| panic!("{text}\n{found}")).kind {
            ItemKind::Event(Event::MCode(code)) => format!("M{code}"),
            ItemKind::Event(Event::SpindleSpeed(speed)) => format!("S{speed}"),
            ItemKind::Dwell(0.0) => "stop".to_owned(),
            ItemKind::Dwell(seconds) => format!("dwell{seconds}"),
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => {
                assert_eq!(segment.start(), at);
                let turns = segment.end()[5] != at[5];
                at = segment.end();
                match rate {
                    Rate::FeedUpTo { feed_v, most_v } => {
                        assert_eq!((feed_v, mode), (most_v, PathMode::ExactStop));
                        format!("({},{})f{:.0}", at[2], at[5], feed_v * 60.0)
                    }
                    _ if turns => format!("c{}", at[5]),
                    rate => format!("{}{}", if rate.is_rapid() { 'r' } else { 'f' }, at[2]),
                }
            }
            other => format!("{other:?}"),
        }
    });
    shown.collect::<Vec<_>>().join(" ")
}

#[test]
fn a_spindle_that_is_an_axis_taps_by_straight_moves() {
    let of = |text: &str| moves(text, with_axis(Dialect::LinuxCnc, false));
    // It stands before, and turns again before the next move.
    assert_eq!(
        of("S600 M3\nG0 Z2\nG33.1 Z-10 K1.25\n(again)\nG33.1 Z-1 K0.5\nG0 Z3"),
        "S600 M3 r2 M5 stop (-10,3456)f750 stop (2,0)f750 stop (-1,2160)f300 stop (2,0)f300 M3 r3"
    );
    assert_eq!(
        of("S600 M3\nG33.1 Z-10 K1\nG1 F100 Z1\nG33.1 Z-9 K1\nM5\nG0 Z3"),
        "S600 M3 M5 stop (-10,3600)f600 stop (0,0)f600 M3 f1 M5 stop (-9,3600)f600 stop (1,0)f600 M5 r3"
    );
    // One that stands is told by the sign of the pitch, one that turns left goes in to the left.
    assert_eq!(
        of("S600 M5\nG33.1 Z-1 K-0.5"),
        "S600 M5 stop (-1,-720)f300 stop (0,0)f300"
    );
    assert_eq!(
        of("S600 M4\nG33.1 Z-1 K0.5"),
        "S600 M4 M5 stop (-1,-720)f300 stop (0,0)f300"
    );
    // In depths, back by a millimetre or all the way, faster out than in, and with a rest.
    assert_eq!(
        of("S600\nG33.1 Z-5 K1 Q2 R1 I2 P0.5"),
        "S600 M5 stop (-2,720)f600 (-1,360)f1200 (-4,1440)f600 (-3,1080)f1200 (-5,1800)f600 dwell0.5 \
         (0,0)f1200"
    );
    // Along any straight way.
    assert_eq!(
        of("S600\nG33.1 X3 Z-4 K1"),
        "S600 M5 stop (-4,1800)f600 stop (0,0)f600"
    );
    assert_eq!(
        of("G20 S600\nG33.1 Z-1 K0.05 Q0.5"),
        "S600 M5 stop (-12.7,3600)f762 (0,0)f762 (-25.4,7200)f762 stop (0,0)f762"
    );
}

#[test]
fn cycles_tap_by_the_axis_of_the_spindle() {
    assert_eq!(
        moves(
            "F600 S600 M3\nG0 Z5\nG99 G84 Z-8 R2 P0.1\nX10\nG80\nM3\nG1 Z1",
            with_axis(Dialect::LinuxCnc, true)
        ),
        "S600 M3 r5 r2 M5 stop (-8,3600)f600 dwell0.1 (2,0)f600 r2 stop (-8,3600)f600 dwell0.1 (2,0)f600 \
         M3 f1"
    );
    // M29 needs no table of a machine that taps rigidly, and has it stand afterwards.
    assert_eq!(
        moves(
            "M3 S300\nM29 S600\nG99 G84 Z-8 R2 Q4 P1 F600\nG80\nG0 Z5",
            with_axis(Dialect::Fanuc, false)
        ),
        "S300 M3 S600 M5 r2 stop (-2,1440)f600 (2,0)f600 (-6,2880)f600 (2,0)f600 (-8,3600)f600 \
         dwell0.001 (2,0)f600 r5"
    );
    assert_eq!(
        moves(
            "G95 F1.5 S600\nG74 Z-8 R1",
            with_axis(Dialect::LinuxCnc, true)
        ),
        "S600 r1 M5 stop (-8,-2160)f900 stop (1,0)f900"
    );
    // Without M29 or `rigid_tapping` the tap is in a holder.
    assert_eq!(
        moves(
            "F600 S600 M3\nG84 Z-8 R2",
            with_axis(Dialect::LinuxCnc, false)
        ),
        "S600 M3 r2 M49 f-8 M4 stop f2 M3 M48"
    );
}

#[test]
fn what_a_spindle_that_is_an_axis_cannot_do_is_refused() {
    let axis = || with_axis(Dialect::LinuxCnc, true);
    for (words, expected) in [
        // 3001 rev/min, and 200 mm/s of Z.
        ("S3001\nG33.1 Z-10 K1", "2:1 invalid-value"),
        ("S3000\nG33.1 Z-10 K1 I1.1", "2:1 invalid-value"),
        ("S2500\nG33.1 Z-10 K5", "2:1 invalid-value"),
        ("G33.1 Z-10 K1", "1:1 spindle"),
        ("S600 M3\nG33.1 Z-10 K-1", "2:1 invalid-value"),
        ("S600\nG33.1 Z-10 K0", "2:1 invalid-value"),
        ("S600\nG33.1 Z-10 K1 Q0", "2:15 invalid-value"),
        ("S600\nG33.1 Z-10 K1 Q0.0001", "2:1 invalid-value"),
        ("S600\nG33.1 Z-10 K1 P-1", "2:15 invalid-value"),
        ("S600\nG33.1 A1 Z-10 K1", "2:1 not-supported"),
        ("S600\nG33.1 C90 K1", "2:1 not-supported"),
        ("S600 M3\nG0 C90", "2:4 spindle"),
        ("S600 M3\nG91 G1 F100 X1 C90", "2:16 spindle"),
        ("S600 M3\nG33.1 Z-1 K1\nG0 C90", "3:4 spindle"),
        ("S600 M4\nF600 G84 Z-10 R2", "2:6 spindle"),
    ] {
        finds(words, axis(), &[expected]);
    }
    finds("S600 M3\nM5\nG0 C90\nG28", axis(), &[]);
    finds("S600 M3\nG0 X1 C0\nG28\nG92 C5", axis(), &[]);
    // A thread follows the angle, which nobody tells here.
    finds("S600 M3\nG33 Z-10 K1", axis(), &["2:1 not-connected"]);
    // What follows a spindle goes in once, and a tap in a holder too.
    let followed = options(Dialect::LinuxCnc, false, None);
    finds(
        "S600 M3\nG33.1 Z-10 K1 Q2",
        followed,
        &["2:15 not-supported"],
    );
    let holder = options(Dialect::Fanuc, false, None);
    finds(
        "S600 M3\nG84 Z-10 R2 Q3 F600",
        holder,
        &["2:13 not-supported"],
    );
}
