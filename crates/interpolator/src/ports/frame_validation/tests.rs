//! Tests of frame validation: every way a frame can be wrong.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::float_cmp,
    reason = "a test"
)]

use super::*;
use crate::testing::{lines, mill, records};
use glidepath_geometry::Axis;
use glidepath_kinematics::{CoreXy, JointLimit, Mechanism};

const PERIOD_NS: u64 = 4_000_000;

fn config() -> Config {
    let mut config = Config::new(mill(), PERIOD_NS);
    config.soft_limits = SoftLimits {
        lowest: AxisVector::repeat(-500.0),
        highest: AxisVector::repeat(500.0),
    };
    config
}

fn idle() -> MachineSnapshot {
    MachineSnapshot {
        state: MachineState::Idle,
        position: AxisVector::zeros(),
        epoch: 0,
        is_open: false,
    }
}

/// The machine while an epoch is executed.
fn running(epoch: u64) -> MachineSnapshot {
    MachineSnapshot {
        state: MachineState::Running,
        epoch,
        is_open: true,
        ..idle()
    }
}

fn frames(epoch: u64) -> Vec<SetpointFrame> {
    records(&lines(7, 3, 300, &mill(), 0.004), epoch, PERIOD_NS)
}

/// Judges all frames after a change to one of them; the first verdict that is not `Pass`.
fn first_not_passed(
    at: usize,
    change: impl FnOnce(&mut SetpointFrame),
) -> Option<(usize, FrameVerdict)> {
    let mut frames = frames(1);
    change(&mut frames[at]);
    let mut frame_validator = FrameValidator::new(&config());
    frames.iter().enumerate().find_map(|(i, frame)| {
        let machine = if i == 0 { idle() } else { running(1) };
        let verdict = frame_validator.judge(frame, &machine);
        (verdict != FrameVerdict::Pass).then_some((i, verdict))
    })
}

