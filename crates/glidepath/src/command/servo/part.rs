//! The part of a servo in its machine: one answers for all drives.

use crate::cli::ServoArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use glidepath_link::{DrivesLock, Ipc};

/// Takes the part of the one that answers for all drives, where these are to say where they are. Of a second one the
/// interpolator uses nothing. Where no feedback is expected, and where a servo only listens, there may be any number.
pub(super) fn part(
    transport: &Ipc,
    args: &ServoArgs,
    config: &MachineConfig,
) -> Result<Option<DrivesLock>, Failure> {
    let answers = config.feedback.is_expected && !args.listens;
    Ok(answers.then(|| transport.answer_for_drives()).transpose()?)
}
