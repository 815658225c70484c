//! The job queue of the planner's service: lines and files that operators want executed, one at a
//! time.
//!
//! A request that is sent again asks how its job stands, and answers are remembered, so nothing is
//! executed twice. While a job runs, others are told that the service is busy. One that comes while the
//! machine is not ready waits a moment before it is refused: what is known of the machine is from before
//! whatever made it ready just now.
//!
//! A job that has not begun lives by its client, which asks again and again. One that says that it does
//! not want it any more, or of which nothing is heard for [`CLIENT_SILENCE`](crate::CLIENT_SILENCE), ends it; and before the
//! first frame it has to ask once more, so that nothing begins for a client that ended while this
//! process could not notice. Once the machine moves, the motion goes on without its client.

use std::collections::VecDeque;
use std::time::Duration;

use glidepath_link::{
    CALLED_OFF, JobReply, JobRequest, JobState, JobWish, LinkError, LongText, Record as _, Server,
    Transport,
};

use crate::exchange::client_watch::ClientWatch;
use crate::exchange::line_server::{LineServer, SentJob};
use crate::service::job::{Job, JobEnd};
use crate::source::sent::LinesEnd;
use crate::source::sent::{Followed, LineFacts, LineInbox};

/// Requests served between two looks at the motion.
const REQUESTS_PER_TURN: u32 = 32;
/// How long a job waits for a machine that is not ready.
pub(crate) const NEWS: Duration = Duration::from_millis(250);
/// Answers that are remembered: several for each client that there may be.
const REMEMBERED: usize = 64;

/// The job that was taken.
#[derive(Debug)]
struct Current {
    /// For people.
    name: String,
    client: (u64, u64),
    watch: ClientWatch,
    is_unwanted: bool,
    /// What its client should know of its program, a line for each.
    warnings: String,
    /// The lines that it is made of.
    lines: Option<LineInbox>,
}

impl Current {
    /// Of a job of which nothing is known yet.
    fn new(job: &Job, client: (u64, u64), lines: Option<LineInbox>) -> Self {
        Self {
            name: job.name(),
            client,
            watch: ClientWatch::new(),
            is_unwanted: false,
            warnings: String::new(),
            lines,
        }
    }

    /// So long was meant to pass since the last look.
    fn wait(&mut self, meant: Duration) {
        self.watch.wait(meant);
        if let Some(lines) = self.lines.as_ref().filter(|_| self.watch.is_silent()) {
            lines.close();
        }
    }

    /// Its client asks.
    const fn hear(&mut self, wish: JobWish) {
        self.watch.hear();
        self.is_unwanted |= matches!(wish, JobWish::Cancel);
    }

    /// What its client is told while it is `doing` something. Before the first frame the client asks once more, so that
    /// the warnings reach it before anything moves.
    fn told(&self, doing: &str) -> String {
        match self.warnings.as_str() {
            "" => doing.to_owned(),
            warnings => format!("{doing}\n{warnings}"),
        }
    }

    /// Why it is to end, if it is.
    fn unwanted(&self) -> Option<&'static str> {
        if self.is_unwanted {
            return Some(CALLED_OFF);
        }
        self.watch.why_not_begun()
    }
}

/// The queue at which jobs are handed in.
pub(crate) struct JobQueue {
    server: Box<dyn Server<JobRequest, JobReply>>,
    lines: LineServer,
    current: Option<Current>,
    /// That job, and how long it has waited for the machine to be ready.
    waiting: Option<(Job, Duration)>,
    /// How the jobs before have ended, the last one last.
    past: VecDeque<JobReply>,
}

impl JobQueue {
    pub(crate) fn open(transport: &dyn Transport) -> Result<Self, LinkError> {
        Ok(Self {
            server: transport.job_server()?,
            lines: LineServer::open(transport)?,
            current: None,
            waiting: None,
            past: VecDeque::new(),
        })
    }

    /// How the machine is set up from now on, as senders are told.
    pub(crate) fn know(&mut self, facts: Option<LineFacts>) {
        self.lines.know(facts.unwrap_or_default());
    }

    /// Answers what came in while nothing is executed, and takes a job, if one came: `claim` is called
    /// with it, and with when it was asked for, before its client is told.
    pub(crate) fn take(&mut self, claim: &mut dyn FnMut(&Job, u64)) -> Result<(), LinkError> {
        for _ in 0..REQUESTS_PER_TURN {
            let (current, past) = (&mut self.current, &self.past);
            let waiting = &mut self.waiting;
            let any = self.server.serve(&mut |request| {
                let wish = match judged(past, request) {
                    Ok(wish) => wish,
                    Err(reply) => return *reply,
                };
                let Some(job) = Job::of(request).filter(|_| wish == JobWish::Execute) else {
                    return unknown(request);
                };
                claim(&job, request.asked_ns);
                let client = (request.client, request.number);
                *current = Some(Current::new(&job, client, None));
                *waiting = Some((job, Duration::ZERO));
                JobReply::new(request, JobState::Running, "waits for the machine")
            })?;
            if self.waiting.is_some() || !any {
                break;
            }
        }
        if self.waiting.is_some() {
            return Ok(());
        }
        if let Some(begun) = self.lines.take()? {
            let SentJob {
                client,
                name,
                asked_ns,
                inbox,
            } = begun;
            let lines = Some(inbox.clone());
            let job = Job::Lines { name, inbox };
            self.current = Some(Current::new(&job, client, lines));
            claim(&job, asked_ns);
            self.waiting = Some((job, Duration::ZERO));
        }
        Ok(())
    }

