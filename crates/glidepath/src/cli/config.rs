//! Arguments of `config`.

use clap::Args;
use std::path::PathBuf;

/// Arguments of `config`.
#[derive(Debug, Args)]
#[command(arg_required_else_help = true)]
pub struct ConfigArgs {
    /// What to do.
    #[command(flatten)]
    pub action: ConfigAction,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

/// What is asked of the configuration.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct ConfigAction {
    /// Print the built-in machine as a configuration, with every key explained
    #[arg(long)]
    pub default: bool,
    /// Explain a key, all keys of a table, or every key: meaning, unit, range, default
    #[arg(long, value_name = "KEY", num_args = 0..=1)]
    #[allow(
        clippy::option_option,
        reason = "clap's form of an option with a value that may be left out"
    )]
    pub explain: Option<Option<String>>,
    /// List everything that has to be mended in a configuration
    #[arg(long, value_name = "FILE")]
    pub check: Option<PathBuf>,
}
