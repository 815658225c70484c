//! The job submitter of pages: lines and programs, handed in at the planner's service as `glidepath mdi`
//! and `glidepath run-file` hand them in.
//!
//! A thread has the job until its end, because a job that has not begun lives by its client. One job at a
//! time: a page that hands in another one meanwhile is told so.

use super::day::now_ms;
use crate::command::jobs::{LETTING_GO, client, no_service};
use glidepath_link::{
    Client, Ipc, JobKind, JobReply, JobRequest, JobState, JobWish, LinkConfig, LinkError,
    Record as _, Transport as _,
};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Between two looks at how a job stands.
const POLL: Duration = Duration::from_millis(20);
/// How long the service may take for an answer.
const PATIENCE: Duration = Duration::from_secs(2);
/// How long a page waits for the end of a job: most of what is refused is refused within that.
const SOON: Duration = Duration::from_millis(400);
/// Lines and programs that are remembered with their end.
const REMEMBERED: usize = 40;

/// What a page wants executed.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Wanted {
    Line(String),
    /// Lines that belong together, with line breaks between them.
    Sequence {
        /// For people.
        name: String,
        lines: String,
    },
    File {
        path: String,
        /// The fingerprint of the program that was looked at.
        program: u64,
        /// How many times its tolerance it may use.
        tolerance_ratio: f64,
        from_line: u32,
        pass: u32,
        agreed: bool,
        resumes: bool,
    },
}

impl Wanted {
    fn request(&self, client: u64, number: u64, asked_ns: u64) -> Option<JobRequest> {
        let (kind, text) = match self {
            Self::Line(line) => (JobKind::Line, line),
            Self::Sequence { lines, .. } => (JobKind::Sequence, lines),
            Self::File { path, .. } => (JobKind::File, path),
        };
        let mut request = JobRequest::new(client, number, kind, text, asked_ns);
        if let Self::File {
            program,
            tolerance_ratio,
            from_line,
            pass,
            agreed,
            resumes,
            ..
        } = self
        {
            (request.program, request.tolerance_ratio) = (*program, *tolerance_ratio);
            (request.from_line, request.pass) = (*from_line, *pass);
            request.confirmed = u32::from(*agreed);
            request.resumes = u32::from(*resumes);
        }
        // What does not fit is not executed in part.
        (request.text.as_str() == text).then_some(request)
    }

    fn name(&self) -> &str {
        match self {
            Self::Line(line) => line,
            Self::Sequence { name, .. } => name,
            Self::File { path, .. } => path.rsplit('/').next().unwrap_or(path),
        }
    }
}

/// How a job stands, as far as a page waits for it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Handed {
    /// It goes on.
    Running,
    /// It was executed.
    Done(String),
    /// It begins in a way that has to be agreed to.
    ToConfirm(String),
    /// It was not executed, or not to its end.
    Not(String),
    /// It was not executed: the file is not the program that was looked at.
    Changed(String),
}

/// A job with its end, for people.
#[derive(Debug, Clone)]
struct Past {
    /// Counts the jobs of the pages.
    number: u64,
    at_ms: u64,
    kind: &'static str,
    name: String,
    /// How it ended; `None` while it goes on.
    end: Option<Handed>,
}

type Seen = Arc<Mutex<VecDeque<Past>>>;

enum Asked {
    HandIn(Wanted, u64, Sender<(u64, Handed)>),
    Cancel,
}

/// The way to the thread that hands jobs in.
#[derive(Debug)]
pub(super) struct JobSubmitter {
    asked: Sender<Asked>,
    seen: Seen,
}

impl JobSubmitter {
    /// Starts the thread, which ends with this.
    pub(super) fn start(link: &LinkConfig) -> Result<Self, std::io::Error> {
        let (asked, receiver) = channel();
        let seen = Seen::default();
        let mut clerk = Clerk {
            link: link.clone(),
            asked: receiver,
            seen: Arc::clone(&seen),
            client: client(),
            number: 0,
        };
        let thread = std::thread::Builder::new().name("live-jobs".to_owned());
        thread.spawn(move || clerk.serve())?;
        Ok(Self { asked, seen })
    }

