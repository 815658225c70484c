//! Tests of jogs and segments: those of programs in C and Python arrive as they were meant.
#![allow(
    clippy::float_cmp,
    reason = "what is passed on stays the same to the bit"
)]

use crate::build::{self, Language, Linked};
use crate::machine::{FARTHEST, Machine, STANDS};
use crate::process::{self, Consumer};
use crate::{IN_PYTHON, NO_COMPILER, NO_PYTHON};
use glidepath_link::{JogDemand, JogMode, RequestKind, SegmentRequest};
use glidepath_testing::skip;

/// What was demanded: mode, number, mask and first value.
fn demanded(jogs: &[JogDemand]) -> Vec<(JogMode, u64, u32, f64)> {
    let told = |jog: &JogDemand| (jog.mode().unwrap(), jog.number, jog.mask, jog.value[0]);
    jogs.iter().map(told).collect()
}

/// The pieces that were accepted are those of one stream, in order and in one piece.
fn is_continuous(segments: &[SegmentRequest]) -> bool {
    let numbers = segments.iter().map(|segment| segment.number);
    let moves = segments.iter().filter(|s| s.length == 0.0 && s.mode != 0);
    let places: Vec<_> = moves.map(|segment| (segment.start, segment.end)).collect();
    numbers.eq(0..segments.len() as u64)
        && segments.iter().all(|s| s.session == segments[0].session)
        && places.first().is_some_and(|(start, _)| *start == STANDS)
        && places.windows(2).all(|two| two[0].1 == two[1].0)
}

fn kinds(segments: &[SegmentRequest]) -> Vec<RequestKind> {
    let kind = |segment: &SegmentRequest| RequestKind::from_code(segment.kind).unwrap();
    segments.iter().map(kind).collect()
}

#[test]
fn a_program_in_c_moves_by_hand_and_streams_segments() {
    let machine = Machine::start();
    let example = |name| build::example(machine.place(), name, Language::C, Linked::Shared);
    let (Some(jog), Some(stream)) = (example("jog"), example("segments")) else {
        skip("programs in C", NO_COMPILER);
        return;
    };
    Consumer::start(machine.place(), "jog", &jog, &["0", "-5", "0.3"]).finish();
    let jogs = machine.jogs();
    let told = demanded(&jogs);
    let (first, last) = (told[0], told[told.len() - 1]);
    assert_eq!(first, (JogMode::Continuous, 1, 1, -5.0), "{told:?}");
    assert_eq!(last, (JogMode::None, 2, 0, 0.0), "{told:?}");
    // Kept, as the same and as new each time.
    assert!(told.len() > 3 && told[1..told.len() - 1].iter().all(|kept| *kept == first));
    assert!(jogs.windows(2).all(|two| two[0].sent_ns < two[1].sent_ns));
    assert!(jogs.iter().all(|jog| jog.client == jogs[0].client));

    let (_, told, _) = Consumer::start(machine.place(), "stream", &stream, &["20", "50"]).finish();
    assert_eq!(told, "4 segments accepted\n");
    let segments = machine.segments();
    assert!(is_continuous(&segments), "{segments:#?}");
    let (open, line, end) = (RequestKind::Open, RequestKind::Line, RequestKind::End);
    assert_eq!(kinds(&segments), [open, line, line, line, line, end]);
    let x: Vec<f64> = segments[1..5]
        .iter()
        .map(|s| s.end[0] - STANDS[0])
        .collect();
    assert_eq!(x, [20.0, 20.0, 0.0, 0.0]);
    assert_eq!((segments[2].line, segments[2].feed_v), (2, 50.0));

    // One that leaves the machine is refused, with the planner's words.
    let far = (FARTHEST + 1.0).to_string();
    let told = Consumer::start(machine.place(), "far", &stream, &[&far, "50"]).fails();
    assert!(told.contains("beyond the soft limit"), "{told}");
}

#[test]
fn a_program_in_python_moves_by_hand_and_streams_segments() {
    let machine = Machine::start();
    let Some(python) = process::python() else {
        skip(IN_PYTHON, NO_PYTHON);
        return;
    };
    let script = build::source("python/tests/test_moving.py");
    let (_, told, _) = Consumer::start(machine.place(), "moving", &python, &[&script]).finish();
    assert!(told.contains("tests passed"), "{told}");
    let (continuous, step, none) = (JogMode::Continuous, JogMode::Incremental, JogMode::None);
    let expected = [
        (continuous, 1, 0b101, 5.0),
        (continuous, 1, 0b101, 5.0),
        (step, 2, 0b001, 0.25),
        (none, 3, 0, 0.0),
        (step, 4, 0b001, -0.25),
        // Closing lets go.
        (none, 5, 0, 0.0),
    ];
    let jogs = machine.jogs();
    assert_eq!(demanded(&jogs), expected);
    assert_eq!((jogs[0].value[2], jogs[0].by_joint), (-2.0, 0));
    assert_eq!((jogs[2].velocity_v, jogs[2].by_joint), (3.0, 1));

    let segments = machine.segments();
    assert!(is_continuous(&segments), "{segments:#?}");
    use RequestKind::{Arc, Dwell, End, Line, Open};
    assert_eq!(kinds(&segments), [Open, Line, Line, Arc, Dwell, End]);
    assert_eq!((segments[1].rapid, segments[1].feed_v), (1, 0.0));
    assert_eq!((segments[2].rapid, segments[2].feed_v), (0, 25.0));
    assert_eq!((segments[2].mode, segments[2].tolerance_mm), (4, 0.01));
    assert_eq!((segments[3].plane, segments[3].mode), (1, 3));
    assert_eq!(segments[3].center, [STANDS[0] + 10.0, STANDS[1] + 5.0]);
    assert_eq!(segments[4].dwell_t, 0.5);
    // Every piece is one that the planner understands.
    assert!(segments.iter().all(|segment| segment.item().is_ok()));
}

/// The library inside, nothing else to be installed.
#[test]
fn a_wheel_has_the_library_inside() {
    let machine = Machine::start();
    let Some(python) = process::python().filter(|python| process::has_pip(python)) else {
        skip(IN_PYTHON, "it is not installed, or its pip is not");
        return;
    };
    let wheel = process::wheel(machine.place(), &python);
    let script = build::source("examples/follow.py");
    let mut consumer = Consumer::from_wheel(machine.place(), &python, &wheel, &script, 5);
    consumer.wait_until_ready();
    machine.publish(0..5, crate::machine::setpoint);
    let (_, told, read) = consumer.finish();
    assert!(told.contains("5 received, 0 lost"), "{told}");
    assert_eq!(read.len(), 5 * size_of::<glidepath_link::Setpoint>());
}
