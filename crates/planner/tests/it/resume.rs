//! Tests of programs that are taken up again in the middle: nothing is skipped, nothing is cut
//! twice.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test that fails may panic"
)]

use std::collections::BTreeMap;
use std::path::Path;

use crate::support::items::settings;
use glidepath_audit::{Audit, AuditSettings, Sample};
use glidepath_gcode::Options;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_link::Auxiliary;
use glidepath_planner::{
    Approach, ItemSource, LineStart, Output, Pipeline, ProgramSource, Remainder, ResumeError,
    ResumePoint, RunError, StartLine, Supply,
};
use glidepath_program::{Frame, Item, Limits};

/// Circles that end where they begin, one of them in three turns, a way there and back, dense
/// chords, dwells and events.
const CURVES: &str = "\
G21 G90 G64 P0.02 F6000
S500
G1 X10 Y0
G2 X10 Y0 I5 J0
G2 X10 Y0 I5 J0 P3
G1 X30
X10
X12
G4 P0.1
S800
X12 Y10
M7
X20 Y14
G61.1
X25 Y14
G64 P0.02
X25.02 Y14.001
X25.04 Y14.003
X25.06 Y14.006
X25.08 Y14.010
X25.10 Y14.015
X28 Y18
G3 X20 Y26 I-8 J0 Z2
G0 X0 Y0 Z5
M2
";

/// A text as if it were a file.
struct Text<'a>(ProgramSource<&'a [u8]>);

impl<'a> Text<'a> {
    fn new(text: &'a str, start: AxisVector) -> Self {
        let options = Options {
            start,
            ..Options::default()
        };
        Self(ProgramSource::new(text.as_bytes(), options))
    }
}

impl ItemSource for Text<'_> {
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

/// Frames with their blocks, and items.
fn run<S: ItemSource>(mut pipeline: Pipeline<S>) -> (Vec<(Frame, u32)>, Vec<Item>) {
    let (mut frames, mut items) = (Vec::new(), Vec::new());
    loop {
        match pipeline.advance().unwrap() {
            Output::Frame(frame) => frames.push((frame, pipeline.block())),
            Output::Item(item) => items.push(item),
            Output::Pending => {}
            Output::End => return (frames, items),
        }
    }
}

/// What an interpolator says that stopped at a frame.
fn left_at(frames: &[(Frame, u32)], stop: usize) -> ResumePoint {
    let (frame, block) = frames[stop];
    let begun = frames.iter().find(|(_, other)| *other == block).unwrap();
    ResumePoint {
        line: frame.line,
        position: frame.position,
        program_start: frames[0].0.position,
        program: 7,
        block,
        path_s: frame.path_s,
        block_path_s: begun.0.path_s,
        unanswered: false,
        found: None,
    }
}

/// The largest deviation of motion from program, both ways and in order.
fn deviation(items: &[Item], positions: impl Iterator<Item = AxisVector>) -> f64 {
    // Stopping at once is not within any limits; how the path is passed is all that is asked here.
    let mut audit = Audit::new(&AuditSettings {
        limits: Limits::uniform(1e6, 1e9, 1e12),
        period_t: 0.004,
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    });
    for item in items {
        audit.program(item);
    }
    for (tick, position) in (0..).zip(positions) {
        audit.sample(&Sample {
            tick,
            line: 0,
            position,
            reported: None,
            is_between_frames: false,
        });
    }
    let report = audit.finish();
    let is_of_path = |v: &&glidepath_audit::Violation| !format!("{:?}", v.kind).contains("Feed");
    let bad: Vec<_> = report.violations.iter().filter(is_of_path).collect();
    assert!(bad.is_empty(), "{bad:#?}");
    report.max_deviation_mm
}

/// Stops a program at every so many frames, and goes on from there.
fn stop_and_resume(text: &str, step: usize) {
    let start = AxisVector::zeros();
    let whole = Pipeline::new(Text::new(text, start), settings(), start);
    let (frames, items) = run(whole);
    let length = frames.last().unwrap().0.path_s;
    for stop in (1..frames.len() - 1).step_by(step) {
        let point = left_at(&frames, stop);
        let rest = Remainder::find(Text::new(text, start), point, settings().tolerance_mm)
            .unwrap_or_else(|error| panic!("frame {stop}, {point:?}: {error}"));
        let (again, _) = run(Pipeline::resuming(rest, settings()));
        let (first, last) = (again[0], again.last().unwrap());
        assert_eq!(first.0.position, point.position);
        assert_eq!(
            last.0.position,
            frames.last().unwrap().0.position,
            "frame {stop}"
        );
        assert!(first.1 >= point.block && first.1 > 0);
        // Blocks are counted on, and the path: neither skipped nor passed twice.
        assert_eq!(last.1, frames.last().unwrap().1, "frame {stop}");
        assert!(
            (last.0.path_s - length).abs() < 0.1,
            "frame {stop}: {} {length}",
            last.0.path_s
        );
        let lines: BTreeMap<u32, u32> = frames.iter().map(|(f, block)| (*block, f.line)).collect();
        for (frame, block) in &again[1..] {
            assert!(
                lines.get(block).is_none_or(|line| *line == frame.line),
                "block {block}"
            );
        }
        let both = frames[..=stop].iter().chain(&again);
        let found = deviation(&items, both.map(|(frame, _)| frame.position));
        assert!(found <= 0.02 * (1.0 + 1e-6), "frame {stop}: {found}");
    }
}

#[test]
fn a_program_goes_on_from_wherever_it_was_left() {
    stop_and_resume(CURVES, 13);
}