fn refusal(at: usize, change: impl FnOnce(&mut SetpointFrame)) -> (usize, FrameRefusal) {
    match first_not_passed(at, change).unwrap() {
        (i, FrameVerdict::Refused(refusal)) => (i, refusal),
        (
            i,
            FrameVerdict::Fault(Fault {
                cause: FaultCause::Frame(refusal),
                ..
            }),
        ) => (i, refusal),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_planned_trajectory_passes() {
    assert_eq!(first_not_passed(0, |_| ()), None);
}

#[test]
fn each_defect_has_its_reason() {
    let last = frames(1).len() - 1;
    let of = |at, change: fn(&mut SetpointFrame)| refusal(at, change);
    assert_eq!(
        of(50, |f| f.velocity[2] = f64::NAN),
        (50, FrameRefusal::NotFinite)
    );
    assert_eq!(of(50, |f| f.flags = 1 << 31), (50, FrameRefusal::Malformed));
    // What is to follow the spindle, and was not announced.
    assert_eq!(
        of(50, |f| f.flags = FrameFlags::SYNC.0),
        (50, FrameRefusal::Malformed)
    );
    assert_eq!(
        of(50, |f| f.period_ns = 1_000_000),
        (50, FrameRefusal::Period)
    );
    assert_eq!(of(50, |f| f.sequence = 60), (50, FrameRefusal::Sequence));
    assert_eq!(
        of(50, |f| f.position[0] += 10.0),
        (50, FrameRefusal::Velocity)
    );
    assert_eq!(of(50, |f| f.position[0] += 0.2).0, 50);
    assert_eq!(of(50, |f| f.position[5] += 0.004), (50, FrameRefusal::Jerk));
    // The limits of its planner are others: all of it follows from a jerk that is four times as high.
    let steep = |f: &mut SetpointFrame| {
        let (jerk_j, t) = (4.0 * config().limits.jerk[5], 0.004);
        f.acceleration[5] += jerk_j * t;
        f.velocity[5] += jerk_j * t * t / 2.0;
        f.position[5] += jerk_j * t * t * t / 6.0;
    };
    assert_eq!(of(50, steep), (50, FrameRefusal::Jerk));
    assert_eq!(
        of(50, |f| f.velocity[1] += 2.0),
        (50, FrameRefusal::Discontinuous)
    );
    assert_eq!(
        of(50, |f| f.acceleration[1] += 400.0),
        (50, FrameRefusal::Discontinuous)
    );
    assert_eq!(
        of(50, |f| f.position[0] = 501.0),
        (50, FrameRefusal::SoftLimit)
    );
    assert_eq!(
        of(last, |f| f.velocity[0] = 0.01),
        (last, FrameRefusal::NotAtRest)
    );
    assert_eq!(
        of(0, |f| f.velocity[0] = 0.01),
        (0, FrameRefusal::NotAtRest)
    );
    assert_eq!(
        of(0, |f| f.position[0] = 1e-6),
        (0, FrameRefusal::Elsewhere)
    );
    assert_eq!(of(0, |f| f.flags = 0), (0, FrameRefusal::Epoch));
}

#[test]
fn a_fault_names_line_axis_and_limit_and_ends_the_epoch() {
    let (at, verdict) = first_not_passed(50, |f| f.position[5] += 0.004).unwrap();
    let FrameVerdict::Fault(fault) = verdict else {
        panic!("{verdict:?}")
    };
    let frame = frames(1)[at];
    assert_eq!(
        (fault.sequence, fault.line, fault.axis),
        (50, frame.line, Some(Axis::C))
    );
    assert!(fault.limit > 0.0 && fault.value.abs() > fault.limit);

    let mut frame_validator = FrameValidator::new(&config());
    let mut broken = frames(1);
    broken[50].position[0] += 10.0;
    let verdicts: Vec<_> = broken
        .iter()
        .enumerate()
        .map(|(i, f)| frame_validator.judge(f, &if i == 0 { idle() } else { running(1) }))
        .collect();
    assert!(verdicts[..50].iter().all(|v| *v == FrameVerdict::Pass));
    assert!(verdicts[51..].iter().all(|v| *v == FrameVerdict::Late));
}

#[test]
fn what_was_accepted_may_come_again() {
    let frames = frames(1);
    let mut frame_validator = FrameValidator::new(&config());
    assert_eq!(
        frame_validator.judge(&frames[0], &idle()),
        FrameVerdict::Pass
    );
    for frame in &frames[1..20] {
        assert_eq!(
            frame_validator.judge(frame, &running(1)),
            FrameVerdict::Pass
        );
    }
    assert_eq!(
        frame_validator.judge(&frames[12], &running(1)),
        FrameVerdict::Known
    );
    assert_eq!(
        frame_validator.judge(&frames[20], &running(1)),
        FrameVerdict::Pass
    );
    assert_eq!(frame_validator.received(), 21);
}

#[test]
fn a_frame_out_of_the_middle_of_another_epoch_neither_waits_nor_ends_the_present_one() {
    let mut frames = frames(1);
    frames[100].epoch = 2;
    let mut frame_validator = FrameValidator::new(&config());
    for (i, frame) in frames.iter().enumerate() {
        let machine = if i == 0 { idle() } else { running(1) };
        let verdict = frame_validator.judge(frame, &machine);
        match i {
            0..100 => assert_eq!(verdict, FrameVerdict::Pass, "{i}"),
            100 => assert_eq!(verdict, FrameVerdict::Refused(FrameRefusal::Epoch)),
            // What it left behind is a gap, and that is the fault.
            101 => assert!(
                matches!(verdict, FrameVerdict::Fault(fault)
                    if fault.cause == FaultCause::Frame(FrameRefusal::Sequence)),
                "{verdict:?}"
            ),
            _ => break,
        }
    }
}

#[test]
fn a_new_epoch_waits_until_the_machine_stands() {
    let mut frame_validator = FrameValidator::new(&config());
    assert_eq!(
        frame_validator.judge(&frames(1)[0], &idle()),
        FrameVerdict::Pass
    );
    // The real-time thread has not opened the first yet, then it runs it.
    assert_eq!(
        frame_validator.judge(&frames(2)[0], &idle()),
        FrameVerdict::Later
    );
    assert_eq!(
        frame_validator.judge(&frames(2)[0], &running(1)),
        FrameVerdict::Later
    );
    let starved = MachineSnapshot {
        state: MachineState::Starved,
        ..running(1)
    };
    assert_eq!(
        frame_validator.judge(&frames(2)[0], &starved),
        FrameVerdict::Pass
    );
    // What is left of the first is over.
    let refused = FrameVerdict::Refused(FrameRefusal::Epoch);
    assert_eq!(frame_validator.judge(&frames(1)[1], &running(2)), refused);
    // An aborted epoch gets no more frames, and a fault lets none begin.
    let aborted = MachineSnapshot { epoch: 2, ..idle() };
    assert_eq!(
        frame_validator.judge(&frames(2)[1], &aborted),
        FrameVerdict::Late
    );
    let faulted = MachineSnapshot {
        state: MachineState::Faulted,
        ..aborted
    };
    frame_validator.note(&faulted);
    assert_eq!(frame_validator.judge(&frames(3)[0], &faulted), refused);
    // One whose first frame was refused does not begin any more: its planner was told so.
    assert_eq!(
        frame_validator.judge(&frames(3)[0], &aborted),
        FrameVerdict::Late
    );
    assert_eq!(frame_validator.next_epoch(2), 4);
    assert_eq!(
        frame_validator.judge(&frames(4)[0], &aborted),
        FrameVerdict::Pass
    );
}

#[test]
fn no_epoch_leaves_no_number_for_the_next_planner() {
    let refused = FrameVerdict::Refused(FrameRefusal::Epoch);
    for highest in [u64::MAX, u64::MAX - 1, 1 << 32, 2 + EPOCH_STEP_MAX] {
        let mut frame_validator = FrameValidator::new(&config());
        assert_eq!(
            frame_validator.judge(&frames(1)[0], &idle()),
            FrameVerdict::Pass
        );
        // Neither while another epoch is under way nor after it: the motion is not disturbed.
        assert_eq!(
            frame_validator.judge(&frames(highest)[0], &running(1)),
            refused
        );
        assert_eq!(
            frame_validator.judge(&frames(1)[1], &running(1)),
            FrameVerdict::Pass
        );
        let ended = MachineSnapshot { epoch: 1, ..idle() };
        assert_eq!(frame_validator.judge(&frames(highest)[0], &ended), refused);
        assert_eq!(frame_validator.epoch, 1);
        assert_eq!(
            frame_validator.judge(&frames(2)[0], &ended),
            FrameVerdict::Pass
        );
    }
}

/// The verdict on a motion of axes one of whose joints has a limit.
fn with_joint_limit(limit: JointLimit) -> Option<(FrameRefusal, f64, f64)> {
    let mut config = config();
    config.mechanism = Mechanism::CoreXy(CoreXy::new(&[Axis::X, Axis::Y, Axis::Z]));
    config.joint_limits.0[0] = limit;
    let mut frame_validator = FrameValidator::new(&config);
    let verdicts = frames(1).into_iter().enumerate().map(|(i, frame)| {
        let machine = if i == 0 { idle() } else { running(1) };
        frame_validator.judge(&frame, &machine)
    });
    match verdicts
        .into_iter()
        .find(|verdict| *verdict != FrameVerdict::Pass)?
    {
        FrameVerdict::Fault(Fault {
            cause: FaultCause::Frame(refusal),
            value,
            limit,
            ..
        }) => Some((refusal, value, limit)),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_a_joint_cannot_do_is_refused_like_what_an_axis_cannot() {
    assert_eq!(with_joint_limit(JointLimit::NONE), None);
    // Inside what each axis can do: two of them move the first belt.
    let cases = [
        (
            JointLimit {
                min_position: -0.1,
                max_position: 0.1,
                ..JointLimit::NONE
            },
            FrameRefusal::SoftLimit,
        ),
        (
            JointLimit {
                velocity: 50.0,
                ..JointLimit::NONE
            },
            FrameRefusal::Velocity,
        ),
        (
            JointLimit {
                acceleration: 500.0,
                ..JointLimit::NONE
            },
            FrameRefusal::Acceleration,
        ),
        (
            JointLimit {
                jerk: 10_000.0,
                ..JointLimit::NONE
            },
            FrameRefusal::Jerk,
        ),
    ];
    for (joint, expected) in cases {
        let (refusal, value, limit) = with_joint_limit(joint).unwrap();
        assert_eq!(refusal, expected);
        assert!(value.abs() > limit.abs(), "{expected:?}: {value} {limit}");
    }
}

/// Frames of three axes that begin at a place of X, on the way of the others.
#[test]
fn an_axis_that_stands_outside_may_stay_and_come_inwards_but_goes_no_further_out() {
    let at = |x: f64| {
        let mut frames = frames(1);
        for frame in &mut frames {
            frame.position[0] += x - frame.position[0];
            (frame.velocity[0], frame.acceleration[0]) = (0.0, 0.0);
        }
        frames
    };
    let judged = |frames: &[SetpointFrame], stands: f64| {
        let mut frame_validator = FrameValidator::new(&config());
        let mut position = AxisVector::zeros();
        position[0] = stands;
        let verdicts = frames.iter().enumerate().map(|(i, frame)| {
            let machine = if i == 0 { idle() } else { running(1) };
            frame_validator.judge(
                frame,
                &MachineSnapshot {
                    position,
                    ..machine
                },
            )
        });
        let mut refused = verdicts.enumerate();
        refused.find(|(_, verdict)| *verdict != FrameVerdict::Pass)
    };
    assert_eq!(judged(&at(503.0), 503.0), None, "it stays");
    // By a nanometre a frame, which no limit minds.
    let drifting = |by: f64| {
        let mut frames = at(503.0);
        for frame in &mut frames {
            frame.position[0] += by * frame.sequence as f64;
        }
        frames
    };
    assert_eq!(judged(&drifting(-1e-8), 503.0), None, "it comes inwards");
    let (at, verdict) = judged(&drifting(1e-8), 503.0).unwrap();
    assert!(
        matches!(verdict, FrameVerdict::Fault(Fault { cause: FaultCause::Frame(FrameRefusal::SoftLimit), limit, .. })
            if limit == 503.0),
        "{at}: {verdict:?}"
    );
}
