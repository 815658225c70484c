//! `glidepath acknowledge`: what an M code asked for is done, or has failed.

use super::operator::{PATIENCE, reach, send_saying, silent};
use super::session;
use crate::cli::AcknowledgeArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::output;
use glidepath_link::{Command, EventId, LinkError};
use serde_json::json;

/// Answers the event that is awaited, or the one that is meant.
///
/// # Errors
/// No interpolator runs, it does not answer, or it refuses.
pub(super) fn acknowledge(args: &AcknowledgeArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    const NAME: &str = "acknowledge";
    let instance = session::instance(&args.operator.instance, config);
    let link = session::link(&instance, config);
    let operator = reach(&link).map_err(|failure| failure.of_command(NAME))?;
    let status = operator.status(PATIENCE)?;
    let status = status.ok_or_else(|| silent(&operator, &link))?;
    let (epoch, sequence) = args
        .event
        .unwrap_or((status.epoch, status.awaited_sequence));
    let event = EventId {
        boot_id: status.boot_id,
        epoch,
        sequence,
    };
    let done = args.fail.is_none();
    let command = Command::Acknowledge { event, done };
    let reason = args.fail.as_deref().unwrap_or_default();
    let reply = send_saying(&operator, &link, command, reason)
        .map_err(|failure| failure.of_command(NAME))?;
    let state = reply.state().map_err(LinkError::from)?.name();
    if let Err(refusal) = reply.outcome().map_err(LinkError::from)? {
        return Err(Failure::CommandRefused {
            command: NAME,
            state,
            reason: reply.why(refusal),
        });
    }
    if args.operator.basic.json {
        output::object(&json!({
            "command": NAME,
            "instance": instance,
            "accepted": true,
            "done": done,
            "event": { "epoch": epoch, "sequence": sequence },
            "state": state,
        }));
    } else {
        let what = if done { "done" } else { "failed" };
        output::result(&format!(
            "acknowledge: accepted, {what}; state before it: {state}\n"
        ));
    }
    Ok(Exit::Done)
}
