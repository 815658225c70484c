//! The subcommands.

use super::basic::BasicArgs;
use super::calibrate::CalibrateArgs;
use super::config::ConfigArgs;
use super::curves::{FitArgs, PreviewArgs};
use super::ethercat::{EthercatAction, EthercatArgs};
use super::grbl::GrblArgs;
use super::host::{BenchArgs, DoctorArgs, JitterArgs};
use super::jog::JogArgs;
use super::live::LiveArgs;
use super::mirror::MirrorArgs;
use super::motion::{
    CheckArgs, FeedArgs, InterpolatorArgs, PlanArgs, PlannerArgs, RunArgs, ServoArgs,
};
use super::offsets::OffsetsCommand;
use super::operator::{
    AbortArgs, AcknowledgeArgs, HomeArgs, JointsArgs, MdiArgs, OperatorArgs, OverrideArgs,
    RunFileArgs, SetPositionArgs, SingleBlockArgs, StatusArgs,
};
use super::path::PathArgs;
use super::program::ProgramArgs;
use super::record::{AuditArgs, RecordArgs, ReplayArgs};
use super::setup::SetupArgs;
use super::telemetry::TelemetryArgs;
use crate::program_file::ProgramFile;
use clap::Subcommand;

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum CliCommand {
    /// Plan a program, play it with a mock servo, and report
    #[command(after_help = "Example: glidepath run part.ngc --best-effort --plot part.svg")]
    Run(RunArgs),
    /// Plan a program without waiting for the clock, and report
    #[command(
        after_help = "Example: glidepath plan part.ngc --setpoints part.csv --plot part.html"
    )]
    Plan(PlanArgs),
    /// List all errors in programs, without motion
    #[command(after_help = "Example: glidepath check part.ngc relief.ngc --json")]
    Check(CheckArgs),
    /// The real-time process: turns frames into setpoints
    #[command(after_help = "Example: glidepath interpolator --config mill.toml --instance mill-1")]
    Interpolator(InterpolatorArgs),
    /// The planner process: reads a program, standard input, or segments of other processes, and
    /// plans frames
    #[command(
        after_help = "Examples: glidepath planner part.ngc · glidepath planner - < part.ngc · \
                            glidepath planner --listen · glidepath planner part.ngc --resume"
    )]
    Planner(PlannerArgs),
    /// Run a program with the planner's service
    #[command(after_help = "Examples: glidepath run-file part.ngc · \
                            glidepath run-file part.ngc --from-line 120 --pass 2")]
    RunFile(RunFileArgs),
    /// Execute a line of G-code with the planner's service
    #[command(after_help = "Example: glidepath mdi 'G54 G0 X0 Y0'")]
    Mdi(MdiArgs),
    /// A servo: plays setpoints on a simulated machine, or on LinuxCNC's HAL
    #[command(after_help = "Example: glidepath servo --setpoints received.csv")]
    Servo(ServoArgs),
    /// The bridge to drives on EtherCAT: sends setpoints to them, and reports where the joints are
    #[command(
        after_help = "Examples: glidepath ethercat --drives drives.toml --config mill.toml · \
                            glidepath ethercat scan enp3s0 > drives.toml · \
                            glidepath ethercat --emulated --best-effort"
    )]
    Ethercat(EthercatArgs),
    /// Stream a program's segments to a listening planner, as another program would
    #[command(after_help = "Example: glidepath feed part.ngc --instance mill-1")]
    Feed(FeedArgs),
    /// Show the state of a running interpolator
    #[command(after_help = "Examples: glidepath status --json · glidepath status --watch part.ngc")]
    Status(StatusArgs),
    /// Show the machine in a browser of this host, and operate it there with `--may operate`
    #[command(
        after_help = "Examples: glidepath live · glidepath live --may operate --programs programs · \
                            glidepath live --may operate --devices 192.168.1.20:8443 --config mill.toml"
    )]
    Live(LiveArgs),
    /// Let senders of grbl (CNCjs, bCNC, gSender, UGS) drive the machine, by TCP or a pseudo-terminal
    #[command(
        after_help = "Examples: glidepath grbl · glidepath grbl --pty /run/user/1000/mill.grbl"
    )]
    Grbl(GrblArgs),
    /// Record every setpoint and status in a file that other tools can open (MCAP), or be a black
    /// box
    #[command(
        after_help = "Examples: glidepath record run.mcap --program part.ngc · \
                            glidepath record box.mcap --ring 10min"
    )]
    Record(RecordArgs),
    /// Play a recording into a servo stack, in place of an interpolator
    #[command(after_help = "Example: glidepath replay run.mcap --instance bench-1")]
    Replay(ReplayArgs),
    /// Check a recording or a CSV file of setpoints: limits, order, gaps, and the path against its
    /// program
    #[command(after_help = "Examples: glidepath audit run.mcap · \
                            glidepath audit received.csv --program part.ngc --config mill.toml")]
    Audit(AuditArgs),
    /// Report to an MQTT broker what the machine does
    #[command(
        after_help = "Example: glidepath telemetry --broker broker.shop:1883 --instance mill-1"
    )]
    Telemetry(TelemetryArgs),
    /// Publish setpoints and status as ordinary services of iceoryx2, for programs that look on
    #[command(after_help = "Example: glidepath mirror --instance mill-1")]
    Mirror(MirrorArgs),
    /// Feed hold: stop on the path; `resume` continues
    #[command(after_help = "Example: glidepath hold")]
    Hold(OperatorArgs),
    /// Continue after a hold, a program stop or the end of a block
    #[command(after_help = "Example: glidepath resume")]
    Resume(OperatorArgs),
    /// Continue to the end of the block, and rest there
    #[command(after_help = "Example: glidepath stop-at-block-end && glidepath step")]
    Step(OperatorArgs),
    /// Stop at the end of the present block, or of the first block where that is possible
    #[command(after_help = "Example: glidepath stop-at-block-end")]
    StopAtBlockEnd(OperatorArgs),
    /// Go back along the path: at most a minute, and not past what cannot be undone
    #[command(after_help = "Example: glidepath hold && glidepath reverse && glidepath resume")]
    Reverse(OperatorArgs),
    /// Go forward along the path again, after `reverse`
    #[command(after_help = "Example: glidepath forward")]
    Forward(OperatorArgs),
    /// Turn single block on or off: rest at the end of every block; `resume` or `step` continues
    #[command(after_help = "Example: glidepath single-block on")]
    SingleBlock(SingleBlockArgs),
    /// Set the override of the feed, of rapids, of jogs or of the spindle
    #[command(
        after_help = "Examples: glidepath override 80 · glidepath override -50 · \
                            glidepath override --rapid 25 · \
                            glidepath override --jog 10 · glidepath override --spindle 110"
    )]
    Override(OverrideArgs),
    /// Move axes by hand, by steps or by the keys of the terminal
    #[command(after_help = "Examples: glidepath jog X10 Y-2.5 --feed 600 · glidepath jog")]
    Jog(JogArgs),
    /// Return to the path after a jog in a hold
    #[command(after_help = "Example: glidepath return && glidepath resume")]
    Return(OperatorArgs),
    /// Answer an M code that waits: it is done, or has failed
    #[command(after_help = "Examples: glidepath acknowledge · \
                            glidepath acknowledge --fail \"no tool 7 in the magazine\"")]
    Acknowledge(AcknowledgeArgs),
    /// Stop on the path and drop the rest of the program
    #[command(after_help = "Examples: glidepath abort · glidepath abort --signal")]
    Abort(AbortArgs),
    /// Clear a fault, whatever its cause; the machine is then idle
    #[command(after_help = "Example: glidepath status && glidepath reset")]
    Reset(OperatorArgs),
    /// Give the drives power, and take the position over from them
    #[command(after_help = "Example: glidepath enable && glidepath home")]
    Enable(OperatorArgs),
    /// Stop on the path, drop the rest of the program, and remove the power from the drives
    #[command(after_help = "Example: glidepath disable")]
    Disable(OperatorArgs),
    /// Home joints, and wait until they are homed
    #[command(after_help = "Examples: glidepath home · glidepath home J2")]
    Home(HomeArgs),
    /// Mark joints as not homed
    #[command(after_help = "Example: glidepath unhome J2")]
    Unhome(JointsArgs),
    /// Set the present position of a joint to a new value
    #[command(after_help = "Example: glidepath set-position J1 200")]
    SetPosition(SetPositionArgs),
    /// Find where a NURBS is too sharp for its feedrate
    #[command(
        after_help = "Example: glidepath preview butterfly.json --method certified --feed 6000 \
                            --period-us 1000 --chord-error 0.001 --json"
    )]
    Preview(PreviewArgs),
    /// Plan the benchmark programs, and compare them with bounds and another control
    #[command(after_help = "Example: glidepath bench tests/data/bench --config-dir config --json")]
    Bench(BenchArgs),
    /// Fit NURBS to the dense runs of short lines of a program
    #[command(
        after_help = "Examples: glidepath fit part.ngc --tolerance 0.01 --output smooth.ngc · \
                            glidepath fit part.ngc --tolerance 0.01 --method hybrid --seed 7 --json"
    )]
    Fit(FitArgs),
    /// Show and change what the machine keeps over a restart: work offsets, G28, G30, G92, tools
    #[command(
        subcommand,
        after_help = "Example: glidepath offsets set G54 X100 Y50 Z-20 --config mill.toml"
    )]
    Offsets(OffsetsCommand),
    /// Describe a machine by answering questions, and have its configuration written
    #[command(
        after_help = "Examples: glidepath setup · glidepath setup router.toml · glidepath setup --suggested mill.toml"
    )]
    Setup(SetupArgs),
    /// Find the dimensions of a delta, a hexapod, an arm or a five-axis machine from measured points
    #[command(
        after_help = "Examples: glidepath calibrate points.csv --config delta.toml · \
                            glidepath calibrate points.csv --config delta.toml --keep rod --accuracy 0.02"
    )]
    Calibrate(CalibrateArgs),
    /// Print, explain or check a configuration, or convert that of another control
    #[command(after_help = "Examples: glidepath config --default > mill.toml · \
                            glidepath config --explain path.tolerance · \
                            glidepath config --check mill.toml · \
                            glidepath config from-linuxcnc machine.ini > machine.toml")]
    Config(ConfigArgs),
    /// Check whether this host is fit for real time, and give the fix for each shortcoming
    #[command(after_help = "Examples: glidepath doctor --config mill.toml · \
                            glidepath doctor --interface enp3s0")]
    Doctor(DoctorArgs),
    /// Measure how late the real-time loop wakes on this host
    #[command(
        after_help = "Example: glidepath jitter --seconds 60 --full-tick --against-cyclictest \
                            --plot jitter.svg"
    )]
    Jitter(JitterArgs),
}

