//! `glidepath mdi` and `glidepath run-file`: what the planner's service is to execute.

use super::attention::Waiting;
use super::lost_planner::LostProgram;
use super::operator::reach;
use super::session;
use super::told::Told;
use crate::cli::{InstanceArgs, MdiArgs, RunFileArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::machine_options::{self, complete};
use crate::output;
use glidepath_link::{
    CALLED_OFF, Client, Command, CommandRequest, Ipc, JobKind, JobReply, JobRequest, JobStage,
    JobState, JobWish, LinkConfig, LinkError, Operator, Record as _, Transport as _,
};
use serde_json::json;
use std::io::{self, BufRead as _, IsTerminal as _};
use std::path::Path;
use std::time::{Duration, Instant};

/// How long a service may take to start.
const PATIENCE: Duration = Duration::from_secs(2);
/// How long the end of a job is waited for behind an interrupt.
const END_PATIENCE: Duration = Duration::from_millis(600);
/// How long the interpolator may take to answer then.
const ABORT_PATIENCE: Duration = Duration::from_millis(100);
/// After how long without an answer it is said that the planner does not answer.
const SILENCE: Duration = Duration::from_secs(3);
/// A planner that answers tells of a fault itself, within so long.
const FAULT_PATIENCE: Duration = Duration::from_secs(1);
/// Between two looks at how a job stands.
const POLL: Duration = Duration::from_millis(20);

/// Has a line executed that was asked for at `asked_ns`, ns of the host's steady clock.
///
/// # Errors
/// No service runs, it refuses, or the motion ended before the line did.
pub(super) fn mdi(args: &MdiArgs, config: &MachineConfig, asked_ns: u64) -> Result<Exit, Failure> {
    let request = JobRequest::new(client(), 1, JobKind::Line, &args.line, asked_ns);
    if request.text.as_str() != args.line {
        let line = args.line.clone();
        return Err(Failure::Word(line, "a line has at most 1024 bytes"));
    }
    let text = execute(&args.instance, config, request, false)?;
    report("mdi", &text, args.basic.json);
    Ok(Exit::Done)
}

/// Has a program in a file executed that was asked for at `asked_ns`.
///
/// # Errors
/// As [`mdi`].
pub(super) fn run_file(
    args: &RunFileArgs,
    config: &MachineConfig,
    asked_ns: u64,
) -> Result<Exit, Failure> {
    let file = args.file.as_path();
    if file == Path::new("-") {
        return Err(Failure::Word(
            "-".to_owned(),
            "the service reads files; `glidepath planner -` reads standard input",
        ));
    }
    let path = file.canonicalize().map_err(FileError::open(file))?;
    if path.is_dir() {
        let error = io::Error::new(io::ErrorKind::InvalidInput, "it is a folder, no program");
        return Err(FileError::open(file)(error).into());
    }
    let name = path.display().to_string();
    let mut request = JobRequest::new(client(), 1, JobKind::File, &name, asked_ns);
    if request.text.as_str() != name {
        return Err(Failure::Word(
            name,
            "the service takes names of at most 1024 bytes",
        ));
    }
    (request.from_line, request.pass) = (args.from_line.unwrap_or(0), args.pass);
    request.tolerance_ratio = args.tolerance_ratio;
    request.confirmed = u32::from(args.yes);
    request.resumes = u32::from(args.resume);
    let text = execute(&args.instance, config, request, true)?;
    report("run-file", &text, args.basic.json);
    Ok(Exit::Done)
}

/// A number that no other client has.
pub(super) fn client() -> u64 {
    use std::hash::{BuildHasher as _, Hasher as _, RandomState};
    RandomState::new().build_hasher().finish()
}

fn report(command: &str, text: &str, json: bool) {
    if json {
        output::object(&json!({ "command": command, "executed": true, "text": complete(text) }));
    } else {
        output::result(&format!("{command}: {text}\n"));
    }
}

/// How long a planner that executes something else is asked again. A job that was ended is let go of a moment after the
/// machine's state says that nothing runs, and what is typed then is not to be refused for it.
pub(super) const LETTING_GO: Duration = Duration::from_millis(1_200);

/// Hands a job in, and waits for its end. It is told what is being done; an interrupt ends the job.
fn execute(
    args: &InstanceArgs,
    config: &MachineConfig,
    mut request: JobRequest,
    may_ask: bool,
) -> Result<String, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let transport = session::join(args, config)?;
    // Where the machine cannot be watched, the job goes on, and this waits for its end.
    let waiting = Waiting::new(Some((&transport, config)));
    let link = session::link(&session::instance(args, config), config);
    let mut desk = Desk {
        client: transport.job_client()?,
        transport: &transport,
        waiting,
        link: &link,
        interrupt: &interrupt,
        interrupted: None,
        is_taken: false,
        program: program(&request),
        told: Told::new(request.text.as_str()),
    };
    let handed_in = Instant::now();
    loop {
        let reply = desk.ask(&request)?;
        let text = reply.text.as_str().to_owned();
        match reply.state().map_err(LinkError::from)? {
            JobState::Busy if handed_in.elapsed() < LETTING_GO && !interrupt.is_set() => {}
            JobState::Running => {
                desk.is_taken = true;
                desk.told.tell_of_job(&text);
                let wish = desk.wish()?;
                request = request.wishing(wish);
            }
            JobState::Done => return Ok(text),
            JobState::ToConfirm if may_ask && agrees(&text)? => {
                (request.number, request.confirmed) = (request.number + 1, 1);
                request = request.wishing(JobWish::Execute);
            }
            JobState::ToConfirm => {
                return Err(Failure::Job {
                    text: format!("not begun: {text}\ngive --yes to agree"),
                    exit: Exit::Rejected,
                });
            }
            JobState::Refused | JobState::Changed => {
                return Err(Failure::Job {
                    text: format!("refused: {text}"),
                    exit: Exit::Rejected,
                });
            }
            JobState::Failed if desk.interrupted.is_some() => {
                return Err(Failure::Job {
                    text: format!("interrupted, and the job has ended: {text}"),
                    exit: Exit::Interrupted,
                });
            }
            JobState::Failed | JobState::Busy | JobState::NotReady | JobState::Unknown => {
                return Err(Failure::Job {
                    text,
                    exit: Exit::Fault,
                });
            }
        }
        desk.waiting.pause(POLL);
    }
}

