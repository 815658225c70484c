//! The lock that the interpolator of an instance holds, and the way to find and signal its holder.
//!
//! The interpolator holds a lock on a file in the instance's directory for as long as it lives. Who
//! holds it is asked of the kernel (`F_GETLK`), which names a living process or none: there is no
//! number in a file that could be out of date. The process is then held by a descriptor, and asked
//! for once more, so that no other that got its number since is ever signalled.

use super::config::LinkConfig;
use super::directory;
use crate::LinkError;
use rustix::fs::{FlockOperation, fcntl_lock};
use rustix::io::Errno;
use rustix::process::{
    Flock, FlockType, Pid, PidfdFlags, Signal, fcntl_getlk, pidfd_open, pidfd_send_signal,
};
use std::fs::File;
use std::io;
use std::os::fd::OwnedFd;
use std::path::{Path, PathBuf};

fn lock_path(config: &LinkConfig) -> PathBuf {
    config.directory().join("interpolator.lock")
}

fn failed(path: &Path) -> impl Fn(io::Error) -> LinkError {
    let path = path.display().to_string();
    move |source| LinkError::Root {
        path: path.clone(),
        source,
    }
}

/// The lock of the interpolator, until dropped or the process ends, however it does.
///
/// The kernel releases it as soon as the process closes the file through any descriptor: nothing
/// else in the interpolator's process may open it.
#[derive(Debug)]
pub(super) struct InterpolatorLock {
    file: File,
    path: PathBuf,
}

impl InterpolatorLock {
    /// Becomes the interpolator of an instance, whose directory exists.
    pub(super) fn take(config: &LinkConfig, service: &'static str) -> Result<Self, LinkError> {
        let path = lock_path(config);
        let failed = failed(&path);
        let file = directory::open(&path).map_err(&failed)?;
        match fcntl_lock(&file, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => Ok(Self {
                file,
                path: path.clone(),
            }),
            Err(Errno::AGAIN | Errno::ACCESS) => Err(LinkError::Taken {
                service,
                role: "interpolator",
                holder: holder(&file)
                    .ok()
                    .flatten()
                    .map(|pid| pid.as_raw_nonzero().get()),
            }),
            Err(error) => Err(failed(error.into())),
        }
    }

    /// The file, by whose name the interpolator is found.
    pub(super) const fn file(&self) -> (&PathBuf, &File) {
        (&self.path, &self.file)
    }
}

/// The process of a living interpolator, which no other can be mistaken for.
///
/// A process does not find itself.
#[derive(Debug)]
pub struct InterpolatorProcess {
    pid: Pid,
    process: OwnedFd,
    lock: File,
    path: PathBuf,
}

impl InterpolatorProcess {
    /// Finds the interpolator of an instance, `None` if none lives. Takes three file descriptors,
    /// and neither shared memory nor room in a file system.
    ///
    /// # Errors
    ///
    /// [`LinkError::Root`] if the instance's directory is not this user's alone or cannot be read.
    pub fn find(config: &LinkConfig) -> Result<Option<Self>, LinkError> {
        config.check()?;
        let path = lock_path(config);
        let failed = failed(&path);
        let found = Self::find_at(&path).map_err(failed)?;
        Ok(found.map(|(pid, process, lock)| Self {
            pid,
            process,
            lock,
            path,
        }))
    }

    fn find_at(path: &Path) -> io::Result<Option<(Pid, OwnedFd, File)>> {
        let lock = match directory::options().open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            opened => opened?,
        };
        while let Some(pid) = holder(&lock)? {
            match pidfd_open(pid, PidfdFlags::empty()) {
                // Still the holder after it was opened: the descriptor is of no other process.
                Ok(process) if holder(&lock)? == Some(pid) => {
                    return Ok(Some((pid, process, lock)));
                }
                Ok(_) | Err(Errno::SRCH) => {}
                Err(error) => return Err(error.into()),
            }
        }
        Ok(None)
    }

    /// Its process number.
    #[must_use]
    pub const fn id(&self) -> i32 {
        self.pid.as_raw_nonzero().get()
    }

    /// Asks it by SIGTERM to bring the motion to rest on the path and to end. Does nothing if it
    /// has ended.
    ///
    /// # Errors
    ///
    /// [`LinkError::Root`] if the system does not let this user signal it.
    pub fn terminate(&self) -> Result<(), LinkError> {
        match pidfd_send_signal(&self.process, Signal::TERM) {
            Ok(()) | Err(Errno::SRCH) => Ok(()),
            Err(error) => Err(failed(&self.path)(error.into())),
        }
    }

    /// Whether it still runs.
    ///
    /// # Errors
    ///
    /// [`LinkError::Root`] if the system does not tell.
    pub fn lives(&self) -> Result<bool, LinkError> {
        let holder = holder(&self.lock).map_err(failed(&self.path))?;
        Ok(holder == Some(self.pid))
    }
}

/// Who holds the lock on a file.
fn holder(file: &File) -> io::Result<Option<Pid>> {
    let Some(lock) = fcntl_getlk(file, &Flock::from(FlockType::WriteLock))? else {
        return Ok(None);
    };
    let why = "it is held in another PID namespace (a container): signal it from there";
    let unseen = || io::Error::new(io::ErrorKind::Unsupported, why);
    lock.pid.ok_or_else(unseen).map(Some)
}
