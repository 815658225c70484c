//! The command line.

mod curves;
mod operator;

pub use curves::{FitArgs, FitMethod, PreviewArgs, PreviewMethod};
pub use operator::{OperatorArgs, OverrideArgs, SingleBlockArgs, Switch};

use crate::config::{INSTANCE_RULE, is_instance_name};
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

mod program;

pub use program::ProgramArgs;

/// Plans G-code under velocity, acceleration and jerk limits, and plays it in hard real time.
#[derive(Debug, Parser)]
#[command(name = "glidepath", version, arg_required_else_help = true, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 program rejected, 2 usage, 3 configuration, \
                          4 not real-time capable, 5 fault while running, 130 interrupted.";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Plan a program, play it with a mock servo, and report
    #[command(after_help = "Example: glidepath run part.ngc --best-effort --plot part.svg")]
    Run(RunArgs),
    /// Compute the same motion without waiting for the clock
    #[command(after_help = "Example: glidepath plan part.ngc --setpoints part.csv --plot part.svg")]
    Plan(PlanArgs),
    /// List everything wrong with programs; no motion
    #[command(after_help = "Example: glidepath check part.ngc relief.ngc --json")]
    Check(CheckArgs),
    /// The real-time process: frames in, setpoints out
    #[command(after_help = "Example: glidepath interpolator --config mill.toml --instance mill-1")]
    Interpolator(InterpolatorArgs),
    /// The planner process: a program, standard input, or segments of other processes to frames
    #[command(
        after_help = "Examples: glidepath planner part.ngc · glidepath planner - < part.ngc · \
                            glidepath planner --listen · glidepath planner part.ngc --resume"
    )]
    Planner(PlannerArgs),
    /// A mock servo: receives setpoints and reports what it saw
    #[command(after_help = "Example: glidepath servo --setpoints received.csv")]
    Servo(ServoArgs),
    /// Stream a program's segments to a listening planner, as another program would
    #[command(after_help = "Example: glidepath feed part.ngc --instance mill-1")]
    Feed(FeedArgs),
    /// Show the state of a running interpolator
    #[command(after_help = "Example: glidepath status --json")]
    Status(OperatorArgs),
    /// Feed hold: come to rest on the path
    #[command(after_help = "Example: glidepath hold")]
    Hold(OperatorArgs),
    /// Go on after a hold, a program stop or the end of a block
    #[command(after_help = "Example: glidepath resume")]
    Resume(OperatorArgs),
    /// Go on to the end of the block, and rest there
    #[command(after_help = "Example: glidepath stop-at-block-end && glidepath step")]
    Step(OperatorArgs),
    /// Come to rest at the end of the present block, or of the first at which that is possible
    #[command(after_help = "Example: glidepath stop-at-block-end")]
    StopAtBlockEnd(OperatorArgs),
    /// Rest at the end of every block, or do so no longer; `resume` or `step` goes on
    #[command(after_help = "Example: glidepath single-block on")]
    SingleBlock(SingleBlockArgs),
    /// Set the override of the feed, or of rapids
    #[command(after_help = "Examples: glidepath override 80 · glidepath override --rapid 25")]
    Override(OverrideArgs),
    /// Come to rest on the path and drop the rest of the program
    #[command(after_help = "Example: glidepath abort")]
    Abort(OperatorArgs),
    /// Find where a NURBS is too sharp for its feedrate
    #[command(
        after_help = "Example: glidepath preview butterfly.json --method certified --feed 6000 \
                            --period-us 1000 --chord-error 0.001 --json"
    )]
    Preview(PreviewArgs),
    /// Plan the benchmark programs, and compare with what is known of them
    #[command(after_help = "Example: glidepath bench tests/data/bench --config-dir config --json")]
    Bench(BenchArgs),
    /// Fit NURBS to the dense runs of short lines of a program
    #[command(
        after_help = "Examples: glidepath fit part.ngc --tolerance 0.01 --output smooth.ngc · \
                            glidepath fit part.ngc --tolerance 0.01 --method hybrid --seed 7 --json"
    )]
    Fit(FitArgs),
    /// Is this host fit for real time? With the fix for each no
    #[command(after_help = "Example: glidepath doctor --config mill.toml")]
    Doctor(DoctorArgs),
    /// Measure how late the real-time loop wakes on this host
    #[command(
        after_help = "Example: glidepath jitter --seconds 60 --full-tick --against-cyclictest \
                            --plot jitter.svg"
    )]
    Jitter(JitterArgs),
}

