//! The generations that this process has seen of what machines keep, so that files that are lost under a running
//! service are not taken for a machine that keeps nothing yet.

use crate::persistence::error::StateError;
use glidepath_persistence::{Directory, PersistentState, Store};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The newest generation of each folder.
static SEEN: Mutex<BTreeMap<PathBuf, u64>> = Mutex::new(BTreeMap::new());

/// A look into a folder, or a change of what is there, that has begun.
#[derive(Debug)]
struct Look<'f> {
    folder: &'f Path,
    /// The newest generation that was seen there before.
    newest: u64,
}

impl<'f> Look<'f> {
    /// Before the files are looked at: what another thread writes meanwhile is no reason to refuse what is read.
    fn begin(folder: &'f Path) -> Self {
        let seen = SEEN.lock().unwrap_or_else(PoisonError::into_inner);
        let newest = seen.get(folder).copied().unwrap_or(0);
        Self { folder, newest }
    }

    /// Notes what was read or written; 0 if nothing is kept.
    ///
    /// # Errors
    /// This process had seen a newer generation there.
    fn end(self, generation: u64) -> Result<(), StateError> {
        let Self { folder, newest } = self;
        if generation < newest {
            let folder = folder.display().to_string();
            return Err(StateError::Gone { folder, newest });
        }
        let mut seen = SEEN.lock().unwrap_or_else(PoisonError::into_inner);
        let newest = seen.entry(folder.to_owned()).or_insert(0);
        *newest = generation.max(*newest);
        Ok(())
    }
}

/// The newest generation of a folder; `None` if nothing was ever kept there.
///
/// # Errors
/// It cannot be read, or this process had seen a newer one.
pub(super) fn read(
    store: &Store<Directory>,
    folder: &Path,
) -> Result<Option<(u64, PersistentState)>, StateError> {
    let look = Look::begin(folder);
    let newest = store.read()?;
    look.end(newest.as_ref().map_or(0, |it| it.0))?;
    Ok(newest)
}

/// Writes the next generation of a folder.
///
/// # Errors
/// It cannot be written, or this process had seen as new a one.
pub(super) fn write(
    store: &mut Store<Directory>,
    folder: &Path,
    kept: &PersistentState,
) -> Result<(), StateError> {
    let look = Look::begin(folder);
    look.end(store.write(kept)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_never_goes_back() {
        let (one, other) = (Path::new("/no/such/one"), Path::new("/no/such/other"));
        for generation in [0, 0, 1, 2, 2, 7] {
            Look::begin(one).end(generation).unwrap();
        }
        Look::begin(other).end(1).unwrap();
        for generation in [0, 1, 6] {
            let told = Look::begin(one).end(generation).unwrap_err().to_string();
            assert!(told.contains("generation 7"), "{told}");
        }
        // Read before another thread wrote.
        let look = Look::begin(one);
        Look::begin(one).end(8).unwrap();
        look.end(7).unwrap();
        assert!(Look::begin(one).end(7).is_err());
    }
}
