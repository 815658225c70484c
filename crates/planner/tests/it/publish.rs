//! Tests of publishing, against an interpolator driven by the planner's own pauses.

use std::cell::RefCell;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::support::attended;
use crate::support::interpolator::Interpolator;
use crate::support::items::{Listed, PERIOD_NS, point, polyline, records, settings, staircase};
use glidepath_gcode::Options;
use glidepath_link::{
    Capacity, EndOfEpoch, FaultCause, InProcess, JobStage, MachineState, Transport,
};
use glidepath_planner::{
    Control, FramePublisher, ItemSource, Pace, Pipeline, ProgramSource, Refusal, RemarkLog,
    RunChannels, RunError, Statistics, Supply,
};

const HORIZON: u64 = 50;

fn pace() -> Pace {
    Pace {
        period_ns: PERIOD_NS,
        horizon_frames: HORIZON,
    }
}

/// The whole way of `planner FILE`: wait, plan from where the machine stands, publish.
fn run(
    transport: &dyn Transport,
    source: impl ItemSource + Send,
    pace: Pace,
    control: &mut Control<'_>,
) -> Result<Statistics, RunError> {
    let mut publisher = FramePublisher::connect(transport, pace)?;
    let start = publisher.wait_until_ready(("part", 0), control)?;
    publisher.publish(&mut Pipeline::new(source, settings(), start), control)
}

#[test]
fn every_frame_is_executed_once_and_in_order() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let (result, notices) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, Listed::new(&staircase(20)), pace(), control),
    );
    let interpolator = interpolator.into_inner();
    let expected = records(&staircase(20), 1);
    assert!(
        interpolator.executed == expected,
        "other frames than planned"
    );
    let statistics = result.unwrap();
    assert_eq!(
        (statistics.segments, statistics.frames),
        (20, expected.len() as u64)
    );
    assert_eq!(interpolator.end(), EndOfEpoch::Completed);
    assert_eq!(interpolator.starved, 0);
    assert_eq!(notices, ["Started { epoch: 1 }"]);
}

#[test]
fn what_a_program_says_is_told_when_the_machine_comes_to_it() {
    const TEXT: &str = "(MSG, begins)\nG21 G90 G1 X1 F600\n(MSG, half)\n(DEBUG, at #5420)\nX30\n\
                        (MSG, over)\nM2\n";
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let positions = RefCell::new(Vec::new());
    let (result, notices) = attended(
        &AtomicBool::new(false),
        |time| {
            let mut interpolator = interpolator.borrow_mut();
            interpolator.pass(time);
            if interpolator.told.len() > positions.borrow().len() {
                positions.borrow_mut().push(interpolator.position[0]);
            }
        },
        |control| {
            let mut publisher = FramePublisher::connect(&transport, pace())?;
            let start = publisher.wait_until_ready(("part", 0), control)?;
            let log = RemarkLog::default();
            publisher.attend_remarks(log.clone());
            let source = ProgramSource::new(TEXT.as_bytes(), Options::default());
            let source = source.attended(RunChannels {
                remarks: Some(log),
                ..RunChannels::default()
            });
            publisher.publish(&mut Pipeline::new(source, settings(), start), control)
        },
    );
    result.unwrap();
    // A status has room for one: the last of those that come together.
    let told = &interpolator.borrow().told;
    assert_eq!(told, &["begins", "at 1.000000", "over"]);
    let positions = positions.into_inner();
    assert!(positions[0] < 1.0, "{positions:?}");
    assert!(positions[1] > 1.0 && positions[1] < 5.0, "{positions:?}");
    assert!((positions[2] - 30.0).abs() < 1e-9, "{positions:?}");
    let remarks: Vec<&String> = notices.iter().filter(|n| n.contains("Remark")).collect();
    assert_eq!(remarks.len(), 4, "{notices:#?}");
}

#[test]
fn the_horizon_is_kept_and_used() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 1000));
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, Listed::new(&staircase(20)), pace(), control),
    );
    result.unwrap();
    let deepest = interpolator.into_inner().deepest as u64;
    assert_eq!(deepest, HORIZON);
}

