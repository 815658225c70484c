//! Tests of planner and interpolator together, as threads, over the transport of the processes.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use glidepath_audit::ViolationKind;
use glidepath_geometry::AxisVector;
use glidepath_link::{Command, EndOfEpoch, FaultCause, MachineState, SetpointFrame};
use glidepath_planner::{ItemSource, RunError, Supply};
use glidepath_program::Frame;
use glidepath_tests::{Instance, Machine, Recording, Watchdog, plan, program, program_from};

const PATIENCE: Duration = Duration::from_secs(120);

/// About two seconds of motion: lines, corners, an arc, a dwell, an event.
const PROGRAM: &str = "\
G21 G90 G64 P0.02 F6000
G0 X10 Y10 Z1
G1 X40
G3 X50 Y20 I0 J10
G1 Y40 Z0
G4 P0.05
S1000 M3
G1 X30 Y35
X10 Y40
X0 Y0 Z0
M2
";

/// Back to where it began.
const HOME: &str = "G21 G90 G1 X0 Y0 Z0 F6000\nM2\n";

/// The setpoints of the epoch are the frames, bit for bit and in order, without any left out.
fn assert_played_exactly(recording: &Recording, epoch: u64, frames: &[Frame]) {
    let mut next = 0;
    for setpoint in recording.epoch(epoch) {
        // At rest, before the motion begins and after it ends, a frame is repeated.
        if setpoint.sequence + 1 == next {
            continue;
        }
        assert_eq!(setpoint.sequence, next, "frames left out");
        let frame = &frames[usize::try_from(next).unwrap()];
        let record = SetpointFrame::from_frame(frame, epoch, 4_000_000);
        let played = [setpoint.position, setpoint.velocity, setpoint.acceleration];
        let planned = [record.position, record.velocity, record.acceleration];
        let bits = |state: [[f64; 9]; 3]| state.map(|vector| vector.map(f64::to_bits));
        assert_eq!(bits(played), bits(planned), "frame {next}");
        next += 1;
    }
    assert_eq!(next, frames.len() as u64, "the end was not played");
}

#[test]
fn what_is_planned_is_played_bit_for_bit() {
    let (instance, _watchdog) = (Instance::new(), Watchdog::new(PATIENCE));
    let recording = Machine::run(
        instance.config(),
        |_| {},
        |machine| {
            let stop = AtomicBool::new(false);
            let statistics = machine.publish(&stop, |_| program(PROGRAM), || {}).unwrap();
            assert_eq!(statistics.segments, 7);
        },
    );
    let (frames, items) = plan(PROGRAM, AxisVector::zeros());
    assert!(recording.is_gapless(), "setpoints were lost");
    assert_played_exactly(&recording, 1, &frames);
    let report = recording.audit(1, &items);
    assert!(report.is_clean(), "{:?}", report.violations);
}

#[test]
fn a_planner_that_dies_leaves_the_machine_on_the_path_and_the_next_goes_on_from_there() {
    let (instance, _watchdog) = (Instance::new(), Watchdog::new(PATIENCE));
    let stop = AtomicBool::new(false);
    let mut rest = AxisVector::zeros();
    let recording = Machine::run(
        instance.config(),
        |config| config.planner_lost_after = Some(Duration::from_millis(300)),
        |machine| {
            let mut watch = machine.watch();
            let mut die_in_motion = || {
                let executed = watch.look().map_or(0, |status| status.frames_executed);
                assert!(executed < 100, "the planner dies, as the test wants");
            };
            let died = catch_unwind(AssertUnwindSafe(|| {
                machine.publish(&stop, |_| program(PROGRAM), &mut die_in_motion)
            }));
            assert!(died.is_err(), "the planner survived");
            let status = machine.wait_for_state(MachineState::Faulted);
            assert_eq!(status.fault(), Ok(Some(FaultCause::PlannerLost)));
            assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Faulted));
            rest = AxisVector::from(status.position);
            machine.command(Command::Reset);
            let _idle = machine.wait_for_state(MachineState::Idle);
            machine
                .publish(&stop, |start| program_from(HOME, start), || {})
                .unwrap();
        },
    );
    // On the path and inside the limits; the motion only did not reach the end.
    let report = recording.audit(1, &plan(PROGRAM, AxisVector::zeros()).1);
    let found: Vec<_> = report
        .violations
        .iter()
        .map(|violation| violation.kind)
        .collect();
    assert_eq!(found, [ViolationKind::Incomplete]);
    // The second planner started where the machine stood.
    let (frames, items) = plan(HOME, rest);
    assert_played_exactly(&recording, 2, &frames);
    let report = recording.audit(2, &items);
    assert!(report.is_clean(), "{:?}", report.violations);
    assert_eq!(report.final_position, AxisVector::zeros());
}