    /// Hands a job in that was asked for at a time of the host's steady clock, and waits a moment for its end. Returns
    /// the number of the job, too, 0 if it has none.
    pub(super) fn hand_in(&self, wanted: Wanted, asked_ns: u64) -> (u64, Handed) {
        let (answer, answered) = channel();
        let gone = || {
            let words = "nobody hands jobs in any more: start the page anew".to_owned();
            (0, Handed::Not(words))
        };
        if self
            .asked
            .send(Asked::HandIn(wanted, asked_ns, answer))
            .is_err()
        {
            return gone();
        }
        answered.recv().unwrap_or_else(|_| gone())
    }

    /// The job that has not begun does not begin. One that moves is ended by an abort.
    pub(super) fn cancel(&self) {
        // Without a thread there is no job.
        let _sent = self.asked.send(Asked::Cancel);
    }

    /// How a job ended: nothing of it if it is not remembered, no end while it goes on.
    #[expect(
        clippy::option_option,
        reason = "not remembered is not the same as under way"
    )]
    pub(super) fn end(&self, number: u64) -> Option<Option<Handed>> {
        let seen = lock(&self.seen);
        let of = seen.iter().find(|past| past.number == number);
        of.map(|past| past.end.clone())
    }

    /// The jobs of the pages, the last one first.
    pub(super) fn object(&self) -> Value {
        let seen = lock(&self.seen);
        let object = |past: &Past| {
            let (state, text) = match &past.end {
                None => ("running", ""),
                Some(Handed::Running) => ("running", ""),
                Some(Handed::Done(text)) => ("done", text.as_str()),
                Some(Handed::ToConfirm(text)) => ("to-confirm", text.as_str()),
                Some(Handed::Not(text) | Handed::Changed(text)) => ("not", text.as_str()),
            };
            json!({
                "number": past.number,
                "at_ms": past.at_ms,
                "kind": past.kind,
                "name": past.name,
                "state": state,
                "text": text,
            })
        };
        seen.iter().map(object).collect()
    }
}

fn lock(seen: &Seen) -> MutexGuard<'_, VecDeque<Past>> {
    // The list is whole, whoever panicked.
    seen.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Whoever hands jobs in, one after the other.
struct Clerk {
    link: LinkConfig,
    asked: Receiver<Asked>,
    seen: Seen,
    client: u64,
    number: u64,
}

impl Clerk {
    fn serve(&mut self) {
        while let Ok(asked) = self.asked.recv() {
            let Asked::HandIn(wanted, asked_ns, answer) = asked else {
                continue;
            };
            self.number += 1;
            self.begin(&wanted);
            let mut waiting = Waiting {
                number: self.number,
                answer: Some(answer),
                since: Instant::now(),
            };
            let end = self.execute(&wanted, asked_ns, &mut waiting);
            waiting.tell(&end);
            if let Some(past) = lock(&self.seen).front_mut() {
                past.end = Some(end);
            }
        }
    }

    fn begin(&self, wanted: &Wanted) {
        let mut seen = lock(&self.seen);
        seen.push_front(Past {
            number: self.number,
            at_ms: now_ms(),
            kind: match wanted {
                Wanted::Line(_) => "line",
                Wanted::Sequence { .. } => "sequence",
                Wanted::File { .. } => "file",
            },
            name: wanted.name().to_owned(),
            end: None,
        });
        seen.truncate(REMEMBERED);
    }

