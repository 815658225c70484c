//! Arguments of `ethercat`.

use super::basic::{BasicArgs, InstanceArgs};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Arguments of `ethercat`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct EthercatArgs {
    /// Something else than driving.
    #[command(subcommand)]
    pub action: Option<EthercatAction>,
    /// File with the devices on the bus, and the joint that each drive moves
    #[arg(long, value_name = "TOML", required_unless_present = "emulated")]
    pub drives: Option<PathBuf>,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
    /// Run even without real-time privileges
    #[arg(long)]
    pub best_effort: bool,
    /// CPU to which the thread of the bus is pinned
    #[arg(long, value_name = "N")]
    pub cpu: Option<usize>,
    /// SCHED_FIFO priority of the thread of the bus, 1 to 99
    #[arg(long, value_name = "N", default_value_t = 70,
          value_parser = clap::value_parser!(u8).range(1..=99))]
    pub priority: u8,
    /// Use emulated drives, over a pair of virtual interfaces in a network namespace of their own.
    /// Without --drives there are three drives, or as many as the machine has joints
    #[arg(long)]
    pub emulated: bool,
    /// Period of the bus of the emulated drives, µs
    #[arg(long, value_name = "N", default_value_t = 2000, requires = "emulated",
          value_parser = clap::value_parser!(u32).range(250..=20_000))]
    pub emulated_period_us: u32,
    /// Write what the emulated drives recorded at every SYNC0 as CSV
    #[arg(long, value_name = "CSV", requires = "emulated")]
    pub emulated_record: Option<PathBuf>,
    /// What stands at the inputs of the emulated devices: a file with lines like `input 3 on`, `home 0 on`,
    /// `limit_low 1 off`, `limit_high 1 off`, `analog 0 2.5` and `input 0 at J2 -7.25` (on where J2 is there or
    /// beyond), looked at while they run. Without --drives there is a device that has inputs of every kind
    #[arg(long, value_name = "FILE", requires = "emulated")]
    pub emulated_inputs: Option<PathBuf>,
    /// It is in its namespace already
    #[arg(long, hide = true)]
    pub in_namespace: bool,
    /// End when the process with this number, which started this one, ends
    #[arg(long, hide = true, value_name = "PID")]
    pub end_with: Option<u32>,
}

/// What else `ethercat` does.
#[derive(Debug, Subcommand)]
pub enum EthercatAction {
    /// List the devices on the bus, as a first drives.toml; nothing moves
    #[command(after_help = "Example: glidepath ethercat scan enp3s0 > drives.toml")]
    Scan(ScanArgs),
}

/// Arguments of `ethercat scan`.
#[derive(Debug, Args)]
pub struct ScanArgs {
    /// The network interface
    pub interface: String,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}
