//! The commands of an operator: `glidepath hold`, `resume`, `step`, `stop-at-block-end`,
//! `single-block`, `reverse`, `forward`, `override` and `status`, talking to a running interpolator
//! by its panel.

use super::active_program::active_program;
use super::other_users::OtherUsers;
use super::persistent_offsets::PersistentOffsets;
use super::session;
use super::tool_names::ToolNames;
use crate::cli::{JointsArgs, OperatorArgs, OverrideArgs};
use crate::clock;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::machine_options::complete;
use crate::output;
use crate::report::{
    AwaitedEvent, Beside, active_object, active_text, names, status_object, status_text,
};
use glidepath_link::{
    Auxiliary, Command, CommandReply, CommandRequest, Ipc, LinkConfig, LinkError, Operator, Power,
    Record as _, Status, Transport as _,
};
use glidepath_realtime::{Clock as _, Monotonic};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// How long an interpolator may take to answer.
pub(super) const PATIENCE: Duration = Duration::from_secs(2);
const POLL: Duration = Duration::from_millis(2);
/// How long a record that is latched may take to come to who asks for it.
const LATCHED: Duration = Duration::from_millis(500);

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
    command_and_wait(args, config, name, command, |_, _| Ok(Effect::Reached))
}

/// What a command that was accepted has come to when it ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Effect {
    /// The effect that was waited for.
    Reached,
    /// It is still to come: what the machine does until then.
    ToCome(&'static str),
}

/// Sends a command, waits until it has the effect that is waited for, and reports the answer.
///
/// # Errors
/// The errors of [`command`], and those of what is waited for.
pub(super) fn command_and_wait(
    args: &OperatorArgs,
    config: &MachineConfig,
    name: &'static str,
    command: Command,
    wait: impl FnOnce(&Operator, &LinkConfig) -> Result<Effect, Failure>,
) -> Result<Exit, Failure> {
    commands(args, config, name, &[command], wait)
}

/// Switches the drives on, and waits until they have power.
///
/// # Errors
/// The errors of [`command`], or the drives do not get power.
pub(super) fn enable(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    command_and_wait(args, config, "enable", Command::Enable, wait_for_power)
}

/// Waits until the drives have power: what is typed next is not to be refused for the want of it.
fn wait_for_power(operator: &Operator, link: &LinkConfig) -> Result<Effect, Failure> {
    let (started, mut has_begun) = (Instant::now(), false);
    loop {
        let status = read_status(operator, link)?;
        match status.power().map_err(LinkError::from)? {
            Power::On | Power::Simulated => return Ok(Effect::Reached),
            Power::Enabling => has_begun = true,
            Power::Off if has_begun || started.elapsed() > PATIENCE => {
                return Err(Failure::CommandRefused {
                    command: "enable",
                    state: status.state().map_err(LinkError::from)?.name(),
                    reason: "the drives did not get power, or lost it again; `glidepath status` \
                             tells what is known of them"
                        .to_owned(),
                });
            }
            Power::Off => {}
        }
        std::thread::sleep(POLL);
    }
}

/// Sends a command about joints: those given, or all of the machine.
///
/// # Errors
/// The errors of [`command`].
pub(super) fn joints(
    args: &JointsArgs,
    config: &MachineConfig,
    name: &'static str,
    of: impl Fn(u32) -> Command,
) -> Result<Exit, Failure> {
    command(&args.operator, config, name, of(joints_meant(args, config)))
}

/// The joints given, or all of the machine, one bit each.
pub(super) fn joints_meant(args: &JointsArgs, config: &MachineConfig) -> u32 {
    let given = args.joints.iter().fold(0, |mask, joint| mask | 1 << joint);
    let all = (1 << config.drives()) - 1;
    if given == 0 { all } else { given }
}

/// Sets the overrides that are given.
///
/// # Errors
/// The errors of [`command`].
pub(super) fn overrides(args: &OverrideArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let feed = args.percent.map(|p| Command::FeedOverride(p / 100.0));
    let rapid = args.rapid.map(|p| Command::RapidOverride(p / 100.0));
    let jog = args.jog.map(|p| Command::JogOverride(p / 100.0));
    let spindle = args.spindle.map(|p| Command::SpindleOverride(p / 100.0));
    let given = feed.into_iter().chain(rapid).chain(jog).chain(spindle);
    let given: Vec<Command> = given.collect();
    commands(&args.operator, config, "override", &given, |_, _| {
        Ok(Effect::Reached)
    })
}

/// Sends commands one after the other, up to the first that is refused, waits until they have the
/// effect that is waited for, and reports the last answer.
fn commands(
    args: &OperatorArgs,
    config: &MachineConfig,
    name: &'static str,
    commands: &[Command],
    wait: impl FnOnce(&Operator, &LinkConfig) -> Result<Effect, Failure>,
) -> Result<Exit, Failure> {
    let instance = session::instance(&args.instance, config);
    let link = session::link(&instance, config);
    let operator = reach(&link).map_err(|failure| failure.of_command(name))?;
    let mut state = "";
    for command in commands {
        let asked = (*command, clock::started_ns());
        let reply = send_asked(&operator, &link, asked, "");
        let reply = reply.map_err(|failure| failure.of_command(name))?;
        state = reply.state().map_err(LinkError::from)?.name();
        if let Err(refusal) = reply.outcome().map_err(LinkError::from)? {
            let reason = reply.why(refusal);
            return Err(Failure::CommandRefused {
                command: name,
                state,
                reason,
            });
        }
    }
    let effect = wait(&operator, &link).map_err(|failure| failure.of_command(name))?;
    Ok(accepted((name, &instance), state, effect, args.basic.json))
}

