//! A job between its announcement and its first motion, with an operator's commands at every tick.

use super::bench::{Bench, config};
use super::client::Machine;
use crate::shared::config::Config;
use glidepath_link::{Command, EndOfEpoch, JobPhase, JobStage, MachineState};
use glidepath_plant::{InjectedFault, JointSettings};

/// Ticks from before the job has the machine to when its motion is under way.
const TICKS: usize = 16;

fn tell(bench: &mut Bench, number: u64, phase: JobPhase) -> Result<(), String> {
    bench.command(Command::Job {
        number,
        phase,
        asked_ns: 0,
        is_stream: false,
    })
}

/// A machine that is ready.
fn ready() -> Bench {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    bench.run(5);
    bench
}

/// Takes the machine for a job, and lines up its frames with the number that it was given.
fn begin(bench: &mut Bench, number: u64) {
    tell(bench, number, JobPhase::Waiting).unwrap();
    tell(bench, number, JobPhase::Preparing).unwrap();
    let status = bench.status();
    assert_eq!(status.job_stage(), Ok(JobStage::Preparing));
    assert_eq!(status.state(), Ok(MachineState::Preparing));
    bench.next_epoch(status.next_epoch);
    bench.load(number, 200);
}

/// Another job is executed to its end.
fn goes_on(bench: &mut Bench, number: u64) {
    begin(bench, number);
    let before = bench.last().position;
    assert!(bench.run_to(MachineState::Running, 60));
    assert!(bench.run_to(MachineState::Idle, 2_000));
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert_ne!(bench.last().position, before);
    tell(bench, number, JobPhase::Over).unwrap();
}

#[test]
fn behind_an_abort_nothing_of_the_job_moves_whenever_it_comes() {
    let mut never_moved = 0;
    for ticks in 0..TICKS {
        let mut bench = ready();
        begin(&mut bench, 1);
        let start = bench.last().position;
        bench.run(ticks);
        bench.command(Command::Abort).unwrap();
        let rests = |bench: &mut Bench| bench.run_to(MachineState::Idle, 300);
        assert!(rests(&mut bench), "{ticks}: {:?}", bench.state());
        let stands = bench.last().position;
        bench.run(300);
        assert_eq!(
            bench.last().position,
            stands,
            "{ticks}: it moves behind an abort"
        );
        assert_eq!(bench.state(), MachineState::Idle, "{ticks}");
        never_moved += usize::from(stands == start);
        let status = bench.status();
        assert_eq!(
            status.state(),
            Ok(MachineState::Idle),
            "{ticks}: nobody has the machine"
        );
        // What was on its way when the abort came is no error of anybody.
        let refused: u64 = status.frames_refused.iter().sum();
        assert_eq!(
            (refused, status.last_error.as_str()),
            (0, ""),
            "{ticks} ticks"
        );
        bench.feed.clear();
        goes_on(&mut bench, 2);
        assert!(bench.worst_ratio() < 1.0 + 1e-6);
    }
    assert!(
        (1..TICKS).contains(&never_moved),
        "{never_moved}: both sides of the first frame"
    );
}

#[test]
fn an_aborted_job_is_told_so_and_its_frames_are_dropped() {
    let mut bench = ready();
    tell(&mut bench, 1, JobPhase::Waiting).unwrap();
    bench.command(Command::Abort).unwrap();
    let why = tell(&mut bench, 1, JobPhase::Preparing).unwrap_err();
    assert!(why.contains("aborted"), "{why}");
    begin(&mut bench, 2);
    let frames = std::mem::take(&mut bench.feed);
    bench.command(Command::Abort).unwrap();
    let status = bench.status();
    assert_eq!(status.job_stage(), Ok(JobStage::Aborted));
    assert!(!status.job_end.as_str().is_empty());
    // Its planner hangs, and goes on long afterwards.
    bench.run(1_000);
    bench.feed = frames;
    bench.run(300);
    assert_eq!(bench.state(), MachineState::Idle);
    let status = bench.status();
    assert_eq!((status.epoch, status.last_error.as_str()), (0, ""));
    bench.feed.clear();
    goes_on(&mut bench, 3);
}

#[test]
fn a_hold_before_the_first_frame_is_in_force_with_it() {
    for ticks in 0..TICKS {
        let mut bench = ready();
        begin(&mut bench, 1);
        bench.run(ticks);
        bench.command(Command::Hold).unwrap();
        assert!(
            bench.run_to(MachineState::Held, 300),
            "{ticks}: {:?}",
            bench.state()
        );
        let stands = bench.last().position;
        bench.run(300);
        assert_eq!(
            (bench.state(), bench.last().position),
            (MachineState::Held, stands)
        );
        bench.command(Command::Resume).unwrap();
        assert!(bench.run_to(MachineState::Idle, 2_000));
        assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Completed));
        assert!(bench.worst_ratio() < 1.0 + 1e-6);
    }
}