#[test]
fn a_full_queue_loses_nothing() {
    let transport = InProcess::new(Capacity {
        frames: 2,
        ..Capacity::default()
    });
    let interpolator = RefCell::new(Interpolator::new(&transport, 3));
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, Listed::new(&staircase(8)), pace(), control),
    );
    result.unwrap();
    assert!(interpolator.into_inner().executed == records(&staircase(8), 1));
}

#[test]
fn waits_for_an_interpolator_that_comes_late() {
    let transport = InProcess::default();
    let mut interpolator = None;
    let mut waited = Duration::ZERO;
    let (result, notices) = attended(
        &AtomicBool::new(false),
        |time| {
            waited += time;
            if waited > Duration::from_secs(5) {
                interpolator
                    .get_or_insert_with(|| Interpolator::new(&transport, 128))
                    .pass(time);
            }
        },
        |control| run(&transport, Listed::new(&staircase(4)), pace(), control),
    );
    result.unwrap();
    assert!(interpolator.unwrap().executed == records(&staircase(4), 1));
    assert_eq!(notices, ["NoInterpolator", "Started { epoch: 1 }"]);
}

#[test]
fn a_horizon_below_the_resume_threshold_does_not_deadlock() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    interpolator.borrow_mut().resume_at = 20;
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| {
            // Without frames for a while at the start, so that it starves.
            let delays = [0, 200];
            let source = Listed::delayed(&staircase(6), &delays);
            run(
                &transport,
                source,
                Pace {
                    horizon_frames: 5,
                    ..pace()
                },
                control,
            )
        },
    );
    result.unwrap();
    let interpolator = interpolator.into_inner();
    assert!(interpolator.starved > 0, "the test did not starve it");
    assert!(interpolator.executed == records(&staircase(6), 1));
}

#[test]
fn a_planner_without_frames_shows_that_it_lives() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| {
            // 10 000 looks at 200 µs are two seconds without items, after enough for some frames.
            let delays = [0, 0, 0, 0, 0, 0, 10_000];
            run(
                &transport,
                Listed::delayed(&staircase(12), &delays),
                pace(),
                control,
            )
        },
    );
    result.unwrap();
    let interpolator = interpolator.into_inner();
    assert!(interpolator.executed == records(&staircase(12), 1));
    assert!(
        (8..=10).contains(&interpolator.repeated),
        "{}",
        interpolator.repeated
    );
}

/// Thinks for two seconds between two items, without ever being out of them: loops that move nothing.
struct Thinking<'a> {
    items: Listed,
    left: u32,
    thought: &'a OnceLock<Duration>,
}

impl ItemSource for Thinking<'_> {
    fn next_item(&mut self) -> Supply {
        self.left = self.left.wrapping_sub(1);
        if self.left == 0 {
            let begun = Instant::now();
            std::thread::sleep(Duration::from_secs(2));
            let _first = self.thought.set(begun.elapsed());
        }
        self.items.next_item()
    }

    fn lines_read(&self) -> u64 {
        self.items.lines_read()
    }
}

#[test]
fn a_planner_that_thinks_gives_signs_of_life() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let thought = OnceLock::new();
    let source = Thinking {
        items: Listed::new(&staircase(12)),
        left: 9,
        thought: &thought,
    };
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, source, pace(), control),
    );
    result.unwrap();
    let interpolator = interpolator.into_inner();
    assert!(interpolator.executed == records(&staircase(12), 1));
    // Every 200 ms by the clock; a busy host lets the planner come to it more seldom.
    let (repeated, most) = (
        interpolator.repeated,
        thought.get().unwrap().as_millis() / 200,
    );
    assert!(
        repeated >= 2 && u128::from(repeated) <= most + 1,
        "{repeated} of {most}"
    );
}

