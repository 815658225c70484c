//! Tests of M-code waits: events that are answered before the motion goes on, early, late, never, twice,
//! wrongly.

use super::bench::{Bench, config, numbers};
use crate::shared::config::Config;
use crate::shared::m_code_waits::{AnswerSource, MCodeWait, MCodeWaits};
use crate::testing::happens;
use core::time::Duration;
use glidepath_geometry::AxisVector;
use glidepath_link::{
    Auxiliary, Command, EventId, FaultCause, MachineState, Setpoint, Transport as _,
};
use glidepath_plant::JointSettings;
use glidepath_program::{CodeWord, Event};

pub(super) fn m_code_waits(rules: &[(u32, AnswerSource, u64)]) -> MCodeWaits {
    let rules: Vec<MCodeWait> = rules
        .iter()
        .map(|&(code, answer, within_ms)| MCodeWait {
            first: code,
            last: code,
            answer,
            within: (within_ms > 0).then(|| Duration::from_millis(within_ms)),
            is_late: false,
        })
        .collect();
    MCodeWaits::new(&rules).unwrap()
}

pub(super) fn bench(m_code_waits: MCodeWaits) -> Bench {
    let joint = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let joints = [joint(12.5), joint(-3.0), joint(40.0)];
    let mut bench = Bench::new(
        Config {
            m_code_waits,
            ..config(false)
        },
        &joints,
    );
    bench.enable(MachineState::Idle);
    bench
}

pub(super) const ACK: AnswerSource = AnswerSource::Acknowledgement;
pub(super) const DONE: bool = true;

pub(super) fn acknowledge(bench: &mut Bench, event: EventId, done: bool) -> Result<(), String> {
    bench.command(Command::Acknowledge { event, done })
}

/// The positions where the machine moves.
pub(super) fn moves(bench: &Bench) -> Vec<[f64; 9]> {
    let mut positions: Vec<_> = bench.setpoints.iter().map(|s| s.position).collect();
    positions.dedup();
    positions
}

#[test]
fn motion_waits_for_its_answer_and_then_is_the_same() {
    let mut free = bench(MCodeWaits::NONE);
    free.load_codes(3, 120, &[6, 8, 106]);
    assert!(free.run_to(MachineState::Running, 50) && free.run_to(MachineState::Idle, 2000));

    let mut held = bench(m_code_waits(&[(6, ACK, 0), (106, ACK, 9_000)]));
    held.load_codes(3, 120, &[6, 8, 106]);
    for code in [6, 106] {
        assert!(held.run_to(MachineState::Awaiting, 1000), "M{code}");
        let stood = held.last().position;
        held.run(300);
        assert_eq!(held.last().position, stood, "M{code}");
        let awaited = held.awaited().unwrap();
        acknowledge(&mut held, awaited, DONE).unwrap();
        let again = acknowledge(&mut held, awaited, DONE).unwrap_err();
        assert!(again.contains("already"), "{again}");
    }
    assert!(held.run_to(MachineState::Idle, 2000));
    assert_eq!(held.fault(), None);
    assert_eq!(moves(&free), moves(&held));
    assert!(held.worst_ratio() < 1.0 + 1e-6);
}

#[test]
fn single_block_waits_for_the_answer_first_and_for_the_operator_behind_it() {
    for is_on_before in [false, true] {
        let mut bench = bench(m_code_waits(&[(6, ACK, 0)]));
        bench.load_codes(3, 120, &[8, 6, 9]);
        if !is_on_before {
            assert!(bench.run_to(MachineState::Awaiting, 1000));
        }
        bench.command(Command::SingleBlock(true)).unwrap();
        for _ in 0..2_000 {
            if bench.last_awaited().is_some() {
                break;
            }
            if bench.state() == MachineState::ProgramStop {
                bench.command(Command::Resume).unwrap();
            }
            bench.tick();
        }
        bench.run(100);
        assert_eq!(bench.state(), MachineState::Awaiting, "{is_on_before}");
        assert!(bench.command(Command::Resume).is_err());
        let stood = bench.last().position;
        let awaited = bench.awaited().unwrap();
        acknowledge(&mut bench, awaited, DONE).unwrap();
        assert!(bench.run_to(MachineState::ProgramStop, 1000));
        bench.run(100);
        assert_eq!(bench.last_awaited(), None);
        let is_there = bench.last().position == stood;
        bench.command(Command::Resume).unwrap();
        assert!(bench.run_to(MachineState::Running, 50), "{is_there}");
    }
}

