//! Tests of the real loop of the real-time thread: it does not allocate, whatever it is told.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test")]

use super::*;
use crate::shared::fault::Fault;
use crate::shared::message::jog_demand::Demand;
use crate::shared::message::{Order, PortsEnds};
use crate::testing::{Rig, hexapod, lines, mill, records};
use core::cell::Cell;
use glidepath_geometry::AxisVector;
use glidepath_link::{Command, FaultCause, JogMode, MachineState, SetpointFrame};
use glidepath_realtime::CountingAllocator;
use std::collections::VecDeque;
use std::sync::atomic::AtomicU64;

/// Ticks a state may take to be reached: several times the longest move.
const PATIENCE: u64 = 20_000;

#[derive(Debug, Clone, Copy)]
enum Act {
    Command(Command),
    Fault(Fault),
    /// A demand for a jog.
    Jog(JogMode, [f64; 3]),
    /// Waits for a state.
    Until(MachineState),
    /// Waits some ticks.
    Ticks(u64),
    /// Frames come, or stay away.
    Frames(bool),
}

/// A clock that lets the loop go on by one tick at a time, when it is told to: what happens in
/// which tick does not depend on how busy the host is.
struct Metronome<'a> {
    now_ns: u64,
    /// Beats allowed so far, and those that were made.
    allowed: &'a AtomicU64,
    made: u64,
    stop: &'a AtomicBool,
}

impl Clock for Metronome<'_> {
    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        self.made += 1;
        while self.allowed.load(Ordering::Acquire) < self.made && !self.stop.load(Ordering::Relaxed)
        {
            std::thread::yield_now();
        }
        self.now_ns = self.now_ns.max(deadline_ns);
    }

    fn spin_until(&mut self, deadline_ns: u64) -> u64 {
        self.now_ns = self.now_ns.max(deadline_ns);
        self.now_ns
    }
}

/// What the ports thread does in the test.
struct Script<'a> {
    allowed: &'a AtomicU64,
    /// Whether the loop still runs.
    lives: &'a dyn Fn() -> bool,
    ends: PortsEnds<'static>,
    feed: VecDeque<SetpointFrame>,
    flows: bool,
    number: u64,
    demands: u64,
    state: MachineState,
}

impl Script<'_> {
    fn play(&mut self, acts: &[Act]) {
        for act in acts {
            let began = self.number;
            match *act {
                Act::Command(command) => self.give(Order::Command(command)),
                Act::Fault(fault) => self.give(Order::Fault(fault)),
                Act::Jog(mode, value) => self.demand(mode, value),
                Act::Frames(flows) => self.flows = flows,
                Act::Ticks(ticks) => {
                    while self.number < began + ticks {
                        self.turn();
                    }
                }
                Act::Until(state) => {
                    while self.state != state {
                        self.turn();
                        let waited = self.number - began;
                        assert!(waited < PATIENCE, "{:?}, not {act:?}", self.state);
                    }
                }
            }
        }
    }

    fn give(&mut self, order: Order) {
        assert!(self.ends.order(order));
    }

    fn demand(&mut self, mode: JogMode, xyz: [f64; 3]) {
        self.demands += 1;
        let value = AxisVector::from_fn(|axis, _| xyz.get(axis).copied().unwrap_or(0.0));
        let demand = Demand {
            client: 1,
            number: self.demands,
            sent_ns: self.number * 4_000_000,
            is_outdated: false,
            behind_stops: 0,
            mode,
            most_v: f64::INFINITY,
            scale: 0.1,
            value,
        };
        assert!(self.ends.demand(demand));
    }

    /// One tick: what there is goes in, and its report comes out.
    fn turn(&mut self) {
        while self.flows && self.ends.frames.ready() {
            let Some(frame) = self.feed.pop_front() else {
                break;
            };
            self.ends.frames.enqueue(frame).unwrap();
        }
        self.allowed.fetch_add(1, Ordering::Release);
        let report = loop {
            if let Some(report) = self.ends.reports.dequeue() {
                break report;
            }
            assert!((self.lives)(), "the loop ended");
            std::thread::yield_now();
        };
        (self.number, self.state) = (report.setpoint.number, report.state);
    }
}

/// Runs the loop while a script is played; returns the calls of the allocator.
fn allocations(acts: &[Act]) -> u64 {
    let Rig {
        mut interpolator,
        mut inputs,
        mut reports,
        ends,
        ..
    } = Rig::new(Config {
        mechanism: hexapod(),
        ..Config::new(mill(), 4_000_000)
    });
    let feed = records(&lines(3, 3, 12_000, &mill(), 0.004), 1, 4_000_000);
    let (stop, allowed) = (AtomicBool::new(false), AtomicU64::new(0));
    std::thread::scope(|scope| {
        let (stop, allowed) = (&stop, &allowed);
        let thread = scope.spawn(move || {
            let clock = Metronome {
                now_ns: 0,
                allowed,
                made: 0,
                stop,
            };
            let mut timer = DeadlineTimer::new(clock, 4_000_000, 4_000_000).with_lead(100_000);
            let before = CountingAllocator::calls_of_this_thread();
            real_time(
                &mut interpolator,
                &mut inputs,
                &mut reports,
                &mut timer,
                stop,
            );
            CountingAllocator::calls_of_this_thread() - before
        });
        let mut script = Script {
            allowed,
            lives: &|| !thread.is_finished(),
            ends,
            feed: feed.into(),
            flows: true,
            number: 0,
            demands: 0,
            state: MachineState::Idle,
        };
        // Also if the script panics: the scope waits for the thread.
        let played = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| script.play(acts)));
        stop.store(true, Ordering::Relaxed);
        let calls = thread.join().unwrap();
        if let Err(panic) = played {
            std::panic::resume_unwind(panic);
        }
        calls
    })
}