/// Where the job is handed in, and what has come of it.
struct Desk<'d> {
    client: Box<dyn Client<JobRequest, JobReply>>,
    transport: &'d Ipc,
    waiting: Waiting,
    link: &'d LinkConfig,
    interrupt: &'d Interrupt,
    /// When the interrupt was seen.
    interrupted: Option<Instant>,
    /// The service has taken the job.
    is_taken: bool,
    /// What is told of it without its planner, if it is a program.
    program: Option<LostProgram>,
    told: Told,
}

/// What goes on with a job whose planner is lost, if it is a program.
fn program(request: &JobRequest) -> Option<LostProgram> {
    let file = request.text.as_str();
    let name = Path::new(file)
        .file_name()
        .filter(|_| request.kind() == Ok(JobKind::File))?;
    Some(LostProgram {
        name: name.to_string_lossy().into_owned(),
        resume: machine_options::resume("run-file", file),
        is_resumed: request.resumes == 1,
    })
}

impl Desk<'_> {
    /// What is wanted of a job that was taken. The interpolator is told of an interrupt, too: it needs
    /// no planner to end the motion.
    fn wish(&mut self) -> Result<JobWish, Failure> {
        if !self.interrupt.is_set() {
            return Ok(JobWish::Ask);
        }
        if self.interrupted.is_none() {
            self.interrupted = Some(Instant::now());
            self.abort();
        }
        self.give_up()?;
        Ok(JobWish::Cancel)
    }

    /// Ends the command where its job does not end soon enough.
    fn give_up(&mut self) -> Result<(), Failure> {
        if !self.interrupt.is_set() {
            return Ok(());
        }
        let since = *self.interrupted.get_or_insert_with(Instant::now);
        if since.elapsed() < END_PATIENCE {
            return Ok(());
        }
        if self.is_taken {
            self.abort();
        }
        Err(Failure::NoAnswer)
    }

    /// The fault that has ended a job whose planner does not say so.
    fn look_for_fault(&self, asked: Instant) -> Result<(), Failure> {
        let fault = self.waiting.fault();
        let Some(fault) = fault.filter(|_| self.is_taken && asked.elapsed() >= FAULT_PATIENCE)
        else {
            return Ok(());
        };
        let mut text = format!("{fault}; {}", self.hangs());
        if let Some(left) = self.left() {
            text.push_str(&format!("; {left}"));
        }
        Err(Failure::Job {
            text,
            exit: Exit::Fault,
        })
    }

    /// What is to be done about a planner that does not answer.
    fn hangs(&self) -> String {
        let Some(process) = self.transport.planner_process() else {
            return "the planner does not answer, and none runs: start `glidepath planner --listen`"
                .to_owned();
        };
        format!(
            "the planner (process {process}) lives and does not answer: it is stopped or hangs; `kill -CONT {process}` lets \
             one go on that was stopped; else end it by `kill -KILL {process}`, and start `glidepath planner --listen`. \
             `glidepath abort` stops the machine without it"
        )
    }

    fn lost(&self) -> Failure {
        Failure::ServiceLost { left: self.left() }
    }

    /// What is to be done for the program whose planner is no more, or does not answer.
    fn left(&self) -> Option<String> {
        Some(self.program.as_ref()?.told(self.link))
    }

    fn abort(&self) {
        abort(self.link);
    }

    /// Asks until there is an answer, or nobody is there who could give one.
    fn ask(&mut self, request: &JobRequest) -> Result<JobReply, Failure> {
        let started = Instant::now();
        loop {
            match self.client.ask(request) {
                Err(LinkError::NoServer { .. }) if self.is_taken => {
                    return Err(self.lost());
                }
                // It may have been started just now.
                Err(LinkError::NoServer { .. }) if started.elapsed() < PATIENCE => {
                    self.told.wait_for("the planner's service", started);
                    if self.interrupt.is_set() {
                        return Err(Failure::Interrupted);
                    }
                    std::thread::sleep(POLL);
                }
                Err(LinkError::NoServer { .. }) => return Err(no_service(self.link)),
                asked => {
                    asked?;
                    break;
                }
            }
        }
        let started = Instant::now();
        let mut is_told = false;
        loop {
            let reply = match self.client.reply() {
                Err(LinkError::NoServer { .. }) if self.is_taken => {
                    return Err(self.lost());
                }
                reply => reply?,
            };
            if let Some(reply) = reply {
                reply.check().map_err(LinkError::from)?;
                return Ok(reply);
            }
            self.told.wait_for("an answer of the planner", started);
            self.give_up()?;
            self.look_for_fault(started)?;
            if !is_told && started.elapsed() >= SILENCE {
                is_told = true;
                output::note(&self.hangs());
            }
            self.waiting.pause(Duration::from_millis(1));
        }
    }
}

