//! The fuzz target: foreign bytes as frames, among those of a planner: what the judge lets through
//! keeps the limits by plain differences, and so does what is published, whatever came.
#![no_main]

use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, SoftLimits, stepped};
use glidepath_link::{Command, MachineState, SetpointFrame, decode};
use glidepath_program::Limits;
use libfuzzer_sys::fuzz_target;

use crate::frame_validation::{FrameValidator, MachineSnapshot, FrameVerdict};

// The judge is not public: it is compiled in here, with those of its neighbours that it uses.
#[allow(dead_code, reason = "only the judge is used")]
#[path = "../../src/ports/frame_validation/mod.rs"]
mod frame_validation;
#[allow(dead_code, reason = "only the judge is used")]
#[path = "../../src/shared/fault.rs"]
mod fault;
#[path = "../../src/shared/rest.rs"]
mod rest;
#[allow(dead_code, reason = "what the tests share")]
#[path = "../../tests/synthetic/mod.rs"]
mod synthetic;

mod shared {
    pub(crate) use crate::{fault, rest};
    pub(crate) mod m_code_waits {
        pub(crate) use glidepath_interpolator::MCodeWaits;
    }
    pub(crate) mod config {
        pub(crate) use glidepath_interpolator::{Config, SoftLimits};
    }
}

const PERIOD_NS: u64 = 4_000_000;
const PERIOD_T: f64 = 0.004;
const TICKS: usize = 120;
/// Frames that pass in a tick: of all ticks no more than the ring holds, were none executed.
const PASS_PER_TICK: usize = 2;
const REACH_MM: f64 = 30.0;

/// A change of the planner's frames: which, from which byte on, by what, and whether it comes in
/// addition.
type Change = (u8, u16, Vec<u8>, bool);

/// The frames of a planner, some of them changed.
fn frames(seed: u8, changes: Vec<Change>) -> Vec<[u8; size_of::<SetpointFrame>()]> {
    let plan = synthetic::plan(
        u64::from(seed),
        3,
        60,
        &synthetic::mill(),
        PERIOD_T,
        AxisVector::zeros(),
    );
    let mut all: Vec<_> = synthetic::records(&plan, 1, PERIOD_NS)
        .iter()
        .map(|frame| bytemuck::cast(*frame))
        .collect();
    for (which, at, bytes, is_added) in changes {
        let which = usize::from(which) % all.len();
        let mut changed: [u8; size_of::<SetpointFrame>()] = all[which];
        let at = usize::from(at) % changed.len();
        for (byte, new) in changed[at..].iter_mut().zip(bytes) {
            *byte = new;
        }
        if is_added {
            all.insert(which, changed);
        } else {
            all[which] = changed;
        }
    }
    all
}

fn keeps_limits(positions: &[AxisVector], limits: &Limits) {
    let reach = positions.iter().map(AxisVector::amax).fold(0.0, f64::max);
    assert!(reach <= REACH_MM + 1e-6, "{reach} mm");
    let worst = synthetic::audit(positions, limits, PERIOD_T);
    assert!(worst.iter().all(|ratio| *ratio <= 1.0 + 1e-5), "{worst:?}");
}

/// Turns an operator may make of the motion: after so many ticks each, back and onward in turn.
type Turns = Vec<u8>;

fuzz_target!(|input: (u8, Vec<Change>, Turns)| {
    let (seed, changes, turns) = input;
    let limits = synthetic::mill();
    let mut config = Config::new(limits, PERIOD_NS);
    config.soft_limits = SoftLimits {
        lowest: AxisVector::repeat(-REACH_MM),
        highest: AxisVector::repeat(REACH_MM),
    };
    let mut judge = FrameValidator::new(&config);
    let (mut passed, mut published) = (Vec::new(), Vec::new());
    stepped(&config, |machine| {
        let mut waiting = frames(seed, changes).into_iter().peekable();
        let mut known = MachineSnapshot {
            state: MachineState::Idle,
            position: AxisVector::zeros(),
            epoch: 0,
            is_open: false,
        };
        let mut is_broken = false;
        let (mut turns, mut until) = (turns.into_iter(), 0);
        let mut ways = [Command::Forward, Command::Reverse].into_iter().cycle();
        for tick in 0..TICKS {
            if tick == until
                && let (Some(ticks), Some(way)) = (turns.next(), ways.next())
            {
                assert!(machine.command(way), "room for a command");
                until = tick + 1 + usize::from(ticks);
            }
            judge.note(&known);
            let mut room = PASS_PER_TICK;
            while room > 0
                && let Some(bytes) = waiting.peek()
            {
                // Bytes of the wrong kind never get as far as the judge.
                let Ok(frame) = decode::<SetpointFrame>(bytes) else {
                    waiting.next();
                    continue;
                };
                match judge.judge(&frame, &known) {
                    FrameVerdict::Later => break,
                    FrameVerdict::Pass => {
                        assert!(!is_broken || frame.sequence == 0, "a frame after a fault");
                        is_broken = false;
                        if frame.sequence == 0 {
                            // At rest: what came before does not belong to its differences.
                            keeps_limits(&passed, &limits);
                            passed.clear();
                        }
                        passed.push(AxisVector::from(frame.position));
                        assert!(machine.offer(&frame), "room for all of them");
                        room -= 1;
                    }
                    FrameVerdict::Fault(_) => is_broken = true,
                    FrameVerdict::Known | FrameVerdict::Late | FrameVerdict::Refused(_) => {}
                }
                waiting.next();
            }
            let setpoint = machine.tick();
            known = MachineSnapshot {
                state: setpoint.state().expect("its own"),
                position: setpoint.position.into(),
                epoch: setpoint.epoch,
                is_open: setpoint.state() != Ok(MachineState::Idle),
            };
            published.push(AxisVector::from(setpoint.position));
        }
    });
    keeps_limits(&passed, &limits);
    keeps_limits(&published, &limits);
});