impl CliCommand {
    /// Whether one JSON object is printed instead of text.
    #[must_use]
    pub const fn json(&self) -> bool {
        match (self, self.basic()) {
            (Self::Config(args), _) => args.json,
            (
                Self::Ethercat(EthercatArgs {
                    action: Some(EthercatAction::Scan(args)),
                    ..
                }),
                _,
            ) => args.json,
            (_, Some(basic)) => basic.json,
            (_, None) => false,
        }
    }

    /// What every command is told that works for a machine.
    #[must_use]
    pub const fn basic(&self) -> Option<&BasicArgs> {
        Some(match self {
            Self::Config(_) | Self::Setup(_) => return None,
            Self::Offsets(command) => command.basic(),
            Self::Run(args) => &args.basic,
            Self::Plan(args) => &args.basic,
            Self::Check(args) => &args.basic,
            Self::Interpolator(args) => &args.basic,
            Self::Planner(args) => &args.basic,
            Self::RunFile(args) => &args.basic,
            Self::Mdi(args) => &args.basic,
            Self::Servo(args) => &args.basic,
            Self::Ethercat(args) => &args.basic,
            Self::Feed(args) => &args.basic,
            Self::Status(args) => &args.operator.basic,
            Self::Live(args) => args.basic(),
            Self::Grbl(args) => &args.operator.basic,
            Self::Record(args) => &args.operator.basic,
            Self::Replay(args) => &args.operator.basic,
            Self::Telemetry(args) => &args.basic,
            Self::Mirror(args) => &args.basic,
            Self::Audit(args) => &args.basic,
            Self::Hold(args)
            | Self::Resume(args)
            | Self::Step(args)
            | Self::StopAtBlockEnd(args)
            | Self::Reverse(args)
            | Self::Forward(args)
            | Self::Return(args)
            | Self::Enable(args)
            | Self::Disable(args)
            | Self::Reset(args) => &args.basic,
            Self::Home(args) => &args.joints.operator.basic,
            Self::Unhome(args) => &args.operator.basic,
            Self::SetPosition(args) => &args.operator.basic,
            Self::Abort(args) => &args.operator.basic,
            Self::Acknowledge(args) => &args.operator.basic,
            Self::SingleBlock(args) => &args.operator.basic,
            Self::Override(args) => &args.operator.basic,
            Self::Jog(args) => &args.operator.basic,
            Self::Fit(args) => &args.basic,
            Self::Preview(args) => &args.basic,
            Self::Bench(args) => &args.basic,
            Self::Calibrate(args) => &args.basic,
            Self::Doctor(args) => &args.basic,
            Self::Jitter(args) => &args.basic,
        })
    }

