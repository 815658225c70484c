//! What an operator does: `glidepath hold`, `resume`, `step`, `stop-at-block-end`, `single-block`,
//! `override`, `abort` and `status`, talking to a running interpolator.

use super::session;
use crate::cli::{OperatorArgs, OverrideArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::output;
use crate::report::{state_name, status_object, status_text};
use glidepath_link::{
    Command, CommandRefusal, CommandReply, CommandRequest, LinkError, Record as _, Status,
    Transport,
};
use serde_json::json;
use std::time::{Duration, Instant};

/// How long an interpolator may take to answer.
const PATIENCE: Duration = Duration::from_secs(2);
const POLL: Duration = Duration::from_millis(2);

/// Sends a command and reports the answer.
///
/// # Errors
/// No interpolator runs, it does not answer, or it refuses.
pub(super) fn command(
    args: &OperatorArgs,
    config: &MachineConfig,
    name: &'static str,
    command: Command,
) -> Result<Exit, Failure> {
    commands(args, config, name, &[command])
}

/// Sets the overrides that are given.
///
/// # Errors
/// The errors of [`command`].
pub(super) fn overrides(args: &OverrideArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let feed = args.percent.map(|p| Command::FeedOverride(p / 100.0));
    let rapid = args.rapid.map(|p| Command::RapidOverride(p / 100.0));
    let given: Vec<Command> = feed.into_iter().chain(rapid).collect();
    commands(&args.operator, config, "override", &given)
}

/// Sends commands one after the other, up to the first that is refused, and reports the last
/// answer.
fn commands(
    args: &OperatorArgs,
    config: &MachineConfig,
    name: &'static str,
    commands: &[Command],
) -> Result<Exit, Failure> {
    let instance = session::instance(&args.instance, config);
    let transport = session::join(&args.instance, config)?;
    let mut state = "";
    for command in commands {
        let reply = send(&transport, &instance, *command)?;
        state = state_name(reply.state().map_err(LinkError::from)?);
        if let Err(refusal) = reply.outcome().map_err(LinkError::from)? {
            let reason = refusal_text(refusal, reply.message.as_str());
            return Err(Failure::CommandRefused {
                command: name,
                state,
                reason,
            });
        }
    }
    if args.basic.json {
        output::object(&json!({
            "command": name,
            "instance": instance,
            "accepted": true,
            "state": state,
        }));
    } else {
        output::result(&format!("{name}: accepted; the machine was {state}\n"));
    }
    Ok(Exit::Done)
}

/// Sends a command and waits for the answer.
///
/// # Errors
/// No interpolator runs, or it does not answer.
pub(super) fn send(
    transport: &dyn Transport,
    instance: &str,
    command: Command,
) -> Result<CommandReply, Failure> {
    let nobody = || Failure::NoInterpolator {
        instance: instance.to_owned(),
    };
    let request = CommandRequest::new(u64::from(std::process::id()), 1, command);
    let reply = match transport.command_client()?.call(&request, PATIENCE) {
        Ok(reply) => reply.ok_or_else(nobody)?,
        Err(LinkError::NoServer { .. }) => return Err(nobody()),
        Err(error) => return Err(error.into()),
    };
    reply.check().map_err(LinkError::from)?;
    Ok(reply)
}

fn refusal_text(refusal: CommandRefusal, message: &str) -> String {
    let reason = match refusal {
        CommandRefusal::Malformed => "the command is malformed",
        CommandRefusal::Unsupported => "this version cannot do that",
        CommandRefusal::WrongState => "not possible in this state",
        CommandRefusal::Busy => "too many commands at once; try again",
        CommandRefusal::ShuttingDown => "the interpolator is ending",
    };
    if message.is_empty() {
        reason.to_owned()
    } else {
        format!("{reason}: {message}")
    }
}

/// Shows the state of the interpolator.
///
/// # Errors
/// No interpolator runs.
pub(super) fn status(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let instance = session::instance(&args.instance, config);
    let transport = session::join(&args.instance, config)?;
    let status = live_status(&transport)?.ok_or_else(|| Failure::NoInterpolator {
        instance: instance.clone(),
    })?;
    if args.basic.json {
        output::object(&status_object(&instance, &status));
    } else {
        output::result(&status_text(&instance, &status));
    }
    Ok(Exit::Done)
}

/// Waits for a status of an interpolator that lives: one that is newer than the first, which a dead
/// one may have left.
fn live_status(transport: &dyn Transport) -> Result<Option<Status>, Failure> {
    let mut source = transport.status_source()?;
    let started = Instant::now();
    let mut first = None;
    while started.elapsed() < PATIENCE {
        if let Some(status) = source.take()? {
            status.check().map_err(LinkError::from)?;
            if *first.get_or_insert(status.updated_ns) != status.updated_ns {
                return Ok(Some(status));
            }
        }
        std::thread::sleep(POLL);
    }
    Ok(None)
}
