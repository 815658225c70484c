//! Tests of the audit, on recordings of plans of random programs: as they are, and with one fault
//! planted in each.

use super::*;
use crate::config;
use crate::plan_steps::PlanSteps;
use bytemuck::Zeroable as _;
use core::fmt::Write as _;
use glidepath_link::MachineState;
use glidepath_planner::{FileSource, Step};
use glidepath_program::Effort;
use glidepath_recording::{Origin, Recorder};
use std::fs::File;
use std::path::PathBuf;

/// Recordings of a run in CI; all of them: `GLIDEPATH_RECORDINGS=100`.
const SAMPLE: u64 = 10;

/// Numbers that look random, the same every time.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next()).unwrap() % end
    }

    #[allow(clippy::cast_precision_loss, reason = "31 bits")]
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next() as f64 / 2_f64.powi(31)
    }
}

fn program(numbers: &mut Numbers) -> String {
    let mut text = "G21 G90 G64 F4000\nG0 X5 Y5 Z2\nG1 Z0\n".to_owned();
    for _ in 0..12 {
        let (x, y) = (numbers.between(-40.0, 40.0), numbers.between(-40.0, 40.0));
        match numbers.below(6) {
            0 => writeln!(text, "G0 X{x:.3} Y{y:.3}"),
            1 => writeln!(text, "G4 P0.05"),
            2 => writeln!(
                text,
                "G3 X{x:.3} Y{y:.3} R{:.3}",
                numbers.between(60.0, 90.0)
            ),
            3 => writeln!(
                text,
                "G1 X{x:.3} Y{y:.3} Z{:.3}",
                numbers.between(-3.0, 3.0)
            ),
            _ => writeln!(
                text,
                "G1 X{x:.3} Y{y:.3} F{:.0}",
                numbers.between(900.0, 9000.0)
            ),
        }
        .unwrap();
    }
    text + "M2\n"
}

/// What an interpolator would have published that plays a plan at 100 %.
fn played(path: &Path, config: &MachineConfig) -> Vec<Setpoint> {
    let stands = config.home();
    let options = config.program_options(stands);
    let source = FileSource::unchecked(path, options, &config.settings()).unwrap();
    let mut steps = PlanSteps::on_one_core(source, config, stands);
    let mut setpoints = Vec::new();
    let mut push = |make: &dyn Fn(&mut Setpoint)| {
        let mut setpoint = Setpoint::zeroed();
        make(&mut setpoint);
        setpoint.boot_id = 1;
        setpoint.number = setpoints.len() as u64;
        setpoint.tick = setpoint.number + 100;
        setpoint.scheduled_ns = setpoint.tick * config.period_ns();
        setpoint.apply_ns = setpoint.scheduled_ns + config.period_ns();
        setpoints.push(setpoint);
    };
    let idle = MachineState::Idle.code();
    for _ in 0..20 {
        push(&|setpoint| {
            setpoint.state = idle;
            setpoint.position = stands.into();
        });
    }
    let mut end = stands;
    loop {
        match steps.step().unwrap() {
            Step::Frame => {
                let frame = *steps.frame();
                end = frame.position;
                push(&|setpoint| {
                    setpoint.epoch = 1;
                    setpoint.state = MachineState::Running.code();
                    setpoint.sequence = frame.sequence;
                    (setpoint.line, setpoint.block) = (frame.line, frame.block);
                    setpoint.flags = frame.flags.0;
                    (setpoint.path_s, setpoint.feed_v) = (frame.path_s, frame.path_v);
                    setpoint.effective_override = 1.0;
                    setpoint.position = frame.position.into();
                    setpoint.velocity = frame.velocity.into();
                    setpoint.acceleration = frame.acceleration.into();
                });
            }
            Step::Item | Step::Pending => {}
            Step::End => break,
        }
    }
    for _ in 0..20 {
        push(&|setpoint| {
            setpoint.epoch = 1;
            setpoint.state = idle;
            setpoint.position = end.into();
        });
    }
    setpoints
}

/// A place where an axis moves, well inside the motion.
fn moving(setpoints: &[Setpoint], numbers: &mut Numbers) -> (usize, usize) {
    loop {
        let at = 60 + numbers.below(setpoints.len() - 120);
        let axis = numbers.below(2);
        let moves = setpoints[at - 6..at + 12]
            .windows(2)
            .all(|pair| (pair[1].position[axis] - pair[0].position[axis]).abs() > 0.01);
        if moves {
            return (at, axis);
        }
    }
}

