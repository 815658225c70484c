//! `glidepath home`: the joints find their home, and the command waits for that.

use super::operator::{PATIENCE, command, joints_meant, reach, read_status, send};
use super::session;
use crate::cli::HomeArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use glidepath_link::{Command, LinkConfig, LinkError, MachineState, Operator};
use std::time::{Duration, Instant};

const NAME: &str = "home";
/// Between two looks at the joints.
const POLL: Duration = Duration::from_millis(20);

/// Sends the joints home, and waits until they are there. An interrupt ends their way.
///
/// # Errors
/// The errors of a command, or the joints did not find their home.
pub(super) fn home(args: &HomeArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let (operator_args, mask) = (&args.joints.operator, joints_meant(&args.joints, config));
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let exit = command(operator_args, config, NAME, Command::Home(mask))?;
    if args.no_wait {
        return Ok(exit);
    }
    if !operator_args.basic.json {
        output::note("home: the joints are on their way");
    }
    let link = session::link(&session::instance(&operator_args.instance, config), config);
    let operator = reach(&link).map_err(|failure| failure.of_command(NAME))?;
    wait(&operator, &link, mask, &interrupt).map_err(|failure| failure.of_command(NAME))?;
    Ok(exit)
}

/// Waits until the joints are at home, or on their way no more.
fn wait(
    operator: &Operator,
    link: &LinkConfig,
    mask: u32,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let (started, mut has_begun) = (Instant::now(), false);
    loop {
        if interrupt.is_set() {
            send(operator, link, Command::Abort)?;
            return Err(Failure::Interrupted);
        }
        let status = read_status(operator, link)?;
        let state = status.state().map_err(LinkError::from)?;
        has_begun |= state == MachineState::Homing;
        let is_over = state != MachineState::Homing;
        if is_over && (has_begun || started.elapsed() > PATIENCE) {
            if status.homed & mask == mask {
                return Ok(());
            }
            return Err(Failure::CommandRefused {
                command: NAME,
                state: state.name(),
                reason:
                    "the joints did not find their home; `glidepath status` tells what is known \
                         of them"
                        .to_owned(),
            });
        }
        std::thread::sleep(POLL);
    }
}
