//! M codes of the machine, what a program says to people, and inputs that are asked.

#![allow(clippy::expect_used, clippy::float_cmp, reason = "a test")]

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Input, InputWait, MCodes, Options, Program, Remark, RemarkKind, WaitFor, check,
};
use glidepath_program::{Event, Item, ItemKind};

fn options() -> Options {
    let mut m_codes = MCodes::default();
    m_codes.declare(100, 199);
    m_codes.declare(428, 428);
    Options {
        m_codes: Arc::new(m_codes),
        default_feed_mm_min: Some(600.0),
        ..Options::default()
    }
}

fn events(text: &str, options: Options) -> Vec<Event> {
    let items = Program::new(text.as_bytes(), options);
    let kinds = items.map(|item| item.expect("a sound program").kind);
    kinds
        .filter_map(|kind| match kind {
            ItemKind::Event(event) => Some(event),
            _ => None,
        })
        .collect()
}

#[test]
fn declared_codes_are_events_and_others_are_refused() {
    let told = events("M100\nG0 X1\nM428 G0 X2\nM199\nM2\n", options());
    assert_eq!(told, [100, 428, 199].map(Event::MCode));
    for (text, code) in [("M200\n", "M200"), ("M427\n", "M427")] {
        let report = check(text.as_bytes(), options());
        assert_eq!(report.diagnostics.len(), 1, "{text}");
        assert!(report.diagnostics[0].message.contains(code));
    }
    let undeclared = check("M100\n".as_bytes(), Options::default());
    assert_eq!(undeclared.diagnostics.len(), 1);
    // Nothing that stands beside a code is skipped.
    assert_eq!(
        check("M100 P5\n".as_bytes(), options()).diagnostics.len(),
        1
    );
    assert_eq!(
        check("M100 M428\n".as_bytes(), options()).diagnostics.len(),
        1
    );
    for code in [3, 6, 30, 66, 98] {
        assert!(!MCodes::is_free(code), "M{code}");
    }
}

#[test]
fn a_new_speed_is_told_at_rest_where_it_is_waited_for() {
    let text = "S1000\nM3\nG0 X1\nS2000\nG1 X2\nM4 S500\nM5\nS100\nM2\n";
    let waits = Options {
        waits_for_speed: true,
        ..options()
    };
    let codes = |events: Vec<Event>| -> Vec<u32> {
        let code = |event| match event {
            Event::MCode(code) => Some(code),
            _ => None,
        };
        events.into_iter().filter_map(code).collect()
    };
    assert_eq!(codes(events(text, options())), [3, 4, 5]);
    assert_eq!(codes(events(text, waits)), [3, 3, 4, 5]);
}

#[test]
fn remarks_are_kept_for_whoever_asks() {
    let text = "(just a comment)\n(MSG, change the fixture)\nG0 X1\n#7=2.5\n\
                (DEBUG, seven is #7, #<_x> and #)\nM0 (turn the part)\n( msg,again)\nM2\n";
    let mut program = Program::new(text.as_bytes(), options()).with_remarks();
    let items = program.by_ref().count();
    let said: Vec<(u32, RemarkKind, String)> = program
        .take_remarks()
        .into_iter()
        .map(|Remark { line, kind, text }| (line, kind, text))
        .collect();
    let expected = [
        (2, RemarkKind::Message, "change the fixture"),
        (5, RemarkKind::Debug, "seven is 2.500000, 1.000000 and #"),
        (6, RemarkKind::Stop, "turn the part"),
        (7, RemarkKind::Message, "again"),
    ];
    let expected = expected.map(|(line, kind, text)| (line, kind, text.to_owned()));
    assert_eq!((items, said), (2, expected.to_vec()));
    let mut deaf = Program::new(text.as_bytes(), options());
    assert_eq!((deaf.by_ref().count(), deaf.take_remarks().len()), (2, 0));
}

#[test]
fn an_input_decides_what_follows() {
    let text = "M66 P2 L3 Q1.5\no1 if [#5399 EQ 1]\nG1 X5\no1 else\nG1 X-5\no1 endif\nM2\n";
    for (answer, x) in [(1.0, 5.0), (-1.0, -5.0)] {
        let real = Options {
            connections: Connections::Real,
            ..options()
        };
        let mut program = Program::new(text.as_bytes(), real);
        let first = program.next().expect("an item").expect("a sound program");
        assert_eq!(first.kind, ItemKind::Event(Event::MCode(66)));
        let wait = program.take_input_wait();
        let expected = InputWait {
            input: Input::Digital(2),
            until: WaitFor::High,
            limit_s: 1.5,
        };
        assert_eq!(wait, Some(expected));
        assert_eq!(program.take_input_wait(), None);
        program.answer_input(answer);
        let rest: Vec<Item> = program.map(|item| item.expect("sound")).collect();
        let ends: Vec<f64> = rest
            .iter()
            .filter_map(|item| match item.kind {
                ItemKind::Move { segment, .. } => Some(segment.end()[0]),
                _ => None,
            })
            .collect();
        assert_eq!(ends, [x]);
    }
    // There is no probe among real inputs.
    let real = Options {
        connections: Connections::Real,
        ..options()
    };
    let report = check("G38.2 Z-5 F100\n".as_bytes(), real);
    assert!(report.diagnostics[0].message.contains("no probe"));
}
