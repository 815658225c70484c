//! The cause of a failed call of iceoryx2, kept per thread: the storage notes it, because the
//! errors of iceoryx2 have no room for it.

use crate::LinkError;
use core::cell::RefCell;
use std::path::Path;

/// What the files of a process that joins take at most: a planner's are the most, 480 KiB.
const JOINING_BYTES: u64 = 1 << 20;

thread_local! {
    static NOTED: RefCell<Option<LinkError>> = const { RefCell::new(None) };
}

/// Keeps the cause of a failure for whoever called iceoryx2 in this thread.
pub(super) fn note(error: LinkError) {
    NOTED.set(Some(error));
}

/// Calls iceoryx2 for an instance. If that fails, and the storage knows why, or there is no room
/// left in the instance's directory, that is the error.
pub(super) fn explained<T>(
    directory: &Path,
    call: impl FnOnce() -> Result<T, LinkError>,
) -> Result<T, LinkError> {
    NOTED.set(None);
    call().map_err(|error| match error {
        LinkError::Transport { .. } => NOTED
            .take()
            .or_else(|| is_full(directory).then(|| LinkError::no_room(directory, JOINING_BYTES)))
            .unwrap_or(error),
        other => other,
    })
}

fn is_full(directory: &Path) -> bool {
    rustix::fs::statvfs(directory)
        .is_ok_and(|found| found.f_bavail == 0 || (found.f_favail == 0 && found.f_files > 0))
}