#[test]
fn a_hold_while_the_job_waits_is_kept_and_can_be_taken_back() {
    let mut bench = ready();
    tell(&mut bench, 1, JobPhase::Waiting).unwrap();
    bench.command(Command::Hold).unwrap();
    assert_eq!(bench.status().job_held, 1);
    begin(&mut bench, 1);
    bench.run(60);
    assert_eq!(bench.state(), MachineState::Held);
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 60));
    bench.feed.clear();
    tell(&mut bench, 2, JobPhase::Waiting).unwrap();
    bench.command(Command::Hold).unwrap();
    bench.command(Command::Resume).unwrap();
    goes_on(&mut bench, 2);
}

#[test]
fn a_job_that_is_given_up_leaves_no_hold_behind() {
    let mut bench = ready();
    begin(&mut bench, 1);
    bench.feed.clear();
    bench.command(Command::Hold).unwrap();
    tell(&mut bench, 1, JobPhase::Over).unwrap();
    assert_eq!(bench.status().state(), Ok(MachineState::Idle));
    goes_on(&mut bench, 2);
}

#[test]
fn what_would_move_the_axes_is_refused_or_comes_before_the_job() {
    let orders = [
        Command::Home(1),
        Command::Unhome(1),
        Command::SetPosition {
            joint: 0,
            position: 7.0,
        },
    ];
    let mut machine = Machine::with(config(false), &[JointSettings::default(); 3]);
    machine.bench.enable(MachineState::Idle);
    begin(&mut machine.bench, 1);
    let frames = std::mem::take(&mut machine.bench.feed);
    for order in orders {
        let why = machine.bench.command(order).unwrap_err();
        assert!(why.contains("job"), "{order:?}: {why}");
    }
    let stands = machine.bench.last().position;
    for tick in 0..40 {
        machine.press([30.0, 0.0, 0.0], tick == 0);
        machine.bench.run(1);
    }
    assert_eq!(machine.bench.last().position, stands);
    machine.let_go();
    machine.bench.feed = frames;
    assert!(machine.bench.run_to(MachineState::Running, 60));
    assert!(machine.bench.run_to(MachineState::Idle, 2_000));
    assert_eq!(
        machine.bench.status().end_of_epoch(),
        Ok(EndOfEpoch::Completed)
    );
}

#[test]
fn whatever_comes_at_the_same_time_as_a_job_one_of_both_has_the_machine() {
    for ticks in 0..8 {
        for first in [false, true] {
            let mut machine = Machine::with(config(false), &[JointSettings::default(); 3]);
            machine.bench.enable(MachineState::Idle);
            machine.bench.run(5);
            if first {
                machine.press([30.0, 0.0, 0.0], true);
                machine.bench.run(ticks);
            }
            tell(&mut machine.bench, 1, JobPhase::Waiting).unwrap();
            let taken = tell(&mut machine.bench, 1, JobPhase::Preparing);
            if !first {
                machine.press([30.0, 0.0, 0.0], true);
                machine.bench.run(ticks);
            }
            let status = machine.bench.status();
            let has_machine = status.job_stage() == Ok(JobStage::Preparing);
            assert_eq!(has_machine, taken.is_ok(), "{ticks} {first}");
            assert_ne!(has_machine, machine.bench.state() == MachineState::Jogging);
        }
    }
}

#[test]
fn what_takes_the_power_ends_the_job_with_its_reason() {
    for ticks in 0..TICKS {
        let mut bench = ready();
        begin(&mut bench, 1);
        bench.run(ticks);
        bench.command(Command::Disable).unwrap();
        assert!(
            bench.run_to(MachineState::Off, 300),
            "{ticks}: {:?}",
            bench.state()
        );
        bench.feed.clear();
        let status = bench.status();
        assert_ne!(status.job_stage(), Ok(JobStage::Preparing));
        if status.epoch == 0 {
            assert!(status.job_end.as_str().contains("drives"), "{ticks}");
            assert!(status.next_epoch > 1, "{ticks}: its planner hears of it");
        }
        bench.command(Command::Enable).unwrap();
        assert!(bench.run_to(MachineState::Idle, 300));
        bench.run(5);
        goes_on(&mut bench, 2);
    }
}

#[test]
fn a_first_frame_that_is_refused_ends_the_job_with_its_reason() {
    let mut bench = ready();
    begin(&mut bench, 1);
    let mut frames = std::mem::take(&mut bench.feed);
    let ticket = bench.status().next_epoch;
    for frame in &mut frames {
        frame.position[0] += 1.0;
    }
    bench.feed = frames;
    bench.run(30);
    let status = bench.status();
    assert_eq!(status.job_stage(), Ok(JobStage::Refused));
    assert!(!status.job_end.as_str().is_empty());
    assert_eq!(status.state(), Ok(MachineState::Idle));
    assert!(status.next_epoch > ticket && status.epoch < ticket);
    bench.feed.clear();
    goes_on(&mut bench, 2);
}

