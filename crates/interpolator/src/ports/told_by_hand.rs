//! The texts of the status' last error about motions that a command ends: why a jog or a way home
//! ended, and nothing that was told before it began.

use crate::shared::message::TickReport;
use crate::shared::message::jog_demand::Demand;
use glidepath_link::{Command, JogMode, MachineState};

/// What a command says of the motion that it ends, once it is accepted; an empty text where
/// a motion begins with it. `why` is what the command says of that itself.
pub(crate) const fn of_command(
    state: MachineState,
    command: Option<Command>,
    why: &str,
) -> Option<&str> {
    use MachineState::{Faulted, Homing, Idle, Jogging, NotHomed, Off};
    let jogs = matches!(state, Jogging);
    let is_at_rest = matches!(state, Idle | NotHomed | Faulted | Off);
    if matches!(command, Some(Command::Home(_) | Command::Return)) {
        Some("")
    } else if jogs && matches!(command, Some(Command::Hold)) {
        Some("a hold ended the jog")
    } else if jogs && matches!(command, Some(Command::Abort)) {
        Some("an abort ended the jog")
    } else if matches!(state, Homing) && matches!(command, Some(Command::Abort)) {
        Some("an abort ended the way home")
    } else if !is_at_rest && !why.is_empty() {
        Some(why)
    } else {
        None
    }
}

/// Whether a jog may begin with a demand. A wheel that stands demands, too, so what it says of
/// begins is not known here.
pub(crate) fn may_begin(report: &TickReport, demand: &Demand) -> bool {
    use MachineState::{Awaiting, Held, Idle, NotHomed, ProgramStop};
    let wants = matches!(demand.mode, JogMode::Continuous | JogMode::Incremental);
    let may = matches!(
        report.state,
        Idle | NotHomed | Held | ProgramStop | Awaiting
    );
    wants && may && report.fault.is_none() && demand.value.amax() > 0.0
}
