//! The settings of the transport for an instance.

use super::config::LinkConfig;
use crate::LinkError;
use core::time::Duration;
use iceoryx2::prelude::{Config, FileName, Path, SemanticString as _, SemanticStringError};

/// How long one side of a connection waits for the other to finish making it. Longer waits belong
/// to the retries of a session, which the ports' callers never pay.
const CREATION_TIMEOUT: Duration = Duration::from_millis(100);

/// What the names of the transport's files begin with; no two instances share a directory.
const PREFIX: &[u8] = b"gp_";

/// The settings of the transport for an instance; never those of the user or the machine.
pub(super) fn settings(config: &LinkConfig) -> Result<Config, LinkError> {
    let directory = config.directory();
    let failed = |error: SemanticStringError| LinkError::Transport {
        service: "instance",
        action: "naming its files",
        detail: error.to_string().into(),
    };
    let mut settings = Config::default();
    settings.global.prefix = FileName::new(PREFIX).map_err(failed)?;
    let root = Path::new(directory.as_os_str().as_encoded_bytes()).map_err(failed)?;
    settings.global.set_root_path(&root);
    settings.global.creation_timeout = CREATION_TIMEOUT;
    settings.global.node.cleanup_dead_nodes_on_creation = true;
    Ok(settings)
}
