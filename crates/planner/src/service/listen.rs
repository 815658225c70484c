//! The listening planner: programs that other processes stream segment by segment.
//!
//! One stream at a time; each is one epoch, from rest to rest. Between streams the planner waits
//! for the next client. The rules of a stream are in the module `stream`; here they meet the
//! ports.
//!
//! A client that dies leaves no trace in the transport that would be noticed in time, and one that
//! hangs leaves none at all. So a stream lives by its requests: after [`CLIENT_SILENCE`](crate::CLIENT_SILENCE) without
//! one it is over. If it has moved by then, the machine comes to rest at the end of what was accepted; if not, nothing
//! of it moves. A client with nothing to send repeats its last request. The motion begins with the end of the stream, or
//! with a request that comes when its first frame is ready.

mod received;

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_kinematics::LimitedMechanism;
use glidepath_link::{SegmentRefusal, Transport, tells_end};
use glidepath_program::Settings;

use crate::exchange::client_watch::ClientWatch;
use crate::exchange::machine::POLL;
use crate::exchange::stream::refuse;
use crate::exchange::stream::{SoftLimits, Stream};
use crate::plan::pipeline::Pipeline;
use crate::publish::epoch::Pace;
use crate::publish::frame_publisher::FramePublisher;
use crate::run::control::{Control, Notice};
use crate::run::error::RunError;
use crate::run::statistics::Statistics;
use crate::service::job::{Job, JobEnd, JobRunner};
use crate::service::job_client_handler::JobClientHandler;
use crate::service::job_queue::{JobQueue, NEWS};
use received::{REQUESTS_PER_TURN, Received, Segments, StreamClientHandler, StreamSource};

/// How long a machine that is not ready is looked at for whether it ended what a client asks for.
const LOOK: Duration = Duration::from_millis(20);

/// The settings of a listening planner.
#[derive(Debug, Clone, Copy)]
pub struct Listening {
    /// What to plan with.
    pub settings: Settings,
    /// What keeps joints inside their limits, where they are not axes.
    pub joints: Option<LimitedMechanism>,
    /// How to publish.
    pub pace: Pace,
    /// Where the axes may go; `None`: not checked.
    pub limits: Option<SoftLimits>,
}

/// Serves streams until the stop flag is set.
///
/// A stream that ends badly (abort, fault, a client that died) is told to its client and in a
/// notice; then the next one may come.
///
/// # Errors
/// [`RunError::Interrupted`] by the stop flag, [`RunError::PeriodMismatch`], or a failure of the link.
pub fn listen(
    transport: &dyn Transport,
    listening: &Listening,
    control: &mut Control<'_>,
) -> Result<(), RunError> {
    serve(transport, listening, None, control)
}

/// Serves streams, and the lines and files that operators hand in, until the stop flag is set.
///
/// # Errors
/// As [`listen`].
pub fn serve(
    transport: &dyn Transport,
    listening: &Listening,
    runner: Option<&mut dyn JobRunner>,
    control: &mut Control<'_>,
) -> Result<(), RunError> {
    let served = serve_all(transport, listening, runner, control);
    served.map_err(|error| match (&error, transport.stands()) {
        // Ports fail by that, too.
        (RunError::Link(_), Err(removed)) => removed.into(),
        _ => error,
    })
}

fn serve_all(
    transport: &dyn Transport,
    listening: &Listening,
    mut runner: Option<&mut dyn JobRunner>,
    control: &mut Control<'_>,
) -> Result<(), RunError> {
    let jobs = runner.is_some().then(|| JobQueue::open(transport));
    let mut listener = Listener {
        server: transport.segment_server()?,
        jobs: jobs.transpose()?,
        publisher: FramePublisher::connect(transport, listening.pace)?,
        last: None,
    };
    loop {
        if control.is_stopped() {
            return Err(RunError::Interrupted);
        }
        (control.notify)(&Notice::Listening);
        if let (Some(jobs), Some(runner)) = (&mut listener.jobs, &runner) {
            jobs.know(runner.facts());
        }
        let (stream, position) = match listener.accept(listening, control)? {
            Accepted::Stream(stream, position) => (*stream, position),
            Accepted::Job(job, start) => {
                if let Some(runner) = runner.as_deref_mut() {
                    listener.run(runner, &job, start, control)?;
                }
                continue;
            }
            Accepted::Reset => {
                if let Some(runner) = runner.as_deref_mut() {
                    runner.reset();
                }
                continue;
            }
        };
        (control.notify)(&Notice::StreamOpened {
            session: stream.session(),
        });
        match listener.execute(stream, position, listening, control) {
            Ok(statistics) => (control.notify)(&Notice::StreamExecuted(statistics)),
            Err(error) if ends_the_listener(&error) => return Err(error),
            Err(error) => (control.notify)(&Notice::StreamBroken(&error)),
        }
    }
}

