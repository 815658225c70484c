//! The error type of the mirror: why its services cannot be made or used.

use crate::{BoxedError, LinkError};
use std::path::PathBuf;

/// The reason why there is no mirror, or none any more.
#[derive(Debug, thiserror::Error)]
pub enum MirrorError {
    /// The directory cannot be the root of a domain.
    #[error("{}: cannot be iceoryx2's root: {reason}", .path.display())]
    Root {
        /// The directory.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// iceoryx2 has no place for another process.
    #[error("iceoryx2 cannot be used ({detail}); {obstacle}")]
    Domain {
        /// What iceoryx2 says.
        detail: BoxedError,
        /// What is in its way.
        obstacle: String,
    },
    /// iceoryx2 does not come back.
    #[error("iceoryx2 has not answered in {waited_s} s; {obstacle}")]
    Hangs {
        /// How long it was waited for, s.
        waited_s: u64,
        /// What is in its way.
        obstacle: String,
    },
    /// The service is there already, and is another.
    #[error(
        "{service}: another program made this service, and not as the mirror does ({detail}); end that \
         program, and let readers open the service instead of creating it"
    )]
    Other {
        /// The service.
        service: String,
        /// What iceoryx2 says.
        detail: BoxedError,
    },
    /// Somebody publishes there.
    #[error(
        "{service}: a program publishes there already, another mirror of this instance or one that \
         forges it; end it"
    )]
    Taken {
        /// The service.
        service: String,
    },
    /// The service cannot be made or opened.
    #[error("{service}: {action} failed: {detail}; {obstacle}")]
    Service {
        /// The service.
        service: String,
        /// What was tried.
        action: &'static str,
        /// What iceoryx2 says.
        detail: BoxedError,
        /// What is in its way.
        obstacle: String,
    },
    /// There is no room for the memory of the services.
    #[error(
        "{}: its memory cannot be taken ({source}); `df -h /dev/shm` shows how much is free: {} needed in all, and some \
         kilobytes for each reader", .path.display(), needed(*.bytes)
    )]
    Memory {
        /// The file.
        path: PathBuf,
        /// How long all files are together, bytes; 0 if that is not known.
        bytes: u64,
        /// Why not.
        source: std::io::Error,
    },
    /// A record cannot be published.
    #[error("{service}: publishing failed: {detail}")]
    Publish {
        /// The service.
        service: String,
        /// What iceoryx2 says.
        detail: BoxedError,
    },
    /// The instance cannot be heard.
    #[error(transparent)]
    Link(LinkError),
}

#[allow(clippy::cast_precision_loss, reason = "for a message")]
fn needed(bytes: u64) -> String {
    match bytes {
        0 => "it is not known how much is".to_owned(),
        _ => format!("{:.1} MB are", bytes as f64 * 1e-6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_much_memory_is_needed_is_told_as_it_was_measured() {
        let told = |bytes| {
            let source = std::io::Error::from(std::io::ErrorKind::StorageFull);
            let path = PathBuf::from("/dev/shm/iox2_a.data");
            let error = MirrorError::Memory {
                path,
                bytes,
                source,
            };
            error.to_string()
        };
        assert!(told(31_460_000).contains("31.5 MB are needed in all"));
        assert!(told(0).contains("it is not known how much is needed in all"));
    }
}
