//! `glidepath hold`, `abort`, `disable` and `return`: each waits until the machine is where the
//! command was to bring it, so that what is typed next finds it there.

use super::jog::lift;
use super::operator::{Effect, PATIENCE, command_and_wait, reach, read_status, send};
use super::other_users::OtherUsers;
use super::session;
use super::thread_watch::ThreadWatch;
use crate::cli::{AbortArgs, OperatorArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::waiting_note::WaitingNote;
use glidepath_link::{
    Command, EndOfEpoch, InterpolatorProcess, JobStage, LinkConfig, LinkError, MachineState,
    Operator, Power, RecordError, Status,
};
use serde_json::json;
use std::time::{Duration, Instant};

/// Between two looks at the machine.
const POLL: Duration = Duration::from_millis(10);
/// When it is said that the end of an interpolator is waited for.
const TELL_AFTER: Duration = Duration::from_millis(500);
/// How long an interpolator that was signalled may take to end: 5 s to come to rest, and to clean up.
const END_PATIENCE: Duration = Duration::from_secs(10);

/// Holds the motion, and waits until it rests; not longer than an answer may take: a thread is cut to its end first.
///
/// # Errors
/// The errors of a command.
pub(super) fn hold(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    command_and_wait(args, config, "hold", Command::Hold, |operator, link| {
        wait(
            operator,
            link,
            |status| Ok(!status.state()?.is_moving()),
            still,
        )
    })
}

/// Brings the machine to rest on the path: by a command, or by a signal that needs nothing but the
/// process.
///
/// # Errors
/// The errors of [`command`], or the process does not end.
pub(super) fn abort(args: &AbortArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    if !args.signal {
        return abort_and_lift(args, config);
    }
    let instance = session::instance(&args.operator.instance, config);
    let found = InterpolatorProcess::find(&session::link(&instance, config))?;
    let process = found.ok_or_else(|| Failure::NoInterpolator {
        instance: instance.clone(),
        others: OtherUsers::look(),
    })?;
    let pid = process.id();
    process.terminate()?;
    let (started, mut is_told) = (Instant::now(), args.operator.basic.json);
    while process.lives()? {
        if !is_told && started.elapsed() >= TELL_AFTER {
            is_told = true;
            output::note(&format!(
                "abort: the interpolator (process {pid}) was signalled; waiting up to {} s for the machine to \
                 rest and the process to end. One that was stopped ends when `kill -CONT {pid}` lets it go on",
                END_PATIENCE.as_secs()
            ));
        }
        if started.elapsed() >= END_PATIENCE {
            let waited_s = END_PATIENCE.as_secs();
            return Err(Failure::DoesNotEnd { pid, waited_s });
        }
        std::thread::sleep(POLL);
    }
    if args.operator.basic.json {
        output::object(&json!({
            "command": "abort",
            "instance": instance,
            "signalled": pid,
            "ended": true,
        }));
    } else {
        let text = format!("abort: the interpolator (process {pid}) was signalled and has ended\n");
        output::result(&text);
    }
    Ok(Exit::Done)
}

/// By command; then the tool axis goes up, if a program was under way and that is configured.
fn abort_and_lift(args: &AbortArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let instance = session::instance(&args.operator.instance, config);
    let link = session::link(&instance, config);
    let lifts = config.jog.lift > 0.0 && !args.no_lift;
    let was_open = lifts
        && reach(&link)?
            .status(PATIENCE)?
            .is_some_and(|status| status.end_of_epoch() == Ok(EndOfEpoch::Open));
    // Heard from before the abort on, which waits for nothing of it and is sent whatever becomes of it.
    let mut watch = was_open.then(|| ThreadWatch::start(&link, config));
    let exit = abort_and_wait(&args.operator, config, &mut watch)?;
    let Some(mut watch) = watch else {
        return Ok(exit);
    };
    if watch.may_be_in_thread() {
        output::note(
            "abort: the tool may be in a thread or a tapped hole, so it is not lifted; turn it out, or jog it away \
             where nothing holds it",
        );
    } else if lift(&link, config)? {
        // It has waited until the machine was at rest.
        return Ok(Exit::Done);
    }
    Ok(exit)
}

/// Ends the motion and the job, and waits until it rests and its planner has let go of it; not longer than an answer
/// may take. What the setpoints tell meanwhile is heard.
///
/// # Errors
/// The errors of a command.
fn abort_and_wait(
    args: &OperatorArgs,
    config: &MachineConfig,
    watch: &mut Option<ThreadWatch>,
) -> Result<Exit, Failure> {
    command_and_wait(args, config, "abort", Command::Abort, |operator, link| {
        let is_so = |status: &Status| {
            watch.iter_mut().for_each(ThreadWatch::look);
            Ok(!has_job(status)? && !status.state()?.is_moving())
        };
        wait(operator, link, is_so, still)
    })
}

/// Switches the drives off, and waits until the motion has ended, its planner has let go of it and the drives
/// have no power; not longer than an answer may take.
///
/// # Errors
/// The errors of a command.
pub(super) fn disable(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let command = Command::Disable;
    command_and_wait(args, config, "disable", command, |operator, link| {
        let is_so = |status: &Status| {
            let has_none = matches!(status.power()?, Power::Off | Power::Simulated);
            let is_off = has_none && !status.state()?.is_moving();
            Ok(is_off && !has_job(status)?)
        };
        wait(operator, link, is_so, still_on)
    })
}

/// Whether a job has the machine, or waits for it.
fn has_job(status: &Status) -> Result<bool, RecordError> {
    let stage = status.job_stage()?;
    Ok(matches!(
        stage,
        JobStage::Waiting | JobStage::Preparing | JobStage::Begun
    ))
}

/// Waits for something, but no longer than an answer may take: the command was accepted all the same. A machine that
/// still moves then, or has power that it is to lose, is told.
fn wait(
    operator: &Operator,
    link: &LinkConfig,
    mut is_so: impl FnMut(&Status) -> Result<bool, RecordError>,
    still: impl Fn(&Status) -> Result<Effect, RecordError>,
) -> Result<Effect, Failure> {
    let started = Instant::now();
    while started.elapsed() < PATIENCE {
        if is_so(&read_status(operator, link)?).map_err(LinkError::from)? {
            return Ok(Effect::Reached);
        }
        std::thread::sleep(POLL);
    }
    let status = read_status(operator, link)?;
    Ok(still(&status).map_err(LinkError::from)?)
}

/// What a machine does that was stopped, and is not where the stop leads after so long. One that rests is stopped,
/// whoever does not let go of it.
fn still(status: &Status) -> Result<Effect, RecordError> {
    Ok(if status.state()?.is_moving() {
        Effect::ToCome(
            "the machine still moves; in a thread or a tap the pass comes to its end first; `glidepath status` tells \
             when it rests",
        )
    } else {
        Effect::Reached
    })
}

/// The same of one whose drives were to be switched off.
fn still_on(status: &Status) -> Result<Effect, RecordError> {
    let has_power = !matches!(status.power()?, Power::Off | Power::Simulated);
    Ok(match still(status)? {
        Effect::Reached if has_power => Effect::ToCome(
            "the drives still have power; `glidepath status` tells when they have none",
        ),
        effect => effect,
    })
}

/// Brings the axes back to the path, and waits until they are there. An interrupt ends their way.
///
/// # Errors
/// The errors of a command, or the axes did not come back.
pub(super) fn return_to_path(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    command_and_wait(args, config, "return", Command::Return, |operator, link| {
        come_back(operator, link, &interrupt)
    })
}

fn come_back(
    operator: &Operator,
    link: &LinkConfig,
    interrupt: &Interrupt,
) -> Result<Effect, Failure> {
    let (started, mut has_begun) = (Instant::now(), false);
    let mut note =
        WaitingNote::new("return: the axes are on their way; Ctrl-C stops them".to_owned());
    loop {
        if interrupt.is_set() {
            send(operator, link, Command::Hold)?;
            return Err(Failure::Interrupted);
        }
        let status = read_status(operator, link)?;
        let state = status.state().map_err(LinkError::from)?;
        let is_away = status.away.iter().any(|away| *away != 0.0);
        has_begun |= state == MachineState::Jogging;
        // What ends the way is told when the motion has come to rest: until then the program is open, and behind it
        // there is no path to be away from.
        if !state.is_moving() {
            let is_open = status.end_of_epoch().map_err(LinkError::from)? == EndOfEpoch::Open;
            if is_open && !is_away {
                return Ok(Effect::Reached);
            }
            if !is_open || has_begun || started.elapsed() > PATIENCE {
                return Err(Failure::NotReturned(not_returned(&status)?));
            }
        }
        note.look();
        std::thread::sleep(POLL);
    }
}

/// What ended the way back to the path.
fn not_returned(status: &Status) -> Result<&'static str, Failure> {
    let is_open = status.end_of_epoch().map_err(LinkError::from)? == EndOfEpoch::Open;
    Ok(if is_open {
        "a hold ended the way back to the path; `glidepath return` goes on with it"
    } else {
        "an abort or a fault ended the program on the way back to its path; the axes stay where they are, and \
         `glidepath run-file FILE --resume` goes on where they are back on it"
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_or_has_power_is_not_said_to_be_stopped() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        for state in [
            MachineState::Holding,
            MachineState::Stopping,
            MachineState::Running,
        ] {
            status.state = state.code();
            for still in [still, still_on] {
                let effect = still(&status);
                assert!(matches!(effect, Ok(Effect::ToCome(text)) if text.contains("still moves")));
            }
        }
        status.state = MachineState::Idle.code();
        for (power, reached) in [
            (Power::Simulated, true),
            (Power::Off, true),
            (Power::Enabling, false),
            (Power::On, false),
        ] {
            status.power = power.code();
            assert_eq!(still(&status), Ok(Effect::Reached));
            assert_eq!(still_on(&status) == Ok(Effect::Reached), reached);
        }
    }
}