    /// Whether it gives one object after the other, each in a line of its own.
    #[must_use]
    pub const fn goes_on(&self) -> bool {
        matches!(self, Self::Status(args) if args.watch)
    }

    /// Which instance it was told to take part in; `None` for the default, and for those that take
    /// part in none.
    #[must_use]
    pub fn instance(&self) -> Option<&str> {
        let args = match self {
            Self::Run(args) => return args.instance.instance.as_deref(),
            Self::Interpolator(args) => &args.instance,
            Self::Planner(args) => &args.instance,
            Self::RunFile(args) => &args.instance,
            Self::Mdi(args) => &args.instance,
            Self::Servo(args) => &args.instance,
            Self::Ethercat(args) => &args.instance,
            Self::Feed(args) => &args.instance,
            Self::Telemetry(args) => &args.instance,
            Self::Mirror(args) => &args.instance,
            Self::Status(args) => &args.operator.instance,
            Self::Live(args) => args.instance(),
            Self::Grbl(args) => &args.operator.instance,
            Self::Record(args) => &args.operator.instance,
            Self::Replay(args) => &args.operator.instance,
            Self::Hold(args)
            | Self::Resume(args)
            | Self::Step(args)
            | Self::StopAtBlockEnd(args)
            | Self::Reverse(args)
            | Self::Forward(args)
            | Self::Return(args)
            | Self::Enable(args)
            | Self::Disable(args)
            | Self::Reset(args) => &args.instance,
            Self::Home(args) => &args.joints.operator.instance,
            Self::Unhome(args) => &args.operator.instance,
            Self::SetPosition(args) => &args.operator.instance,
            Self::Abort(args) => &args.operator.instance,
            Self::Acknowledge(args) => &args.operator.instance,
            Self::SingleBlock(args) => &args.operator.instance,
            Self::Override(args) => &args.operator.instance,
            Self::Jog(args) => &args.operator.instance,
            Self::Plan(args) => &args.instance,
            Self::Check(args) => &args.instance,
            Self::Offsets(command) => command.instance(),
            Self::Audit(_)
            | Self::Config(_)
            | Self::Setup(_)
            | Self::Fit(_)
            | Self::Preview(_)
            | Self::Bench(_)
            | Self::Calibrate(_)
            | Self::Doctor(_)
            | Self::Jitter(_) => return None,
        };
        args.instance.as_deref()
    }

    /// What the command line says about how a path is followed.
    #[must_use]
    pub const fn path(&self) -> Option<&PathArgs> {
        match self {
            Self::Run(args) => Some(&args.path),
            Self::Plan(args) => Some(&args.path),
            Self::Live(args) => Some(&args.path),
            Self::Record(args) => Some(&args.path),
            Self::Audit(args) => Some(&args.path),
            Self::Planner(args) => Some(&args.path),
            _ => None,
        }
    }

    /// The program the command reads, if it does, and how.
    #[must_use]
    pub const fn program(&self) -> Option<(Option<&ProgramFile>, &ProgramArgs)> {
        match self {
            Self::Run(args) => Some((Some(&args.file), &args.program)),
            Self::Plan(args) => Some((Some(&args.file), &args.program)),
            Self::Feed(args) => Some((Some(&args.file), &args.program)),
            Self::Planner(args) => Some((args.file.as_ref(), &args.program)),
            Self::Live(args) if args.action.is_none() => Some((args.file.as_ref(), &args.program)),
            // Each file of a check may be in a dialect of its own.
            Self::Check(args) => Some((None, &args.program)),
            Self::Audit(args) => Some((args.program.as_ref(), &args.reading)),
            _ => None,
        }
    }
}
