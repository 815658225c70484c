//! `glidepath jog`: by steps, or by the keys of a terminal.

mod arrival;
mod demands;
mod keys;
mod lift;
mod panel;
mod steps;
mod terminal;

use super::failure::Failure;
use super::session;
use crate::cli::JogArgs;
use crate::config::MachineConfig;
use crate::exit::Exit;
pub(super) use arrival::{Arrival, PATIENCE, at_end_already, positions};
pub(super) use demands::{Asked, Demands};
pub(super) use lift::lift;
pub(super) use panel::Panel;

/// Moves the axes by hand.
///
/// # Errors
/// No interpolator runs, the machine cannot be jogged now, or it does not move.
pub(super) fn jog(args: &JogArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let instance = session::instance(&args.operator.instance, config);
    let link = session::link(&instance, config);
    // Says so at once where no interpolator runs; joining alone would make an instance.
    super::operator::reach(&link)?;
    let panel = Panel::open(&link, config)?;
    if args.steps.is_empty() {
        keys::jog(args, config, &instance, panel)
    } else {
        steps::jog(args, config, &instance, panel)
    }
}
