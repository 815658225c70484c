//! `glidepath home`: the joints find their home, and the command waits for that.

use super::ending;
use super::operator::{PATIENCE, command, joints_meant, reach, read_status, send};
use super::session;
use crate::cli::HomeArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use glidepath_link::{Command, LinkConfig, LinkError, MachineState, Operator, Status};
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
            return judge(&status, state, mask);
        }
        std::thread::sleep(POLL);
    }
}

/// Whether the joints are at home by the way that has ended. Who sets out for home is not homed
/// before it has ended well, so that their bits are of this way.
fn judge(status: &Status, state: MachineState, mask: u32) -> Result<(), Failure> {
    if status.homed & mask == mask && ending::failure(status).is_none() {
        return Ok(());
    }
    let reason = ending::why(status).unwrap_or_else(|| {
        "the joints did not find their home; `glidepath status` tells what is known of them"
            .to_owned()
    });
    Err(Failure::CutShort {
        command: NAME,
        state: state.name(),
        reason,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::{FaultCause, Text};

    #[test]
    fn joints_that_are_homed_are_not_at_home_by_a_way_that_ended_in_a_fault_or_without_power() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        let told = |status: &Status| {
            let state = status.state().unwrap();
            judge(status, state, 0b11).map_err(|failure| failure.to_string())
        };
        (status.homed, status.state) = (0b111, MachineState::Idle.code());
        assert_eq!(told(&status), Ok(()));
        status.state = MachineState::Off.code();
        assert!(told(&status).unwrap_err().contains("switched off"));
        status.state = MachineState::Faulted.code();
        status.fault = FaultCause::Homing.code();
        let fault = told(&status).unwrap_err();
        assert!(fault.contains("did not find its home"), "{fault}");
        (status.fault, status.homed) = (0, 0b101);
        status.state = MachineState::NotHomed.code();
        status.last_error = Text::new("an abort ended the way home");
        let abort = told(&status).unwrap_err();
        assert_eq!(
            abort,
            "home has ended before its end: an abort ended the way home"
        );
    }
}