/// Configuration and form of the report: the same for every command.
#[derive(Debug, Clone, Args)]
pub struct BasicArgs {
    /// Machine configuration (TOML); without it the built-in 3-axis mill
    #[arg(long, short, value_name = "TOML")]
    pub config: Option<PathBuf>,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

/// Which shared memory.
#[derive(Debug, Clone, Args)]
pub struct InstanceArgs {
    /// Name of the machine's shared memory; overrides `link.instance` of the configuration
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

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The G-code program
    pub file: PathBuf,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Which shared memory.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Run without real-time privileges too; the report says what was granted
    #[arg(long)]
    pub best_effort: bool,
    /// Write the setpoints the mock servo received as CSV
    #[arg(long, value_name = "CSV")]
    pub setpoints: Option<PathBuf>,
    /// Write a plot of the motion (SVG); without it the plot goes to the temporary folder
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
}

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct PlanArgs {
    /// The G-code program
    pub file: PathBuf,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Write every setpoint as CSV
    #[arg(long, value_name = "CSV")]
    pub setpoints: Option<PathBuf>,
    /// Write a plot of the motion (SVG)
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
}

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The G-code programs
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `interpolator`.
#[derive(Debug, Args)]
pub struct InterpolatorArgs {
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Which shared memory.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Move without real-time privileges too
    #[arg(long)]
    pub best_effort: bool,
    /// End when the process with this number, which started this one, ends
    #[arg(long, hide = true, value_name = "PID")]
    pub end_with: Option<u32>,
}

/// Arguments of `planner`.
#[derive(Debug, Args)]
pub struct PlannerArgs {
    /// The G-code program, or `-` for standard input
    #[arg(required_unless_present = "listen", conflicts_with = "listen")]
    pub file: Option<PathBuf>,
    /// Take segments from other processes instead of a program
    #[arg(long)]
    pub listen: bool,
    /// Go on with the program from where the machine stands on its path
    ///
    /// For a program whose planner died, or that was aborted. Motion starts at once. Refused if the
    /// machine does not stand on the path, or the text is not that of the program that was under way.
    #[arg(long, conflicts_with = "listen")]
    pub resume: bool,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Which shared memory.
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
    /// Which shared memory.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Write the setpoints received as CSV
    #[arg(long, value_name = "CSV")]
    pub setpoints: Option<PathBuf>,
    /// Write every record received to standard output, for the process that started this one
    #[arg(long, hide = true, conflicts_with_all = ["setpoints", "json"])]
    pub relay: bool,
    /// End when the process with this number, which started this one, ends
    #[arg(long, hide = true, value_name = "PID")]
    pub end_with: Option<u32>,
}

/// Arguments of `feed`.
#[derive(Debug, Args)]
pub struct FeedArgs {
    /// The G-code program
    pub file: PathBuf,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Which shared memory.
    #[command(flatten)]
    pub instance: InstanceArgs,
}

/// Arguments of `bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Folder with the programs and bench.json, the catalogue of them
    #[arg(default_value = "tests/data/bench")]
    pub folder: PathBuf,
    /// Folder with the configuration of each machine that the catalogue names, such as mill.toml;
    /// without it the built-in ones
    #[arg(long, value_name = "FOLDER", conflicts_with = "config")]
    pub config_dir: Option<PathBuf>,
    /// Configuration and form of the report. A configuration given holds for all programs.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `doctor`.
#[derive(Debug, Args)]
pub struct DoctorArgs {
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `jitter`. What is not given is taken from the configuration.
#[derive(Debug, Args)]
pub struct JitterArgs {
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Period of the loop, µs
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(50..=1_000_000))]
    pub period_us: Option<u32>,
    /// How long to measure, s
    #[arg(long, value_name = "S", default_value_t = 10,
          value_parser = clap::value_parser!(u32).range(1..=604_800))]
    pub seconds: u32,
    /// CPU the loop is pinned to
    #[arg(long, value_name = "N")]
    pub cpu: Option<usize>,
    /// SCHED_FIFO priority, 1 to 99
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=99))]
    pub priority: Option<u8>,
    /// Do the interpolator's work in every period, on a synthetic motion
    #[arg(long)]
    pub full_tick: bool,
    /// Run cyclictest in the same time on the same CPU, half a period apart, and compare
    #[arg(long)]
    pub against_cyclictest: bool,
    /// Write a plot of the latency (SVG)
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
}

impl Command {
    /// What every command is told.
    #[must_use]
    pub const fn basic(&self) -> &BasicArgs {
        match self {
            Self::Run(args) => &args.basic,
            Self::Plan(args) => &args.basic,
            Self::Check(args) => &args.basic,
            Self::Interpolator(args) => &args.basic,
            Self::Planner(args) => &args.basic,
            Self::Servo(args) => &args.basic,
            Self::Feed(args) => &args.basic,
            Self::Status(args)
            | Self::Hold(args)
            | Self::Resume(args)
            | Self::Step(args)
            | Self::StopAtBlockEnd(args)
            | Self::Abort(args) => &args.basic,
            Self::SingleBlock(args) => &args.operator.basic,
            Self::Override(args) => &args.operator.basic,
            Self::Fit(args) => &args.basic,
            Self::Preview(args) => &args.basic,
            Self::Bench(args) => &args.basic,
            Self::Doctor(args) => &args.basic,
            Self::Jitter(args) => &args.basic,
        }
    }
}
