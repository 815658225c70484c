//! Why a command did not do what was asked.

use crate::bench::CatalogueError;
use crate::command::evidence::Evidence;
use crate::command::grbl::error::EndpointError;
use crate::command::other_users::OtherUsers;
use crate::config::ConfigError;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::jitter::JitterError;
use crate::persistence::error::StateError;
use crate::program_text::UnknownEvent;
use crate::report::counted;
use crate::text_diagnostic::TextDiagnostic;
use glidepath_ethercat as ethercat;
use glidepath_gcode::Diagnostic;
use glidepath_hal::HalError;
use glidepath_interpolator as interpolator;
use glidepath_kinematics::CalibrationError;
use glidepath_link::mirror::MirrorError;
use glidepath_link::{LinkError, refused};
use glidepath_live::ServerError;
use glidepath_migration::ReadError;
use glidepath_persistence::var::VarError;
use glidepath_planner::{self as planner, FeedError, Refusal};
use glidepath_recording::ReadError as RecordingError;
use thiserror::Error;

/// A command's failure, with its exit code.
#[derive(Debug, Error)]
pub(super) enum Failure {
    /// The configuration was refused.
    #[error(transparent)]
    Configuration(#[from] ConfigError),
    /// What is kept over a restart cannot be used.
    #[error(transparent)]
    State(#[from] StateError),
    /// The answers ended before a question.
    #[error("no answer to \"{question}\": nothing is written")]
    Unanswered {
        /// The question.
        question: String,
    },
    /// A word that is not understood.
    #[error("`{0}` is not understood: {1}")]
    Word(String, &'static str),
    /// The configuration of another control cannot be read.
    #[error("{file}, {error}")]
    Foreign {
        /// The file.
        file: String,
        /// What is wrong.
        error: ReadError,
    },
    /// The file of the inputs of emulated devices has something to mend.
    #[error("{file}:{error}")]
    Inputs {
        /// The file.
        file: String,
        /// Where, and what is wrong.
        error: String,
    },
    /// LinuxCNC's parameter file has something to mend.
    #[error("{file}, {error}")]
    Var {
        /// The file.
        file: String,
        /// What is wrong.
        error: VarError,
    },
    /// A key of the configuration that does not exist.
    #[error("there is no key `{key}`{}", match nearest {
        Some(name) => format!("; did you mean `{name}`? `glidepath config --explain` lists them all"),
        None => "; `glidepath config --explain` lists them all".to_owned(),
    })]
    UnknownKey {
        /// What was asked for.
        key: String,
        /// The one that is most like it.
        nearest: Option<&'static str>,
    },
    /// The benchmark programs cannot be found.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// A file cannot be opened, read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A program has something to mend.
    #[error("{program} is rejected; {}", if *moved { "the motion stopped at the last good block" } else { "nothing moved" })]
    Rejected {
        /// The program.
        program: String,
        /// What was found.
        diagnostics: Vec<Diagnostic>,
        /// Diagnostics that are not listed.
        more: u32,
        /// Whether the part in front of the first of them was run.
        moved: bool,
    },
    /// A program could not be checked to its end.
    #[error(
        "{program} is not checked beyond line {line}, because its loops go on for too long; nothing \
         moved; {}", if *has_joints {
            "this machine's joints are judged over the whole of a program, so that it cannot be run \
             unchecked: end its loops"
        } else {
            "--allow-unchecked runs it all the same, each line judged only when it comes to it"
        }
    )]
    Unchecked {
        /// The program.
        program: String,
        /// Where the check was given up.
        line: u32,
        /// Whether the machine has joints that are not its axes.
        has_joints: bool,
    },
    /// More motion than is to be planned.
    #[error(
        "{program} takes {takes} at least, at its feeds and with its dwells, and {longest} of motion are \
         planned at most, because each period is computed; give a higher feed, shorter dwells or a part of \
         it, or --longest with more than that. A machine executes it, however long it takes"
    )]
    TooLong {
        /// The program.
        program: String,
        /// The least time of it.
        takes: String,
        /// The most that is planned.
        longest: String,
    },
    /// A curve file has something to mend.
    #[error("the curve is rejected: {0}")]
    Curve(Box<TextDiagnostic>),
    /// A file of measured points has something to mend.
    #[error("the points have {} to mend", counted(rows.len() as u64 + more, "place"))]
    Points {
        /// What was found, in the order of the text.
        rows: Vec<TextDiagnostic>,
        /// How many more there are.
        more: u64,
    },
    /// Measured points give no dimensions.
    #[error("{error}; {remedy}")]
    NotCalibrated {
        /// Why.
        error: CalibrationError,
        /// What to do.
        remedy: &'static str,
    },
    /// A dimension to keep that the mechanism does not have.
    #[error("the mechanism has no dimension `{name}`; it has: {}", .names.join(", "))]
    UnknownDimension {
        /// What was asked for.
        name: String,
        /// Those that there are.
        names: Vec<String>,
    },
    /// A curve file holds one curve.
    #[error("{runs} runs cannot be written as one curve; write a program: --output FILE.ngc")]
    NotOneCurve {
        /// How many there are.
        runs: usize,
    },
    /// A curve is further from its run than was asked for.
    #[error(
        "the curve is {error_mm:.6} mm off, more than the tolerance of {tolerance_mm} mm, so it is not \
         written; give a larger --tolerance, or another --method"
    )]
    CurveBeyond {
        /// How far it is off, mm.
        error_mm: f64,
        /// What was asked for, mm.
        tolerance_mm: f64,
    },
    /// An event that cannot be written into a program.
    #[error(
        "line {line}: the words of this M code are not known any more, so it cannot be written; take \
         it out, or write curve files",
        line = .0.line
    )]
    UnknownEvent(UnknownEvent),
    /// No feedrate is known.
    #[error("no feedrate: give --feed, or `feed` in the curve file")]
    NoFeed,
    /// A program that passed the check was refused later.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The system refuses to have Ctrl-C handled.
    #[error("cannot handle signals: {0}")]
    Signals(std::io::Error),
    /// The terminal cannot be used.
    #[error("cannot use the terminal: {0}")]
    Terminal(std::io::Error),
    /// Nobody answers for an instance.
    #[error(
        "no interpolator runs in the instance \"{instance}\"; start `glidepath interpolator`, or name \
         another with --instance{others}"
    )]
    NoInterpolator {
        /// The instance.
        instance: String,
        /// Who has one.
        others: OtherUsers,
    },
    /// The interpolator lives, and does not answer.
    #[error(
        "the interpolator of the instance \"{instance}\" (process {process}) has not answered in \
         {waited_s} s"
    )]
    Silent {
        /// The instance.
        instance: String,
        /// The interpolator.
        process: i32,
        /// How long it was waited for.
        waited_s: u64,
    },
    /// A command that brings the machine to rest was not answered.
    #[error(
        "{command}: no answer: {source}. An interpolator that goes on still obeys. If the machine moves \
         meanwhile, the last resort is `glidepath abort --signal`, or SIGTERM to the interpolator: it comes to rest on the path \
         and ends"
    )]
    NotStopped {
        /// The command.
        command: &'static str,
        /// Why.
        source: Box<Self>,
    },
    /// The interpolator was signalled, and still runs.
    #[error(
        "the interpolator (process {pid}) has not ended {waited_s} s after SIGTERM: if the machine \
         moves, cut its power; then `kill -KILL {pid}`"
    )]
    DoesNotEnd {
        /// The interpolator.
        pid: i32,
        /// How long it was waited for.
        waited_s: u64,
    },
    /// The interpolator refused a command.
    #[error("{}", refused(.command, .reason))]
    CommandRefused {
        /// The command.
        command: &'static str,
        /// What the machine does.
        state: &'static str,
        /// Why.
        reason: String,
    },
    /// The axes did not come back to the path.
    #[error("return: {0}")]
    NotReturned(&'static str),
    /// A jog cannot begin: every axis of it is at the end of its travel already.
    #[error("{}", refused("jog", .reason))]
    AtEndOfTravel {
        /// What the machine does.
        state: &'static str,
        /// Which axes, and where.
        reason: String,
    },
    /// A motion that was accepted did not come to its end.
    #[error("{command} has ended before its end: {reason}")]
    CutShort {
        /// The command.
        command: &'static str,
        /// What the machine does.
        state: &'static str,
        /// Why.
        reason: String,
    },
    /// The planner's service did not execute a job to its end.
    #[error("{text}")]
    Job {
        /// Why.
        text: String,
        /// What that is.
        exit: Exit,
    },
    /// Nobody executes lines and files.
    #[error(
        "no planner serves this machine: start `glidepath planner --listen`, or the service \
         glidepath-planner"
    )]
    NoService,
    /// A planner executes a program of its own, and takes no jobs.
    #[error(
        "no planner serves this machine: one of its own executes {job}, and takes no jobs; wait for its end, or end \
         it with `glidepath abort`, and then start `glidepath planner --listen`"
    )]
    NotServing {
        /// What it executes.
        job: String,
    },
    /// The planner's service ended with a job that it had taken.
    #[error(
        "the planner's service ended before this was done; `glidepath status` says where the machine stands; \
         start `glidepath planner --listen` again{}", match left {
            Some(left) => format!("; {left}"),
            None => String::new(),
        }
    )]
    ServiceLost {
        /// What is to be done for the program, if the job was one.
        left: Option<String>,
    },
    /// The interpolator could not start or failed.
    #[error(transparent)]
    Interpolator(#[from] interpolator::RunError),
    /// The planner ended before the end of the motion.
    #[error(transparent)]
    Planner(#[from] planner::RunError),
    /// A program whose motion ended before it did, with what goes on with it.
    #[error("{source}; {left}")]
    Left {
        /// Why.
        source: planner::RunError,
        /// Where it was left, and how to go on.
        left: String,
    },
    /// A program was not streamed to its end.
    #[error(transparent)]
    Feed(#[from] FeedError),
    /// Standard input was to be resumed.
    #[error("standard input cannot be read from its beginning again: resume from a file")]
    ResumePipe,
    /// What inputs and the probe answer cannot be kept.
    #[error("what inputs and the probe answer cannot be kept: {0}; nothing has moved")]
    Answers(std::io::Error),
    /// The bus of the drives does not work.
    #[error(transparent)]
    Bus(#[from] ethercat::RunError),
    /// A network interface cannot be used.
    #[error(transparent)]
    Wire(#[from] ethercat::WireError),
    /// The configuration does not expect drives to answer.
    #[error(
        "the machine's configuration says that no drives answer: set source = \"drives\" in its \
         [feedback]; without it nobody asks for their power"
    )]
    NoFeedback,
    /// Feedback would count as lost although all is well.
    #[error(
        "the machine's configuration calls feedback stale after {stale_t} s, and that of this bus is up to \
         {needed_t} s old while frames may still be lost: set stale_s = {needed_t} in its [feedback]"
    )]
    Stale {
        /// What is configured, s.
        stale_t: f64,
        /// What is needed, s.
        needed_t: f64,
    },
    /// Drives cannot be emulated on this host.
    #[error("cannot emulate drives on this host: {0}")]
    NotEmulated(String),
    /// The shared memory cannot be used.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// There is no mirror, or none any more.
    #[error("mirror: {0}")]
    Mirror(#[from] MirrorError),
    /// LinuxCNC's HAL is no servo stack, or no longer.
    #[error("servo: {0}")]
    Hal(#[from] HalError),
    /// The configuration does not fit LinuxCNC's HAL.
    #[error("servo: {what}; {remedy}")]
    HalConfiguration {
        /// What does not.
        what: String,
        /// How to mend it.
        remedy: String,
    },
    /// A recording cannot be read.
    #[error("{file}: {error}")]
    Recording {
        /// The file.
        file: String,
        /// What is wrong.
        error: RecordingError,
    },
    /// A process cannot be started or ended.
    #[error("cannot start or end a process: {0}")]
    Process(std::io::Error),
    /// A process ended before its time.
    #[error("the {name} ended: {reason}")]
    ProcessEnded {
        /// Its subcommand.
        name: &'static str,
        /// What it said.
        reason: String,
        /// What its end means.
        exit: Exit,
    },
    /// A run ended before its end.
    #[error("{source}; {evidence}")]
    EndedEarly {
        /// Why.
        source: Box<Self>,
        /// What was played, and where the machine stood.
        evidence: Box<Evidence>,
    },
    /// Senders cannot be served.
    #[error(transparent)]
    Endpoint(#[from] EndpointError),
    /// No device has this name.
    #[error("no device is paired as `{name}`{}", match names.as_slice() {
        [] => "; none is".to_owned(),
        names => format!("; there are: {}", names.join(", ")),
    })]
    NoDevice {
        /// The name that was given.
        name: String,
        /// Those that there are.
        names: Vec<String>,
    },
    /// The page cannot be served.
    #[error(transparent)]
    Server(#[from] ServerError),
    /// The timing of this host cannot be measured.
    #[error(transparent)]
    Jitter(#[from] JitterError),
    /// A part of this process does not work.
    #[error("{0} failed")]
    Thread(&'static str),
    /// The command was interrupted.
    #[error("interrupted")]
    Interrupted,
    /// The command was interrupted, and its job has not ended yet.
    #[error(
        "interrupted: the job was told to end, and has not said yet that it has; `glidepath status` \
         tells what the machine does"
    )]
    NoAnswer,
}
