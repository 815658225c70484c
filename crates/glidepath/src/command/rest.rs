//! `glidepath hold`, `abort` and `return`: what is typed next finds the machine where the command was to bring it.

use super::operator::{PATIENCE, command_and_wait, read_status, send};
use crate::cli::OperatorArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use glidepath_link::{
    Command, JobStage, LinkConfig, LinkError, MachineState, Operator, RecordError, Status,
};
use std::time::{Duration, Instant};

/// Between two looks at the machine.
const POLL: Duration = Duration::from_millis(10);

/// Holds the motion, and waits until it rests; not longer than an answer may take: a thread is cut to its end first.
///
/// # Errors
/// The errors of a command.
pub(super) fn hold(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    command_and_wait(args, config, "hold", Command::Hold, |operator, link| {
        wait(operator, link, |status| Ok(!status.state()?.is_moving()))
    })
}

/// Ends the motion and the job, and waits until it rests and its planner has let go of it; not longer than an answer
/// may take.
///
/// # Errors
/// The errors of a command.
pub(super) fn abort(args: &OperatorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    command_and_wait(args, config, "abort", Command::Abort, |operator, link| {
        wait(operator, link, |status| {
            let has_job = matches!(
                status.job_stage()?,
                JobStage::Waiting | JobStage::Preparing | JobStage::Begun
            );
            Ok(!has_job && !status.state()?.is_moving())
        })
    })
}

/// Waits for something, but no longer than an answer may take: the command was accepted all the same.
fn wait(
    operator: &Operator,
    link: &LinkConfig,
    is_so: impl Fn(&Status) -> Result<bool, RecordError>,
) -> Result<(), Failure> {
    let started = Instant::now();
    while started.elapsed() < PATIENCE {
        if is_so(&read_status(operator, link)?).map_err(LinkError::from)? {
            break;
        }
        std::thread::sleep(POLL);
    }
    Ok(())
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

fn come_back(operator: &Operator, link: &LinkConfig, interrupt: &Interrupt) -> Result<(), Failure> {
    let (started, mut has_begun) = (Instant::now(), false);
    loop {
        if interrupt.is_set() {
            send(operator, link, Command::Hold)?;
            return Err(Failure::Interrupted);
        }
        let status = read_status(operator, link)?;
        let state = status.state().map_err(LinkError::from)?;
        let is_away = status.away.iter().any(|away| *away != 0.0);
        has_begun |= state == MachineState::Jogging;
        if state != MachineState::Jogging {
            if !is_away {
                return Ok(());
            }
            if has_begun || started.elapsed() > PATIENCE {
                return Err(Failure::CommandRefused {
                    command: "return",
                    state: state.name(),
                    reason: "the axes did not come back to the path: something ended their way; \
                             `glidepath return` goes on with it"
                        .to_owned(),
                });
            }
        }
        std::thread::sleep(POLL);
    }
}
