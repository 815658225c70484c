//! The lock of the process that answers for all drives of an instance: two would both say where the same joints are.
//!
//! A lock of the kernel names its holder, and is released however that ends.

use super::config::LinkConfig;
use super::directory;
use crate::LinkError;
use rustix::fs::{FlockOperation, fcntl_lock};
use rustix::io::Errno;
use rustix::process::{Flock, FlockType, fcntl_getlk};
use std::fs::File;

/// The part of the one who answers for all drives, until dropped or the process ends.
///
/// The kernel releases it as soon as the process closes the file through any descriptor: a process takes it once.
#[derive(Debug)]
pub struct DrivesLock {
    _file: File,
}

impl DrivesLock {
    /// Takes the part; the directory of the instance exists.
    pub(super) fn take(config: &LinkConfig, service: &'static str) -> Result<Self, LinkError> {
        let path = config.directory().join("drives.lock");
        let failed = |source| LinkError::Root {
            path: path.display().to_string(),
            source,
        };
        let file = directory::open(&path).map_err(failed)?;
        match fcntl_lock(&file, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => Ok(Self { _file: file }),
            Err(Errno::AGAIN | Errno::ACCESS) => {
                let lock = fcntl_getlk(&file, &Flock::from(FlockType::WriteLock));
                let pid = lock.ok().flatten().and_then(|lock| lock.pid);
                Err(LinkError::Taken {
                    service,
                    role: "servo",
                    holder: pid.map(|pid| pid.as_raw_nonzero().get()),
                })
            }
            Err(error) => Err(failed(error.into())),
        }
    }
}
