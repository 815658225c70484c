//! The listening planner: programs that other processes stream segment by segment.
//!
//! One stream at a time; each is one epoch, from rest to rest. Between streams the planner waits
//! for the next client. The rules of a stream are in the module `stream`; here they meet the
//! ports.
//!
//! A client that dies leaves no trace in the transport that would be noticed in time, and one that
//! hangs leaves none at all. So a stream lives by its requests: after [`CLIENT_SILENCE`] without
//! one it is over, and the machine comes to rest at the end of what was accepted. A client with
//! nothing to send repeats its last request.

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_kinematics::PathCaps;
use glidepath_link::{LinkError, SegmentRefusal, SegmentReply, SegmentRequest, Server, Transport};
use glidepath_motion::PlanError;
use glidepath_program::Settings;

use crate::stream::refuse;
use crate::{
    Control, ItemSource, Notice, Pace, Pipeline, Publisher, Refusal, RunError, SoftLimits,
    Statistics, Stream, Supply,
};

/// A client from which nothing was heard for so long is taken for dead.
pub const CLIENT_SILENCE: Duration = Duration::from_secs(2);

/// Requests served between two looks at the motion.
const REQUESTS_PER_TURN: u32 = 256;

type Segments = dyn Server<SegmentRequest, SegmentReply>;

/// What a listening planner needs to know.
#[derive(Debug, Clone, Copy)]
pub struct Listening {
    /// What to plan with.
    pub settings: Settings,
    /// What keeps joints inside their limits, where they are not axes.
    pub joints: Option<PathCaps>,
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
    let mut listener = Listener {
        server: transport.segment_server()?,
        publisher: Publisher::connect(transport, listening.pace)?,
        last: None,
    };
    loop {
        (control.notify)(&Notice::Listening);
        let (stream, position) = listener.accept(listening, control)?;
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

struct Listener<'t> {
    server: Box<Segments>,
    publisher: Publisher<'t>,
    /// The stream before, whose client may still ask how it ended.
    last: Option<Stream>,
}

impl Listener<'_> {
    /// Waits for a client that opens a stream while the machine is ready for it.
    fn accept(
        &mut self,
        listening: &Listening,
        control: &mut Control<'_>,
    ) -> Result<(Stream, AxisVector), RunError> {
        loop {
            if control.is_stopped() {
                return Err(RunError::Interrupted);
            }
            let ready = match self.publisher.ready(control) {
                Ok(Some(position)) => Ok(position),
                Ok(None) => Err("the machine is not ready for a program".to_owned()),
                Err(error) if ends_the_listener(&error) => return Err(error),
                Err(error) => Err(error.to_string()),
            };
            if let Some(opened) = self.serve_waiting(&ready, listening.limits)? {
                return Ok(opened);
            }
            self.publisher.idle(control)?;
        }
    }

    /// Answers what came in; returns a stream if one was opened.
    fn serve_waiting(
        &mut self,
        ready: &Result<AxisVector, String>,
        limits: Option<SoftLimits>,
    ) -> Result<Option<(Stream, AxisVector)>, RunError> {
        let last = &mut self.last;
        for _ in 0..REQUESTS_PER_TURN {
            let mut opened = None;
            let any = self.server.serve(&mut |request| {
                let known = last
                    .as_mut()
                    .filter(|last| last.session() == request.session);
                if let Some(last) = known {
                    return last.answer(request);
                }
                let refused = match ready {
                    Ok(position) => match Stream::open(request, *position, limits) {
                        Ok(mut stream) => {
                            let reply = stream.answer(request);
                            opened = Some((stream, *position));
                            return reply;
                        }
                        Err(refused) => refused,
                    },
                    Err(why) => (SegmentRefusal::Stopped, why.clone()),
                };
                refuse(request, &refused)
            })?;
            // What follows in an opened stream is for the stream to answer.
            if opened.is_some() || !any {
                return Ok(opened);
            }
        }
        Ok(None)
    }

    /// Plans and publishes a stream to its end, and keeps it for its client's last questions.
    fn execute(
        &mut self,
        stream: Stream,
        position: AxisVector,
        listening: &Listening,
        control: &mut Control<'_>,
    ) -> Result<Statistics, RunError> {
        let source = StreamSource::new(self.server.as_mut(), stream);
        let mut pipeline =
            Pipeline::new(source, listening.settings, position).with_joints(listening.joints);
        let outcome = self.publisher.publish(&mut pipeline, control);
        let mut stream = pipeline.into_source().stream;
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

/// The items of a stream, received while they are planned.
struct StreamSource<'s> {
    server: &'s mut Segments,
    stream: Stream,
    /// Time since the last request of the stream.
    silent: Duration,
    /// Why the stream ended without its client saying so.
    broken: Option<Refusal>,
}

impl<'s> StreamSource<'s> {
    const fn new(server: &'s mut Segments, stream: Stream) -> Self {
        Self {
            server,
            stream,
            silent: Duration::ZERO,
            broken: None,
        }
    }

    /// Ends the stream here: what was accepted is executed.
    fn give_up(&mut self, broken: Refusal) {
        if self.stream.is_open() {
            self.stream
                .close(SegmentRefusal::Stopped, broken.to_string());
            self.broken = Some(broken);
        }
    }

    /// Answers what came in.
    fn serve(&mut self) -> Result<(), LinkError> {
        let Self {
            server,
            stream,
            silent,
            ..
        } = self;
        for _ in 0..REQUESTS_PER_TURN {
            let any = server.serve(&mut |request| {
                if request.session == stream.session() {
                    *silent = Duration::ZERO;
                }
                stream.answer(request)
            })?;
            if !any {
                break;
            }
        }
        Ok(())
    }
}

impl ItemSource for StreamSource<'_> {
    fn next_item(&mut self) -> Supply {
        if let Some(item) = self.stream.pop() {
            return Supply::Item(item);
        }
        if let Some(broken) = self.broken.take() {
            return Supply::Refused(broken);
        }
        if self.stream.is_open() {
            Supply::Pending
        } else {
            Supply::End
        }
    }

    fn attend(&mut self, waited: Duration) {
        self.silent = self.silent.saturating_add(waited);
        if let Err(error) = self.serve() {
            self.give_up(Refusal::StreamFailed(error));
        } else if self.stream.is_open() && self.silent >= CLIENT_SILENCE {
            self.give_up(Refusal::ClientLost {
                accepted: self.stream.accepted(),
            });
        }
    }

    fn unplannable(&mut self, error: &PlanError) {
        self.stream
            .close(SegmentRefusal::Unplannable, error.to_string());
    }

    fn lines_read(&self) -> u64 {
        self.stream.accepted()
    }
}
