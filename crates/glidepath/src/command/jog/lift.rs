//! The lift of the tool axis behind an abort, where that is configured.

use super::panel::Panel;
use super::steps::set_out;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::interrupt::Interrupt;
use crate::output;
use core::time::Duration;
use glidepath_geometry::AXES;
use glidepath_link::{JogMode, LinkConfig, MachineState};
use glidepath_realtime::{Clock as _, Monotonic};
use std::time::Instant;

/// Between two looks at the machine.
const POLL: Duration = Duration::from_millis(10);
/// How long the motion may take to come to rest.
const PATIENCE: Duration = Duration::from_secs(10);

/// Waits until the machine rests without a program, and takes the tool axis up, not beyond its
/// travel; whether it went up.
///
/// # Errors
/// The machine does not come to rest ready for a jog, or it does not move.
pub(in crate::command) fn lift(link: &LinkConfig, config: &MachineConfig) -> Result<bool, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let mut panel = Panel::open(link, config)?;
    let (started, asked_ns) = (Instant::now(), Monotonic.now_ns());
    while panel.state()? != MachineState::Idle {
        if interrupt.is_set() || started.elapsed() > PATIENCE {
            output::note("abort: the machine is not ready for a jog; the tool is not lifted");
            return Ok(false);
        }
        std::thread::sleep(POLL);
    }
    let mut value = [0.0; AXES];
    let axis = config.jog.tool_axis;
    if let Some(slot) = value.get_mut(axis.index()) {
        *slot = config.jog.lift;
    }
    let demands = &mut panel.demands;
    demands.ask(asked_ns, JogMode::Incremental, value, 0.0, false)?;
    set_out(&mut panel, &interrupt)?;
    while panel.state()? == MachineState::Jogging {
        if interrupt.is_set() {
            panel.demands.let_go()?;
        }
        std::thread::sleep(POLL);
    }
    output::note(&format!(
        "abort: {axis} went up, by {} mm at most; a resumption (--resume) is refused until it is back, and says how far",
        config.jog.lift
    ));
    Ok(true)
}
