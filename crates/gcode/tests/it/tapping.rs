//! Rigid tapping: G33.1, G84 and G74, M29.

use std::sync::Arc;

use crate::support::listed;
use glidepath_gcode::{Dialect, MCodes, Options, Program, Threading, check};
use glidepath_program::{Event, ItemKind, Limits, Rate};

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
        items("S600\nM29\nG98 G74 Z-10 R2 F600", fanuc()),
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
