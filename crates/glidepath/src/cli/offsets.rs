//! Arguments of `offsets`.

use super::basic::{BasicArgs, InstanceArgs};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

/// What is done with what a machine keeps over a restart.
#[derive(Debug, Subcommand)]
pub enum OffsetsCommand {
    /// Show everything that is kept
    #[command(after_help = "Example: glidepath offsets show --config mill.toml")]
    Show(ShowArgs),
    /// Set a coordinate system, the position of G28 or G30, or the kept offset of G92
    #[command(
        after_help = "Examples: glidepath offsets set G55 X120 Y-35.5 R2 --config mill.toml · \
                            glidepath offsets set G30 Z-1 --config mill.toml"
    )]
    Set(SetArgs),
    /// Choose the coordinate system in which programs start
    #[command(after_help = "Example: glidepath offsets use G55 --config mill.toml")]
    Use(UseArgs),
    /// Import coordinates from LinuxCNC's parameter file (.var)
    #[command(
        after_help = "Example: glidepath offsets import linuxcnc.var --linear-units inch --config mill.toml"
    )]
    Import(ImportArgs),
    /// Print coordinates in the format of LinuxCNC's parameter file
    #[command(
        after_help = "Example: glidepath offsets export --linear-units mm --config mill.toml > linuxcnc.var"
    )]
    Export(ExportArgs),
    /// Use the kept state of a machine with other axes or kinematics for this machine
    #[command(after_help = "Example: glidepath offsets adopt --config mill.toml")]
    Adopt(ShowArgs),
    /// After a file was damaged: use the newest intact generation
    #[command(after_help = "Example: glidepath offsets recover --config mill.toml")]
    Recover(ShowArgs),
}

impl OffsetsCommand {
    /// What every command is told.
    #[must_use]
    pub const fn basic(&self) -> &BasicArgs {
        match self {
            Self::Show(args) | Self::Adopt(args) | Self::Recover(args) => &args.basic,
            Self::Set(args) => &args.basic,
            Self::Use(args) => &args.basic,
            Self::Import(args) => &args.basic,
            Self::Export(args) => &args.basic,
        }
    }

    /// The machine.
    #[must_use]
    pub const fn instance(&self) -> &InstanceArgs {
        match self {
            Self::Show(args) | Self::Adopt(args) | Self::Recover(args) => &args.instance,
            Self::Set(args) => &args.instance,
            Self::Use(args) => &args.instance,
            Self::Import(args) => &args.instance,
            Self::Export(args) => &args.instance,
        }
    }
}

/// Arguments of `offsets show` and the like.
#[derive(Debug, Args)]
pub struct ShowArgs {
    /// The machine that commands in messages are for.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `offsets set`.
#[derive(Debug, Args)]
pub struct SetArgs {
    /// G54 … G59, G59.1, G59.2, G59.3, G28, G30 or G92
    pub what: String,
    /// Axes with their machine coordinates in mm and degrees, such as X12.5; R: the rotation of a
    /// coordinate system, degrees
    #[arg(required = true, value_name = "WORD")]
    pub words: Vec<String>,
    /// The machine that commands in messages are for.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `offsets use`.
#[derive(Debug, Args)]
pub struct UseArgs {
    /// G54 … G59, G59.1, G59.2 or G59.3
    pub system: String,
    /// The machine that commands in messages are for.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// The units of LinuxCNC's machine: its `[TRAJ] LINEAR_UNITS`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LinearUnits {
    /// Millimetres
    Mm,
    /// Inches
    Inch,
}

/// The units of LinuxCNC's machine: its `[TRAJ] ANGULAR_UNITS`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AngularUnits {
    /// Degrees
    Degree,
    /// Radians
    Radian,
    /// Gradians: 400 in a turn
    Grad,
}

/// The units of a parameter file.
#[derive(Debug, Clone, Copy, Args)]
pub struct UnitArgs {
    /// `LINEAR_UNITS` of `[TRAJ]` in LinuxCNC's machine configuration
    #[arg(long, value_enum, value_name = "UNITS")]
    pub linear_units: LinearUnits,
    /// `ANGULAR_UNITS` of `[TRAJ]`
    #[arg(long, value_enum, value_name = "UNITS", default_value = "degree")]
    pub angular_units: AngularUnits,
}

/// Arguments of `offsets import`.
#[derive(Debug, Args)]
pub struct ImportArgs {
    /// LinuxCNC's parameter file
    pub file: PathBuf,
    /// Its units.
    #[command(flatten)]
    pub units: UnitArgs,
    /// The machine that commands in messages are for.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `offsets export`.
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// Its units.
    #[command(flatten)]
    pub units: UnitArgs,
    /// The machine that commands in messages are for.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}