#[test]
fn an_answer_that_is_early_or_of_another_event_is_refused() {
    let mut bench = bench(m_code_waits(&[(6, ACK, 0), (106, ACK, 0)]));
    bench.load_codes(4, 100, &[7, 6, 106]);
    assert!(bench.run_to(MachineState::Running, 50));
    let codes: Vec<u64> = [6.0, 106.0]
        .map(|code| bench.feed_of(code))
        .into_iter()
        .collect();
    let epoch = bench.last().epoch;
    let event = |sequence| EventId {
        boot_id: 77,
        epoch,
        sequence,
    };
    let early = acknowledge(&mut bench, event(codes[0]), DONE).unwrap_err();
    assert!(early.contains("too early"), "{early}");
    assert!(bench.run_to(MachineState::Awaiting, 1000));
    let next = acknowledge(&mut bench, event(codes[1]), DONE).unwrap_err();
    assert!(next.contains("too early"), "{next}");
    let wrong = acknowledge(&mut bench, event(codes[0] - 1), DONE).unwrap_err();
    assert!(wrong.contains("another event"), "{wrong}");
    let other_life = EventId {
        boot_id: 5,
        ..event(codes[0])
    };
    let wrong = acknowledge(&mut bench, other_life, DONE).unwrap_err();
    assert!(wrong.contains("started again"), "{wrong}");
    bench.run(50);
    assert_eq!(bench.state(), MachineState::Awaiting);
    acknowledge(&mut bench, event(codes[0]), DONE).unwrap();
    assert!(bench.run_to(MachineState::Running, 10));
}

#[test]
fn what_fails_or_takes_too_long_is_a_fault_at_rest() {
    for (done, cause) in [
        (Some(false), FaultCause::AuxFailed),
        (None, FaultCause::AuxTimeout),
    ] {
        let mut bench = bench(m_code_waits(&[(6, ACK, 1000)]));
        bench.load_codes(5, 100, &[7, 6]);
        assert!(bench.run_to(MachineState::Awaiting, 1000));
        let stood = bench.last().position;
        let awaited = bench.awaited().unwrap();
        if let Some(done) = done {
            acknowledge(&mut bench, awaited, done).unwrap();
            assert!(bench.run_to(MachineState::Faulted, 5));
        } else {
            assert!(!bench.run_to(MachineState::Faulted, 200));
            assert!(bench.run_to(MachineState::Faulted, 100));
        }
        assert_eq!(bench.fault(), Some(cause));
        assert_eq!(bench.last().position, stood);
        assert_eq!(bench.status().fault_line, 2);
        let late = acknowledge(&mut bench, awaited, DONE).unwrap_err();
        assert!(
            late.contains("no event") || late.contains("already"),
            "{late}"
        );
        bench.command(Command::Reset).unwrap();
        assert!(bench.run_to(MachineState::Idle, 5));
    }
}

#[test]
fn a_spindle_that_turns_up_is_waited_for() {
    let mut bench = bench(m_code_waits(&[
        (3, AnswerSource::SpindleAtSpeed, 10_000),
        (5, AnswerSource::SpindleStopped, 10_000),
    ]));
    bench.load_codes(6, 60, &[7, 3, 5]);
    // A speed before the first motion: 3000 rev/min take 1.25 s.
    happens(&mut bench.feed[1], Event::SpindleSpeed(3000.0));
    assert!(bench.run_to(MachineState::Awaiting, 1000));
    let awaited = bench.awaited().unwrap();
    let refused = acknowledge(&mut bench, awaited, DONE).unwrap_err();
    assert!(refused.contains("feedback"), "{refused}");
    let ticks = (0..1000)
        .take_while(|_| bench.tick().state() == Ok(MachineState::Awaiting))
        .count();
    assert!((280..340).contains(&ticks), "{ticks} ticks");
    let speed = bench.plant.measured().spindle_v;
    assert!((speed - 50.0).abs() < 0.1, "{speed} rev/s");
    assert!(bench.run_to(MachineState::Awaiting, 1000), "M5");
    assert!(bench.run_to(MachineState::Idle, 1000));
    assert_eq!(bench.plant.measured().spindle_v, 0.0);
}

/// Without feedback nobody tells of the spindle: it is taken to do what it is told.
#[test]
fn a_simulated_spindle_is_not_waited_for() {
    let mut bench = Bench::new(
        Config {
            m_code_waits: m_code_waits(&[(3, AnswerSource::SpindleAtSpeed, 1000)]),
            feedback: None,
            ..config(false)
        },
        &[],
    );
    bench.run(3);
    bench.load_codes(7, 60, &[3]);
    assert!(bench.run_to(MachineState::Running, 50) && bench.run_to(MachineState::Idle, 2000));
    assert_eq!(bench.fault(), None);
}

