//! Tests of every kind of M-code wait, with every kind of answer, while the operator and the planner do
//! this or that.

use super::bench::Bench;
use super::m_code_waits::{ACK, DONE, acknowledge, bench, late, m_code_waits, moves, told};
use crate::shared::m_code_waits::MCodeWaits;
use glidepath_link::{Command, EventId, FaultCause, MachineState};
use glidepath_program::Event;

/// The code that is waited for, for 1.2 s at most.
const CODE: u32 = 106;
const WITHIN_MS: u64 = 1_200;
/// Of each motion behind an event, about: longer than what a planner that dies leaves behind.
const TICKS: usize = 170;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Waits {
    /// At the code.
    There,
    /// Later: in front of a feed, or at the end of a block.
    Later,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Answered {
    Early,
    Late,
    Never,
    Failed,
    Twice,
    Wrongly,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Meanwhile {
    Nothing,
    Hold,
    SingleBlock,
    Override,
    Abort,
    PlannerDies,
}

/// One combination.
#[derive(Debug, Clone, Copy)]
struct Cell {
    waits: Waits,
    answered: Answered,
    meanwhile: Meanwhile,
}

impl Cell {
    fn all(waits: Waits) -> Vec<Self> {
        use Answered::{Early, Failed, Late, Never, Twice, Wrongly};
        use Meanwhile::{Abort, Hold, Nothing, Override, PlannerDies, SingleBlock};
        let mut cells = Vec::new();
        for answered in [Early, Late, Never, Failed, Twice, Wrongly] {
            for meanwhile in [Nothing, Hold, SingleBlock, Override, Abort, PlannerDies] {
                cells.push(Self {
                    waits,
                    answered,
                    meanwhile,
                });
            }
        }
        cells
    }

    const fn events(self) -> [Event; 4] {
        let awaited = match self.waits {
            Waits::There => Event::MCode(9),
            Waits::Later => Event::Await(CODE),
        };
        [
            Event::MCode(7),
            Event::MCode(CODE),
            Event::MCode(8),
            awaited,
        ]
    }

    /// Why it ends, if not with its program.
    fn ends_with(self) -> Option<FaultCause> {
        match (self.answered, self.meanwhile) {
            (_, Meanwhile::Abort) => None,
            (Answered::Never, _) => Some(FaultCause::AuxTimeout),
            (Answered::Failed, _) => Some(FaultCause::AuxFailed),
            (_, Meanwhile::PlannerDies) => Some(FaultCause::PlannerLost),
            _ => None,
        }
    }

    /// Whether the motion is not held up at all.
    fn is_in_time(self) -> bool {
        self.waits == Waits::Later && self.answered == Answered::Early
    }
}

/// Ticks until a state, and lets single blocks go on.
fn go(bench: &mut Bench, until: MachineState, most: usize) -> bool {
    (0..most).any(|_| {
        let state = bench.tick().state();
        if state == Ok(MachineState::ProgramStop) {
            bench.command(Command::Resume).unwrap();
        }
        state == Ok(until)
    })
}

/// Early, whatever comes of it.
fn answer_early(bench: &mut Bench, cell: Cell, sequence: u64) {
    match cell.waits {
        Waits::There => {
            let event = EventId {
                boot_id: 77,
                epoch: bench.last().epoch,
                sequence,
            };
            let early = acknowledge(bench, event, DONE).unwrap_err();
            assert!(early.contains("too early"), "{cell:?}: {early}");
        }
        Waits::Later => {
            let event = told(bench, f64::from(CODE));
            acknowledge(bench, event, DONE).unwrap();
        }
    }
}

/// Answers what is awaited.
fn answer(bench: &mut Bench, cell: Cell, event: EventId) {
    bench.run(60);
    match cell.answered {
        Answered::Never => {}
        Answered::Failed => acknowledge(bench, event, false).unwrap(),
        Answered::Early | Answered::Late => acknowledge(bench, event, DONE).unwrap(),
        Answered::Twice => {
            acknowledge(bench, event, DONE).unwrap();
            let again = acknowledge(bench, event, false).unwrap_err();
            assert!(again.contains("already"), "{cell:?}: {again}");
        }
        Answered::Wrongly => {
            let others = [
                EventId {
                    sequence: event.sequence + 1,
                    ..event
                },
                EventId {
                    epoch: event.epoch + 1,
                    ..event
                },
                EventId {
                    boot_id: 5,
                    ..event
                },
            ];
            for other in others {
                acknowledge(bench, other, DONE).unwrap_err();
            }
            bench.run(20);
            assert_eq!(bench.last_awaited(), Some(event), "{cell:?}");
            acknowledge(bench, event, DONE).unwrap();
        }
    }
}

/// What the operator or the planner does while the answer is awaited, or under way to its wait.
/// Returns whether the program goes on.
fn interfere(bench: &mut Bench, cell: Cell) -> bool {
    match cell.meanwhile {
        Meanwhile::Hold => {
            bench.command(Command::Hold).unwrap();
            assert!(go(bench, MachineState::Held, 200), "{cell:?}");
        }
        Meanwhile::Abort => {
            bench.command(Command::Abort).unwrap();
            assert!(go(bench, MachineState::Idle, 200), "{cell:?}");
            return false;
        }
        Meanwhile::PlannerDies => bench.feed.clear(),
        Meanwhile::Nothing | Meanwhile::SingleBlock | Meanwhile::Override => {}
    }
    true
}

/// Plays a cell to its end.
fn play(cell: Cell, free: &[[f64; 9]]) {
    let rule = [(CODE, ACK, WITHIN_MS)];
    let mut bench = bench(match cell.waits {
        Waits::There => m_code_waits(&rule),
        Waits::Later => late(&rule),
    });
    bench.load_events(3, TICKS, &cell.events());
    let sequence = bench.feed_of(f64::from(CODE));
    assert!(bench.run_to(MachineState::Running, 50));
    match cell.meanwhile {
        Meanwhile::SingleBlock => bench.command(Command::SingleBlock(true)).unwrap(),
        Meanwhile::Override => bench.command(Command::FeedOverride(0.4)).unwrap(),
        _ => {}
    }
    if cell.answered == Answered::Early {
        answer_early(&mut bench, cell, sequence);
    }
    let mut event = None;
    if !cell.is_in_time() {
        assert!(go(&mut bench, MachineState::Awaiting, 9000), "{cell:?}");
        event = bench.last_awaited();
    }
    let stood = bench.last().position;
    let goes_on = interfere(&mut bench, cell);
    if let Some(event) = event.filter(|_| goes_on) {
        answer(&mut bench, cell, event);
        let is_passed = matches!(cell.ends_with(), None | Some(FaultCause::PlannerLost));
        assert!(is_passed || bench.last().position == stood, "{cell:?}");
    }
    if cell.meanwhile == Meanwhile::Hold && cell.ends_with().is_none() {
        bench.run(30);
        assert_eq!(bench.state(), MachineState::Held, "{cell:?}");
        bench.command(Command::Resume).unwrap();
    }
    let end = match cell.ends_with() {
        None => MachineState::Idle,
        Some(_) => MachineState::Faulted,
    };
    assert!(go(&mut bench, end, 9000), "{cell:?}: {:?}", bench.state());
    assert_eq!(bench.fault(), cell.ends_with(), "{cell:?}");
    assert_eq!(bench.awaited(), None, "{cell:?}");
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{cell:?}");
    if goes_on && end == MachineState::Idle {
        let now = moves(&bench);
        assert_eq!(now.last(), free.last(), "{cell:?}");
        // Slower motion passes other places of the same path.
        let is_as_planned = matches!(cell.meanwhile, Meanwhile::Nothing | Meanwhile::SingleBlock);
        assert!(!is_as_planned || now == free, "{cell:?}");
    }
    // Nobody is left to be answered.
    if let Some(event) = event {
        acknowledge(&mut bench, event, DONE).unwrap_err();
    }
}

#[test]
fn every_m_code_wait_with_every_answer_whatever_happens_meanwhile() {
    for waits in [Waits::There, Waits::Later] {
        let cells = Cell::all(waits);
        let mut free = bench(MCodeWaits::NONE);
        free.load_events(3, TICKS, &cells[0].events());
        assert!(free.run_to(MachineState::Running, 50) && free.run_to(MachineState::Idle, 3000));
        let free = moves(&free);
        for cell in cells {
            play(cell, &free);
        }
    }
}
