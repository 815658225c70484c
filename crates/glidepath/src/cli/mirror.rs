//! Arguments of `mirror`.

use super::basic::{BasicArgs, InstanceArgs};
use clap::Args;
use std::path::PathBuf;

/// Arguments of `mirror`.
#[derive(Debug, Args)]
pub struct MirrorArgs {
    /// Root of iceoryx2's domain, where readers find the services; without it that of iceoryx2's
    /// configuration on this host (/tmp/iceoryx2)
    #[arg(long, value_name = "DIRECTORY", value_hint = clap::ValueHint::DirPath)]
    pub root: Option<PathBuf>,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
}