/// Plants a fault, and tells what kind of finding it has to give.
fn plant(fault: u64, setpoints: &mut Vec<Setpoint>, numbers: &mut Numbers) -> &'static str {
    let (at, axis) = moving(setpoints, numbers);
    match fault % 5 {
        0 => {
            // A step that is a few times what the jerk allows in a period, 2.56 µm.
            let step = numbers.between(0.006, 0.05);
            setpoints[at].position[axis] += step;
            "limit"
        }
        1 => {
            // A bump of half a second, so smooth that no limit need be broken by it.
            let height = numbers.between(0.03, 0.3);
            for (k, setpoint) in (0_u32..125).zip(&mut setpoints[at..]) {
                let turn = f64::from(k) / 125.0 * core::f64::consts::TAU;
                setpoint.position[1 - axis] += height * (1.0 - turn.cos()) / 2.0;
            }
            "deviation"
        }
        2 => {
            setpoints.swap(at, at + 1 + numbers.below(3));
            "order"
        }
        3 => {
            let count = 1 + numbers.below(10);
            setpoints.drain(at..at + count);
            "gap"
        }
        _ => {
            let place = setpoints[at].position[axis];
            for setpoint in &mut setpoints[at..at + 2 + numbers.below(9)] {
                setpoint.position[axis] = place;
            }
            "frozen"
        }
    }
}

fn recorder(path: &Path) -> Recorder<File> {
    let mut origin = Origin {
        configuration: config::EMBEDDED.to_owned(),
        ..Origin::default()
    };
    origin.tell("instance", "test");
    Recorder::new(File::create(path).unwrap(), &origin).unwrap()
}

fn record(folder: &Path, name: &str, setpoints: &[Setpoint]) -> PathBuf {
    let path = folder.join(name);
    let mut recorder = recorder(&path);
    for setpoint in setpoints {
        recorder.setpoint(setpoint).unwrap();
    }
    recorder.finish().unwrap();
    path
}

fn by(config: &MachineConfig, program: &Path) -> Program {
    Program::by(config.clone(), Some(program.to_owned()))
}

#[test]
fn every_fault_is_found_and_none_where_there_is_none() {
    let count = std::env::var("GLIDEPATH_RECORDINGS").ok();
    let count = count.and_then(|text| text.parse().ok()).unwrap_or(SAMPLE);
    let folder = tempfile::tempdir().unwrap();
    let mut config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    config.path.effort = Effort::Fast;
    for seed in 0..count {
        let numbers = &mut Numbers(seed * 7919 + 1);
        let program = program(numbers);
        let path = folder.path().join("program.ngc");
        std::fs::write(&path, &program).unwrap();
        let mut setpoints = played(&path, &config);
        let clean = record(folder.path(), "clean.mcap", &setpoints);
        let verdict = judge(&ProgramFile::named(&clean), &by(&config, &path)).unwrap();
        assert_eq!(verdict.setpoints, setpoints.len() as u64);
        assert!(
            verdict.was_replanned && verdict.notes.is_empty(),
            "{verdict:?}"
        );
        assert_eq!(
            verdict.findings.listed,
            [],
            "seed {seed}, clean:\n{program}"
        );
        let expected = plant(seed, &mut setpoints, numbers);
        let faulty = record(folder.path(), "faulty.mcap", &setpoints);
        let verdict = judge(&ProgramFile::named(&faulty), &by(&config, &path)).unwrap();
        let kinds: Vec<_> = verdict
            .findings
            .listed
            .iter()
            .map(|found| found.kind)
            .collect();
        assert!(
            kinds.contains(&expected),
            "seed {seed}: {expected} is not in {kinds:?}\n{program}"
        );
    }
}

/// The power goes in mid-motion: the drives coast to rest and sag, and setpoints follow them.
#[test]
fn an_ordinary_fault_has_no_findings() {
    let folder = tempfile::tempdir().unwrap();
    let mut config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    config.path.effort = Effort::Fast;
    let path = folder.path().join("program.ngc");
    let numbers = &mut Numbers(11);
    std::fs::write(&path, program(numbers)).unwrap();
    let mut setpoints = played(&path, &config);
    for setpoint in &mut setpoints {
        setpoint.enable = 7;
    }
    let (at, axis) = moving(&setpoints, numbers);
    let (mut place, mut step) = (setpoints[at].position, 0.0);
    for (k, setpoint) in (0_u32..).zip(&mut setpoints[at..]) {
        setpoint.state = MachineState::Faulted.code();
        (setpoint.enable, setpoint.epoch, setpoint.reference) = (0, 1, 1);
        // What encoders say is no motion within limits.
        step = if k < 20 { 0.9 } else { 0.5 * step };
        place[axis] += step;
        place[2] -= if k % 7 == 0 { 0.05 } else { 0.0 };
        setpoint.position = place;
        (setpoint.velocity, setpoint.acceleration) = ([0.0; 9], [0.0; 9]);
    }
    let recorded = record(folder.path(), "fault.mcap", &setpoints);
    let verdict = judge(&ProgramFile::named(&recorded), &by(&config, &path)).unwrap();
    assert_eq!(verdict.findings.listed, [], "{verdict:?}");
    assert!(
        verdict.most.iter().all(|most| *most <= 1.0 + 1e-6),
        "{verdict:?}"
    );
    assert!(
        verdict.max_deviation_mm.is_some_and(|mm| mm < 0.02),
        "{verdict:?}"
    );
    let notes = verdict.notes.join("; ");
    assert!(notes.contains("ends before the program"), "{notes}");
}

