//! Tests of M codes of the machine, what a program says to people, and inputs that are asked.

#![allow(clippy::expect_used, clippy::float_cmp, reason = "a test")]

use std::sync::Arc;

use glidepath_gcode::{
    AdaptiveFeed, Connections, DiagnosticCode, Dialect, Input, InputWait, MCodes, Options, Program,
    Remark, RemarkKind, WaitFor, WaitsAt, check,
};
use glidepath_program::{CodeWord, Event, Item, ItemKind};

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
        check("M100 R5\n".as_bytes(), options()).diagnostics.len(),
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
fn the_words_of_a_code_come_in_front_of_it() {
    let told = events("G90\nM100 Q-2.5 P[1+2]\nM428 P0\nM2\n", options());
    let word = |word, value| Event::CodeWord { word, value };
    let expected = [
        word(CodeWord::P, 3.0),
        word(CodeWord::Q, -2.5),
        Event::MCode(100),
        word(CodeWord::P, 0.0),
        Event::MCode(428),
    ];
    assert_eq!(told, expected);
    // Two codes that both take P.
    let report = check("M100 G4 P1\n".as_bytes(), options());
    assert!(report.diagnostics[0].message.contains("which code the P"));
}

/// What a program comes to, in short.
fn kinds_of(text: &str, options: Options) -> Vec<String> {
    let items = Program::new(text.as_bytes(), options);
    let kinds = items.map(|item| item.expect("a sound program").kind);
    kinds
        .map(|kind| match kind {
            ItemKind::Move { rate, .. } if rate.is_rapid() => "rapid".to_owned(),
            ItemKind::Move { .. } => "feed".to_owned(),
            ItemKind::Dwell(_) => "dwell".to_owned(),
            ItemKind::Event(Event::MCode(code) | Event::PassingCode(code)) => format!("M{code}"),
            ItemKind::Event(Event::Await(code)) => format!("wait M{code}"),
            ItemKind::Event(event) => format!("{event:?}"),
        })
        .collect()
}

#[test]
fn codes_are_awaited_in_front_of_the_next_feed_or_at_the_end_of_their_block() {
    let mut m_codes = MCodes::default();
    m_codes.declare_waiting(3, 4, WaitsAt::NextFeed);
    m_codes.declare_waiting(8, 8, WaitsAt::NextFeed);
    m_codes.declare_waiting(110, 110, WaitsAt::BlockEnd);
    m_codes.declare(100, 199);
    let options = Options {
        m_codes: Arc::new(m_codes),
        default_feed_mm_min: Some(600.0),
        connections: Connections::Simulated,
        ..Options::default()
    };
    let expect = |text: &str, expected: &[&str]| {
        assert_eq!(kinds_of(text, options.clone()), expected, "{text}");
    };
    expect(
        "M3\nG0 X5\nM100\nX6\nG4 P1\nG1 X7\nX8\nM5\nM2\n",
        &[
            "M3", "rapid", "M100", "rapid", "dwell", "wait M3", "feed", "feed", "M5",
        ],
    );
    // In a line, and in front of arcs, cycles and searches.
    expect("M3 G1 X1\nM2\n", &["M3", "wait M3", "feed", "M5"]);
    expect("M4\nG2 X2 I1\nM2\n", &["M4", "wait M4", "feed", "M5"]);
    expect("M3\nG38.3 X5\nM2\n", &["M3", "wait M3", "feed", "M5"]);
    expect(
        "M3 M8\nG81 X1 Z-1 R1\nM2\n",
        &[
            "M3", "M8", "rapid", "rapid", "wait M8", "wait M3", "feed", "rapid", "M5", "M9",
        ],
    );
    expect(
        "G1 M110 X1\nX2\nM2\n",
        &["M110", "feed", "wait M110", "feed"],
    );
    expect("G0 M110 X1\nM2\n", &["M110", "rapid", "wait M110"]);
    expect("M110\nM2\n", &["M110", "wait M110"]);
    // What is told again, or is void, is not waited for twice.
    expect(
        "M3\nM4\nG1 X1\nM2\n",
        &["M3", "M4", "wait M4", "feed", "M5"],
    );
    expect(
        "M3\nM5\nM8\nM9\nG1 X1\nM2\n",
        &["M3", "M5", "M8", "M9", "feed"],
    );
    // The end of the program is no feed, and stops what is on.
    expect("M3\nG0 X1\nM2\n", &["M3", "rapid", "M5"]);
    // A line that was typed has to have its answer: the feed may come with the next one.
    expect("M3\nG0 X1\n", &["M3", "rapid", "wait M3"]);
}

