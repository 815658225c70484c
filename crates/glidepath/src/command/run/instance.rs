//! The instance of a run: its name, and the removal of its shared memory, also of runs that were killed.

use glidepath_link::{LinkConfig, remove_leftovers};

use crate::output;

/// What the names of runs begin with for which nobody chose one.
const PREFIX: &str = "run-";

/// A name for the shared memory that no other run has.
#[expect(clippy::disallowed_methods, reason = "a name")]
pub(super) fn own() -> String {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let nanos = since.unwrap_or_default().subsec_nanos();
    format!("{PREFIX}{}-{nanos:x}", std::process::id())
}

/// Removes an instance's shared memory when everything that used it is gone.
pub(super) struct Leftovers(pub(super) LinkConfig);

impl Drop for Leftovers {
    fn drop(&mut self) {
        if let Err(error) = remove_leftovers(&self.0) {
            output::note(&format!("cannot remove the shared memory: {error}"));
        }
    }
}

/// Removes the shared memory of runs without a process, beside that of `own`: one that was killed removed
/// nothing, and nobody comes back to an instance of that name.
pub(super) fn remove_killed_runs(own: &LinkConfig) {
    let entries = std::fs::read_dir(&own.root).into_iter().flatten();
    let names = entries
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok());
    for instance in names.filter(|name| name.starts_with(PREFIX) && *name != own.instance) {
        let killed = LinkConfig {
            instance,
            ..own.clone()
        };
        // What cannot be removed does no harm to this run.
        let _removed = remove_leftovers(&killed);
    }
}
