//! The fuzz target: foreign bytes as demands for a jog, among those of an operator, at any time:
//! the axes stay inside their limits and travel, and come to rest when told.
#![no_main]

use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, SoftLimits, stepped};
use glidepath_link::{Command, JogDemand, MachineState, decode};
use glidepath_program::Limits;
use libfuzzer_sys::fuzz_target;

#[allow(dead_code, reason = "what the tests share")]
#[path = "../../tests/synthetic/mod.rs"]
mod synthetic;

const PERIOD_NS: u64 = 4_000_000;
const PERIOD_T: f64 = 0.004;
const REACH_MM: f64 = 50.0;
/// Far longer than any stop of this machine.
const STOP_TICKS: usize = 500;

/// Mode, velocity or step of X, Y and Z, how long ago it was sent in ms, the bytes that are changed
/// from a place on, and ticks up to the next one.
type Turn = (u8, [i8; 3], i8, u16, Vec<u8>, u8);

fn demand(number: u64, now_ns: u64, turn: &Turn) -> Option<JogDemand> {
    let (mode, value, late_ms, at, bytes, _) = turn;
    let mut demand = JogDemand {
        client: 1,
        number,
        sent_ns: now_ns.saturating_add_signed(-i64::from(*late_ms) * 4_000_000),
        mode: u32::from(*mode % 5),
        mask: 0b111,
        scale: 0.1,
        ..bytemuck::Zeroable::zeroed()
    };
    for (slot, value) in demand.value.iter_mut().zip(value) {
        *slot = f64::from(*value);
    }
    let record = bytemuck::bytes_of_mut(&mut demand);
    let at = usize::from(*at) % record.len();
    for (byte, new) in record[at..].iter_mut().zip(bytes) {
        *byte = *new;
    }
    decode(bytemuck::bytes_of(&demand)).ok()
}

fuzz_target!(|turns: Vec<Turn>| {
    let mut limits = synthetic::mill();
    for axis in 3..9 {
        limits.velocity[axis] = Limits::UNLIMITED;
        limits.acceleration[axis] = Limits::UNLIMITED;
        limits.jerk[axis] = Limits::UNLIMITED;
    }
    let mut config = Config::new(limits, PERIOD_NS);
    config.soft_limits = SoftLimits {
        lowest: AxisVector::repeat(-REACH_MM),
        highest: AxisVector::repeat(REACH_MM),
    };
    let mut positions = Vec::new();
    stepped(&config, |machine| {
        let mut now_ns = 0;
        for (number, turn) in (1..).zip(turns.iter().take(40)) {
            if let Some(demand) = demand(number, now_ns, turn) {
                machine.jog(&demand);
            }
            for _ in 0..turn.5 % 64 {
                let setpoint = machine.tick();
                now_ns = setpoint.scheduled_ns;
                positions.push(AxisVector::from(setpoint.position));
            }
        }
        // Demands and commands come by ways of their own: what was demanded last is heard first.
        positions.push(AxisVector::from(machine.tick().position));
        machine.command(Command::Abort);
        let rests = (0..STOP_TICKS).any(|_| {
            let setpoint = machine.tick();
            positions.push(AxisVector::from(setpoint.position));
            setpoint.state() == Ok(MachineState::Idle)
        });
        assert!(rests, "it goes on after an abort");
    });
    let reach = positions.iter().map(AxisVector::amax).fold(0.0, f64::max);
    assert!(reach <= REACH_MM + 1e-6, "{reach} mm");
    let worst = synthetic::audit(&positions, &limits, PERIOD_T);
    assert!(worst.iter().all(|ratio| *ratio <= 1.0 + 1e-5), "{worst:?}");
});
