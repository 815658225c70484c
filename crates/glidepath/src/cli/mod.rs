//! The command line.

mod basic;
mod calibrate;
mod command;
mod config;
mod curves;
mod ethercat;
mod grbl;
mod groups;
mod host;
mod jog;
mod live;
mod mirror;
mod motion;
mod offsets;
mod operator;
mod path;
mod program;
mod record;
mod setup;
mod telemetry;
mod time;

pub use basic::{BasicArgs, InstanceArgs, OverwriteArgs, RunInstanceArgs};
pub use calibrate::CalibrateArgs;
pub use command::CliCommand;
pub use config::{
    ConfigAction, ConfigArgs, ConfigSource, ConvertArgs, ScrewArgs, ScrewUnit, Values,
};
pub use curves::{FitArgs, FitMethod, PreviewArgs, PreviewMethod};
pub use ethercat::{EthercatAction, EthercatArgs, ScanArgs};
pub use grbl::GrblArgs;
pub use groups::grouped;
pub use host::{BenchArgs, DoctorArgs, JitterArgs};
pub use jog::{JogArgs, JogStep};
pub use live::{DevicesAction, DevicesArgs, LiveAction, LiveArgs, May, RevokeArgs};
pub use mirror::MirrorArgs;
pub use motion::{
    CheckArgs, FeedArgs, HalArgs, InterpolatorArgs, PlanArgs, PlannerArgs, RunArgs, RunDrives,
    ServoArgs,
};
pub use offsets::{
    AngularUnits, ExportArgs, ImportArgs, LinearUnits, OffsetsCommand, SetArgs, ShowArgs, UnitArgs,
    UseArgs,
};
pub use operator::{
    AbortArgs, AcknowledgeArgs, HomeArgs, JointsArgs, MdiArgs, OperatorArgs, OverrideArgs,
    RunFileArgs, SetPositionArgs, SingleBlockArgs, StatusArgs, Switch,
};
pub use path::PathArgs;
pub use program::ProgramArgs;
pub use record::{AuditArgs, RecordArgs, ReplayArgs};
pub use setup::SetupArgs;
pub use telemetry::TelemetryArgs;

use clap::Parser;

/// Plans G-code under velocity, acceleration and jerk limits, and plays it in hard real time.
#[derive(Debug, Parser)]
#[command(name = "glidepath", version, arg_required_else_help = true, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: CliCommand,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 program rejected, 2 usage, 3 configuration, \
                          4 not real-time capable, 5 fault while running, \
                          6 program not checked to its end, 7 jog cut short by the end of travel, \
                          8 a stop was accepted, but the machine still moves or has power, 130 interrupted.";
