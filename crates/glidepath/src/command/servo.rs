//! `glidepath servo`: a mock servo. It takes setpoints as a real one would, and counts.

use super::session;
use crate::cli::ServoArgs;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt::{Interrupt, end_with};
use crate::output;
use crate::reception::Reception;
use crate::recording::Recording;
use crate::report::grouped;
use crate::sample::Sample;
use glidepath_link::{LinkError, Record as _, Setpoint, Transport as _};
use serde_json::json;
use std::io::Write as _;
use std::time::Duration;

/// Between two looks for setpoints: a fraction of a period, and a small one of the queue.
const POLL: Duration = Duration::from_millis(1);

/// Receives until asked to end.
///
/// # Errors
/// The link cannot be used, or a file cannot be written.
pub fn servo(args: &ServoArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    end_with(args.end_with).map_err(Failure::Signals)?;
    if args.relay {
        return relay(args, config, &interrupt);
    }
    let mut recording = Recording::create(config, args.setpoints.as_deref(), None)?;
    let mut reception = Reception::default();
    let period_t = config.period_t();
    receive(args, config, &interrupt, |setpoint| {
        reception.count(setpoint);
        recording.push(&Sample::received(setpoint, period_t))?;
        Ok(true)
    })?;
    recording.finish("", "")?;
    if args.basic.json {
        output::object(&json!({
            "received": reception.received,
            "lost_setpoints": reception.lost,
            "restarts": reception.restarts,
            "setpoints": args.setpoints,
        }));
    } else {
        output::result(&format!(
            "servo: {} setpoints, {} lost, {} restarts of the interpolator\n",
            grouped(reception.received),
            grouped(reception.lost),
            reception.restarts
        ));
    }
    Ok(interrupt.exit())
}

/// Passes every record on, byte for byte, until the reader goes away.
fn relay(args: &ServoArgs, config: &MachineConfig, interrupt: &Interrupt) -> Result<Exit, Failure> {
    let mut out = std::io::stdout().lock();
    receive(args, config, interrupt, |setpoint| {
        Ok(out
            .write_all(bytemuck::bytes_of(setpoint))
            .and_then(|()| out.flush())
            .is_ok())
    })?;
    Ok(interrupt.exit())
}

/// Hands over every setpoint, checked, until `take` gives false or the process is asked to end.
fn receive(
    args: &ServoArgs,
    config: &MachineConfig,
    interrupt: &Interrupt,
    mut take: impl FnMut(&Setpoint) -> Result<bool, Failure>,
) -> Result<(), Failure> {
    let transport = session::join(&args.instance, config)?;
    let mut source = transport.setpoint_source()?;
    while !interrupt.is_set() {
        while let Some(setpoint) = source.take()? {
            setpoint.check().map_err(LinkError::from)?;
            if !take(&setpoint)? {
                return Ok(());
            }
        }
        std::thread::sleep(POLL);
    }
    Ok(())
}