#[test]
fn the_stop_flag_aborts() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let stop = AtomicBool::new(false);
    let (result, _) = attended(
        &stop,
        |time| {
            let mut interpolator = interpolator.borrow_mut();
            interpolator.pass(time);
            stop.store(interpolator.executed.len() > 100, Ordering::Relaxed);
        },
        |control| run(&transport, Listed::new(&staircase(200)), pace(), control),
    );
    assert!(matches!(result, Err(RunError::Interrupted)), "{result:?}");
    assert_eq!(interpolator.into_inner().end(), EndOfEpoch::Aborted);
}

/// What comes of a run to whose interpolator something happens after a hundred frames.
fn upset_under_way(upset: impl Fn(&mut Interpolator)) -> Result<Statistics, RunError> {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| {
            let mut interpolator = interpolator.borrow_mut();
            interpolator.pass(time);
            if interpolator.executed.len() == 100 {
                upset(&mut interpolator);
            }
        },
        |control| run(&transport, Listed::new(&staircase(200)), pace(), control),
    );
    result
}

#[test]
fn an_abort_by_somebody_else_is_reported() {
    let result = upset_under_way(|interpolator| interpolator.abort());
    assert!(matches!(result, Err(RunError::Aborted)), "{result:?}");
}

#[test]
fn a_fault_is_reported_with_its_cause() {
    let result = upset_under_way(|interpolator| interpolator.fail(FaultCause::MissedTicks));
    match result {
        Err(RunError::Fault(fault)) => assert_eq!(fault.cause, FaultCause::MissedTicks),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_fault_that_was_reset_before_it_was_seen_is_called_that() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| {
            let mut interpolator = interpolator.borrow_mut();
            if interpolator.executed.len() >= 100 && interpolator.end() == EndOfEpoch::Open {
                interpolator.fail(FaultCause::MissedTicks);
                interpolator.reset();
            }
            interpolator.pass(time);
        },
        |control| run(&transport, Listed::new(&staircase(200)), pace(), control),
    );
    let told = result.unwrap_err().to_string();
    assert_eq!(
        told,
        "the machine stopped by a fault that was reset meanwhile"
    );
}

#[test]
fn an_interpolator_that_dies_is_noticed() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Some(Interpolator::new(&transport, 128)));
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| {
            let mut slot = interpolator.borrow_mut();
            if let Some(interpolator) = slot.as_mut() {
                interpolator.pass(time);
                if interpolator.executed.len() >= 100 {
                    *slot = None;
                }
            }
        },
        |control| run(&transport, Listed::new(&staircase(200)), pace(), control),
    );
    assert!(
        matches!(result, Err(RunError::InterpolatorLost)),
        "{result:?}"
    );
}

#[test]
fn a_planner_starts_where_a_dead_one_left_the_machine() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    interpolator.borrow_mut().position = point(3.0, 4.0);
    let items = polyline(&[point(3.0, 4.0), point(10.0, 4.0)]);
    let (result, notices) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, Listed::new(&items), pace(), control),
    );
    result.unwrap();
    let interpolator = interpolator.into_inner();
    assert_eq!(interpolator.position, point(10.0, 4.0));
    assert_eq!(interpolator.state(), MachineState::Idle);
    assert_eq!(interpolator.job_stage(), JobStage::Over);
    assert_eq!(
        interpolator.doings,
        ["part: waits for the machine", "part: planning", "part"]
    );
    assert_eq!(notices, ["Started { epoch: 1 }"]);
}

