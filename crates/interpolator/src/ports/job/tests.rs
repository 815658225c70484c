//! Tests of the job of a planner: what ends it, and what it is told.

use super::*;
use crate::shared::fault::Fault;
use crate::shared::message::TickReport;
use glidepath_link::FaultCause;

const FREE: Result<(), &str> = Ok(());

fn told(jobs: &mut JobBook, number: u64, phase: JobPhase, now_ns: u64) -> Result<Told, String> {
    jobs.tell(
        (number, phase, 0),
        Text::new("a.ngc: checking"),
        now_ns,
        FREE,
    )
}

fn in_state(state: MachineState) -> TickReport {
    TickReport {
        state,
        ..TickReport::blank()
    }
}

#[test]
fn a_job_takes_an_idle_machine_and_gives_it_back() {
    let mut jobs = JobBook::new();
    let idle = in_state(MachineState::Idle);
    assert_eq!(told(&mut jobs, 7, JobPhase::Waiting, 1), Ok(Told::Nothing));
    assert_eq!(jobs.state(&idle), MachineState::Idle);
    let busy = jobs.tell(
        (7, JobPhase::Preparing, 0),
        Text::new(""),
        2,
        Err("it moves"),
    );
    assert_eq!(busy, Err("it moves".to_owned()));
    assert_eq!(told(&mut jobs, 7, JobPhase::Preparing, 3), Ok(Told::Takes));
    assert_eq!(jobs.state(&idle), MachineState::Preparing);
    assert_eq!(
        told(&mut jobs, 7, JobPhase::Preparing, 4),
        Ok(Told::Nothing)
    );
    assert_eq!(told(&mut jobs, 7, JobPhase::Over, 5), Ok(Told::GivesBack));
    assert_eq!(jobs.state(&idle), MachineState::Idle);
    assert!(told(&mut jobs, 7, JobPhase::Preparing, 6).is_err(), "over");
}

#[test]
fn an_aborted_job_stays_aborted_in_every_phase() {
    for phases in [
        &[JobPhase::Waiting][..],
        &[JobPhase::Waiting, JobPhase::Preparing],
    ] {
        let mut jobs = JobBook::new();
        for phase in phases {
            told(&mut jobs, 7, *phase, 1).unwrap();
        }
        let had_machine = phases.len() == 2;
        assert_eq!(jobs.end(JobStage::Aborted, "by hand"), had_machine);
        for phase in [JobPhase::Waiting, JobPhase::Preparing] {
            assert_eq!(told(&mut jobs, 7, phase, 2), Err("by hand".to_owned()));
        }
        jobs.begin();
        assert_eq!(jobs.stage, JobStage::Aborted, "no frame makes it begin");
        // The next one is free of it.
        assert_eq!(told(&mut jobs, 8, JobPhase::Waiting, 3), Ok(Told::Nothing));
        assert_eq!(told(&mut jobs, 8, JobPhase::Preparing, 3), Ok(Told::Takes));
    }
}

#[test]
fn a_hold_is_kept_for_the_beginning_and_ends_with_the_job() {
    let mut jobs = JobBook::new();
    jobs.hold(true);
    assert!(!jobs.is_held(), "there is no job");
    told(&mut jobs, 7, JobPhase::Waiting, 1).unwrap();
    jobs.hold(true);
    assert!(jobs.is_held());
    told(&mut jobs, 7, JobPhase::Preparing, 2).unwrap();
    assert!(jobs.is_held());
    jobs.hold(false);
    assert!(!jobs.is_held());
    jobs.hold(true);
    jobs.end(JobStage::Aborted, "");
    assert!(!jobs.is_held());
}

#[test]
fn a_silent_planner_and_an_unfit_machine_end_a_job() {
    let mut jobs = JobBook::new();
    told(&mut jobs, 7, JobPhase::Waiting, 0).unwrap();
    let off = in_state(MachineState::Off);
    assert!(!jobs.watch(&off, false, SILENCE_NS), "it waits for power");
    assert!(jobs.is_to_come());
    assert!(!jobs.watch(&off, false, SILENCE_NS + 1));
    assert!(!jobs.is_to_come());

    let mut jobs = JobBook::new();
    told(&mut jobs, 7, JobPhase::Waiting, 0).unwrap();
    told(&mut jobs, 7, JobPhase::Preparing, 0).unwrap();
    assert!(!jobs.watch(&in_state(MachineState::Idle), false, 1));
    assert!(jobs.watch(&off, false, 2), "it had the machine");
    let refused = told(&mut jobs, 7, JobPhase::Preparing, 3);
    assert_eq!(refused, Err(MachineState::Off.text().to_owned()));
}

#[test]
fn a_job_that_a_fault_ends_says_which() {
    let mut jobs = JobBook::new();
    told(&mut jobs, 7, JobPhase::Waiting, 0).unwrap();
    told(&mut jobs, 7, JobPhase::Preparing, 0).unwrap();
    let mut faulted = in_state(MachineState::Faulted);
    faulted.fault = Some(Fault::new(FaultCause::FeedbackLost, 0, 0));
    assert!(jobs.watch(&faulted, false, 2));
    let refused = told(&mut jobs, 7, JobPhase::Preparing, 3);
    assert_eq!(refused, Err(FaultCause::FeedbackLost.text().to_owned()));
}

