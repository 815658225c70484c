//! Arguments of `config`.

use clap::{Args, Subcommand, ValueEnum};
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
    /// List all errors in a configuration, and in the files and folders that it names
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
    /// Make the compensation of a joint from a measured screw: LinuxCNC's COMP_FILE, or columns of a laser or gauge
    #[command(
        after_help = "Examples: glidepath config from-screw x.comp --joint J0 --values measured · \
                            glidepath config from-screw laser.csv --joint J2 --values errors --unit inch"
    )]
    FromScrew(ScrewArgs),
}

/// Arguments of the conversion of a screw.
#[derive(Debug, Args)]
pub struct ScrewArgs {
    /// The file: position, value on the way up, and perhaps the value on the way down in each line
    pub file: PathBuf,
    /// The joint, J0 to J8
    #[arg(long, value_parser = joint)]
    pub joint: usize,
    /// What the values are
    #[arg(long, value_enum)]
    pub values: Values,
    /// Unit of the file; degrees are mm
    #[arg(long, value_enum, default_value = "mm")]
    pub unit: ScrewUnit,
}

/// What the columns of a screw are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Values {
    /// Where the carriage was (LinuxCNC's COMP_FILE_TYPE = 0)
    Measured,
    /// How far beyond its position it was
    Errors,
    /// What is to be added to the position (LinuxCNC's COMP_FILE_TYPE = 1)
    Trims,
}

/// The unit of a screw's file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ScrewUnit {
    /// Millimetres, or degrees
    Mm,
    /// Inches
    Inch,
}

/// The number of a joint.
fn joint(text: &str) -> Result<usize, String> {
    let number = text
        .strip_prefix('J')
        .and_then(|number| number.parse().ok());
    number
        .filter(|joint| *joint < glidepath_kinematics::JOINTS)
        .ok_or_else(|| "the joints are J0 to J8".to_owned())
}

/// Arguments of a conversion.
#[derive(Debug, Args)]
pub struct ConvertArgs {
    /// The file to convert
    pub file: PathBuf,
}
