//! Commands: what may be done when, and the answer.

use crate::message::{Order, PortsEnds, Report};
use glidepath_link::{
    Command, CommandOutcome, CommandRefusal, CommandReply, CommandRequest, MachineState,
};

/// Answers a command: passes an order on to the real-time thread, or says why not.
///
/// Acceptance means that the order is on its way. It is carried out at the next tick if the state
/// then still allows it.
pub(crate) fn answer(
    request: &CommandRequest,
    report: &Report,
    boot_id: u64,
    ends: &mut PortsEnds<'_>,
) -> CommandReply {
    let (outcome, message) = match request.command() {
        Err(error) => (Err(CommandRefusal::Malformed), error.to_string()),
        Ok(command) => match order_for(command, report.state) {
            Ok(None) => (Ok(()), String::new()),
            Ok(Some(order)) => match ends.orders.enqueue(order) {
                Ok(()) => (Ok(()), String::new()),
                Err(_) => (
                    Err(CommandRefusal::Busy),
                    "too many commands at once; ask again".to_owned(),
                ),
            },
            Err((refusal, why)) => (Err(refusal), why.to_owned()),
        },
    };
    CommandReply::new(boot_id, request.number, outcome, report.state, &message)
}

type Refusal = (CommandRefusal, &'static str);

fn order_for(command: Command, state: MachineState) -> Result<Option<Order>, Refusal> {
    use MachineState::{Faulted, Held, Holding, Idle, ProgramStop, Stopping};
    let only = |allowed: bool, order, why| {
        if allowed {
            Ok(Some(order))
        } else {
            Err((CommandRefusal::WrongState, why))
        }
    };
    match command {
        Command::Ping => Ok(None),
        Command::Hold => only(
            !matches!(state, Idle | Faulted),
            Order::Hold,
            "no program runs: there is nothing to hold",
        ),
        Command::Resume => only(
            matches!(state, Holding | Held | ProgramStop),
            Order::Resume,
            "nothing is held: resume goes on after a hold or a program stop",
        ),
        Command::FeedOverride(ratio) => Ok(Some(Order::FeedOverride(ratio))),
        Command::RapidOverride(ratio) => Ok(Some(Order::RapidOverride(ratio))),
        // Without a program, what is left to end is a latched fault.
        Command::Abort => only(
            state != Idle,
            if state == Faulted {
                Order::Reset
            } else {
                Order::Abort
            },
            "no program runs: there is nothing to abort",
        ),
        Command::Reset => only(
            state == Faulted,
            Order::Reset,
            "no fault is latched, or the motion has not yet come to rest",
        ),
        Command::StopAtEndOfBlock => only(
            !matches!(state, Idle | Faulted | Stopping),
            Order::StopAtEndOfBlock,
            "no program runs: there is no block to stop at the end of",
        ),
        Command::SingleBlock(on) => Ok(Some(Order::SingleBlock(on))),
        Command::Step => only(
            matches!(state, Holding | Held | ProgramStop),
            Order::Step,
            "nothing is held: a step goes on after a hold, a program stop or the end of a block",
        ),
    }
}

/// Whether a reply refuses.
pub(crate) fn is_refusal(reply: &CommandReply) -> bool {
    !matches!(reply.outcome(), Ok(CommandOutcome::Ok(())))
}