#[test]
fn holds_jogs_and_aborts_while_an_answer_is_awaited() {
    let mut bench = bench(m_code_waits(&[(6, ACK, 0)]));
    bench.load_codes(8, 100, &[7, 6]);
    assert!(bench.run_to(MachineState::Awaiting, 1000));
    let awaited = bench.awaited().unwrap();
    bench.command(Command::Hold).unwrap();
    assert!(bench.run_to(MachineState::Held, 5));
    // Answered in a hold: it goes on when the operator says so.
    acknowledge(&mut bench, awaited, DONE).unwrap();
    bench.run(50);
    assert_eq!(bench.state(), MachineState::Held);
    bench.command(Command::Resume).unwrap();
    assert!(bench.run_to(MachineState::Running, 10));
    assert!(bench.run_to(MachineState::Idle, 2000));

    bench.load_codes(9, 100, &[7, 6]);
    assert!(bench.run_to(MachineState::Awaiting, 1000));
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 10));
    assert_eq!((bench.awaited(), bench.fault()), (None, None));
}

/// Whoever comes late has the state of spindle, coolant and tool at once.
#[test]
fn auxiliary_state_is_latched() {
    let mut bench = bench(m_code_waits(&[(6, ACK, 2_000)]));
    bench.load_codes(10, 60, &[3, 8, 6]);
    assert!(bench.run_to(MachineState::Awaiting, 1000));
    bench.run(10);
    let mut late = bench.link.auxiliary_source().unwrap();
    bench.run(10);
    let mut record: Option<Auxiliary> = None;
    while let Some(newer) = late.take().unwrap() {
        record = Some(newer);
    }
    let record = record.unwrap();
    assert_eq!(
        record.spindle(),
        Ok(glidepath_link::SpindleState::Stopped),
        "M6 stops it"
    );
    assert!(record.coolant().contains(glidepath_link::Coolant::FLOOD));
    assert_eq!(record.awaited_event(), Ok(Some(Event::MCode(6))));
    assert_eq!(Some(record.awaited), bench.awaited());
    assert_eq!(
        record.awaited_until_ns - record.awaited_since_ns,
        2_000_000_000
    );
    assert!(record.generation >= 3);
}

/// Answers at random, with holds, overrides, other answers and aborts between them: limits are kept,
/// no wait is passed without its answer, and the path is the planned one.
#[test]
fn random_answers() {
    for seed in 0..crate::testing::random_cases(12).into() {
        let mut draw = numbers(seed);
        let mut bench = bench(m_code_waits(&[(6, ACK, 0), (106, ACK, 0), (107, ACK, 0)]));
        let codes = [7, 6, 106, 9, 107];
        bench.load_codes(seed, 40 + draw.whole(0, 60) as usize, &codes);
        let planned: Vec<AxisVector> = bench.feed.iter().map(|f| f.position.into()).collect();
        let end = planned[planned.len() - 1];
        let at = [6.0, 106.0, 107.0].map(|code| bench.feed_of(code));
        let mut answered = 0;
        for _ in 0..6000 {
            let state = bench.tick().state().unwrap();
            if state == MachineState::Idle && answered == 3 {
                break;
            }
            let awaited = bench.last_awaited();
            match (draw.whole(0, 60), awaited) {
                (0, _) => bench.command(Command::Hold).unwrap_or_default(),
                (1..=4, _) => bench.command(Command::Resume).unwrap_or_default(),
                (5, _) => {
                    let ratio = 0.3 + 0.9 * draw.unit();
                    bench.command(Command::FeedOverride(ratio)).unwrap();
                }
                (6..=9, Some(event)) => {
                    let wrong = EventId {
                        sequence: event.sequence + draw.whole(1, 3),
                        ..event
                    };
                    acknowledge(&mut bench, wrong, DONE).unwrap_err();
                }
                (10..=12, Some(event)) => {
                    answered += usize::from(acknowledge(&mut bench, event, DONE).is_ok());
                }
                _ => {}
            }
            let next = at.get(answered).copied().unwrap_or(u64::MAX);
            assert!(bench.last().sequence <= next, "seed {seed}");
        }
        assert_eq!(answered, 3, "seed {seed}");
        assert_eq!(AxisVector::from(bench.last().position), end, "seed {seed}");
        assert!(bench.worst_ratio() < 1.0 + 1e-6, "seed {seed}");
        assert_eq!(bench.fault(), None, "seed {seed}");
    }
}

/// As [`m_code_waits`], for codes that are waited for later.
pub(super) fn late(rules: &[(u32, AnswerSource, u64)]) -> MCodeWaits {
    let rules: Vec<MCodeWait> = rules
        .iter()
        .map(|&(code, ..)| m_code_waits(rules).of(code).unwrap())
        .map(|m_code_wait| MCodeWait {
            is_late: true,
            ..m_code_wait
        })
        .collect();
    MCodeWaits::new(&rules).unwrap()
}

