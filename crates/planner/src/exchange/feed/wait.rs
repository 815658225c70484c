//! The wait of a client that streams, as long as the caller wants the run to go on.

use std::time::Duration;

use super::FeedError;
use crate::run::control::Control;

/// Between two looks for what is waited for.
pub(super) const POLL: Duration = Duration::from_micros(200);

/// Waits a little, unless the caller wants the run to end.
pub(super) fn pause(time: Duration, control: &mut Control<'_>) -> Result<(), FeedError> {
    if control.is_stopped() {
        return Err(FeedError::Interrupted);
    }
    (control.pause)(time);
    Ok(())
}
