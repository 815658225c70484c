//! What nobody has answered, or let pass, when the motion ends is not done.

use super::bench::Bench;
use super::m_code_waits::{ACK, DONE, acknowledge, bench, m_code_waits};
use glidepath_link::{Auxiliary, Command, MachineState, Subscriber, Transport as _};
use glidepath_plant::InjectedFault;
use glidepath_program::{Event, FrameFlags};

/// A machine that waits for its second tool.
struct Changing {
    bench: Bench,
    records: Box<dyn Subscriber<Auxiliary>>,
    record: Auxiliary,
}

impl Changing {
    fn new() -> Self {
        let mut bench = bench(m_code_waits(&[(6, ACK, 0)]));
        let records = bench.link.auxiliary_source().unwrap();
        let tool = |tool| [Event::SelectTool(tool), Event::MCode(6)];
        bench.load_events(8, 60, &[tool(1), tool(2)].concat());
        let mut machine = Self {
            bench,
            records,
            record: Auxiliary::default(),
        };
        assert!(machine.bench.run_to(MachineState::Awaiting, 1000));
        machine.answer(DONE);
        machine.bench.run(3);
        assert!(machine.bench.run_to(MachineState::Awaiting, 1000));
        assert_eq!(machine.bench.status().block, 4);
        machine
    }

    fn answer(&mut self, done: bool) {
        let awaited = self.bench.awaited().unwrap();
        acknowledge(&mut self.bench, awaited, done).unwrap();
    }

    /// The tool in the spindle, and whether the change to the second one is to be done again.
    fn left(&mut self) -> (u32, u32) {
        self.bench.run(30);
        while let Some(record) = self.records.take().unwrap() {
            self.record = record;
        }
        (self.record.tool, self.bench.status().unanswered)
    }
}

#[test]
fn a_tool_change_that_is_not_answered_is_not_done_however_the_motion_ends() {
    let ends: [fn(&mut Changing); 5] = [
        |machine| machine.bench.command(Command::Abort).unwrap(),
        |machine| machine.answer(!DONE),
        |machine| {
            machine.bench.command(Command::Hold).unwrap();
            machine.bench.run(10);
            machine.bench.command(Command::Abort).unwrap();
        },
        |machine| machine.bench.command(Command::Disable).unwrap(),
        |machine| machine.bench.inject(InjectedFault::EmergencyStop(true)),
    ];
    for (number, end) in ends.into_iter().enumerate() {
        let mut machine = Changing::new();
        assert_eq!(machine.left(), (2, 0), "told, and awaited");
        end(&mut machine);
        assert_eq!(machine.left(), (1, 1), "end {number}");
        assert_eq!(machine.record.prepared_tool, 2);
        assert_eq!(machine.bench.status().block, 4, "end {number}");
    }
}

#[test]
fn a_tool_change_that_was_answered_is_done_however_the_motion_ends() {
    let mut machine = Changing::new();
    machine.bench.command(Command::Hold).unwrap();
    machine.answer(DONE);
    assert_eq!(machine.left(), (2, 0));
    machine.bench.command(Command::Abort).unwrap();
    assert_eq!(machine.left(), (2, 0), "held where it was answered");
    assert_eq!(machine.bench.status().block, 4);

    let mut machine = Changing::new();
    machine.answer(DONE);
    machine.bench.run(20);
    machine.bench.command(Command::Abort).unwrap();
    assert_eq!(machine.left(), (2, 0), "in the motion behind it");
}

/// Also where the motion is held in front of it, in its block: a program that is resumed begins so.
#[test]
fn a_code_that_the_motion_did_not_come_to_is_not_done() {
    let mut bench = bench(m_code_waits(&[(6, ACK, 0)]));
    bench.load_codes(8, 60, &[6]);
    // It begins held, at its first frame.
    bench.command(Command::FeedOverride(0.0)).unwrap();
    for frame in &mut bench.feed {
        frame.block = 1;
    }
    assert!(bench.run_to(MachineState::Held, 100));
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 100));
    assert_eq!(bench.awaited(), None);
    assert_eq!(bench.status().unanswered, 1);
}

#[test]
fn a_program_stop_that_nobody_let_pass_is_not_done() {
    for passes in [false, true] {
        let mut bench = bench(m_code_waits(&[]));
        let stop = Event::ProgramStop(0);
        bench.load_events(8, 60, &[Event::MCode(7), stop]);
        for frame in &mut bench.feed {
            if frame.event() == Ok(Some(stop)) {
                frame.flags |= FrameFlags::PROGRAM_STOP.0;
            }
        }
        assert!(bench.run_to(MachineState::ProgramStop, 1000));
        if passes {
            bench.command(Command::Resume).unwrap();
            assert!(bench.run_to(MachineState::Running, 10));
        }
        bench.command(Command::Abort).unwrap();
        assert!(bench.run_to(MachineState::Idle, 1000));
        assert_eq!(bench.status().unanswered, u32::from(!passes));
        assert_eq!(bench.status().block, 2);
        // The next program has nothing to do with it.
        bench.load(9, 60);
        assert!(bench.run_to(MachineState::Running, 100));
        assert_eq!(bench.status().unanswered, 0);
    }
}