/// A source that dries up for a while before its fourth item.
struct Slow<S> {
    source: S,
    given: u32,
    dry: u32,
}

impl<S: ItemSource> ItemSource for Slow<S> {
    fn next_item(&mut self) -> Supply {
        if self.given == 4 && self.dry > 0 {
            self.dry -= 1;
            return Supply::Pending;
        }
        self.given += 1;
        self.source.next_item()
    }

    fn lines_read(&self) -> u64 {
        self.source.lines_read()
    }
}

#[test]
fn a_source_that_dries_up_makes_the_machine_wait_on_the_path() {
    let (instance, _watchdog) = (Instance::new(), Watchdog::new(PATIENCE));
    let stop = AtomicBool::new(false);
    let mut starved = false;
    let recording = Machine::run(
        instance.config(),
        |config| config.planner_lost_after = Some(Duration::from_millis(600)),
        |machine| {
            let mut watch = machine.watch();
            let look = || {
                let state = watch.look().map(|status| status.state);
                starved |= state == Some(MachineState::Starved.code());
            };
            let source = |_| Slow {
                source: program(PROGRAM),
                given: 0,
                dry: 10_000,
            };
            machine.publish(&stop, source, look).unwrap();
        },
    );
    assert!(starved, "the source was not slow enough for the test");
    let report = recording.audit(1, &plan(PROGRAM, AxisVector::zeros()).1);
    assert!(report.is_clean(), "{:?}", report.violations);
}

#[test]
fn hold_resume_and_override_stay_on_the_path() {
    let (instance, _watchdog) = (Instance::new(), Watchdog::new(PATIENCE));
    let stop = AtomicBool::new(false);
    let recording = Machine::run(
        instance.config(),
        |_| {},
        |machine| {
            std::thread::scope(|scope| {
                let operator = scope.spawn(|| {
                    let _moving = machine.wait_for("motion", |status| status.frames_executed > 60);
                    machine.command(Command::Hold);
                    let held = machine.wait_for_state(MachineState::Held);
                    assert_eq!(held.end_of_epoch(), Ok(EndOfEpoch::Open));
                    machine.command(Command::FeedOverride(0.5));
                    machine.command(Command::Resume);
                    let _moving = machine.wait_for("motion", |status| {
                        status.frames_executed > held.frames_executed + 40
                    });
                    machine.command(Command::FeedOverride(1.0));
                });
                machine.publish(&stop, |_| program(PROGRAM), || {}).unwrap();
                operator.join().unwrap();
            });
        },
    );
    let report = recording.audit(1, &plan(PROGRAM, AxisVector::zeros()).1);
    assert!(report.is_clean(), "{:?}", report.violations);
}

#[test]
fn the_stop_flag_of_the_planner_stops_the_machine_on_the_path() {
    let (instance, _watchdog) = (Instance::new(), Watchdog::new(PATIENCE));
    let stop = AtomicBool::new(false);
    let recording = Machine::run(
        instance.config(),
        |_| {},
        |machine| {
            let mut watch = machine.watch();
            let interrupt = || {
                let executed = watch.look().map_or(0, |status| status.frames_executed);
                stop.store(executed > 80, Ordering::Relaxed);
            };
            let result = machine.publish(&stop, |_| program(PROGRAM), interrupt);
            assert!(matches!(result, Err(RunError::Interrupted)), "{result:?}");
            let status = machine.wait_for_state(MachineState::Idle);
            assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Aborted));
        },
    );
    let report = recording.audit(1, &plan(PROGRAM, AxisVector::zeros()).1);
    let found: Vec<_> = report
        .violations
        .iter()
        .map(|violation| violation.kind)
        .collect();
    assert_eq!(found, [ViolationKind::Incomplete]);
}
