//! The presence lock of an instance: which processes take part, and the removal of what the last
//! one left.
//!
//! Every process of an instance holds a shared lock on a file of the instance for as long as it has
//! ports; the kernel releases it however the process ends. Whoever gets the exclusive lock knows
//! that no other is there, and removes what the instance left in its directory. The lock file is removed last, under the lock, and a newcomer makes sure that the file it locked
//! still is the one the name stands for.
//!
//! Somebody may remove the directory, or a file of it, while processes live. Those that are connected go on, and nobody
//! else finds them: so they look now and then whether the names by which they are found still stand for their files.

use super::config::LinkConfig;
use super::directory::{Identity, is_still, open};
use crate::LinkError;
use core::cell::RefCell;
use std::fs::{File, TryLockError};
use std::io;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// How long a newcomer waits for one that is removing leftovers.
const PATIENCE: Duration = Duration::from_secs(2);

/// The presence of this process in an instance, until dropped.
#[derive(Debug)]
pub(super) struct Presence {
    lock: File,
    config: LinkConfig,
    /// By what others find this process.
    found_by: RefCell<Vec<(PathBuf, Identity)>>,
}

impl Presence {
    pub(super) fn announce(config: &LinkConfig) -> Result<Self, LinkError> {
        let started = Instant::now();
        loop {
            // If this fails in passing, the instance is being removed, or was while this was tried.
            match Self::try_announce(config) {
                Err(LinkError::Root { source, .. })
                    if is_passing(&source) && started.elapsed() < PATIENCE =>
                {
                    std::thread::sleep(Duration::from_millis(2));
                }
                result => return result,
            }
        }
    }

    fn try_announce(config: &LinkConfig) -> Result<Self, LinkError> {
        config.prepare()?;
        let path = lock_path(config);
        let failed = |source| LinkError::Root {
            path: path.display().to_string(),
            source,
        };
        let lock = open(&path).map_err(failed)?;
        lock.try_lock_shared()
            .map_err(|error| failed(error.into()))?;
        if is_still(&lock, &path).map_err(failed)? {
            let identity = Identity::of(&lock).map_err(failed)?;
            Ok(Self {
                lock,
                config: config.clone(),
                found_by: RefCell::new(vec![(path, identity)]),
            })
        } else {
            Err(failed(io::ErrorKind::NotFound.into()))
        }
    }
}

impl Presence {
    /// Which instance it is.
    pub(super) const fn config(&self) -> &LinkConfig {
        &self.config
    }

    /// From now on others find this process by a file, too.
    pub(super) fn is_found_by(&self, path: PathBuf, file: &File) -> io::Result<()> {
        let identity = Identity::of(file)?;
        self.found_by.borrow_mut().push((path, identity));
        Ok(())
    }

    /// Looks whether others still find this process.
    pub(super) fn stands(&self) -> Result<(), LinkError> {
        let found_by = self.found_by.borrow();
        let gone = found_by.iter().find(|(path, file)| !file.is_at(path));
        match gone {
            Some((path, _)) => Err(LinkError::Removed {
                path: path.display().to_string(),
            }),
            None => Ok(()),
        }
    }

    /// Claims a part that one process at a time may play, until the file is dropped or the process
    /// ends, however it does. `None` if another plays it.
    pub(super) fn claim(&self, part: &str) -> Result<Option<File>, LinkError> {
        let path = self.config.directory().join(part);
        let claim = || {
            let file = open(&path)?;
            match file.try_lock() {
                Ok(()) => Ok(Some(file)),
                Err(TryLockError::WouldBlock) => Ok(None),
                Err(TryLockError::Error(error)) => Err(error),
            }
        };
        claim().map_err(|source| LinkError::Root {
            path: path.display().to_string(),
            source,
        })
    }
}

impl Drop for Presence {
    fn drop(&mut self) {
        // The last one out removes the files. If that fails they do no harm: the next one does. Where the directory was
        // removed meanwhile, the one of that name is another instance's.
        let is_last = self.lock.try_lock().is_ok();
        if is_last && is_still(&self.lock, &lock_path(&self.config)).unwrap_or(false) {
            let _ = sweep(&self.config);
        }
    }
}

/// Removes what an instance left behind, if no process of it lives. Returns whether nothing is
/// left.
///
/// A process does this itself when it ends in good order. To be called for an instance whose
/// processes may all have been killed.
///
/// # Errors
///
/// [`LinkError::Name`], or [`LinkError::Root`] if files cannot be removed.
pub fn remove_leftovers(config: &LinkConfig) -> Result<bool, LinkError> {
    config.prepare()?;
    let path = lock_path(config);
    let failed = |source| LinkError::Root {
        path: path.display().to_string(),
        source,
    };
    let file = open(&path).map_err(failed)?;
    match file.try_lock() {
        Ok(()) if is_still(&file, &path).map_err(failed)? => sweep(config).map_err(failed),
        // Somebody is there, or came since.
        Ok(()) | Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(source)) => Err(failed(source)),
    }
}

/// Removes the files of an instance. To be called with the exclusive lock.
fn sweep(config: &LinkConfig) -> io::Result<bool> {
    let (directory, lock) = (config.directory(), lock_path(config));
    for entry in std::fs::read_dir(&directory)? {
        let path = entry?.path();
        if path.is_dir() {
            ignore_missing(std::fs::remove_dir_all(&path))?;
        } else if path != lock {
            ignore_missing(std::fs::remove_file(&path))?;
        }
    }
    ignore_missing(std::fs::remove_file(&lock))?;
    // Not empty if a newcomer was quick: then it is in use again. The root is shared by all
    // instances, and goes with the last.
    if std::fs::remove_dir(&directory).is_ok() {
        let _ = std::fs::remove_dir(&config.root);
    }
    Ok(true)
}

fn lock_path(config: &LinkConfig) -> PathBuf {
    config.directory().join("lock")
}

fn is_passing(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::WouldBlock | io::ErrorKind::NotFound
    )
}

fn ignore_missing(result: io::Result<()>) -> io::Result<()> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        other => other,
    }
}
