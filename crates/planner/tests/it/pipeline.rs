//! Tests of programs to frames: what is refused, and what the way of reading must not change.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

use std::io::Write;
use std::time::Duration;

use crate::support::items::{Listed, frames_of, point, polyline, settings, staircase};
use glidepath_gcode::{DiagnosticCode, Options};
use glidepath_geometry::AxisVector;
use glidepath_motion::PlanError;
use glidepath_planner::{
    FileSource, ItemSource, Output, PipeSource, Pipeline, Refusal, RunChannels, Statistics,
};
use glidepath_program::{Frame, FrameFlags, Item};
use proptest::prelude::*;

const PROGRAM: &str = "\
G21 G90 G64 P0.02 F3000
G0 X5 Y5
G1 X20
G3 X30 Y15 I0 J10
G1 Y40 (up)
G4 P0.1
S1000 M3
G61 G1 X0
Y0
M2
";

/// Drives a pipeline to its end, waiting where it is pending.
fn drain<S: ItemSource>(source: S) -> (Vec<Frame>, Statistics, Option<Refusal>) {
    let mut pipeline = Pipeline::new(source, settings(), AxisVector::zeros());
    let mut frames = Vec::new();
    let refusal = loop {
        match pipeline.advance() {
            Ok(Output::Frame(frame)) => frames.push(frame),
            Ok(Output::Item(_)) => {}
            Ok(Output::Pending) => std::thread::sleep(Duration::from_micros(100)),
            Ok(Output::End) => break None,
            Err(refusal) => break Some(refusal),
        }
    };
    assert_eq!(
        pipeline.advance().ok(),
        Some(Output::End),
        "the end comes once"
    );
    (frames, pipeline.statistics(), refusal)
}

fn file(text: &str) -> tempfile::NamedTempFile {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    file
}

#[test]
fn a_file_and_a_pipe_give_the_same_frames() {
    let file = file(PROGRAM);
    let source = FileSource::open(file.path(), Options::default(), &settings()).unwrap();
    let (from_file, statistics, refusal) = drain(source);
    assert!(refusal.is_none(), "{refusal:?}");
    assert_eq!(
        (statistics.lines, statistics.segments, statistics.others),
        (10, 6, 4),
        "the end stops the spindle"
    );
    assert_eq!(statistics.frames, from_file.len() as u64);

    let (reader, mut writer) = std::io::pipe().unwrap();
    let typist = std::thread::spawn(move || {
        for piece in PROGRAM.as_bytes().chunks(7) {
            writer.write_all(piece).unwrap();
            std::thread::sleep(Duration::from_millis(1));
        }
    });
    let (from_pipe, piped, refusal) =
        drain(PipeSource::spawn(reader, Options::default(), RunChannels::default()).unwrap());
    typist.join().unwrap();
    assert!(refusal.is_none(), "{refusal:?}");
    assert_eq!(piped, statistics);
    assert!(from_pipe == from_file, "a pipe gives other frames");
}

#[test]
fn frames_begin_and_end_at_rest() {
    let frames = frames_of(&staircase(4), AxisVector::zeros());
    let (first, last) = (frames.first().unwrap(), frames.last().unwrap());
    assert!(first.flags.contains(FrameFlags::FIRST));
    assert!(last.flags.contains(FrameFlags::LAST));
    for frame in [first, last] {
        assert_eq!(frame.velocity, AxisVector::zeros());
        assert_eq!(frame.acceleration, AxisVector::zeros());
    }
    assert_eq!(
        (first.position, last.position),
        (point(0.0, 0.0), point(10.0, 10.0))
    );
    assert!(frames.iter().zip(0..).all(|(frame, n)| frame.sequence == n));
}

#[test]
fn a_file_with_errors_is_refused_with_all_of_them() {
    let file = file("G1 X1 F100\nG1 X1 X2\nG1 Y2\nG777\nM2\n");
    match FileSource::open(file.path(), Options::default(), &settings()) {
        Err(Refusal::Program {
            diagnostics,
            unlisted: 0,
        }) => {
            let found: Vec<_> = diagnostics.iter().map(|f| (f.line, f.code)).collect();
            assert_eq!(
                found,
                [
                    (2, DiagnosticCode::DuplicateWord),
                    (4, DiagnosticCode::UnknownGCode)
                ]
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_missing_file_is_refused() {
    let missing = std::path::Path::new("/nonexistent/program.ngc");
    let refused = FileSource::open(missing, Options::default(), &settings());
    assert!(matches!(refused, Err(Refusal::Read(_))), "{refused:?}");
}

#[test]
fn a_pipe_with_an_error_is_planned_to_a_stop_before_it() {
    let good = "G1 X10 F3000\nY10\nX30\n";
    let bad = format!("{good}G1 X\nG1 X0 Y0\n");
    let read = |text: &str| {
        let input = std::io::Cursor::new(text.to_owned());
        drain(PipeSource::spawn(input, Options::default(), RunChannels::default()).unwrap())
    };
    let (frames, _, refusal) = read(&bad);
    match refusal {
        Some(Refusal::Program { diagnostics, .. }) => {
            assert_eq!((diagnostics.len(), diagnostics[0].line), (1, 4));
        }
        other => panic!("{other:?}"),
    }
    assert!(frames == read(good).0, "not the motion of the good part");
    assert_eq!(frames.last().unwrap().position, point(30.0, 10.0));
}

#[test]
fn an_item_that_cannot_be_planned_ends_the_motion_before_it() {
    let mut items = staircase(3);
    items.extend(polyline(&[point(50.0, 50.0), point(60.0, 50.0)]));
    items.extend(polyline(&[point(10.0, 5.0), point(0.0, 0.0)]));
    let (frames, statistics, refusal) = drain(Listed::new(&items));
    let expected = PlanError::Gap {
        line: 1,
        gap_mm: 45.0,
    };
    assert!(
        matches!(refusal, Some(Refusal::Plan(error)) if error == expected),
        "{refusal:?}"
    );
    assert_eq!(statistics.segments, 3);
    assert!(frames == frames_of(&staircase(3), AxisVector::zeros()));
}

/// A random walk of straight moves.
fn walk() -> impl Strategy<Value = Vec<Item>> {
    prop::collection::vec((-20.0..20.0, -20.0..20.0), 2..20)
        .prop_map(|points| polyline(&points.iter().map(|&(x, y)| point(x, y)).collect::<Vec<_>>()))
}

proptest! {
    #[test]
    fn how_often_a_source_is_pending_changes_nothing(
        items in walk(),
        delays in prop::collection::vec(0_u32..3, 20),
    ) {
        let start = match items[0].kind {
            glidepath_program::ItemKind::Move { segment, .. } => segment.start(),
            _ => unreachable!(),
        };
        let mut pipeline = Pipeline::new(Listed::delayed(&items, &delays), settings(), start);
        let delayed: Vec<_> =
            std::iter::from_fn(|| pipeline.next_frame().unwrap()).collect();
        prop_assert!(delayed == frames_of(&items, start));
    }
}
