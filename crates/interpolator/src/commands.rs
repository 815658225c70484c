//! Commands: what may be done when, and the answer.

use crate::acknowledgements::Acknowledgements;
use crate::feedback::DriveBook;
use crate::message::{Order, PortsEnds, Report};
use glidepath_link::{
    Command, CommandOutcome, CommandRefusal, CommandReply, CommandRequest, MachineState, Objection,
};

/// Answers a command: passes it on to the real-time thread, or says why not.
///
/// Acceptance means that the command is on its way. It is carried out at the next tick if the state
/// then still allows it.
pub(crate) fn answer(
    request: &CommandRequest,
    report: &Report,
    boot_id: u64,
    drives: Option<(&mut DriveBook, u64)>,
    acknowledgements: &mut Acknowledgements,
    ends: &mut PortsEnds<'_>,
) -> CommandReply {
    let (outcome, message) = match request.command() {
        Err(error) => (Err(CommandRefusal::Malformed), error.to_string()),
        Ok(Command::Ping | Command::Tell) => (Ok(()), String::new()),
        Ok(Command::Acknowledge { event, done }) => {
            match acknowledgements.judge(event, done, report) {
                Err(why) => objected(why),
                Ok(()) => {
                    let command = Command::Acknowledge { event, done };
                    let (outcome, message) = pass_on(command, report.state, ends);
                    if outcome.is_ok() {
                        acknowledgements.answer(event);
                    }
                    (outcome, message)
                }
            }
        }
        Ok(command) => match judge(command, report, drives) {
            Err(why) => objected(why),
            Ok(false) => (Ok(()), String::new()),
            Ok(true) => pass_on(command, report.state, ends),
        },
    };
    CommandReply::new(boot_id, request.number, outcome, report.state, &message)
}

fn objected(why: Objection) -> (CommandOutcome, String) {
    (Err(CommandRefusal::WrongState), why.text().to_owned())
}

/// Whether the real-time thread has to know of a command.
///
/// # Errors
/// Why it is not possible.
fn judge(
    command: Command,
    report: &Report,
    drives: Option<(&mut DriveBook, u64)>,
) -> Result<bool, Objection> {
    // Joints that were just told to come home are not yet seen to move.
    let sets_out = drives.as_ref().is_some_and(|(book, _)| book.is_homing());
    let is_stop = command == Command::Abort && sets_out;
    if !is_stop && let Some(why) = objection(command, report, drives.is_some()) {
        return Err(why);
    }
    drives.map_or(Ok(true), |(book, now_ns)| {
        book.command(command, report, now_ns)
    })
}

fn pass_on(
    command: Command,
    state: MachineState,
    ends: &mut PortsEnds<'_>,
) -> (CommandOutcome, String) {
    // Without a program, what is left to abort is a latched fault.
    let clears_fault = command == Command::Abort && state == MachineState::Faulted;
    let command = if clears_fault {
        Command::Reset
    } else {
        command
    };
    match ends.orders.enqueue(Order::Command(command)) {
        Ok(()) => (Ok(()), String::new()),
        Err(_) => (
            Err(CommandRefusal::Busy),
            CommandRefusal::Busy.text().to_owned(),
        ),
    }
}

/// Why a command is not possible as things are, if it is not.
fn objection(command: Command, report: &Report, has_drives: bool) -> Option<Objection> {
    use MachineState::{
        Awaiting, Faulted, Held, Holding, Homing, Idle, Jogging, NotHomed, Off, ProgramStop,
        Stopping,
    };
    let (state, is_away) = (report.state, report.is_away);
    let (is_possible, why) = match command {
        Command::Ping
        | Command::Tell
        | Command::Forward
        | Command::RapidOverride(_)
        | Command::JogOverride(_)
        | Command::SingleBlock(_) => return None,
        Command::FeedOverride(ratio) if ratio >= 0.0 => return None,
        Command::FeedOverride(_) | Command::Reverse => (
            !matches!(state, Idle | Faulted | Off | NotHomed | Homing),
            Objection::NoPathBack,
        ),
        Command::Hold => (
            !matches!(state, Idle | Faulted | Off | NotHomed | Homing),
            Objection::NothingToHold,
        ),
        Command::Resume | Command::Step if is_away => (false, Objection::Away),
        Command::Resume => (
            matches!(state, Holding | Held | ProgramStop),
            Objection::NothingHeld,
        ),
        Command::Abort => (
            !matches!(state, Idle | Off | NotHomed) || report.has_use_of_abort,
            Objection::NothingToAbort,
        ),
        Command::Reset => (state == Faulted, Objection::NoFault),
        Command::StopAtEndOfBlock => (
            !matches!(
                state,
                Idle | Faulted | Stopping | Jogging | Off | NotHomed | Homing
            ),
            Objection::NoBlock,
        ),
        Command::Step => (
            matches!(state, Holding | Held | ProgramStop),
            Objection::NoStep,
        ),
        Command::Enable
        | Command::Disable
        | Command::SetPosition { .. }
        | Command::Home(_)
        | Command::Unhome(_) => (has_drives, Objection::Simulated),
        Command::Return if !is_away => (false, Objection::OnPath),
        Command::Return => (
            matches!(state, Held | ProgramStop | Awaiting),
            Objection::Moving,
        ),
        // It is judged by itself.
        Command::Acknowledge { .. } => return None,
    };
    (!is_possible).then_some(why)
}

/// Whether a reply refuses.
pub(crate) fn is_refusal(reply: &CommandReply) -> bool {
    !matches!(reply.outcome(), Ok(CommandOutcome::Ok(())))
}