const LATER: [Event; 4] = [
    Event::CodeWord {
        word: CodeWord::Q,
        value: -2.5,
    },
    Event::MCode(106),
    Event::MCode(8),
    Event::Await(106),
];

/// The event of a code that was told, once it was; single blocks go on.
pub(super) fn told(bench: &mut Bench, code: f64) -> EventId {
    let begun = bench.setpoints.len();
    let is_it = |s: &&Setpoint| s.event() == Ok(Some(Event::MCode(code as u32)));
    for _ in 0..2000 {
        if bench.tick().state() == Ok(MachineState::ProgramStop) {
            bench.command(Command::Resume).unwrap();
        }
        if let Some(told) = bench.setpoints[begun..].iter().find(is_it) {
            return EventId {
                boot_id: 77,
                epoch: told.epoch,
                sequence: told.sequence,
            };
        }
    }
    panic!("M{code} is not told");
}

#[test]
fn a_code_that_is_awaited_later_may_be_answered_before() {
    let mut free = bench(MCodeWaits::NONE);
    free.load_events(3, 120, &LATER);
    assert!(free.run_to(MachineState::Running, 50) && free.run_to(MachineState::Idle, 2000));

    for early in [true, false] {
        let mut bench = bench(late(&[(106, ACK, 9_000)]));
        bench.load_events(3, 120, &LATER);
        let event = told(&mut bench, 106.0);
        bench.run(20);
        assert_eq!(bench.status().state(), Ok(MachineState::Running));
        if early {
            acknowledge(&mut bench, event, DONE).unwrap();
            let again = acknowledge(&mut bench, event, DONE).unwrap_err();
            assert!(again.contains("already"), "{again}");
        } else {
            assert!(bench.run_to(MachineState::Awaiting, 2000));
            let status = bench.status();
            assert_eq!(
                bench.awaited(),
                Some(event),
                "it is known by the code's event"
            );
            assert_eq!((status.awaited_value, status.awaited_line), (106.0, 2));
            assert_eq!(status.awaited_words.get(CodeWord::Q), Some(-2.5));
            assert_eq!(status.awaited_words.get(CodeWord::P), None);
            let stood = bench.last().position;
            bench.run(300);
            assert_eq!(bench.last().position, stood);
            acknowledge(&mut bench, event, DONE).unwrap();
        }
        assert!(bench.run_to(MachineState::Idle, 2000), "{early}");
        assert_eq!(bench.fault(), None);
        assert_eq!(moves(&free), moves(&bench));
        assert!(bench.worst_ratio() < 1.0 + 1e-6);
    }
}

#[test]
fn what_is_awaited_later_and_fails_or_never_comes_is_a_fault_at_its_wait() {
    for (answered, cause) in [
        (Some(false), FaultCause::AuxFailed),
        (None, FaultCause::AuxTimeout),
    ] {
        let mut bench = bench(late(&[(106, ACK, 400)]));
        bench.load_events(5, 120, &LATER);
        let event = told(&mut bench, 106.0);
        if let Some(done) = answered {
            acknowledge(&mut bench, event, done).unwrap();
        }
        bench.run(20);
        assert_eq!(bench.fault(), None, "not before its wait");
        assert!(bench.run_to(MachineState::Faulted, 2000));
        assert_eq!(bench.fault(), Some(cause));
    }
}

#[test]
fn a_spindle_comes_up_to_speed_on_the_way_to_the_first_feed() {
    let rules = [(3, AnswerSource::SpindleAtSpeed, 20_000)];
    let events = [Event::SpindleSpeed(900.0), Event::MCode(3), Event::Await(3)];
    let mut stands = Vec::new();
    for m_code_waits in [m_code_waits(&rules), late(&rules)] {
        let mut bench = bench(m_code_waits);
        bench.load_events(9, 250, &events);
        let event = told(&mut bench, 3.0);
        let early = acknowledge(&mut bench, event, DONE).unwrap_err();
        assert!(early.contains("feedback"), "{early}");
        assert!(bench.run_to(MachineState::Idle, 9000));
        let (awaiting, at_speed): (Vec<_>, Vec<_>) = bench
            .setpoints
            .iter()
            .map(|s| s.state == MachineState::Awaiting.code())
            .partition(|awaits| *awaits);
        assert!(!at_speed.is_empty());
        stands.push(awaiting.len());
    }
    assert!(stands[1] + 50 < stands[0], "{stands:?}");
}
