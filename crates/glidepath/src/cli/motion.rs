//! Arguments of the commands that check, plan and run programs, and of the processes by themselves.

use super::basic::{BasicArgs, InstanceArgs, OverwriteArgs, RunInstanceArgs};
use super::path::PathArgs;
use super::program::{ProgramArgs, program_file};
use super::time::time;
use crate::program_file::ProgramFile;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

/// What `run` moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RunDrives {
    /// A mock servo.
    Mock,
    /// Emulated drives on EtherCAT.
    Emulated,
}

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The G-code program; `-` is standard input
    #[arg(value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: ProgramFile,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// How the path is followed.
    #[command(flatten)]
    pub path: PathArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: RunInstanceArgs,
    /// Run even without real-time privileges; the report says what was granted
    #[arg(long)]
    pub best_effort: bool,
    /// What is moved: "mock", a servo that moves exactly as commanded, or "emulated", emulated
    /// drives on EtherCAT, with the same bridge as real ones
    #[arg(long, value_name = "DRIVES", default_value = "mock")]
    pub drives: RunDrives,
    /// Period of the bus of the emulated drives, µs
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(250..=20_000))]
    pub bus_period_us: u32,
    /// Write what the emulated drives recorded at every SYNC0 as CSV
    #[arg(long, value_name = "CSV")]
    pub drives_record: Option<PathBuf>,
    /// Write the setpoints that the mock servo received as CSV
    #[arg(long, value_name = "CSV")]
    pub setpoints: Option<PathBuf>,
    /// Write a plot of the motion: NAME.svg, or an interactive page, NAME.html. Without this option
    /// the plot goes to NAME.svg in the present folder, if no other file has that name
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
    /// Which files may be overwritten.
    #[command(flatten)]
    pub overwrite: OverwriteArgs,
}

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct PlanArgs {
    /// The G-code program; `-` is standard input
    #[arg(value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: ProgramFile,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// How the path is followed.
    #[command(flatten)]
    pub path: PathArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance whose service would execute it.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Write every setpoint as CSV
    #[arg(long, value_name = "CSV")]
    pub setpoints: Option<PathBuf>,
    /// Write a plot of the motion: NAME.svg, or an interactive page, NAME.html
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
    /// Refuse programs whose feeds and dwells take longer than this, such as 90s, 10min, 8h or 30d
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "7d")]
    pub longest: Duration,
    /// Which files may be overwritten.
    #[command(flatten)]
    pub overwrite: OverwriteArgs,
}

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The G-code programs; `-` is standard input
    #[arg(required = true, value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub files: Vec<ProgramFile>,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance whose service would execute it.
    #[command(flatten)]
    pub instance: InstanceArgs,
}

/// Arguments of `interpolator`.
#[derive(Debug, Args)]
pub struct InterpolatorArgs {
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Run even without real-time privileges
    #[arg(long)]
    pub best_effort: bool,
    /// Expect drives to answer, whatever the configuration says
    #[arg(long, hide = true)]
    pub expect_drives: bool,
    /// End when the process with this number, which started this one, ends
    #[arg(long, hide = true, value_name = "PID")]
    pub end_with: Option<u32>,
}

/// Arguments of `planner`.
#[derive(Debug, Args)]
pub struct PlannerArgs {
    /// The G-code program, or `-` for standard input
    #[arg(required_unless_present = "listen", conflicts_with = "listen", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: Option<ProgramFile>,
    /// Run as the service of the machine: execute lines (`mdi`), programs (`run-file`) and segments
    /// of other processes (`feed`), one at a time
    #[arg(long)]
    pub listen: bool,
    /// Continue the program from where the machine stands on its path
    ///
    /// For a program that was aborted, or whose planner died. Motion starts at once. It is refused
    /// if the machine does not stand on the path, or if the text is not that of the program that
    /// was running.
    #[arg(long, conflicts_with = "listen")]
    pub resume: bool,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// How the path is followed.
    #[command(flatten)]
    pub path: PathArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// End when the process with this number, which started this one, ends
    #[arg(long, hide = true, value_name = "PID")]
    pub end_with: Option<u32>,
}

