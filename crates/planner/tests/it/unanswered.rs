//! A program that was left at a code that nobody had answered: it is told again, and waited for again.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test that fails may panic"
)]

use crate::support::items::settings;
use glidepath_gcode::{MCodes, Options, WaitsAt};
use glidepath_geometry::AxisVector;
use glidepath_link::Auxiliary;
use glidepath_planner::{
    ItemSource, Output, Pipeline, ProgramSource, Remainder, ResumeError, ResumePoint, Supply,
};
use glidepath_program::{CodeWord, Event, ItemKind};

/// A text as if it were a file.
#[derive(Debug)]
struct Text(ProgramSource<&'static [u8]>);

impl Text {
    fn new(text: &'static str) -> Self {
        let mut m_codes = MCodes::default();
        m_codes.declare_waiting(110, 110, WaitsAt::Code);
        m_codes.declare_waiting(120, 120, WaitsAt::NextFeed);
        let options = Options {
            m_codes: m_codes.into(),
            ..Options::default()
        };
        Self(ProgramSource::new(text.as_bytes(), options))
    }
}

impl ItemSource for Text {
    fn next_item(&mut self) -> Supply {
        self.0.next_item()
    }

    fn lines_read(&self) -> u64 {
        self.0.lines_read()
    }

    fn fingerprint(&self) -> u64 {
        7
    }
}

/// The rest of a program of which X1 is the first move, left at the n-th of its items behind that.
fn left(text: &'static str, item: u32, unanswered: bool) -> Remainder<Text> {
    let mut position = AxisVector::zeros();
    position[0] = 1.0;
    let point = ResumePoint {
        line: 0,
        position,
        program_start: AxisVector::zeros(),
        program: 7,
        block: 1 + item,
        path_s: 1.0,
        block_path_s: 1.0,
        unanswered,
        found: None,
    };
    Remainder::find(Text::new(text), point, 0.02).unwrap()
}

/// Its first items: events, and moves as `None`.
fn begins(mut rest: Remainder<Text>, count: usize) -> Vec<Option<Event>> {
    let next = |_| match rest.next_item() {
        Supply::Item(item) => match item.kind {
            ItemKind::Event(event) => Some(event),
            _ => None,
        },
        other => panic!("{other:?}"),
    };
    (0..count).map(next).collect()
}

const TOOL: &str = "G21 G90\nG0 X1\nT2 M6\nM3 S5000\nG1 X30 F600\nM2\n";

#[test]
fn a_tool_change_that_was_not_answered_is_asked_for_again() {
    let (change, speed) = (Some(Event::MCode(6)), Some(Event::SpindleSpeed(5000.0)));
    assert_eq!(begins(left(TOOL, 2, true), 2), [change, speed]);
    assert_eq!(begins(left(TOOL, 2, false), 1), [speed]);
    // With the tool that it has selected, whatever was selected since.
    let mut now = Auxiliary::default();
    now.take(Event::SelectTool(5));
    let restoring = left(TOOL, 2, true).restoring(&now);
    assert_eq!(restoring, Ok(vec![Event::SelectTool(2)]));
}

#[test]
fn what_waits_is_waited_for_again_whatever_it_is() {
    for (text, event) in [
        (
            "G21 G90\nG0 X1\nM0\nG1 X30 F600\nM2\n",
            Event::ProgramStop(0),
        ),
        ("G21 G90\nG0 X1\nM3\nG1 X30 F600\nM2\n", Event::MCode(3)),
        ("G21 G90\nG0 X1\nM110\nG1 X30 F600\nM2\n", Event::MCode(110)),
    ] {
        assert_eq!(begins(left(text, 1, true), 2), [Some(event), None]);
        assert_eq!(begins(left(text, 1, false), 1), [None]);
    }
}

#[test]
fn a_code_of_the_machine_s_own_is_told_again_with_its_words() {
    const OWN: &str = "G21 G90\nG0 X1\nM110 P7\nG1 X30 F600\nM2\n";
    let words = Event::CodeWord {
        word: CodeWord::P,
        value: 7.0,
    };
    let expected = [Some(words), Some(Event::MCode(110)), None];
    assert_eq!(begins(left(OWN, 2, true), 3), expected);
    // Blocks are numbered as before: it can be left again there.
    let mut pipeline = Pipeline::resuming(left(OWN, 2, true), settings());
    let mut told = Vec::new();
    loop {
        match pipeline.advance().unwrap() {
            Output::Item(item) => told.push((item.block, item.kind)),
            Output::End => break,
            Output::Frame(_) | Output::Pending => {}
        }
    }
    let of_code = told
        .iter()
        .find(|(_, kind)| *kind == ItemKind::Event(Event::MCode(110)));
    assert_eq!(of_code.unwrap().0, 3);
}

#[test]
fn a_code_that_is_waited_for_later_is_told_again_where_it_waits() {
    const LATER: &str = "G21 G90\nG0 X1\nM120 P3\nG0 X1 Y0\nG1 X30 F600\nM2\n";
    let all = begins(left(LATER, 2, false), 2);
    let gate = all
        .iter()
        .position(|event| *event == Some(Event::Await(120)));
    let gate = u32::try_from(gate.unwrap()).unwrap() + 3;
    let words = Event::CodeWord {
        word: CodeWord::P,
        value: 3.0,
    };
    let told = [words, Event::MCode(120), Event::Await(120)].map(Some);
    assert_eq!(begins(left(LATER, gate, true), 3), told);
    assert_eq!(begins(left(LATER, gate, false), 1), [None]);
}

#[test]
fn with_another_tool_than_it_was_left_with_nothing_goes_on() {
    let mut now = Auxiliary::default();
    now.take(Event::SelectTool(2));
    now.take(Event::MCode(6));
    // Behind the change, in front of the spindle.
    let rest = || left(TOOL, 3, false);
    assert!(rest().restoring(&now).is_ok());
    now.take(Event::SelectTool(5));
    now.take(Event::MCode(6));
    let refused = rest().restoring(&now).unwrap_err();
    let (tool, expected) = (5, 2);
    assert_eq!(refused, ResumeError::OtherTool { tool, expected });
    let text = refused.to_string();
    assert!(text.contains("`glidepath mdi 'T2 M6'`"), "{text}");
    // A program that has changed none goes on with whatever is in.
    const NONE: &str = "G21 G90\nG0 X1\nM7\nG1 X30 F600\nM2\n";
    assert!(left(NONE, 1, false).restoring(&now).is_ok());
}
