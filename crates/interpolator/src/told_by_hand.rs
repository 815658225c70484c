//! What the status' last error says of motions that a command ends: why a jog or a way home ended, and
//! nothing that was told before it began.

use crate::jog::Demand;
use crate::message::Report;
use glidepath_link::{Command, JogMode, MachineState, SWITCHED_OFF};

/// What a command says of the motion that it ends, once it is accepted; an empty text where
/// a motion begins with it.
pub(crate) const fn of_command(
    state: MachineState,
    command: Option<Command>,
) -> Option<&'static str> {
    match (state, command) {
        (_, Some(Command::Home(_) | Command::Return)) => Some(""),
        (MachineState::Jogging, Some(Command::Hold)) => Some("a hold ended the jog"),
        (MachineState::Jogging, Some(Command::Abort)) => Some("an abort ended the jog"),
        (MachineState::Homing, Some(Command::Abort)) => Some("an abort ended the way home"),
        (
            MachineState::Idle | MachineState::NotHomed | MachineState::Faulted | MachineState::Off,
            _,
        ) => None,
        (_, Some(Command::Disable)) => Some(SWITCHED_OFF),
        _ => None,
    }
}

/// Whether a jog may begin with a demand. A wheel that stands demands, too, so what it says of
/// begins is not known here.
pub(crate) fn may_begin(report: &Report, demand: &Demand) -> bool {
    use MachineState::{Awaiting, Held, Idle, NotHomed, ProgramStop};
    let wants = matches!(demand.mode, JogMode::Continuous | JogMode::Incremental);
    let may = matches!(
        report.state,
        Idle | NotHomed | Held | ProgramStop | Awaiting
    );
    wants && may && report.fault.is_none() && demand.value.amax() > 0.0
}
