//! Arguments of `setup`.

use clap::Args;
use std::path::PathBuf;

/// Arguments of `setup`.
#[derive(Debug, Args)]
pub struct SetupArgs {
    /// The configuration to write; a file that is there is never overwritten
    #[arg(default_value = "machine.toml", value_name = "TOML")]
    pub file: PathBuf,
    /// Take the suggested answer to every question
    #[arg(long)]
    pub suggested: bool,
}