    fn execute(&mut self, wanted: &Wanted, asked_ns: u64, waiting: &mut Waiting) -> Handed {
        let Some(request) = wanted.request(self.client, self.number, asked_ns) else {
            let words = "lines, and names of programs, have at most 1024 bytes";
            return Handed::Not(words.to_owned());
        };
        match self.follow(request, waiting) {
            Ok(end) => end,
            Err(LinkError::NoServer { .. }) => Handed::Not(no_service(&self.link).to_string()),
            Err(error) => Handed::Not(error.to_string()),
        }
    }

    /// Hands a job in, and asks how it stands until it has ended.
    fn follow(&self, mut request: JobRequest, waiting: &mut Waiting) -> Result<Handed, LinkError> {
        let transport = Ipc::connect(&self.link)?;
        let mut queue = transport.job_client()?;
        let mut wish = JobWish::Ask;
        let handed_in = Instant::now();
        loop {
            let Some(reply) = ask(&mut *queue, &request)? else {
                return Ok(Handed::Not(
                    "the planner's service does not answer".to_owned(),
                ));
            };
            let text = reply.text.as_str().to_owned();
            match reply.state()? {
                JobState::Running => waiting.look(),
                JobState::Busy if handed_in.elapsed() < LETTING_GO => {
                    std::thread::sleep(POLL);
                    continue;
                }
                JobState::Done => return Ok(Handed::Done(text)),
                JobState::ToConfirm => return Ok(Handed::ToConfirm(text)),
                JobState::Changed => return Ok(Handed::Changed(text)),
                JobState::Refused
                | JobState::Failed
                | JobState::Busy
                | JobState::NotReady
                | JobState::Unknown => return Ok(Handed::Not(text)),
            }
            loop {
                match self.asked.try_recv() {
                    Ok(Asked::Cancel) => wish = JobWish::Cancel,
                    Ok(Asked::HandIn(_, _, answer)) => {
                        let words = "a job of a page is under way; wait for its end, or abort it";
                        // A page that has gone is not told.
                        let _told = answer.send((0, Handed::Not(words.to_owned())));
                    }
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => {
                        wish = JobWish::Cancel;
                        break;
                    }
                }
            }
            request = request.wishing(wish);
            std::thread::sleep(POLL);
        }
    }
}

/// Asks once; `None` if there is no answer.
fn ask(
    queue: &mut dyn Client<JobRequest, JobReply>,
    request: &JobRequest,
) -> Result<Option<JobReply>, LinkError> {
    queue.ask(request)?;
    let started = Instant::now();
    while started.elapsed() < PATIENCE {
        if let Some(reply) = queue.reply()? {
            reply.check()?;
            return Ok(Some(reply));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    Ok(None)
}

/// The page that waits for a job.
struct Waiting {
    number: u64,
    answer: Option<Sender<(u64, Handed)>>,
    since: Instant,
}

impl Waiting {
    /// The job goes on: its page does not wait for long.
    fn look(&mut self) {
        if self.since.elapsed() >= SOON {
            self.tell(&Handed::Running);
        }
    }

    fn tell(&mut self, handed: &Handed) {
        if let Some(answer) = self.answer.take() {
            // A page that has gone is not told.
            let _told = answer.send((self.number, handed.clone()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_not_handed_in() {
        let line = |length| Wanted::Line("x".repeat(length)).request(1, 1, 5);
        assert!(line(1024).is_some() && line(1025).is_none());
        let file = Wanted::File {
            path: "/srv/programs/part.ngc".to_owned(),
            program: 99,
            tolerance_ratio: 2.0,
            from_line: 7,
            pass: 2,
            agreed: true,
            resumes: false,
        };
        let request = file.request(3, 4, 5).unwrap();
        assert_eq!(request.tolerance_ratio.to_bits(), 2.0_f64.to_bits());
        assert_eq!(
            (request.from_line, request.pass, request.confirmed),
            (7, 2, 1)
        );
        assert_eq!(request.program, 99, "what was looked at, and nothing else");
        assert_eq!((request.client, request.number, request.resumes), (3, 4, 0));
        assert_eq!(file.name(), "part.ngc");
    }
}
