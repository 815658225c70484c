//! The part of a servo in its machine: one answers for all drives.

use crate::cli::ServoArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use glidepath_link::{DrivesLock, Ipc, LinkError};
use std::time::{Duration, Instant};

/// How long one that was killed may take to be gone.
const SETTLE: Duration = Duration::from_millis(500);
const POLL: Duration = Duration::from_millis(20);

/// Takes the part of the one that answers for all drives, where these are to say where they are. Of a second one the
/// interpolator uses nothing. Where no feedback is expected, and where a servo only listens, there may be any number.
pub(super) fn part(
    transport: &Ipc,
    args: &ServoArgs,
    config: &MachineConfig,
) -> Result<Option<DrivesLock>, Failure> {
    if args.listens || !config.feedback.is_expected {
        return Ok(None);
    }
    let began = Instant::now();
    loop {
        match transport.answer_for_drives() {
            Err(LinkError::Taken { .. }) if began.elapsed() < SETTLE => std::thread::sleep(POLL),
            taken => return Ok(Some(taken?)),
        }
    }
}