    /// Whether a sender wants modes and offsets reset, which is to be done at once.
    pub(crate) fn take_reset(&mut self) -> bool {
        self.lines.take_reset()
    }

    /// Whether a job waits for the machine.
    pub(crate) const fn has_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// The job that waits has the machine.
    pub(crate) fn take_waiting(&mut self) -> Option<Job> {
        self.waiting.take().map(|(job, _)| job)
    }

    /// A job waits on. Returns how it ends, if it has waited for long enough.
    pub(crate) fn wait(&mut self, waited: Duration, why: &str) -> bool {
        let Some((_, since)) = &mut self.waiting else {
            return false;
        };
        *since += waited;
        if *since < NEWS {
            return false;
        }
        self.end(JobState::NotReady, why);
        true
    }

    /// What others are told while a job is executed, or waits; without one somebody else has the planner.
    pub(crate) fn busy(&self) -> String {
        match &self.current {
            Some(current) => format!(
                "the planner executes {}; wait for its end, or end it with `glidepath abort`",
                current.name
            ),
            None => "the planner executes what another program streams; wait for its end, or end it with \
                     `glidepath abort`"
                .to_owned(),
        }
    }

    /// Answers what came in while a job is `doing` something, or somebody else has the planner.
    /// Returns why the job is to end, if its client does not want it any more.
    pub(crate) fn serve_busy(
        &mut self,
        waited: Duration,
        doing: &str,
    ) -> Result<Option<&'static str>, LinkError> {
        let busy = &self.busy();
        if let Some(current) = &mut self.current {
            current.wait(waited);
        }
        let lines = self
            .current
            .as_ref()
            .and_then(|it| Some((it.client, it.lines.clone()?)));
        for wish in self.lines.serve(lines.as_ref(), busy)? {
            if let Some(current) = &mut self.current {
                current.hear(wish);
            }
        }
        for _ in 0..REQUESTS_PER_TURN {
            let (current, past) = (&mut self.current, &self.past);
            let any = self.server.serve(&mut |request| {
                let wish = match judged(past, request) {
                    Ok(wish) => wish,
                    Err(reply) => return *reply,
                };
                match current {
                    Some(current) if current.client == (request.client, request.number) => {
                        current.hear(wish);
                        JobReply::new(request, JobState::Running, &current.told(doing))
                    }
                    _ if wish == JobWish::Execute => JobReply::new(request, JobState::Busy, busy),
                    _ => unknown(request),
                }
            })?;
            if !any {
                break;
            }
        }
        Ok(self.current.as_ref().and_then(Current::unwanted))
    }

    /// What the client of the job should know of its program.
    pub(crate) fn warn(&mut self, warnings: &str) {
        if let Some(current) = &mut self.current {
            warnings.clone_into(&mut current.warnings);
        }
    }

    /// How far the job is executed.
    pub(crate) fn follow(&self, followed: &Followed) {
        let lines = self.current.as_ref().and_then(|it| it.lines.as_ref());
        if let Some(lines) = lines {
            lines.follow(followed);
        }
    }

    /// The first frame of the job is ready. Returns whether it may be published: its client has asked
    /// since.
    pub(crate) fn may_begin(&mut self) -> bool {
        let current = self.current.as_mut();
        current.is_none_or(|current| current.watch.may_begin())
    }

    /// The job has ended.
    pub(crate) fn finish(&mut self, end: &JobEnd) {
        let (state, text) = match end {
            JobEnd::Done(text) => (JobState::Done, text),
            JobEnd::Refused(text) => (JobState::Refused, text),
            JobEnd::Failed(text) => (JobState::Failed, text),
            JobEnd::ToConfirm(text) => (JobState::ToConfirm, text),
            JobEnd::Changed(text) => (JobState::Changed, text),
        };
        self.end(state, text);
    }

    fn end(&mut self, state: JobState, text: &str) {
        self.waiting = None;
        let Some(Current { client, lines, .. }) = self.current.take() else {
            return;
        };
        if let Some(lines) = lines {
            let end = match state {
                JobState::Done => LinesEnd::Done,
                JobState::Failed => LinesEnd::Failed,
                JobState::Running
                | JobState::Refused
                | JobState::Busy
                | JobState::NotReady
                | JobState::ToConfirm
                | JobState::Unknown
                | JobState::Changed => LinesEnd::NotBegun,
            };
            self.lines.end(client, lines, (end, text));
            return;
        }
        if self.past.len() == REMEMBERED {
            self.past.pop_front();
        }
        self.past.push_back(JobReply {
            client: client.0,
            number: client.1,
            state: state.code(),
            reserved: 0,
            text: LongText::new(text),
        });
    }
}

/// What a request wants of a job that has not ended, or the answer to it.
fn judged(past: &VecDeque<JobReply>, request: &JobRequest) -> Result<JobWish, Box<JobReply>> {
    let is_it =
        |reply: &&JobReply| (reply.client, reply.number) == (request.client, request.number);
    if let Some(known) = past.iter().rev().find(is_it) {
        return Err(Box::new(*known));
    }
    request
        .check()
        .and_then(|()| request.wish())
        .map_err(|error| {
            Box::new(JobReply::new(
                request,
                JobState::Refused,
                &error.to_string(),
            ))
        })
}

fn unknown(request: &JobRequest) -> JobReply {
    const WHY: &str = "the planner knows nothing of this job: it was started anew; `glidepath status` \
                       tells what the machine does";
    JobReply::new(request, JobState::Unknown, WHY)
}
