//! Tests of M functions of SINUMERIK's programs: several in a block, and those of the machine's builder.

use std::sync::Arc;

use glidepath_gcode::{MCodes, Options, Program, check};
use glidepath_program::{Event, ItemKind};

use super::options;
use crate::support::listed;

fn with_codes() -> Options {
    let mut m_codes = MCodes::default();
    for code in [18, 52, 71, 82, 90, 91, 428] {
        m_codes.declare(code, code);
    }
    Options {
        m_codes: Arc::new(m_codes),
        ..options()
    }
}

fn codes(text: &str) -> Vec<u32> {
    Program::new(text.as_bytes(), with_codes())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Event(Event::PassingCode(code) | Event::MCode(code)) => Some(code),
            _ => None,
        })
        .collect()
}

#[test]
fn a_block_takes_up_to_five() {
    assert_eq!(codes("M90 M71 M18"), [90, 71, 18]);
    assert_eq!(codes("M18 G0 X1 M71"), [18, 71]);
    assert_eq!(codes("M7 M8 M52"), [7, 8, 52]);
    assert_eq!(codes("S100 M3 M8 M90 M71 M82"), [3, 8, 90, 71, 82]);
    assert_eq!(codes("M=90 M1=71\nM18"), [90, 71, 18]);
    for (text, place) in [
        ("S100 M3 M8 M90 M71 M82 M18", "1:24"),
        ("M90 M71 M90", "1:9"),
        ("M90 M71 M71", "1:9"),
        ("S100 M3 M4", "1:9"),
        ("S100 M3 M90 M5", "1:13"),
        ("M90 M428", "1:5"),
        ("M428 M90", "1:6"),
    ] {
        let report = check(text.as_bytes(), with_codes());
        let expected = format!("{place} modal-group-conflict");
        assert_eq!(listed(&report), [expected.as_str()], "{text}");
    }
}
