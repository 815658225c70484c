//! Tests of what is said of faults.

use super::*;
use crate::record::Text;

#[test]
fn faults_have_texts_of_their_own_and_say_what_clears_them() {
    let all: Vec<FaultCause> = FaultCause::all().collect();
    assert_eq!(all.len(), 23 + FrameRefusal::ALL.len());
    for (i, cause) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|other| other.text() != cause.text()));
        assert!(cause.remedy().contains("`glidepath "), "{cause:?}");
    }
}

#[test]
fn a_fault_is_one_clause_with_its_place_and_rounded_numbers_with_units() {
    let mut report = FaultReport {
        cause: FaultCause::Frame(FrameRefusal::Velocity),
        axis: Some(Axis::X),
        joint: None,
        drive_fault: 0,
        value: 210.345_678_901_234_5,
        limit: 200.0,
        line: 12,
    };
    assert_eq!(
        report.to_string(),
        "a frame was refused: it is above the velocity limit, axis X, 210 where 200 mm/s is \
         allowed, line 12"
    );
    (report.cause, report.axis, report.joint) = (FaultCause::FollowingError, None, Some(1));
    (report.value, report.limit, report.line) = (3.214_159_265_358_979, 0.5, 0);
    assert_eq!(
        report.to_string(),
        "a joint is too far from where it is to be, joint J1, 3.21 where 0.5 mm or ° is allowed"
    );
    (report.cause, report.joint) = (FaultCause::MissedTicks, None);
    for allowed in [0.0, 3.0] {
        (report.value, report.limit) = (7.0, allowed);
        assert_eq!(
            report.to_string(),
            format!("too many ticks were missed: 7 within a second, where {allowed} are allowed")
        );
    }
    (report.cause, report.joint) = (FaultCause::FeedbackLost, None);
    (report.value, report.limit, report.line) = (0.016_000_1, 0.012, 7);
    assert_eq!(
        report.to_string(),
        "the drives no longer say where they are: what they said last is 0.016 s old, where 0.012 s \
         is allowed, line 7"
    );
}

#[test]
fn what_a_servo_stack_has_lost_is_told_by_its_own_number() {
    let text = |cause, value| {
        let report = FaultReport {
            cause,
            axis: None,
            joint: None,
            drive_fault: 0,
            value,
            limit: 0.0,
            line: 7,
        };
        report.to_string()
    };
    let table = [
        (
            FaultCause::SetpointsLost,
            0.03,
            "the drives heard no setpoints for 30 ms, line 7",
        ),
        (
            FaultCause::DeviceLost,
            0.0,
            "a device on the bus of the drives is lost: the one at position 0 of the line, line 7",
        ),
        (
            FaultCause::DeviceLost,
            -1.0,
            "a device on the bus of the drives is lost: one that says that it is in OP, line 7",
        ),
        (
            FaultCause::BusLost,
            0.0,
            "the bus of the drives was lost, line 7",
        ),
    ];
    for (cause, value, told) in table {
        assert_eq!(text(cause, value), told);
    }
}

#[test]
fn what_somebody_said_of_a_fault_is_told_with_it_and_nothing_is_told_twice() {
    let mut status: Status = bytemuck::Zeroable::zeroed();
    assert_eq!(status.fault_text(), None);
    status.fault = FaultCause::AuxFailed.code();
    status.last_error = Text::new("no tool 7 in the magazine");
    assert_eq!(
        status.fault_text().as_deref(),
        Some("what an event asked for has failed: no tool 7 in the magazine")
    );
    status.last_error = Text::new(FaultCause::AuxFailed.text());
    assert_eq!(
        status.fault_text().as_deref(),
        Some(FaultCause::AuxFailed.text())
    );
    // What was said last may be of something else.
    status.fault = FaultCause::Drive.code();
    status.last_error = Text::new("joint J0 follows with an error of 0.1");
    assert_eq!(
        status.fault_text().as_deref(),
        Some(FaultCause::Drive.text())
    );
}

#[test]
fn causes_of_losses_are_those_of_feedback() {
    use crate::record::Loss;
    let causes: Vec<_> = Loss::ALL
        .iter()
        .map(|loss| FaultCause::of_loss(*loss))
        .collect();
    let expected = [
        FaultCause::SetpointsLost,
        FaultCause::DeviceLost,
        FaultCause::BusLost,
        FaultCause::SpindleDrive,
        FaultCause::SpindleGear,
    ];
    assert_eq!(causes[0], None);
    assert_eq!(causes[1..], expected.map(Some));
    let are_losses = FaultCause::all().filter(|cause| cause.is_loss());
    assert_eq!(are_losses.collect::<Vec<_>>(), expected);
}
