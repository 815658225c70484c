//! A program that asks inputs and the probe is left anywhere, and goes on as it would have.

use std::io;
use std::sync::{Arc, Mutex};

use glidepath_gcode::{Connections, Options, Probed};
use glidepath_geometry::AxisVector;
use glidepath_program::{Effort, Event, Frame, FrameFlags, Limits, Settings, Smoothing};

use super::{Remainder, ResumePoint};
use crate::plan::pipeline::Pipeline;
use crate::plan::step::Step;
use crate::run::error::RunError;
use crate::run::refusal::Refusal;
use crate::run::resume_error::ResumeError;
use crate::source::input_arbiter::{AnsweredInput, InputArbiter, InputJournal, InputResult};
use crate::source::item_source::{ItemSource, Settled, Supply};
use crate::source::program::ProgramSource;
use crate::source::run_channels::RunChannels;
use crate::source::start_line::{Approach, LineStart, StartLine, StartLineError};

/// Where the part begins, and where the machine comes to rest behind a contact, mm.
const PART_Z: f64 = -7.25;
const STANDS_Z: f64 = -7.3;

const PROGRAM: &str = "\
G21 G90 G94 F600
G0 X5 Y2
M66 P0 L0
G1 X[6+#5399]
G38.2 Z-20 F300
G91 G0 Z1
G38.2 Z-3 F30
G90
G10 L2 P1 Z#5063
G0 Z3
M66 E1
G1 Y[#5399]
G38.3 Z2.5 F60
G1 X[#5070+9] Z[#5063+1]
M2
";

/// A journal in memory.
#[derive(Debug, Clone, Default)]
struct Journal {
    kept: Arc<Mutex<Vec<AnsweredInput>>>,
    recalled: usize,
}

impl Journal {
    fn of(answers: &[AnsweredInput]) -> Self {
        Self {
            kept: Arc::new(Mutex::new(answers.to_vec())),
            recalled: 0,
        }
    }

    fn answers(&self) -> Vec<AnsweredInput> {
        self.kept.lock().unwrap().clone()
    }
}

impl InputJournal for Journal {
    fn recall(&mut self) -> Option<AnsweredInput> {
        let next = self.kept.lock().unwrap().get(self.recalled).copied();
        self.recalled += usize::from(next.is_some());
        next
    }

    fn end_recall(&mut self) -> io::Result<()> {
        self.kept.lock().unwrap().truncate(self.recalled);
        Ok(())
    }

    fn keep(&mut self, answered: &AnsweredInput) -> io::Result<()> {
        self.kept.lock().unwrap().push(*answered);
        Ok(())
    }
}

/// A text as if it were a file.
#[derive(Debug)]
struct Text(ProgramSource<&'static [u8]>);

impl Text {
    fn new(start: AxisVector, arbiter: &InputArbiter) -> Self {
        let options = Options {
            start,
            connections: Connections::Real,
            probing_v: Some(10.0),
            ..Options::default()
        };
        let source = ProgramSource::new(PROGRAM.as_bytes(), options);
        Self(source.attended(RunChannels {
            inputs: Some(arbiter.clone()),
            ..RunChannels::default()
        }))
    }
}

impl ItemSource for Text {
    fn next_item(&mut self) -> Supply {
        self.0.next_item()
    }

    fn settle(&mut self, known: Option<InputResult>) -> Result<Settled, Refusal> {
        self.0.settle(known)
    }

    fn lines_read(&self) -> u64 {
        self.0.lines_read()
    }

    fn fingerprint(&self) -> u64 {
        7
    }
}

/// Where the machine was, and what was known then.
#[derive(Debug, Clone)]
struct Stand {
    point: ResumePoint,
    answers: Vec<AnsweredInput>,
}

/// A machine with a part under its probe.
struct Machine {
    arbiter: InputArbiter,
    journal: Journal,
    stands: Vec<Stand>,
    block_path_s: f64,
}

impl Machine {
    fn new(arbiter: InputArbiter, journal: Journal) -> Self {
        Self {
            arbiter,
            journal,
            stands: Vec::new(),
            block_path_s: 0.0,
        }
    }

    fn stand(&mut self, position: AxisVector, (block, path_s): (u32, f64), found: Option<Probed>) {
        let before = self.stands.last().map(|stand| stand.point.block);
        if before != Some(block) {
            self.block_path_s = path_s;
        }
        self.stands.push(Stand {
            point: ResumePoint {
                line: 0,
                position,
                program_start: AxisVector::zeros(),
                program: 7,
                block,
                path_s,
                block_path_s: self.block_path_s,
                unanswered: false,
                found,
            },
            answers: self.journal.answers(),
        });
    }

    /// Executes a program to its end.
    fn execute<S: ItemSource>(&mut self, pipeline: &mut Pipeline<S>) {
        loop {
            let tripped = self.epoch(pipeline);
            if !pipeline.comes_to_probe(tripped.is_some()).unwrap() {
                return;
            }
            let last = self.stands.last().unwrap().point;
            let probed = tripped.unwrap_or(Probed {
                contact: None,
                was_so: false,
                stands: last.position,
            });
            let at = (last.block, last.path_s);
            self.stand(probed.stands, at, probed.contact.and(Some(probed)));
            pipeline.go_on_from(probed.stands, last.path_s);
            self.arbiter.answer(InputResult::Probe(probed)).unwrap();
            self.stand(probed.stands, at, probed.contact.and(Some(probed)));
        }
    }

    /// One epoch, and what the probe has found in it.
    fn epoch<S: ItemSource>(&mut self, pipeline: &mut Pipeline<S>) -> Option<Probed> {
        let mut looks = false;
        loop {
            match pipeline.step().unwrap() {
                Step::Item => {}
                Step::End => return None,
                Step::Pending => self.arbiter.answer(InputResult::Input(2.5)).unwrap(),
                Step::Frame => {
                    let frame = *pipeline.frame();
                    looks |= matches!(frame.events.at_rest(), Some(Event::Probe { .. }));
                    let touches = frame.position[2] <= PART_Z;
                    let found = looks && touches;
                    assert!(found || !touches || !looks, "it moves into the part");
                    assert!(
                        frame.position[2] > STANDS_Z - 1e-9,
                        "it moves into the part"
                    );
                    if found {
                        let (mut contact, mut stands) = (frame.position, frame.position);
                        (contact[2], stands[2]) = (PART_Z, STANDS_Z);
                        return Some(Probed {
                            contact: Some(contact),
                            was_so: false,
                            stands,
                        });
                    }
                    self.stand(frame.position, (frame.block, frame.path_s), None);
                }
            }
        }
    }
}

fn settings() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::Fast,
    }
}

/// The program from its beginning to its end.
fn whole() -> Machine {
    let (arbiter, journal) = (InputArbiter::default(), Journal::default());
    arbiter.keep_in(Box::new(journal.clone()), false);
    let start = AxisVector::zeros();
    let mut pipeline = Pipeline::new(Text::new(start, &arbiter), settings(), start);
    let mut machine = Machine::new(arbiter, journal);
    machine.execute(&mut pipeline);
    machine
}

#[test]
fn a_program_that_asks_goes_on_from_wherever_it_was_left() {
    let all = whole();
    let answers = all.journal.answers();
    assert_eq!(answers.len(), 5, "{answers:#?}");
    let end = all.stands.last().unwrap();
    // 9 for no contact of the last search, and its end in the coordinates that G10 has made.
    assert!(
        (end.point.position
            - AxisVector::from_column_slice(&[
                9.0,
                2.5,
                3.5 + PART_Z,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0
            ]))
        .amax()
            < 1e-9
    );
    let mut goes_on = 0;
    // The last one is the end.
    let rests = &all.stands[..all.stands.len() - 1];
    for (number, stand) in rests.iter().enumerate() {
        // Every one around where blocks meet, and some of the others.
        let near = |other: usize| all.stands.get(other).map(|other| other.point.block);
        let is_passing = near(number.saturating_sub(2)) == near(number + 2);
        if is_passing && stand.point.found.is_none() && number % 11 != 0 {
            continue;
        }
        let left = (number, &stand.point, stand.answers.len());
        let arbiter = InputArbiter::default();
        let journal = Journal::of(&stand.answers);
        arbiter.keep_in(Box::new(journal.clone()), true);
        let source = Text::new(AxisVector::zeros(), &arbiter);
        let rest = Remainder::find(source, stand.point, settings().tolerance_mm)
            .unwrap_or_else(|error| panic!("{left:?}: {error}"));
        arbiter.begin_here().unwrap();
        let mut machine = Machine::new(arbiter, journal.clone());
        let mut pipeline = Pipeline::resuming(rest, settings());
        machine.execute(&mut pipeline);
        let last = machine.stands.last().unwrap();
        assert_eq!(last.point.position, end.point.position, "{left:?}");
        assert_eq!(last.point.block, end.point.block, "{left:?}");
        assert_eq!(machine.stands[0].point.position, stand.point.position);
        // What was asked before is not asked again, and what was not, is.
        assert_eq!(journal.answers(), answers, "{left:?}");
        goes_on += 1;
    }
    assert!(goes_on > 100, "{goes_on}");
}

#[test]
fn what_was_answered_and_is_not_known_any_more_is_refused() {
    let all = whole();
    let end = all.stands.last().unwrap();
    for known in 0..4 {
        let arbiter = InputArbiter::default();
        arbiter.keep_in(Box::new(Journal::of(&end.answers[..known])), true);
        let source = Text::new(AxisVector::zeros(), &arbiter);
        let refused = Remainder::find(source, end.point, 0.02).unwrap_err();
        let line = [3, 5, 7, 11][known];
        assert!(
            matches!(refused, RunError::Refused(Refusal::AnswerUnknown { line: of }) if of == line),
            "{refused}"
        );
    }
    // Answers of another run, in which other lines asked.
    let mut others = end.answers.clone();
    others[1].line = 6;
    let arbiter = InputArbiter::default();
    arbiter.keep_in(Box::new(Journal::of(&others)), true);
    let refused = Remainder::find(Text::new(AxisVector::zeros(), &arbiter), end.point, 0.02);
    assert!(matches!(
        refused.unwrap_err(),
        RunError::Refused(Refusal::AnswerUnknown { line: 5 })
    ));
}

#[test]
fn from_a_line_on_it_is_told_what_it_was_told_before_and_asks_anew_behind() {
    let answers = whole().journal.answers();
    let mut stands = AxisVector::zeros();
    (stands[0], stands[1], stands[2]) = (30.0, 20.0, 10.0);
    let approach = Approach {
        position: stands,
        now: glidepath_link::Auxiliary::default(),
        tool_axis: glidepath_geometry::Axis::Z,
        top: None,
    };
    // Line, answers in front of it, and where it begins.
    for (line, told, z) in [(3, 0, 0.0), (5, 1, 10.0), (6, 2, STANDS_Z), (12, 4, -4.25)] {
        let (arbiter, journal) = (InputArbiter::default(), Journal::of(&answers));
        arbiter.keep_in(Box::new(journal.clone()), true);
        let start = StartLine { line, pass: 1 };
        let found = LineStart::find(Text::new(stands, &arbiter), start, &approach).unwrap();
        if line > 3 {
            assert!((found.begins_at()[2] - z).abs() < 1e-9, "line {line}");
        }
        arbiter.begin_here().unwrap();
        assert_eq!(journal.answers().len(), told, "line {line}");
        let mut machine = Machine::new(arbiter, journal.clone());
        let mut pipeline = Pipeline::resuming(found.approached(&approach), settings());
        machine.execute(&mut pipeline);
        let again = journal.answers();
        assert_eq!(again.len(), answers.len(), "line {line}");
        assert!(again.iter().zip(&answers).all(|(a, b)| a.line == b.line));
    }
    let (arbiter, journal) = (InputArbiter::default(), Journal::of(&answers[..2]));
    arbiter.keep_in(Box::new(journal), true);
    let start = StartLine { line: 10, pass: 1 };
    let refused = LineStart::find(Text::new(stands, &arbiter), start, &approach).unwrap_err();
    assert!(matches!(
        refused,
        StartLineError::Refused(Refusal::AnswerUnknown { line: 7 })
    ));
}

/// A program that can be read again.
struct Kept(ProgramSource<&'static [u8]>);

impl ItemSource for Kept {
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

#[test]
fn what_was_stopped_turns_again_before_anything_moves() {
    const CUTTING: &str = "G21 G90 F600 S8000 M3\nM8\nG1 X10\nG1 X20\nM5\nG1 X30\nM2\n";
    let source = || Kept(ProgramSource::new(CUTTING.as_bytes(), Options::default()));
    let frames = |mut pipeline: Pipeline<Kept>| {
        let mut frames = Vec::new();
        while let Some(frame) = pipeline.next_frame().unwrap() {
            frames.push(frame);
        }
        frames
    };
    let start = AxisVector::zeros();
    let whole = frames(Pipeline::new(source(), settings(), start));
    for (x, told) in [
        (
            15.0,
            vec![
                Event::MCode(3),
                Event::MCode(8),
                Event::Await(3),
                Event::Await(8),
            ],
        ),
        // The program has stopped the spindle itself by then.
        (25.0, vec![Event::MCode(8), Event::Await(8)]),
    ] {
        let left = whole.iter().find(|f| f.position[0] > x).unwrap();
        let first = whole.iter().find(|f| f.block == left.block).unwrap();
        let point = ResumePoint {
            line: left.line,
            position: left.position,
            program_start: start,
            program: 7,
            block: left.block,
            path_s: left.path_s,
            block_path_s: first.path_s,
            unanswered: false,
            found: None,
        };
        let rest = Remainder::find(source(), point, settings().tolerance_mm).unwrap();
        // What the program has told, but for what an abort has stopped.
        let mut now = glidepath_link::Auxiliary::default();
        now.take(Event::SpindleSpeed(8000.0));
        let (events, line) = (rest.restoring(&now).unwrap(), rest.line());
        assert_eq!(events, told);
        let mut pipeline = Pipeline::resuming(rest, settings()).beginning_with(events, line);
        let mut before = Vec::new();
        let mut last = left.block;
        while let Some(frame) = pipeline.next_frame().unwrap() {
            let moves = frame.velocity.amax() > 0.0;
            assert!(!moves || before.len() >= told.len(), "it moves too early");
            before.extend(frame.events.as_slice().iter().map(|told| told.event));
            assert!(frame.block >= left.block);
            assert!(frame.line >= left.line || frame.flags.contains(FrameFlags::FIRST));
            last = frame.block;
        }
        assert_eq!(before[..told.len()], told);
        assert_eq!(
            last,
            whole.last().unwrap().block,
            "blocks keep their numbers"
        );
    }
}

/// Events, dwells and moves in turn, so that the machine is told to be in blocks that do not move.
const IN_TURN: &str = "G21 G90 F600\nS8000 M3\nG4 P0.02\nG1 X10\nM8\nG1 X20 Y3\nG4 P0.02\nM5\nG2 X30 Y3 I5 J0\nM9\n\
                       G4 P0.02\nM2\n";

fn in_turn() -> Kept {
    Kept(ProgramSource::new(IN_TURN.as_bytes(), Options::default()))
}

fn frames_of<S: ItemSource>(mut pipeline: Pipeline<S>) -> Vec<Frame> {
    let mut frames = Vec::new();
    while let Some(frame) = pipeline.next_frame().unwrap() {
        frames.push(frame);
    }
    frames
}

/// The point of a machine that stands somewhere at the time of a frame.
fn point_at(frames: &[Frame], of: &Frame, position: AxisVector, path_s: f64) -> ResumePoint {
    let first = frames.iter().find(|frame| frame.block == of.block).unwrap();
    ResumePoint {
        line: of.line,
        position,
        program_start: AxisVector::zeros(),
        program: 7,
        block: of.block,
        path_s,
        block_path_s: first.path_s,
        unanswered: false,
        found: None,
    }
}

/// Goes on from a point to the end of the program.
fn goes_on_from(point: ResumePoint, end: &Frame) {
    let rest = Remainder::find(in_turn(), point, settings().tolerance_mm)
        .unwrap_or_else(|error| panic!("{point:?}: {error}"));
    let frames = frames_of(Pipeline::resuming(rest, settings()));
    assert_eq!(frames[0].position, point.position, "{point:?}");
    let last = frames.last().unwrap();
    assert_eq!(last.position, end.position, "{point:?}");
    assert_eq!(last.block, end.block, "{point:?}");
}

#[test]
fn it_goes_on_from_between_two_frames_whatever_block_is_told() {
    let start = AxisVector::zeros();
    let frames = frames_of(Pipeline::new(in_turn(), settings(), start));
    let end = frames.last().unwrap();
    for pair in frames.windows(2) {
        let [before, after] = pair else { continue };
        // The curve between both is off their chord by far less than the tolerance.
        for part in [0.001, 0.5] {
            let position = before.position + part * (after.position - before.position);
            let path_s = before.path_s + part * (after.path_s - before.path_s);
            goes_on_from(point_at(&frames, before, position, path_s), end);
        }
    }
}

#[test]
fn it_goes_on_from_beside_the_path_and_not_from_elsewhere() {
    let start = AxisVector::zeros();
    let frames = frames_of(Pipeline::new(in_turn(), settings(), start));
    let end = frames.last().unwrap();
    let none = Frame {
        block: 0,
        ..frames[0]
    };
    let blocks = frames.chunk_by(|a, b| a.block == b.block);
    for frame in blocks.map(|block| &block[0]).chain([&none]) {
        if frame.block == end.block {
            continue;
        }
        let mut place = frame.position;
        (place[0], place[2]) = (place[0] - 4e-6, place[2] + 0.004);
        let mut point = point_at(&frames, &frames[0], place, frame.path_s);
        (point.block, point.block_path_s) = (frame.block, frame.path_s);
        goes_on_from(point, end);
        point.position[2] += 1.0;
        let refused = Remainder::find(in_turn(), point, settings().tolerance_mm);
        let refused = refused.map(drop).unwrap_err();
        assert!(
            matches!(refused, RunError::Resume(ResumeError::OffPath { .. })),
            "block {}: {refused}",
            frame.block
        );
    }
}

/// What comes behind the question is not known before it is answered.
#[test]
fn it_asks_again_from_beside_the_path() {
    let all = whole();
    let asked = all.stands.iter().position(|stand| {
        // The first block behind the rapid, which is the M66.
        stand.point.block == 2
    });
    let mut stand = all.stands[asked.unwrap()].clone();
    assert!(stand.answers.is_empty(), "{stand:?}");
    for (away, is_near) in [(0.004, true), (1.0, false)] {
        stand.point.position[2] = away;
        let (arbiter, journal) = (InputArbiter::default(), Journal::of(&[]));
        arbiter.keep_in(Box::new(journal.clone()), true);
        let source = Text::new(AxisVector::zeros(), &arbiter);
        let rest = Remainder::find(source, stand.point, settings().tolerance_mm);
        if !is_near {
            let refused = rest.map(drop).unwrap_err();
            assert!(matches!(
                refused,
                RunError::Resume(ResumeError::OffPath { .. })
            ));
            continue;
        }
        arbiter.begin_here().unwrap();
        let mut machine = Machine::new(arbiter, journal.clone());
        machine.execute(&mut Pipeline::resuming(rest.unwrap(), settings()));
        assert_eq!(machine.stands[0].point.position, stand.point.position);
        let last = machine.stands.last().unwrap();
        assert_eq!(
            last.point.position,
            all.stands.last().unwrap().point.position
        );
        assert_eq!(journal.answers(), all.journal.answers());
    }
}