/// The planner dies in mid-motion, the machine rests between two frames and keeps its power: what follows
/// is the place where it rests, with the frame before it.
#[test]
fn a_rest_between_two_frames_in_a_fault_is_on_the_path() {
    let folder = tempfile::tempdir().unwrap();
    let mut config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    config.path.effort = Effort::Fast;
    let path = folder.path().join("program.ngc");
    let numbers = &mut Numbers(17);
    std::fs::write(&path, program(numbers)).unwrap();
    let mut setpoints = played(&path, &config);
    let (at, _) = moving(&setpoints, numbers);
    let (before, after) = (setpoints[at].position, setpoints[at + 1].position);
    let sequence = setpoints[at].sequence;
    for (k, setpoint) in (0_u32..).zip(&mut setpoints[at + 1..]) {
        setpoint.state = MachineState::Faulted.code();
        (setpoint.epoch, setpoint.sequence) = (1, sequence);
        setpoint.fraction = if k == 0 { 0.5 } else { 0.0 };
        for (i, place) in setpoint.position.iter_mut().enumerate() {
            *place = f64::midpoint(before[i], after[i]);
        }
    }
    let recorded = record(folder.path(), "fault.mcap", &setpoints);
    let verdict = judge(&ProgramFile::named(&recorded), &by(&config, &path)).unwrap();
    let listed = verdict.findings.listed.into_iter();
    let deviations: Vec<_> = listed.filter(|it| it.kind == "deviation").collect();
    assert_eq!(deviations, []);
}

/// A program that ends where it begins is held before it moves, and aborted.
#[test]
fn what_was_ended_before_it_moved_has_no_findings() {
    let folder = tempfile::tempdir().unwrap();
    let mut config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    config.path.effort = Effort::Fast;
    let path = folder.path().join("program.ngc");
    std::fs::write(&path, "G21 G90 F600\nG1 X20\nY20\nX0\nY0\nM2\n").unwrap();
    let mut setpoints = played(&path, &config);
    let begin = setpoints.iter().position(|setpoint| setpoint.epoch == 1);
    setpoints.truncate(begin.unwrap() + 50);
    let begin = setpoints[begin.unwrap()];
    for setpoint in setpoints.iter_mut().filter(|setpoint| setpoint.epoch == 1) {
        setpoint.state = MachineState::Held.code();
        (setpoint.sequence, setpoint.effective_override) = (0, 0.0);
        setpoint.position = begin.position;
        setpoint.velocity = begin.velocity;
        setpoint.acceleration = begin.acceleration;
    }
    let folder = folder.path();
    let mut recorder = recorder(&folder.join("held.mcap"));
    for setpoint in &setpoints {
        recorder.setpoint(setpoint).unwrap();
    }
    let mut status = glidepath_link::Status::zeroed();
    status.end_of_epoch = EndOfEpoch::Aborted.code();
    recorder.status(&status).unwrap();
    recorder.finish().unwrap();
    let held = ProgramFile::named(folder.join("held.mcap"));
    let verdict = judge(&held, &by(&config, &path)).unwrap();
    assert_eq!(verdict.findings.listed, []);
    assert!(verdict.max_deviation_mm.is_some_and(|mm| mm < 1e-5));
}

#[test]
fn a_deviation_is_found_without_the_plan_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    config.path.effort = Effort::Fast;
    let path = folder.path().join("program.ngc");
    let numbers = &mut Numbers(5);
    std::fs::write(&path, program(numbers)).unwrap();
    let mut setpoints = played(&path, &config);
    // A moment at another override: then the plan is not held against it.
    let running = setpoints
        .iter_mut()
        .filter(|setpoint| setpoint.effective_override > 0.0);
    running
        .skip(30)
        .take(1)
        .for_each(|setpoint| setpoint.effective_override = 0.9);
    let clean = record(folder.path(), "clean.mcap", &setpoints);
    let verdict = judge(&ProgramFile::named(&clean), &by(&config, &path)).unwrap();
    assert!(!verdict.was_replanned);
    assert_eq!(verdict.findings.listed, []);
    // A smooth bump across the path, which lies in a plane there.
    let (at, _) = moving(&setpoints, numbers);
    for (k, setpoint) in (0_u32..125).zip(&mut setpoints[at..]) {
        let turn = f64::from(k) / 125.0 * core::f64::consts::TAU;
        setpoint.position[2] += 0.2 * (1.0 - turn.cos()) / 2.0;
    }
    let faulty = record(folder.path(), "faulty.mcap", &setpoints);
    let verdict = judge(&ProgramFile::named(&faulty), &by(&config, &path)).unwrap();
    assert!(
        verdict
            .findings
            .listed
            .iter()
            .any(|found| found.kind == "deviation"),
        "{verdict:?}"
    );
}
