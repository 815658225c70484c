//! The planner's service: lines and files that operators want executed, one at a time.
//!
//! A request that is sent again asks how its job stands, so nothing is executed twice. While a job
//! runs, others are told that the service is busy. One that comes while the machine is not ready
//! waits a moment before it is refused: what is known of the machine is from before whatever made it
//! ready just now.

use std::path::PathBuf;
use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{JobKind, JobReply, JobRequest, JobState, LinkError, Record as _, Server};

use crate::{Control, Publisher, StartLine};

/// Requests served between two looks at the motion.
const REQUESTS_PER_TURN: u32 = 32;
/// How long a job waits for a machine that is not ready.
const NEWS: Duration = Duration::from_millis(250);

/// Something to execute.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Job {
    /// A line.
    Line(String),
    /// A program.
    File {
        /// Where it is.
        path: PathBuf,
        /// Where to begin; `None`: at its beginning.
        from: Option<StartLine>,
        /// What was told of that beginning is agreed to.
        confirmed: bool,
    },
}

impl Job {
    fn of(request: &JobRequest) -> Option<Self> {
        let text = request.text.as_str();
        Some(match request.kind().ok()? {
            JobKind::Line => Self::Line(text.to_owned()),
            JobKind::File => Self::File {
                path: text.into(),
                from: (request.from_line > 0).then(|| StartLine {
                    line: request.from_line,
                    pass: request.pass.max(1),
                }),
                confirmed: request.confirmed == 1,
            },
        })
    }
}

/// How a job ended, with words for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum JobEnd {
    /// It was executed to its end.
    Done(String),
    /// It was refused: nothing has changed, and nothing moved.
    Refused(String),
    /// The motion ended before it did.
    Failed(String),
    /// It begins in a way that has to be agreed to.
    ToConfirm(String),
}

/// Who executes jobs.
pub trait JobRunner {
    /// Executes a job, for a machine that stands at a position. `attend` is to be called every few
    /// milliseconds while the machine moves.
    fn run(
        &mut self,
        job: &Job,
        start: AxisVector,
        publisher: &mut Publisher<'_>,
        attend: &mut dyn FnMut(Duration),
        control: &mut Control<'_>,
    ) -> JobEnd;
}

/// Where jobs are handed in.
pub(crate) struct JobDesk {
    server: Box<dyn Server<JobRequest, JobReply>>,
    /// The job taken last, and how it stands.
    last: Option<JobReply>,
    /// That job, and how long it has waited for the machine to be ready.
    waiting: Option<(Job, Duration)>,
}

impl JobDesk {
    pub(crate) const fn new(server: Box<dyn Server<JobRequest, JobReply>>) -> Self {
        Self {
            server,
            last: None,
            waiting: None,
        }
    }

    /// Answers what came in while nothing is executed; returns a job if one is to be executed now.
    /// `waited` is the time since the last call.
    pub(crate) fn serve_idle(
        &mut self,
        ready: &Result<AxisVector, String>,
        waited: Duration,
    ) -> Result<Option<(Job, AxisVector)>, LinkError> {
        if self.waiting.is_none() {
            self.take()?;
        } else {
            self.serve_busy("waits for the machine to be ready")?;
        }
        match (self.waiting.take(), ready) {
            (Some((job, _)), Ok(start)) => Ok(Some((job, *start))),
            (Some((_, since)), Err(why)) if since >= NEWS => {
                self.end(JobState::NotReady, why);
                Ok(None)
            }
            (Some((job, since)), Err(_)) => {
                self.waiting = Some((job, since + waited));
                Ok(None)
            }
            (None, _) => Ok(None),
        }
    }

    /// Takes the next job that came in.
    fn take(&mut self) -> Result<(), LinkError> {
        for _ in 0..REQUESTS_PER_TURN {
            let (last, waiting) = (&mut self.last, &mut self.waiting);
            let any = self.server.serve(&mut |request| {
                if let Some(known) = answered(*last, request) {
                    return known;
                }
                if let Err(error) = request.check() {
                    return JobReply::new(request, JobState::Refused, &error.to_string());
                }
                let Some(job) = Job::of(request) else {
                    return JobReply::new(request, JobState::Refused, "unknown");
                };
                *waiting = Some((job, Duration::ZERO));
                *last.insert(JobReply::new(request, JobState::Running, ""))
            })?;
            if self.waiting.is_some() || !any {
                break;
            }
        }
        Ok(())
    }

    /// Answers what came in while something is executed.
    pub(crate) fn serve_busy(&mut self, what: &str) -> Result<(), LinkError> {
        for _ in 0..REQUESTS_PER_TURN {
            let last = self.last;
            let any = self.server.serve(&mut |request| {
                answered(last, request)
                    .unwrap_or_else(|| JobReply::new(request, JobState::Busy, what))
            })?;
            if !any {
                break;
            }
        }
        Ok(())
    }

    /// The job taken last has ended.
    pub(crate) fn finish(&mut self, end: &JobEnd) {
        let (state, text) = match end {
            JobEnd::Done(text) => (JobState::Done, text),
            JobEnd::Refused(text) => (JobState::Refused, text),
            JobEnd::Failed(text) => (JobState::Failed, text),
            JobEnd::ToConfirm(text) => (JobState::ToConfirm, text),
        };
        self.end(state, text);
    }

    fn end(&mut self, state: JobState, text: &str) {
        if let Some(last) = &mut self.last {
            (last.state, last.text) = (state.code(), glidepath_link::LongText::new(text));
        }
    }
}

/// The answer to a request that was answered before.
fn answered(last: Option<JobReply>, request: &JobRequest) -> Option<JobReply> {
    last.filter(|last| (last.client, last.number) == (request.client, request.number))
}
