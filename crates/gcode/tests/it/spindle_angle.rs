//! M19: the angle, the way there and the time that it may take reach whoever turns the spindle, or are refused.

use glidepath_gcode::{Connections, MCodes, Options, Program, check};
use glidepath_program::{CodeWord, Event, ItemKind, OrientWay};
use std::sync::Arc;

fn options(orients: bool, waits: bool) -> Options {
    let mut m_codes = MCodes::default();
    if waits {
        m_codes.declare(19, 19);
    }
    Options {
        connections: Connections::Real,
        orients,
        m_codes: Arc::new(m_codes),
        ..Options::default()
    }
}

fn told(text: &str, options: Options) -> Vec<Event> {
    let items = Program::new(text.as_bytes(), options).map(|item| item.expect("a sound program"));
    items
        .filter_map(|item| match item.kind {
            ItemKind::Event(event) => Some(event),
            _ => None,
        })
        .filter(|event| *event != Event::MCode(2))
        .collect()
}

const fn at(deg: f64, way: OrientWay) -> Event {
    Event::SpindleAngle { deg, way }
}

#[test]
fn the_angle_the_way_and_the_time_are_told() {
    for (text, deg, way, within) in [
        ("M19", 0.0, OrientWay::Shortest, None),
        ("M19 R0", 0.0, OrientWay::Shortest, None),
        ("M19 R90.5", 90.5, OrientWay::Shortest, None),
        ("M19 R360 P0", 360.0, OrientWay::Shortest, None),
        ("M19 R30 P1 Q2.5", 30.0, OrientWay::Clockwise, Some(2.5)),
        ("M19 P2", 0.0, OrientWay::Counterclockwise, None),
    ] {
        let word = within.map(|value| Event::CodeWord {
            word: CodeWord::Q,
            value,
        });
        let mut meant = vec![at(deg, way)];
        meant.extend(word);
        meant.push(Event::MCode(19));
        let found = told(&format!("{text}\nM2\n"), options(true, true));
        assert_eq!(found, meant, "{text}");
    }
    // One that stops where it stops by itself is told no angle.
    let plain = told("M19 Q3\nM2\n", options(false, true));
    let word = CodeWord::Q;
    let q = Event::CodeWord { word, value: 3.0 };
    assert_eq!(plain, [q, Event::MCode(19)]);
}

fn refuses_with(text: &str, options: Options, code: &str) {
    let report = check(format!("{text}\nM2\n").as_bytes(), options);
    let found = crate::support::listed(&report);
    let is_it = |found: &String| found.starts_with("1:") && found.ends_with(code);
    assert!(found.first().is_some_and(is_it), "{text}: {found:?}");
}

#[test]
fn what_would_not_come_to_the_spindle_is_refused() {
    let not_turned = options(false, true);
    for text in ["M19 R90", "M19 R0", "M19 P1", "M19 R30 P1 Q1"] {
        refuses_with(text, not_turned.clone(), "not-connected");
    }
    refuses_with("M19 R30 Q1", options(true, false), "not-connected");
    for text in ["M19 R-1", "M19 R360.5", "M19 P3", "M19 Q0", "M19 Q-1"] {
        refuses_with(text, options(true, true), "invalid-value");
    }
}
