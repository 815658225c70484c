//! Arguments of an operator's commands.

use super::basic::{BasicArgs, InstanceArgs};
use crate::config;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Arguments of the commands that talk to a running interpolator.
#[derive(Debug, Args)]
pub struct OperatorArgs {
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
}

/// Arguments of `status`.
#[derive(Debug, Args)]
pub struct StatusArgs {
    /// The running program, to show its lines, its progress and the time left
    #[arg(value_name = "PROGRAM", requires = "watch")]
    pub program: Option<PathBuf>,
    /// Repeat until Ctrl-C; with --json, print one object per line
    #[arg(long)]
    pub watch: bool,
    /// Time between two displays, s
    #[arg(long, value_name = "SECONDS", default_value_t = 0.25, value_parser = seconds, requires = "watch")]
    pub every: f64,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

fn seconds(text: &str) -> Result<f64, &'static str> {
    let number: f64 = text.parse().map_err(|_| "give a number")?;
    if (0.02..=3600.0).contains(&number) {
        Ok(number)
    } else {
        Err("give 0.02 to 3600")
    }
}

/// Arguments of `abort`.
#[derive(Debug, Args)]
pub struct AbortArgs {
    /// The last resort: end the interpolator by SIGTERM, which needs no shared memory
    #[arg(long)]
    pub signal: bool,
    /// Do not raise the tool axis by `jog.lift` of the configuration
    #[arg(long)]
    pub no_lift: bool,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

/// Arguments of `override`.
#[derive(Debug, Args)]
#[group(id = "factor", required = true, multiple = true)]
pub struct OverrideArgs {
    /// Percent of the programmed feedrate, up to 200; negative to go back along the path
    #[arg(value_parser = percent, group = "factor", allow_negative_numbers = true)]
    pub percent: Option<f64>,
    /// Percent of the speed of rapids, 0 to 100
    #[arg(long, value_name = "PERCENT", value_parser = rapid_percent, group = "factor")]
    pub rapid: Option<f64>,
    /// Percent of the speed of jogs, 0 to 100
    #[arg(long, value_name = "PERCENT", value_parser = rapid_percent, group = "factor")]
    pub jog: Option<f64>,
    /// Percent of the programmed speed of the spindle, within `override_min` and `override_max` of `[spindle]`
    #[arg(long, value_name = "PERCENT", value_parser = spindle_percent, group = "factor")]
    pub spindle: Option<f64>,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

/// Arguments of `acknowledge`.
#[derive(Debug, Args)]
pub struct AcknowledgeArgs {
    /// Report that the M code has failed, with the reason as a text
    #[arg(long, value_name = "TEXT")]
    pub fail: Option<String>,
    /// Answer only this event: EPOCH/SEQUENCE, from `awaited` of `status --json`
    #[arg(long, value_name = "EVENT", value_parser = event)]
    pub event: Option<(u64, u64)>,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

/// Arguments of `mdi`.
#[derive(Debug, Args)]
pub struct MdiArgs {
    /// The line, such as 'G0 X10 Y5'
    pub line: String,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
}

/// Arguments of `run-file`.
#[derive(Debug, Args)]
pub struct RunFileArgs {
    /// The G-code program, where the service can read it
    pub file: PathBuf,
    /// Start at this line, as if all lines before it had been executed
    ///
    /// First shows what differs from what the program expects there: position, tool, spindle,
    /// coolant, outputs. When you agree, the tool axis moves up, M codes set what differs, the
    /// other axes move there, and the tool axis moves down at the feed.
    #[arg(long, value_name = "LINE", value_parser = clap::value_parser!(u32).range(1..))]
    pub from_line: Option<u32>,
    /// Start at this pass, if the line is executed several times
    #[arg(long, value_name = "COUNT", default_value_t = 1, requires = "from_line",
          value_parser = clap::value_parser!(u32).range(1..))]
    pub pass: u32,
    /// Answer yes to the question
    #[arg(long, requires = "from_line")]
    pub yes: bool,
    /// Continue this program where it was left, after an abort or a fault
    #[arg(long, conflicts_with = "from_line")]
    pub resume: bool,
    /// Plan with so many times the tolerance of the configuration and of G64 P, .1 to 10
    ///
    /// `plan --tolerance` and the page tell what it saves. A run that is resumed keeps what it began with.
    #[arg(long, value_name = "RATIO", default_value_t = 1.0, conflicts_with = "resume",
          value_parser = config::tolerance_ratio)]
    pub tolerance_ratio: f64,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
}

/// On or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// On.
    On,
    /// Off.
    Off,
}

/// Arguments of `single-block`.
#[derive(Debug, Args)]
pub struct SingleBlockArgs {
    /// Whether to rest at the end of every block
    pub switch: Switch,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

/// Arguments of `home`.
#[derive(Debug, Args)]
pub struct HomeArgs {
    /// Return at once, without waiting until the joints are homed
    #[arg(long)]
    pub no_wait: bool,
    /// The joints.
    #[command(flatten)]
    pub joints: JointsArgs,
}

/// Arguments of `unhome`, and the joints of `home`.
#[derive(Debug, Args)]
pub struct JointsArgs {
    /// The joints, such as J0 J2; all if none is given
    #[arg(value_parser = joint)]
    pub joints: Vec<u32>,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

/// Arguments of `set-position`.
#[derive(Debug, Args)]
pub struct SetPositionArgs {
    /// The joint, such as J1
    #[arg(value_parser = joint)]
    pub joint: u32,
    /// The new value of its present position, mm or degrees
    #[arg(allow_hyphen_values = true, value_parser = position)]
    pub position: f64,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

fn event(text: &str) -> Result<(u64, u64), &'static str> {
    let parts = text.split_once('/');
    let numbers =
        parts.and_then(|(epoch, sequence)| Some((epoch.parse().ok()?, sequence.parse().ok()?)));
    numbers.ok_or("give an event, such as 3/812")
}

fn joint(text: &str) -> Result<u32, &'static str> {
    let number = text.strip_prefix(['J', 'j']).and_then(|n| n.parse().ok());
    number
        .filter(|joint| *joint < 9)
        .ok_or("give a joint, J0 to J8")
}

fn position(text: &str) -> Result<f64, &'static str> {
    let position = text
        .parse()
        .ok()
        .filter(|position: &f64| position.is_finite());
    position.ok_or("give a number")
}

fn percent(text: &str) -> Result<f64, &'static str> {
    percent_from(-200.0, 200.0, text).ok_or("give a number from -200 to 200")
}

fn rapid_percent(text: &str) -> Result<f64, &'static str> {
    percent_from(0.0, 100.0, text).ok_or("give a number from 0 to 100")
}

fn spindle_percent(text: &str) -> Result<f64, &'static str> {
    percent_from(0.0, 200.0, text).ok_or("give a number from 0 to 200")
}

fn percent_from(least: f64, most: f64, text: &str) -> Option<f64> {
    let percent = text.parse().ok()?;
    (least..=most).contains(&percent).then_some(percent)
}
