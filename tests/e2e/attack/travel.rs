//! Setpoints against the ends of travel.

use glidepath_link::{MachineState, Setpoint};

/// What rounding is, mm.
const ROUNDING_MM: f64 = 1e-9;
/// Findings that are told.
const MOST: usize = 5;

/// Setpoints of programs, and of jogs of a machine that is homed, that are beyond the travel of X, Y and Z, mm.
/// `swing` is what a rest at an end, within a period, swings over between two frames.
pub(super) fn beyond(setpoints: &[Setpoint], travel: &[[f64; 2]; 3], swing: f64) -> Vec<String> {
    let (mut found, mut before) = (Vec::new(), None);
    for setpoint in setpoints {
        let state = setpoint.state().ok();
        let is_limited = state.is_some_and(|state| keeps_travel(state, before));
        if state != Some(MachineState::Jogging) {
            before = state;
        }
        let most = if setpoint.is_between_frames() {
            swing + ROUNDING_MM
        } else {
            ROUNDING_MM
        };
        let places = setpoint.position.iter().zip(travel).zip(["X", "Y", "Z"]);
        for ((place, [low, high]), axis) in places.filter(|_| is_limited) {
            if !(low - most..=high + most).contains(place) {
                let tick = setpoint.tick;
                found.push(format!("tick {tick}: {axis} {place} in state {state:?}"));
            }
        }
    }
    found.truncate(MOST);
    found
}

/// Whether soft limits hold in a state. A jog has those of what it began in.
fn keeps_travel(state: MachineState, before: Option<MachineState>) -> bool {
    use MachineState::{
        Awaiting, Held, Holding, Idle, Jogging, ProgramStop, Running, Starved, Starving, Waiting,
    };
    let is_of_program = |state| {
        matches!(
            state,
            Running | Holding | Held | Starving | Starved | ProgramStop | Waiting | Awaiting
        )
    };
    is_of_program(state)
        || state == Jogging && before.is_some_and(|before| before == Idle || is_of_program(before))
}