#[test]
fn the_feed_follows_an_input_where_there_is_one() {
    let of = |adaptive_feed| Options {
        adaptive_feed,
        ..options()
    };
    let text = "M52 P1\nG1 X1\nM52 P0\nM52\nM2\n";
    let told = events(text, of(AdaptiveFeed::Switched));
    let switched = [1.0, 0.0, 1.0].map(|value| Event::CodeWord {
        word: CodeWord::P,
        value,
    });
    let told: Vec<Event> = told
        .into_iter()
        .filter(|e| *e != Event::MCode(52))
        .collect();
    assert_eq!(told, switched);
    // What is always so, or never, is no event, and cannot be changed.
    for (feed, is_so, is_not) in [
        (AdaptiveFeed::None, "M52 P0\nM2\n", "M52\nM2\n"),
        (AdaptiveFeed::Always, "M52\nM2\n", "M52 P0\nM2\n"),
    ] {
        assert_eq!(events(is_so, of(feed)), []);
        let report = check(is_not.as_bytes(), of(feed));
        assert!(report.diagnostics[0].help.contains("adaptive_feed"));
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

/// A message says that a code can be declared where it can be, and where it helps.
#[test]
fn what_is_said_about_a_code_and_what_may_be_declared_agree() {
    for dialect in [
        Dialect::LinuxCnc,
        Dialect::Marlin,
        Dialect::Fanuc,
        Dialect::Siemens,
    ] {
        for number in 0..=9999 {
            let text = format!("M{number}\n");
            let refused = |declared: bool| {
                let mut m_codes = MCodes::default();
                if declared {
                    m_codes.declare(number, number);
                }
                let options = Options {
                    dialect,
                    m_codes: Arc::new(m_codes),
                    ..Options::default()
                };
                let found = check(text.as_bytes(), options).diagnostics;
                found.into_iter().find(|diagnostic| {
                    matches!(
                        diagnostic.code,
                        DiagnosticCode::UnknownMCode | DiagnosticCode::NotSupported
                    )
                })
            };
            let Some(first) = refused(false) else {
                continue;
            };
            // As the configuration has it, which takes M3 to M9, M19 and M61 besides.
            let is_taken = MCodes::is_free(number) || matches!(number, 3..=9 | 19 | 61);
            let helps = is_taken && refused(true).is_none();
            let says = first.help.contains("[m_codes.");
            assert!(helps || !says, "M{number} of {dialect}: {first}");
            // What a code is on its own control is a better answer than that it may be another one.
            if first.code == DiagnosticCode::UnknownMCode {
                assert_eq!(says, helps, "M{number} of {dialect}: {first}");
            }
        }
        for text in ["M1.5\n", "M10000\n", "M-5\n"] {
            let options = Options {
                dialect,
                ..Options::default()
            };
            let found = check(text.as_bytes(), options).diagnostics;
            assert!(!found.is_empty(), "{text}");
            assert!(
                found.iter().all(|d| !d.help.contains("[m_codes.")),
                "{text}"
            );
        }
    }
}

/// grbl reads over M1 (`gcode.c`: "Optional stop not supported. Ignore."), and so do its senders' lines.
#[test]
fn m1_stops_where_it_is_to() {
    let of = |stops_at_m1| {
        let options = Options {
            stops_at_m1,
            ..Options::default()
        };
        kinds_of("G0 X1\nM1\nX2\nM2\n", options)
    };
    assert_eq!(of(true), ["rapid", "OptionalStop", "rapid"]);
    assert_eq!(of(false), ["rapid", "rapid"]);
}