/// Whether no other stream could do better.
const fn ends_the_listener(error: &RunError) -> bool {
    matches!(
        error,
        RunError::Interrupted | RunError::PeriodMismatch { .. } | RunError::Link(_)
    )
}

/// What is to be executed.
enum Accepted {
    Stream(Box<Stream>, AxisVector),
    Job(Job, AxisVector),
    /// A sender wants modes and offsets reset.
    Reset,
}

struct Listener<'t> {
    server: Box<Segments>,
    jobs: Option<JobQueue>,
    publisher: FramePublisher<'t>,
    /// The stream before, whose client may still ask how it ended.
    last: Option<Stream>,
}

impl Listener<'_> {
    /// Waits for a client that opens a stream, or hands in a job, and for the machine to be ready for
    /// it.
    fn accept(
        &mut self,
        listening: &Listening,
        control: &mut Control<'_>,
    ) -> Result<Accepted, RunError> {
        loop {
            if control.is_stopped() {
                return Err(RunError::Interrupted);
            }
            let is_ready = match self.publisher.ready() {
                Ok(position) => position.is_some(),
                Err(error) if ends_the_listener(&error) => return Err(error),
                Err(_) => false,
            };
            if let Some(accepted) = self.serve_jobs(control)? {
                return Ok(accepted);
            }
            let has_waiting = self.jobs.as_ref().is_some_and(JobQueue::has_waiting);
            if !has_waiting
                && let Some((stream, position)) =
                    self.serve_waiting(is_ready, listening.limits, control)?
            {
                return Ok(Accepted::Stream(Box::new(stream), position));
            }
            self.publisher.idle(control)?;
        }
    }

    /// Answers operators; returns a job that has the machine.
    fn serve_jobs(&mut self, control: &mut Control<'_>) -> Result<Option<Accepted>, RunError> {
        let (Some(jobs), publisher) = (&mut self.jobs, &mut self.publisher) else {
            return Ok(None);
        };
        if !jobs.has_waiting() {
            jobs.take(&mut |job, asked_ns| publisher.claim(&job.name(), asked_ns, control))?;
        }
        if !jobs.has_waiting() {
            return Ok(jobs.take_reset().then_some(Accepted::Reset));
        }
        let doing = publisher.doing();
        let unwanted = jobs.serve_busy(POLL, &doing)?;
        let taken = match unwanted {
            Some(why) => Err(RunError::Ended {
                why: why.to_owned(),
            }),
            None => publisher.tend(POLL).and_then(|()| publisher.take(control)),
        };
        match taken {
            Ok(Some(start)) => {
                let job = jobs.take_waiting();
                return Ok(job.map(|job| Accepted::Job(job, start)));
            }
            Ok(None) => {
                if jobs.wait(POLL, &publisher.why_not_ready()) {
                    publisher.release(control);
                }
            }
            Err(error) if ends_the_listener(&error) => return Err(error),
            Err(
                error @ (RunError::Aborted | RunError::NotBegun { .. } | RunError::Ended { .. }),
            ) => {
                publisher.release(control);
                jobs.finish(&JobEnd::Failed(error.to_string()));
            }
            Err(error) => {
                if jobs.wait(POLL, &error.to_string()) {
                    publisher.release(control);
                }
            }
        }
        Ok(None)
    }

    /// Answers what came in; returns a stream if one was opened.
    fn serve_waiting(
        &mut self,
        is_ready: bool,
        limits: Option<SoftLimits>,
        control: &mut Control<'_>,
    ) -> Result<Option<(Stream, AxisVector)>, RunError> {
        let (last, publisher) = (&mut self.last, &mut self.publisher);
        for _ in 0..REQUESTS_PER_TURN {
            let mut opened = None;
            let any = self.server.serve(&mut |request| {
                let known = last
                    .as_mut()
                    .filter(|last| last.session() == request.session);
                if let Some(last) = known {
                    return last.answer(request);
                }
                let stopped = |why| (SegmentRefusal::Stopped, why);
                // A stop after that counts for the stream, also if this planner has hung since.
                let asked_ns = match Stream::asked_ns(request) {
                    Ok(asked_ns) => asked_ns,
                    Err(refused) => return refuse(request, &refused),
                };
                // A machine that is not ready is told all the same: whoever stopped what was asked for ended it.
                let patience = if is_ready { NEWS } else { LOOK };
                let taken = publisher.take_for_stream((asked_ns, patience), control);
                let refused = match taken {
                    Ok(Some(position)) => match Stream::open(request, position, limits) {
                        Ok(mut stream) => {
                            let reply = stream.answer(request);
                            opened = Some((stream, position));
                            return reply;
                        }
                        Err(refused) => refused,
                    },
                    Ok(None) => stopped(publisher.why_not_ready()),
                    Err(RunError::Aborted) => {
                        let refusal = SegmentRefusal::Aborted;
                        (refusal, refusal.text().to_owned())
                    }
                    // Nor does it begin by being asked for again.
                    Err(RunError::NotBegun { why }) if tells_end(&why) => {
                        (SegmentRefusal::Aborted, format!("nothing moved: {why}"))
                    }
                    Err(error) => stopped(error.to_string()),
                };
                publisher.release(control);
                refuse(request, &refused)
            })?;
            // What follows in an opened stream is for the stream to answer.
            if opened.is_some() || !any {
                return Ok(opened);
            }
        }
        Ok(None)
    }

    /// Has a job executed; whoever asks for anything else meanwhile is told that the planner is
    /// busy.
    fn run(
        &mut self,
        runner: &mut dyn JobRunner,
        job: &Job,
        start: AxisVector,
        control: &mut Control<'_>,
    ) -> Result<(), RunError> {
        let Self {
            server,
            jobs,
            publisher,
            ..
        } = self;
        let Some(jobs) = jobs else { return Ok(()) };
        let mut handler = JobClientHandler {
            jobs,
            refuse: &mut |why| {
                let refused = (SegmentRefusal::Busy, why.to_owned());
                server
                    .serve(&mut |request| refuse(request, &refused))
                    .map(|_| ())
            },
            failed: Ok(()),
        };
        let end = runner.run(job, start, publisher, &mut handler, control);
        let failed = handler.failed;
        publisher.release(control);
        jobs.finish(&end);
        failed.map_err(Into::into)
    }

    /// Plans and publishes a stream to its end, and keeps it for its client's last questions.
    fn execute(
        &mut self,
        stream: Stream,
        position: AxisVector,
        listening: &Listening,
        control: &mut Control<'_>,
    ) -> Result<Statistics, RunError> {
        let received = Mutex::new(Received {
            stream,
            broken: None,
            idle: Duration::ZERO,
        });
        let mut handler = StreamClientHandler {
            server: self.server.as_mut(),
            received: &received,
            client: ClientWatch::new(),
            jobs: self.jobs.as_mut(),
        };
        let mut pipeline = Pipeline::new(StreamSource(&received), listening.settings, position)
            .with_joints(listening.joints)
            .of_stream();
        let outcome = self
            .publisher
            .publish_and_attend(&mut pipeline, &mut handler, control);
        let received = received.into_inner();
        let mut stream = received.unwrap_or_else(PoisonError::into_inner).stream;
        match &outcome {
            Ok(_) => stream.close(
                SegmentRefusal::NotOpen,
                "the stream was executed".to_owned(),
            ),
            Err(error) => stream.close(SegmentRefusal::Stopped, error.to_string()),
        }
        self.last = Some(stream);
        outcome
    }
}
