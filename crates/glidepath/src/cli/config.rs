//! Arguments of `config`.

use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Arguments of `config`.
#[derive(Debug, Args)]
#[command(
    arg_required_else_help = true,
    subcommand_negates_reqs = true,
    args_conflicts_with_subcommands = true
)]
pub struct ConfigArgs {
    /// What to do.
    #[command(flatten)]
    pub action: ConfigAction,
    /// Print one JSON object instead of text
    #[arg(long, global = true)]
    pub json: bool,
    /// The configuration of another control to convert.
    #[command(subcommand)]
    pub from: Option<ConfigSource>,
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
    /// List all errors in a configuration
    #[arg(long, value_name = "FILE")]
    pub check: Option<PathBuf>,
}

/// The control whose configuration is converted.
#[derive(Debug, Subcommand)]
pub enum ConfigSource {
    /// Convert LinuxCNC's machine configuration
    #[command(after_help = "Example: glidepath config from-linuxcnc machine.ini > machine.toml")]
    FromLinuxcnc(ConvertArgs),
    /// Convert grbl's or grblHAL's settings, as `$$` and `$#` print them
    #[command(after_help = "Example: glidepath config from-grbl settings.txt > machine.toml")]
    FromGrbl(ConvertArgs),
    /// Convert Klipper's printer.cfg
    #[command(after_help = "Example: glidepath config from-klipper printer.cfg > machine.toml")]
    FromKlipper(ConvertArgs),
}

/// Arguments of a conversion.
#[derive(Debug, Args)]
pub struct ConvertArgs {
    /// The file to convert
    pub file: PathBuf,
}