#[test]
fn a_planner_that_is_started_anew_ends_the_job_before() {
    let mut jobs = JobBook::new();
    told(&mut jobs, 7, JobPhase::Waiting, 0).unwrap();
    told(&mut jobs, 7, JobPhase::Preparing, 0).unwrap();
    assert_eq!(
        told(&mut jobs, 8, JobPhase::Waiting, 1),
        Ok(Told::GivesBack)
    );
    assert!(!jobs.has_machine() && jobs.is_to_come());
    assert_eq!(told(&mut jobs, 7, JobPhase::Over, 2), Ok(Told::Nothing));
    assert!(jobs.is_to_come(), "what is over is the other one");
}

const ABORT: (JobStage, &str) = (JobStage::Aborted, "aborted before anything moved");

/// `disable` just behind a job that its planner has not told of: its client hears of the power, not of an abort.
#[test]
fn a_job_that_was_asked_for_before_a_stop_is_told_which_stop_it_was() {
    let ended = |by| {
        let mut jobs = JobBook::new();
        jobs.stop(50, by);
        let told = jobs.tell((7, JobPhase::Waiting, 49), Text::new(""), 100, FREE);
        (jobs.stage, told.unwrap_err())
    };
    let switched_off = (JobStage::Refused, "the drives were switched off");
    let (stage, why) = ended(switched_off);
    assert_eq!((stage, why.as_str()), switched_off);
    let (stage, why) = ended(ABORT);
    assert!(stage == JobStage::Aborted && why.contains("was stopped after this was asked for"));
}

#[test]
fn a_stream_is_known_by_what_its_planner_says_and_not_by_a_name() {
    let is_of_stream = |number, name: &str, is_stream| {
        let mut jobs = JobBook::new();
        for phase in [JobPhase::Waiting, JobPhase::Preparing] {
            jobs.tell((7, phase, 0), Text::new(name), 0, FREE).unwrap();
        }
        jobs.note_stream(number, is_stream);
        jobs.begin();
        let mut status = bytemuck::Zeroable::zeroed();
        jobs.write(&mut status);
        status.is_of_stream()
    };
    assert!(!is_of_stream(7, "a stream of segments.ngc", false));
    assert!(is_of_stream(7, "anything", true));
    assert!(!is_of_stream(6, "anything", true), "it is of another job");
}

#[test]
fn a_stop_counts_for_what_was_asked_for_before_it_whenever_its_planner_tells() {
    let asked = |jobs: &mut JobBook, number, asked_ns| {
        jobs.tell(
            (number, JobPhase::Waiting, asked_ns),
            Text::new(""),
            100,
            FREE,
        )
    };
    let mut jobs = JobBook::new();
    jobs.stop(50, ABORT);
    assert!(asked(&mut jobs, 7, 49).is_err());
    assert!(!jobs.is_to_come());
    for asked_ns in [50, 51, 0] {
        let number = 8 + asked_ns;
        assert_eq!(
            asked(&mut jobs, number, asked_ns),
            Ok(Told::Nothing),
            "{asked_ns}"
        );
        assert!(jobs.is_to_come() && !jobs.is_held());
    }
    jobs.hold_what_was_asked(60, false);
    assert_eq!(asked(&mut jobs, 70, 59), Ok(Told::Nothing));
    assert!(jobs.is_held(), "it begins held");
    assert_eq!(asked(&mut jobs, 71, 61), Ok(Told::Nothing));
    assert!(!jobs.is_held());
    // The job before has the machine.
    assert_eq!(
        told(&mut jobs, 71, JobPhase::Preparing, 101),
        Ok(Told::Takes)
    );
    jobs.stop(110, ABORT);
    assert_eq!(asked(&mut jobs, 72, 109), Ok(Told::GivesBack));
    assert!(asked(&mut jobs, 72, 109).is_err());
}

#[test]
fn a_job_that_rests_under_way_is_an_orphan_when_its_planner_falls_silent() {
    let mut jobs = JobBook::new();
    told(&mut jobs, 7, JobPhase::Waiting, 0).unwrap();
    told(&mut jobs, 7, JobPhase::Preparing, 0).unwrap();
    jobs.begin();
    let resting = |state| TickReport {
        end_of_epoch: EndOfEpoch::Open,
        ..in_state(state)
    };
    for state in [
        MachineState::Held,
        MachineState::ProgramStop,
        MachineState::Awaiting,
    ] {
        assert!(!jobs.is_orphaned(&resting(state), SILENCE_NS));
        assert!(jobs.is_orphaned(&resting(state), SILENCE_NS + 1));
        assert!(
            !jobs.is_orphaned(&in_state(state), SILENCE_NS + 1),
            "it is over"
        );
    }
    let running = resting(MachineState::Running);
    assert!(
        !jobs.is_orphaned(&running, SILENCE_NS + 1),
        "its frames tell"
    );
    told(&mut jobs, 7, JobPhase::Preparing, SILENCE_NS).unwrap();
    assert!(!jobs.is_orphaned(&resting(MachineState::Held), SILENCE_NS + 1));
}

#[test]
fn what_was_asked_for_before_a_stop_is_known() {
    let mut jobs = JobBook::new();
    assert!(!jobs.was_stopped_after(1));
    jobs.stop(50, ABORT);
    jobs.hold_what_was_asked(60, true);
    for (asked_ns, was_stopped) in [(0, false), (49, true), (59, true), (60, false), (61, false)] {
        assert_eq!(jobs.was_stopped_after(asked_ns), was_stopped, "{asked_ns}");
    }
}