/// Reports that a command was accepted in a state, and what it has come to.
fn accepted((name, instance): (&str, &str), state: &str, effect: Effect, as_json: bool) -> Exit {
    let (exit, to_come) = match effect {
        Effect::Reached => (Exit::Done, None),
        Effect::ToCome(doing) => (Exit::NotYet, Some(doing)),
    };
    if as_json {
        let mut object = json!({
            "command": name,
            "instance": instance,
            "accepted": true,
            "state": state,
        });
        if let Some(doing) = to_come {
            object["not_yet"] = complete(doing).into();
            object["exit_code"] = (exit as u8).into();
        }
        output::object(&object);
    } else {
        let doing = to_come.map_or_else(String::new, |doing| format!("; not done yet: {doing}"));
        output::result(&format!(
            "{name}: accepted; state before it: {state}{doing}\n"
        ));
    }
    exit
}

/// Finds the interpolator of an instance.
///
/// # Errors
/// None runs, or it cannot be reached.
pub(super) fn reach(link: &LinkConfig) -> Result<Operator, Failure> {
    Operator::find(link).map_err(|error| of_link(error, link))
}

/// Sends a command and waits for the answer.
///
/// # Errors
/// The interpolator ended, or it does not answer.
pub(super) fn send(
    operator: &Operator,
    link: &LinkConfig,
    command: Command,
) -> Result<CommandReply, Failure> {
    send_saying(operator, link, command, "")
}

/// The same with a word for people.
///
/// # Errors
/// The errors of [`send`].
pub(super) fn send_saying(
    operator: &Operator,
    link: &LinkConfig,
    command: Command,
    text: &str,
) -> Result<CommandReply, Failure> {
    send_asked(operator, link, (command, Monotonic.now_ns()), text)
}

/// The same for a command that was asked for at a time of the host's steady clock, ns.
fn send_asked(
    operator: &Operator,
    link: &LinkConfig,
    (command, asked_ns): (Command, u64),
    text: &str,
) -> Result<CommandReply, Failure> {
    let request = CommandRequest::new(u64::from(std::process::id()), 1, command);
    let request = request.saying(text).asked_at(asked_ns);
    let reply = operator.call(&request, PATIENCE);
    let reply = reply.map_err(|error| of_link(error, link))?;
    reply.ok_or_else(|| silent(operator, link))
}

pub(super) fn of_link(error: LinkError, link: &LinkConfig) -> Failure {
    match error {
        LinkError::NoServer { .. } => Failure::NoInterpolator {
            instance: link.instance.clone(),
            others: OtherUsers::look(),
        },
        error => error.into(),
    }
}

pub(super) fn silent(operator: &Operator, link: &LinkConfig) -> Failure {
    Failure::Silent {
        instance: link.instance.clone(),
        process: operator.interpolator().id(),
        waited_s: PATIENCE.as_secs(),
    }
}

/// Shows the state of the interpolator.
///
/// # Errors
/// No interpolator runs, or it shows none.
pub(super) fn status(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let instance = session::instance(&args.instance, config);
    let link = session::link(&instance, config);
    let operator = reach(&link)?;
    let status = read_status(&operator, &link)?;
    let active = active_program(&link, &status);
    let beside = Beside {
        asked: asked(&link, config, &status),
        offset: PersistentOffsets::new(config, &link).look(&status),
        not_homed: config.axes_not_homed(&status),
    };
    if args.basic.json {
        let mut object = status_object(&instance, &status, &beside.asked);
        object["axes_not_homed"] = names(&beside.not_homed);
        let offset = beside.offset.as_ref();
        let [system, part] = offset.map_or([Value::Null, Value::Null], |offset| {
            offset.objects(&status.position, &config.axis_names())
        });
        (object["offset"], object["work_position"]) = (system, part);
        object["active_program"] = active_object(active.as_ref());
        output::object(&object);
    } else {
        let active = active.as_ref().map(active_text).unwrap_or_default();
        let text = status_text(&instance, &status, &beside);
        output::result(&(text + &active));
    }
    Ok(Exit::Done)
}

/// What the machine waits for. Which tool that is goes through the shared memory, which an operator can
/// do without: where that cannot be used, it is not told.
fn asked(link: &LinkConfig, config: &MachineConfig, status: &Status) -> AwaitedEvent {
    if status.awaited_since_ns == 0 {
        return AwaitedEvent::default();
    }
    let names = ToolNames::new(config);
    let told = auxiliary(link);
    names.asked(config, status, told.as_ref())
}

/// What spindle, coolant and tool are to do; `None` where nothing says so.
pub(super) fn auxiliary(link: &LinkConfig) -> Option<Auxiliary> {
    let transport = Ipc::connect(link).ok()?;
    let mut records = transport.auxiliary_source().ok()?;
    let started = Instant::now();
    while started.elapsed() < LATCHED {
        if let Some(record) = records.take().ok()? {
            record.check().ok()?;
            return Some(record);
        }
        std::thread::sleep(POLL);
    }
    None
}

/// The next status of an interpolator.
///
/// # Errors
/// It ended, or shows none.
pub(super) fn read_status(operator: &Operator, link: &LinkConfig) -> Result<Status, Failure> {
    let shown = operator.status(PATIENCE);
    let shown = shown.map_err(|error| of_link(error, link))?;
    shown.ok_or_else(|| silent(operator, link))
}