/// Has the motion of a job or a stream aborted that was given up. What it comes to is seen by how that ends.
pub(super) fn abort(link: &LinkConfig) {
    let request =
        CommandRequest::new(u64::from(std::process::id()), 1, Command::Abort).saying(CALLED_OFF);
    if let Ok(operator) = reach(link) {
        let _answer = operator.call(&request, ABORT_PATIENCE);
    }
}

/// Shows what is to be agreed to, and asks, if somebody is there to be asked.
fn agrees(text: &str) -> Result<bool, Failure> {
    if !io::stdin().is_terminal() {
        return Ok(false);
    }
    output::note(text);
    output::note("go there and begin? (yes)");
    let mut answer = String::new();
    io::stdin()
        .lock()
        .read_line(&mut answer)
        .map_err(|_| Failure::Interrupted)?;
    Ok(answer.trim() == "yes")
}

/// Nobody takes jobs: no planner is there, or one with a program of its own.
pub(super) fn no_service(link: &LinkConfig) -> Failure {
    let status = Operator::find(link).and_then(|operator| operator.status(PATIENCE));
    let busy = status.ok().flatten().filter(|status| {
        let stage = status.job_stage();
        matches!(
            stage,
            Ok(JobStage::Waiting | JobStage::Preparing | JobStage::Begun)
        )
    });
    match busy {
        Some(status) => Failure::NotServing {
            job: status.job.as_str().to_owned(),
        },
        None => Failure::NoService,
    }
}
