//! `glidepath mdi` and `glidepath run-file`: what the planner's service is to execute.

use super::attention::Attention;
use super::operator::{reach, send};
use super::session;
use crate::cli::{InstanceArgs, MdiArgs, RunFileArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::output;
use glidepath_link::{
    Client, Command, JobKind, JobReply, JobRequest, JobState, LinkError, Record as _,
    Transport as _,
};
use serde_json::json;
use std::io::{BufRead as _, IsTerminal as _};
use std::time::{Duration, Instant};

/// How long a service may take to start.
const PATIENCE: Duration = Duration::from_secs(2);
/// How long an answer is waited for behind an interrupt: that comes when a program has been read.
const ANSWER_PATIENCE: Duration = Duration::from_secs(10);
/// Between two looks at how a job stands.
const POLL: Duration = Duration::from_millis(20);

/// Has a line executed.
///
/// # Errors
/// No service runs, it refuses, or the motion ended before the line did.
pub(super) fn mdi(args: &MdiArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let request = JobRequest::new(client(), 1, JobKind::Line, &args.line);
    if request.text.as_str() != args.line {
        let line = args.line.clone();
        return Err(Failure::Word(line, "a line has at most 1024 bytes"));
    }
    let text = execute(&args.instance, config, request, false)?;
    report("mdi", &text, args.basic.json);
    Ok(Exit::Done)
}

/// Has a program in a file executed.
///
/// # Errors
/// As [`mdi`].
pub(super) fn run_file(args: &RunFileArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let path = args
        .file
        .canonicalize()
        .map_err(FileError::open(&args.file))?;
    let name = path.display().to_string();
    let mut request = JobRequest::new(client(), 1, JobKind::File, &name);
    if request.text.as_str() != name {
        return Err(Failure::Word(
            name,
            "the service takes names of at most 1024 bytes",
        ));
    }
    (request.from_line, request.pass) = (args.from_line.unwrap_or(0), args.pass);
    request.confirmed = u32::from(args.yes);
    let text = execute(&args.instance, config, request, true)?;
    report("run-file", &text, args.basic.json);
    Ok(Exit::Done)
}

/// A number that no other client has.
fn client() -> u64 {
    use std::hash::{BuildHasher as _, Hasher as _, RandomState};
    RandomState::new().build_hasher().finish()
}

fn report(command: &str, text: &str, json: bool) {
    if json {
        output::object(&json!({ "command": command, "executed": true, "text": text }));
    } else {
        output::result(&format!("{command}: {text}\n"));
    }
}

/// Hands a job in, and waits for its end. An interrupt aborts the motion.
fn execute(
    args: &InstanceArgs,
    config: &MachineConfig,
    mut request: JobRequest,
    may_ask: bool,
) -> Result<String, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let transport = session::join(args, config)?;
    let mut client = transport.job_client()?;
    let mut attention = Attention::new(&transport, config)?;
    let mut is_aborted = false;
    loop {
        let reply = ask(&mut *client, &request, &interrupt)?;
        let text = reply.text.as_str().to_owned();
        match reply.state().map_err(LinkError::from)? {
            JobState::Running => attention.look()?,
            JobState::Done => return Ok(text),
            JobState::ToConfirm if may_ask && agrees(&text)? => {
                (request.number, request.confirmed) = (request.number + 1, 1);
            }
            JobState::ToConfirm => {
                return Err(Failure::Job {
                    text: format!("not begun: {text}\ngive --yes to agree"),
                    exit: Exit::Rejected,
                });
            }
            JobState::Refused => {
                return Err(Failure::Job {
                    text: format!("refused: {text}"),
                    exit: Exit::Rejected,
                });
            }
            JobState::Failed | JobState::Busy | JobState::NotReady => {
                return Err(Failure::Job {
                    text,
                    exit: Exit::Fault,
                });
            }
        }
        if interrupt.is_set() && !is_aborted {
            is_aborted = true;
            let link = session::link(&session::instance(args, config), config);
            let operator = reach(&link)?;
            // What it answers is seen by how the job ends.
            send(&operator, &link, Command::Abort)?;
        }
        std::thread::sleep(POLL);
    }
}

fn ask(
    client: &mut dyn Client<JobRequest, JobReply>,
    request: &JobRequest,
    interrupt: &Interrupt,
) -> Result<JobReply, Failure> {
    let started = Instant::now();
    let mut interrupted = None::<Instant>;
    loop {
        match client.ask(request) {
            // It may have been started just now.
            Err(LinkError::NoServer { .. }) if started.elapsed() < PATIENCE => {
                std::thread::sleep(POLL);
            }
            Err(LinkError::NoServer { .. }) => return Err(Failure::NoService),
            asked => {
                asked?;
                break;
            }
        }
    }
    loop {
        // A long program is read before it is answered; a service that ended is an error here.
        if let Some(reply) = client.reply()? {
            reply.check().map_err(LinkError::from)?;
            return Ok(reply);
        }
        // What was asked for may begin yet: then it is aborted. One that is stopped itself never answers.
        if interrupt.is_set()
            && interrupted.get_or_insert_with(Instant::now).elapsed() > ANSWER_PATIENCE
        {
            return Err(Failure::NoAnswer);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Shows what is to be agreed to, and asks, if somebody is there to be asked.
fn agrees(text: &str) -> Result<bool, Failure> {
    if !std::io::stdin().is_terminal() {
        return Ok(false);
    }
    output::note(text);
    output::note("go there and begin? (yes)");
    let mut answer = String::new();
    std::io::stdin()
        .lock()
        .read_line(&mut answer)
        .map_err(|_| Failure::Interrupted)?;
    Ok(answer.trim() == "yes")
}