/// Arguments of `servo`.
#[derive(Debug, Args)]
pub struct ServoArgs {
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Write the setpoints received as CSV
    #[arg(long, value_name = "CSV")]
    pub setpoints: Option<PathBuf>,
    /// Let setpoints stay away for eight periods in place of three before the joints stop by themselves: for hosts
    /// without real time
    #[arg(long, conflicts_with = "hal")]
    pub best_effort: bool,
    /// Where the joints of the simulated machine are at the start, mm or degrees, such as
    /// 12.5,-3,40. Without it, they are where programs begin
    #[arg(
        long,
        value_name = "POSITIONS",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub stands: Vec<f64>,
    /// Simulate a probe that makes contact when a joint is at a position or below, such as J2=-10.
    /// The contact is input 0
    #[arg(long, value_name = "JOINT=POSITION", value_parser = touches_at)]
    pub probe: Option<(usize, f64)>,
    /// LinuxCNC's HAL as consumer.
    #[command(flatten)]
    pub hal: HalArgs,
    /// Which files may be overwritten.
    #[command(flatten)]
    pub overwrite: OverwriteArgs,
    /// Move nothing and send no feedback: another stack has the drives
    #[arg(long, hide = true)]
    pub listens: bool,
    /// Write every record received to standard output, for the process that started this one
    #[arg(long, hide = true, conflicts_with_all = ["setpoints", "json"])]
    pub relay: bool,
    /// End when the process with this number, which started this one, ends
    #[arg(long, hide = true, value_name = "PID")]
    pub end_with: Option<u32>,
}

/// How LinuxCNC's HAL takes the place of the machine that is not there.
#[derive(Debug, Args)]
pub struct HalArgs {
    /// Play on LinuxCNC's HAL: send lines to `streamer`, take feedback from `sampler`
    #[arg(long, conflicts_with_all = ["stands", "probe"])]
    pub hal: bool,
    /// Period of HAL's thread, µs
    #[arg(
        long,
        requires = "hal",
        value_name = "US",
        default_value_t = 1000,
        value_parser = clap::value_parser!(u32).range(50..=100_000)
    )]
    pub hal_period_us: u32,
    /// How many periods HAL lags behind the setpoints, and this process may be late
    #[arg(
        long,
        requires = "hal",
        value_name = "PERIODS",
        default_value_t = 8,
        value_parser = clap::value_parser!(u32).range(2..=256)
    )]
    pub hal_prefill: u32,
    /// How late setpoints may arrive, µs; HAL plays them later by that time. Without it, a period
    /// of the setpoints
    #[arg(
        long,
        requires = "hal",
        value_name = "US",
        value_parser = clap::value_parser!(u32).range(..=200_000)
    )]
    pub hal_wait_us: Option<u32>,
    /// The number of `streamer` and `sampler`
    #[arg(
        long,
        requires = "hal",
        value_name = "NUMBER",
        default_value_t = 0,
        value_parser = clap::value_parser!(u32).range(0..=7)
    )]
    pub hal_channel: u32,
}

/// Arguments of `feed`.
#[derive(Debug, Args)]
pub struct FeedArgs {
    /// The G-code program; `-` is standard input
    #[arg(value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: ProgramFile,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
}

/// A joint, and where the probe of an imitated machine touches.
fn touches_at(text: &str) -> Result<(usize, f64), &'static str> {
    let found = text.split_once('=').and_then(|(joint, position)| {
        let joint = joint.strip_prefix('J')?.parse().ok()?;
        let position: f64 = position.parse().ok()?;
        (joint < glidepath_geometry::AXES && position.is_finite()).then_some((joint, position))
    });
    found.ok_or("give a joint and a position, such as J2=-10")
}