#[test]
fn bench_programs_go_on_from_wherever_they_were_left() {
    let folder = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/bench"
    ));
    for (name, step) in [
        ("star_mill", 97),
        ("zigzag_mill", 397),
        ("circle_g1_0.1_mill", 97),
        ("butterfly_g1_mill", 997),
    ] {
        let text = std::fs::read_to_string(folder.join(format!("{name}.ngc"))).unwrap();
        stop_and_resume(&text, step);
    }
}

/// A rest can be left and resumed, too: its blocks are those of the program.
#[test]
fn a_rest_can_be_resumed() {
    let start = AxisVector::zeros();
    let (frames, _) = run(Pipeline::new(Text::new(CURVES, start), settings(), start));
    let first = left_at(&frames, frames.len() / 3);
    let rest = Remainder::find(Text::new(CURVES, start), first, 0.02).unwrap();
    let (again, _) = run(Pipeline::resuming(rest, settings()));
    let second = ResumePoint {
        program_start: start,
        ..left_at(&again, again.len() / 2)
    };
    let rest = Remainder::find(Text::new(CURVES, start), second, 0.02).unwrap();
    let (last, _) = run(Pipeline::resuming(rest, settings()));
    assert_eq!(last[0].0.position, second.position);
    let end = |frames: &[(Frame, u32)]| frames.last().map(|(f, block)| (f.position, *block));
    assert_eq!(end(&last), end(&frames));
}

#[test]
fn what_cannot_be_resumed_is_refused() {
    let start = AxisVector::zeros();
    let (frames, _) = run(Pipeline::new(Text::new(CURVES, start), settings(), start));
    let good = left_at(&frames, frames.len() / 2);
    let refused = |point: ResumePoint| match Remainder::find(Text::new(CURVES, start), point, 0.02)
    {
        Err(RunError::Resume(error)) => error,
        other => panic!("{:?}", other.is_ok()),
    };
    let other = ResumePoint { program: 8, ..good };
    assert_eq!(refused(other), ResumeError::OtherProgram);
    let mut moved = good;
    moved.position[2] += 0.1;
    let error = refused(moved);
    assert!(
        matches!(error, ResumeError::OffPath { away: Some(away), .. } if (away.norm() - 0.1).abs() < 1e-3),
        "{error}"
    );
    let beyond = ResumePoint { block: 900, ..good };
    assert!(matches!(
        refused(beyond),
        ResumeError::OffPath { line: 0, .. }
    ));
}

/// The way to a line near the beginning has more parts than there are blocks in front: blocks keep their numbers, and
/// what was left on the way is not taken for the program.
#[test]
fn a_program_begun_at_a_line_near_its_beginning_goes_on_from_wherever_it_was_left() {
    const SHORT: &str = "G21 G90 F6000\nM3 S500\nG1 X20\nY20\nX0\nY0\nM2\n";
    let start = AxisVector::repeat(2.0);
    let (whole, _) = run(Pipeline::new(Text::new(SHORT, start), settings(), start));
    for line in 2..=6 {
        let approach = Approach {
            position: start,
            now: Auxiliary::default(),
            tool_axis: Axis::Z,
            top: Some(6.0),
        };
        let begin = StartLine { line, pass: 1 };
        let found = LineStart::find(Text::new(SHORT, start), begin, &approach).unwrap();
        let block = found.block();
        let (frames, _) = run(Pipeline::resuming(found.approached(&approach), settings()));
        // Each block is the one of its line.
        let lines: BTreeMap<u32, u32> = whole.iter().map(|(f, block)| (*block, f.line)).collect();
        let (mut on_the_way, mut beyond) = (0, 0);
        for stop in (1..frames.len() - 1).step_by(5) {
            let point = ResumePoint {
                program_start: start,
                ..left_at(&frames, stop)
            };
            let rest = Remainder::find(Text::new(SHORT, start), point, 0.02);
            if point.block < block {
                let refused = matches!(
                    rest,
                    Err(RunError::Resume(ResumeError::OnTheWay { line: told })) if told == line
                );
                assert!(refused, "line {line}, {point:?}");
                on_the_way += 1;
                continue;
            }
            assert_eq!(lines.get(&point.block), Some(&point.line), "{point:?}");
            let rest = rest.unwrap_or_else(|error| panic!("line {line}, {point:?}: {error}"));
            // What has happened is not done again.
            assert!(rest.line() == 0 || rest.line() >= point.line, "{point:?}");
            beyond += 1;
        }
        assert!(
            on_the_way > 0 && beyond > 0,
            "{line}: {on_the_way}, {beyond}"
        );
    }
}

/// Lifted by an abort, jogged along the path, or both: the refusal tells how far, and what leads back.
#[test]
fn a_machine_that_was_moved_is_told_what_leads_back() {
    const LINE: &str = "G21 G90 F6000\nG1 X60\nY5\nM2\n";
    let start = AxisVector::zeros();
    let (frames, _) = run(Pipeline::new(Text::new(LINE, start), settings(), start));
    let stop = frames
        .iter()
        .position(|(frame, _)| frame.position[0] > 20.0);
    let left = left_at(&frames, stop.unwrap());
    let find = |point: ResumePoint| Remainder::find(Text::new(LINE, start), point, 0.02);
    for (moves, words) in [
        ([0.0, 3.0], &["jog Z-3`"][..]),
        ([5.0, 0.0], &["jog X-5.00", "` leads back"]),
        (
            [-6.5, 3.0],
            &["jog X6.49", "`, and then `glidepath jog Z-3` lead back"],
        ),
    ] {
        let mut moved = left;
        moved.position[0] += moves[0];
        moved.position[2] += moves[1];
        let error = find(moved).err().map(|error| error.to_string()).unwrap();
        for word in words.iter().chain(&["`lift`"]) {
            assert!(error.contains(word), "{word}: {error}");
        }
        assert!(!error.contains("inf"), "{error}");
    }
    assert!(find(left).is_ok());
}
