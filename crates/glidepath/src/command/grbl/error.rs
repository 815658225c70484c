//! The errors of the endpoint: why senders cannot be served.

use std::io;
use thiserror::Error;

/// Why senders cannot be served.
#[derive(Debug, Error)]
pub(in crate::command) enum EndpointError {
    /// The TCP port cannot be had.
    #[error("port {port} of 127.0.0.1 cannot be had: {cause}; give another one with --port")]
    Port {
        /// Which.
        port: u16,
        /// Why.
        cause: io::Error,
    },
    /// The pseudo-terminal, or the link to it, cannot be made.
    #[error(
        "no pseudo-terminal can be had at {link}: {cause}; name a place that is free, in a folder that \
         this user may write to"
    )]
    Terminal {
        /// The link.
        link: String,
        /// Why.
        cause: io::Error,
    },
    /// A thread cannot be started.
    #[error("no thread for a sender's commands: {0}")]
    Thread(#[source] io::Error),
}