#[test]
fn hold_resume_override_starvation_and_abort_do_not_allocate() {
    use MachineState::{Held, Idle, Running, Starved};
    let acts = [
        Act::Until(Running),
        Act::Command(Command::Hold),
        Act::Until(Held),
        Act::Command(Command::Resume),
        Act::Until(Running),
        Act::Command(Command::FeedOverride(0.3)),
        Act::Ticks(300),
        Act::Command(Command::RapidOverride(0.5)),
        Act::Command(Command::FeedOverride(1.0)),
        Act::Ticks(300),
        Act::Frames(false),
        Act::Until(Starved),
        Act::Frames(true),
        Act::Until(Running),
        Act::Command(Command::Abort),
        Act::Until(Idle),
    ];
    assert_eq!(allocations(&acts), 0);
}

#[test]
fn jogs_from_rest_and_from_a_held_path_do_not_allocate() {
    use JogMode::{Continuous, Incremental, Wheel};
    use MachineState::{Held, Idle, Jogging, Running};
    let acts = [
        Act::Until(Running),
        Act::Ticks(100),
        Act::Command(Command::Hold),
        Act::Until(Held),
        Act::Jog(Continuous, [50.0, 20.0, 0.0]),
        Act::Until(Jogging),
        Act::Ticks(20),
        Act::Jog(Continuous, [-30.0, 20.0, 10.0]),
        Act::Ticks(20),
        Act::Jog(JogMode::None, [0.0; 3]),
        Act::Until(Held),
        Act::Command(Command::Return),
        Act::Until(Jogging),
        Act::Until(Held),
        Act::Command(Command::Resume),
        Act::Until(Running),
        Act::Command(Command::Abort),
        Act::Frames(false),
        Act::Until(Idle),
        // What was under way of the program is dropped first.
        Act::Ticks(50),
        Act::Jog(Wheel, [0.0; 3]),
        Act::Ticks(5),
        Act::Jog(Wheel, [100.0, -30.0, 0.0]),
        Act::Until(Jogging),
        Act::Until(Idle),
        Act::Jog(Incremental, [5.0, 0.0, 1.0]),
        Act::Until(Jogging),
        Act::Ticks(10),
        Act::Command(Command::JogOverride(0.3)),
        Act::Command(Command::Abort),
        Act::Until(Idle),
    ];
    assert_eq!(allocations(&acts), 0);
}

#[test]
fn steps_faults_and_reset_do_not_allocate() {
    use MachineState::{Faulted, Idle, ProgramStop, Running};
    let acts = [
        Act::Until(Running),
        Act::Command(Command::SingleBlock(true)),
        Act::Until(ProgramStop),
        Act::Command(Command::Step),
        Act::Until(Running),
        Act::Until(ProgramStop),
        Act::Command(Command::SingleBlock(false)),
        Act::Command(Command::Resume),
        Act::Until(Running),
        Act::Command(Command::StopAtEndOfBlock),
        Act::Until(ProgramStop),
        Act::Command(Command::Resume),
        Act::Until(Running),
        Act::Fault(Fault::new(FaultCause::Ports, 0, 0)),
        Act::Until(Faulted),
        Act::Command(Command::Reset),
        Act::Until(Idle),
    ];
    assert_eq!(allocations(&acts), 0);
}

/// Goes to every time it is told to.
struct Sleeper<'a>(&'a Cell<u64>);

impl Clock for Sleeper<'_> {
    fn now_ns(&self) -> u64 {
        self.0.get()
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        self.0.set(self.0.get().max(deadline_ns));
    }
}

#[test]
fn a_setpoint_is_handed_over_as_soon_as_it_is_there_and_all_else_waits_for_the_phase() {
    // The period, when the setpoint is there and when it is looked for, us after the tick.
    let cases: [(u64, u64, &[u64]); 4] = [
        (4_000, 1, &[50]),
        (4_000, 90, &[50, 100]),
        (4_000, 300, &[50, 100, 150]),
        (160, 15, &[10, 20]),
    ];
    for (period_us, there_us, expected) in cases {
        let (tick_ns, period_ns) = (7_000_000, 1000 * period_us);
        let first_ns = tick_ns + first_look_ns(period_ns);
        let now_ns = Cell::new(first_ns);
        let first_look = Wake {
            tick: 1,
            scheduled_ns: first_ns,
            woke_ns: first_ns,
            missed: 0,
        };
        let mut looks = Vec::new();
        hand_over(&mut Sleeper(&now_ns), &first_look, period_ns, || {
            looks.push((now_ns.get() - tick_ns) / 1000);
            now_ns.get() >= tick_ns + 1000 * there_us
        });
        assert_eq!(looks, expected, "{there_us} of {period_us}");
        assert_eq!(now_ns.get(), tick_ns + phase_ns(period_ns));
    }
}
