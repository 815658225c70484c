//! `glidepath ethercat`: drives on EtherCAT.

mod bridge;
mod desk;
mod emulated;
mod emulated_drives;
mod emulated_inputs;
mod emulated_terminals;
mod input_file;
mod input_line;
mod namespace;
mod scan;
mod timed_wire;

use crate::cli::{EthercatAction, EthercatArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;

/// Drives the drives until it is asked to end, or lists what hangs on the wire.
///
/// # Errors
/// The interface, the bus or shared memory cannot be used.
pub(super) fn ethercat(args: &EthercatArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    match &args.action {
        Some(EthercatAction::Scan(args)) => scan::scan(args),
        None if args.emulated && !args.in_namespace => Err(namespace::enter()),
        None if args.emulated => emulated::drive(args, config),
        None => bridge::drive(args, config),
    }
}