/// Behind a job that did not begin: nobody has the machine, and a hold of nothing is no hold.
fn is_free(machine: &mut Machine, why: &str) {
    let bench = &mut machine.bench;
    bench.feed.clear();
    let status = bench.status();
    assert_eq!(status.job_stage(), Ok(JobStage::Refused), "{why}");
    assert!(!status.job_end.as_str().is_empty(), "{why}");
    assert_eq!(status.epoch, 0, "{why}");
    tell(bench, 1, JobPhase::Over).unwrap();
    bench.run(5);
    assert_eq!(bench.state(), MachineState::Idle, "{why}");
    bench.command(Command::Hold).unwrap();
    bench.run(5);
    let stands = bench.last().position;
    machine.jog([30.0, 0.0, 0.0], 20);
    assert_eq!(machine.bench.state(), MachineState::Jogging, "{why}");
    assert_ne!(machine.bench.last().position, stands, "{why}");
    machine.let_go();
    assert!(machine.bench.run_to(MachineState::Idle, 200), "{why}");
    goes_on(&mut machine.bench, 2);
}

#[test]
fn a_second_frame_that_is_refused_gives_the_machine_back() {
    for is_held in [false, true] {
        let mut machine = Machine::with(config(false), &[JointSettings::default(); 3]);
        machine.bench.enable(MachineState::Idle);
        machine.bench.run(5);
        begin(&mut machine.bench, 1);
        machine.bench.feed[1].acceleration[0] += 1e6;
        if is_held {
            let frames = std::mem::take(&mut machine.bench.feed);
            machine.bench.command(Command::Hold).unwrap();
            machine.bench.feed = frames;
        }
        assert!(machine.bench.run_to(MachineState::Faulted, 60));
        machine.bench.command(Command::Reset).unwrap();
        assert!(machine.bench.run_to(MachineState::Idle, 10));
        is_free(&mut machine, if is_held { "held" } else { "not held" });
    }
}

/// The first frame may be under way between both threads, or come later.
#[test]
fn a_fault_before_the_first_frame_gives_the_machine_back() {
    let mut not_begun = 0;
    for ticks in 0..TICKS {
        let mut machine = Machine::with(config(false), &[JointSettings::default(); 3]);
        machine.bench.enable(MachineState::Idle);
        machine.bench.run(5);
        begin(&mut machine.bench, 1);
        let frames = std::mem::take(&mut machine.bench.feed);
        machine.bench.inject(InjectedFault::EmergencyStop(true));
        machine.bench.run(ticks);
        machine.bench.feed = frames;
        assert!(machine.bench.run_to(MachineState::Faulted, 300), "{ticks}");
        let epoch = machine.bench.status().epoch;
        machine.bench.inject(InjectedFault::EmergencyStop(false));
        machine.bench.run(50);
        machine.bench.command(Command::Reset).unwrap();
        machine.bench.run(50);
        machine.bench.enable(MachineState::Idle);
        if epoch == 0 {
            not_begun += 1;
            is_free(&mut machine, &format!("{ticks} ticks"));
        }
    }
    assert!(
        (1..TICKS).contains(&not_begun),
        "{not_begun}: both sides of the first frame"
    );
}

#[test]
fn a_planner_of_which_nothing_is_heard_loses_the_machine() {
    let mut bench = ready();
    begin(&mut bench, 1);
    let frames = std::mem::take(&mut bench.feed);
    bench.run(800);
    assert_eq!(bench.status().job_stage(), Ok(JobStage::Refused));
    bench.feed = frames;
    bench.run(100);
    assert_eq!(bench.status().epoch, 0);
    bench.feed.clear();
    goes_on(&mut bench, 2);
}

#[test]
fn at_rest_a_hold_and_an_abort_are_done_and_clear_no_fault() {
    let mut bench = ready();
    bench.command(Command::Hold).unwrap();
    bench.command(Command::Abort).unwrap();
    goes_on(&mut bench, 1);
    bench.inject(InjectedFault::EmergencyStop(true));
    bench.run(60);
    bench.command(Command::Abort).unwrap();
    bench.command(Command::Hold).unwrap();
    bench.run(10);
    assert_eq!(bench.state(), MachineState::Faulted);
}

#[test]
fn where_no_drive_reports_switching_off_ends_a_job_that_waits() {
    let settings = Config {
        feedback: None,
        ..config(false)
    };
    let mut bench = Bench::new(settings, &[JointSettings::default(); 3]);
    bench.run(10);
    let refused = bench.command(Command::Disable).unwrap_err();
    assert!(
        refused.contains("simulated"),
        "nothing is to be ended: {refused}"
    );
    tell(&mut bench, 1, JobPhase::Waiting).unwrap();
    assert_eq!(bench.status().state(), Ok(MachineState::Idle));
    bench.command(Command::Disable).unwrap();
    assert!(tell(&mut bench, 1, JobPhase::Preparing).is_err());
}