/// Runs a program whose check takes until `checked_at`; something else happens at `at`, ms.
fn interfered(
    (at, checked_at): (u64, u64),
    interfere: impl Fn(&mut Interpolator),
) -> (Result<Statistics, RunError>, Interpolator) {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let (is_checked, time) = (AtomicBool::new(false), RefCell::new(Duration::ZERO));
    let [at, checked_at] = [at, checked_at].map(Duration::from_millis);
    let (result, _) = attended(
        &AtomicBool::new(false),
        |waited| {
            let mut now = time.borrow_mut();
            let before = *now;
            *now += waited;
            if before < at && *now >= at {
                interfere(&mut interpolator.borrow_mut());
            }
            is_checked.store(*now >= checked_at, Ordering::Relaxed);
            interpolator.borrow_mut().pass(waited);
        },
        |control| {
            let mut publisher = FramePublisher::connect(&transport, pace())?;
            let start = publisher.wait_until_ready(("part", 0), control)?;
            let watch = publisher.watch();
            let check = || {
                while !is_checked.load(Ordering::Relaxed) && !watch.is_to_end() {
                    std::thread::sleep(Duration::from_millis(1));
                }
            };
            let nobody = &mut |_: Duration| {};
            publisher.work("checking", nobody, control, check)?;
            let source = Listed::new(&staircase(3));
            publisher.publish(&mut Pipeline::new(source, settings(), start), control)
        },
    );
    (result, interpolator.into_inner())
}

#[test]
fn an_abort_before_the_first_frame_ends_the_job_and_nothing_moves() {
    // While it waits for the machine, and while it is checked.
    for at in [12, 60, 150, 250] {
        let (result, interpolator) = interfered((at, 300), Interpolator::abort);
        assert!(matches!(result, Err(RunError::Aborted)), "{at}: {result:?}");
        assert_eq!(interpolator.executed.len(), 0, "{at}");
        assert_eq!(interpolator.job_stage(), JobStage::Aborted, "{at}");
    }
}

#[test]
fn a_first_frame_that_is_refused_ends_the_job_with_its_reason() {
    let (result, interpolator) = interfered((12, 60), |machine| machine.refuses = true);
    let why = match result {
        Err(RunError::NotBegun { why }) => why,
        other => panic!("{other:?}"),
    };
    assert_eq!(why, "it stands elsewhere");
    assert_eq!(interpolator.executed.len(), 0);
}

#[test]
fn a_machine_that_becomes_unfit_ends_the_job_with_its_reason() {
    let (result, interpolator) = interfered((100, 300), |machine| {
        machine.end_job(JobStage::Refused, "the drives were switched off");
    });
    assert!(
        matches!(&result, Err(RunError::NotBegun { why }) if why.contains("switched off")),
        "{result:?}"
    );
    assert_eq!(interpolator.executed.len(), 0);
}

#[test]
fn no_fault_is_reset_by_a_planner() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    interpolator.borrow_mut().fail(FaultCause::PlannerLost);
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, Listed::new(&staircase(2)), pace(), control),
    );
    let error = result.unwrap_err();
    assert!(error.to_string().contains("glidepath reset"), "{error}");
    assert_eq!(interpolator.into_inner().state(), MachineState::Faulted);
}

#[test]
fn other_faults_are_left_to_the_operator() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    interpolator.borrow_mut().fail(FaultCause::MissedTicks);
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, Listed::new(&staircase(2)), pace(), control),
    );
    assert!(matches!(result, Err(RunError::Fault(_))), "{result:?}");
    assert_eq!(interpolator.into_inner().state(), MachineState::Faulted);
}

#[test]
fn a_program_that_fails_midway_is_executed_up_to_there() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let mut source = Listed::new(&staircase(5));
    source.fails = true;
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| run(&transport, source, pace(), control),
    );
    assert!(
        matches!(result, Err(RunError::Refused(Refusal::Read(_)))),
        "{result:?}"
    );
    let interpolator = interpolator.into_inner();
    assert!(interpolator.executed == records(&staircase(5), 1));
    assert_eq!(interpolator.position, point(15.0, 10.0));
    assert_eq!(interpolator.end(), EndOfEpoch::Completed);
}

#[test]
fn another_period_is_refused() {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let (result, _) = attended(
        &AtomicBool::new(false),
        |time| interpolator.borrow_mut().pass(time),
        |control| {
            let pace = Pace {
                period_ns: 1_000_000,
                ..pace()
            };
            run(&transport, Listed::new(&staircase(2)), pace, control)
        },
    );
    assert!(
        matches!(result, Err(RunError::PeriodMismatch { .. })),
        "{result:?}"
    );
}
