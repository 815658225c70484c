//! The error type of ports and transports: why a port could not be made or used.

use crate::RecordError;
use crate::service::{JOBS, LINES, SEGMENTS};
use std::io;
use std::path::Path;

/// An error of the transport underneath.
pub type BoxedError = Box<dyn core::error::Error + Send + Sync>;

/// The reason why a port could not be made or used.
#[derive(Debug, thiserror::Error)]
pub enum LinkError {
    /// The directory for the instance's files cannot be used.
    #[error(
        "{path}: cannot be used for the link's files ({source}); run all processes of an instance as \
         the same user, or set XDG_RUNTIME_DIR to another directory of this user in memory, for all \
         of them"
    )]
    Root {
        /// The directory.
        path: String,
        /// What the system says.
        source: io::Error,
    },
    /// A file has no room in its file system, which is memory.
    #[error(
        "{path}: no room{} in the file system it is on, which is memory: free some (`df -h`, `du -ax`), \
         or set XDG_RUNTIME_DIR to a directory on another, for all processes of the instance",
        needed(*.bytes)
    )]
    NoRoom {
        /// The file, or the directory it was to be in.
        path: String,
        /// How much it needs, 0 where that is not known.
        bytes: u64,
    },
    /// A file of the instance cannot be used.
    #[error("{path}: {source}{}", remedy(.source))]
    File {
        /// The file.
        path: String,
        /// What the system says.
        source: io::Error,
    },
    /// What an instance is found by is gone: processes that are connected stay so, and nobody else finds them.
    #[error(
        "{path}: it was removed while processes of this instance ran, so that nobody finds them any more; end all of \
         them, and start them again"
    )]
    Removed {
        /// What was removed.
        path: String,
    },
    /// A name in the configuration has characters or a length that file names cannot have.
    #[error(
        "{what} \"{name}\": only letters, digits, '-' and '_' are allowed, 1 to {longest} of them"
    )]
    Name {
        /// What it names.
        what: &'static str,
        /// The name.
        name: String,
        /// The longest possible.
        longest: usize,
    },
    /// The service exists with another version of the record or other properties.
    #[error(
        "{service}: another version of glidepath serves it (expected {record}, {detail}); run all \
         processes of an instance from the same build, or end the others"
    )]
    VersionMismatch {
        /// The service.
        service: &'static str,
        /// The record expected here.
        record: &'static str,
        /// What the transport found.
        detail: BoxedError,
    },
    /// All places at the service are taken.
    #[error("{service}: no place for another {role}; end the one that runs{}", process_text(.holder))]
    Taken {
        /// The service.
        service: &'static str,
        /// What wanted to connect.
        role: &'static str,
        /// The process that has the place, where there is one place and that is known.
        holder: Option<i32>,
    },
    /// There is nobody at the other end.
    #[error("{}", nobody(.service))]
    NoServer {
        /// The service.
        service: &'static str,
    },
    /// Too many requests without an answer; take the replies first.
    #[error("{service}: too many requests without an answer")]
    TooManyRequests {
        /// The service.
        service: &'static str,
    },
    /// What arrived is not to be used.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Anything else the transport reports.
    #[error("{service}: {action} failed: {detail}")]
    Transport {
        /// The service, or the instance as a whole.
        service: &'static str,
        /// What was tried.
        action: &'static str,
        /// What the transport says.
        detail: BoxedError,
    },
}

fn needed(bytes: u64) -> String {
    match bytes {
        0 => String::new(),
        bytes => format!(" for {bytes} bytes"),
    }
}

fn remedy(error: &io::Error) -> &'static str {
    use rustix::io::Errno;
    match Errno::from_io_error(error) {
        Some(Errno::MFILE) => "; raise the limit of open files (ulimit -n, LimitNOFILE=)",
        Some(Errno::NFILE) => "; all files of the system are open: end what opened so many",
        _ => "",
    }
}

impl LinkError {
    /// Why a file of so many bytes (0 where it is there already) cannot be had.
    pub(crate) fn no_file(path: &Path, bytes: u64, source: io::Error) -> Self {
        use io::ErrorKind::{OutOfMemory, QuotaExceeded, StorageFull};
        match source.kind() {
            StorageFull | QuotaExceeded | OutOfMemory => Self::no_room(path, bytes),
            _ => Self::File {
                path: path.display().to_string(),
                source,
            },
        }
    }

    /// No room for a file of so many bytes.
    pub(crate) fn no_room(path: &Path, bytes: u64) -> Self {
        Self::NoRoom {
            path: path.display().to_string(),
            bytes,
        }
    }

    /// The same, with the process that has the place.
    pub(crate) fn held_by(self, process: Option<i32>) -> Self {
        match self {
            Self::Taken { service, role, .. } => Self::Taken {
                service,
                role,
                holder: process,
            },
            error => error,
        }
    }

    /// Why a port could not be made: no place is left at the service, or something else.
    pub(crate) fn no_port(
        service: &'static str,
        role: &'static str,
        is_full: bool,
        detail: impl Into<BoxedError>,
    ) -> Self {
        if is_full {
            Self::Taken {
                service,
                role,
                holder: None,
            }
        } else {
            Self::Transport {
                service,
                action: "making a port",
                detail: detail.into(),
            }
        }
    }
}

fn process_text(process: &Option<i32>) -> String {
    process.map_or_else(String::new, |process| format!(" (process {process})"))
}

/// Who should serve a service and does not.
fn nobody(service: &str) -> &'static str {
    if matches!(service, SEGMENTS | JOBS | LINES) {
        "no planner listens; start `glidepath planner --listen` first"
    } else {
        "no interpolator runs; start `glidepath interpolator` first"
    }
}
