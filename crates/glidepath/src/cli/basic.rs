//! Arguments of many commands: the machine, the form of the report, the shared memory.

use super::program::program_file;
use crate::config::{INSTANCE_RULE, is_instance_name};
use crate::program_file::ProgramFile;
use clap::Args;

/// Configuration and form of the report: the same for every command.
#[derive(Debug, Clone, Args)]
pub struct BasicArgs {
    /// Machine configuration (TOML); without it the built-in 3-axis mill
    #[arg(long, short, env = "GLIDEPATH_CONFIG", hide_env_values = true, value_name = "TOML", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub config: Option<ProgramFile>,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

/// Which files may be overwritten.
#[derive(Debug, Clone, Copy, Args)]
pub struct OverwriteArgs {
    /// Overwrite files even of another kind than the one written, but never a file that the command
    /// reads
    #[arg(long)]
    pub force: bool,
}

/// The instance, by which processes find each other.
#[derive(Debug, Clone, Args)]
pub struct InstanceArgs {
    /// Name of the machine's shared memory; overrides `link.instance` of the configuration
    #[arg(long, env = "GLIDEPATH_INSTANCE", hide_env_values = true, value_name = "NAME", value_parser = instance_name)]
    pub instance: Option<String>,
}

/// The instance of a run, whose machine is a mock: that of the environment may be a machine's.
#[derive(Debug, Clone, Args)]
pub struct RunInstanceArgs {
    /// Name of the run's shared memory; overrides `link.instance` of the configuration
    #[arg(long, value_name = "NAME", value_parser = instance_name)]
    pub instance: Option<String>,
}

fn instance_name(name: &str) -> Result<String, &'static str> {
    if is_instance_name(name) {
        Ok(name.to_owned())
    } else {
        Err(INSTANCE_RULE)
    }
}
