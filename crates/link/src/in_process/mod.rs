//! The transport inside one process: for tests, and for planning without a machine.
//!
//! It behaves as the transport between processes does, seen through the ports: the same order, the
//! same back-pressure, the same loss. Its queues are behind a lock, which only port calls take.

mod queue;
mod request;
mod shared;
mod topic;

use crate::service::{
    AUXILIARY, COMMANDS, Capacity, FEEDBACK, FEEDBACK_DEPTH, FRAMES, JOBS, JOG, JOG_DEPTH, LINES,
    PEERS, SEGMENTS, SENDERS, SETPOINTS, STATUS,
};
use crate::{
    Auxiliary, Client, CommandReply, CommandRequest, Feedback, FrameSink, JobReply, JobRequest,
    JogDemand, LinesReply, LinesRequest, LinkError, Publisher, SegmentReply, SegmentRequest,
    Server, Setpoint, SetpointFrame, Status, Subscriber, Transport,
};
use queue::FrameQueue;
use request::Exchange;
use shared::Shared;
use topic::Topic;

/// All services of one instance. Clones are ways to the same instance, for other threads.
#[derive(Debug, Clone)]
pub struct InProcess {
    frames: Shared<FrameQueue>,
    setpoints: Shared<Topic<Setpoint>>,
    status: Shared<Topic<Status>>,
    auxiliary: Shared<Topic<Auxiliary>>,
    feedback: Shared<Topic<Feedback>>,
    jog: Shared<Topic<JogDemand>>,
    commands: Shared<Exchange<CommandRequest, CommandReply>>,
    segments: Shared<Exchange<SegmentRequest, SegmentReply>>,
    jobs: Shared<Exchange<JobRequest, JobReply>>,
    lines: Shared<Exchange<LinesRequest, LinesReply>>,
}

impl InProcess {
    /// A new instance, which nothing else can reach but clones of this.
    #[must_use]
    pub fn new(capacity: Capacity) -> Self {
        Self {
            frames: Shared::new(FrameQueue::new(FRAMES, capacity.frames)),
            setpoints: Shared::new(Topic::new(
                SETPOINTS,
                capacity.setpoints,
                capacity.subscribers,
                SENDERS,
            )),
            status: Shared::new(Topic::new(STATUS, 1, capacity.subscribers, SENDERS)),
            auxiliary: Shared::new(Topic::new(AUXILIARY, 1, capacity.subscribers, SENDERS)),
            feedback: Shared::new(Topic::new(
                FEEDBACK,
                FEEDBACK_DEPTH,
                capacity.subscribers,
                PEERS,
            )),
            jog: Shared::new(Topic::new(JOG, JOG_DEPTH, capacity.subscribers, PEERS)),
            commands: Shared::new(Exchange::new(COMMANDS)),
            segments: Shared::new(Exchange::new(SEGMENTS)),
            jobs: Shared::new(Exchange::new(JOBS)),
            lines: Shared::new(Exchange::new(LINES)),
        }
    }
}

impl Default for InProcess {
    fn default() -> Self {
        Self::new(Capacity::default())
    }
}

impl Transport for InProcess {
    fn frame_sink(&self) -> Result<Box<dyn FrameSink>, LinkError> {
        Ok(Box::new(queue::Sink::new(&self.frames)?))
    }

    fn frame_source(&self) -> Result<Box<dyn Subscriber<SetpointFrame>>, LinkError> {
        Ok(Box::new(queue::Source::new(&self.frames)?))
    }

    fn setpoint_sink(&self) -> Result<Box<dyn Publisher<Setpoint>>, LinkError> {
        Ok(Box::new(topic::Sink::new(&self.setpoints)?))
    }

    fn setpoint_source(&self) -> Result<Box<dyn Subscriber<Setpoint>>, LinkError> {
        Ok(Box::new(topic::Source::new(&self.setpoints)?))
    }

    fn status_sink(&self) -> Result<Box<dyn Publisher<Status>>, LinkError> {
        Ok(Box::new(topic::Sink::new(&self.status)?))
    }

    fn status_source(&self) -> Result<Box<dyn Subscriber<Status>>, LinkError> {
        Ok(Box::new(topic::Source::new(&self.status)?))
    }

    fn auxiliary_sink(&self) -> Result<Box<dyn Publisher<Auxiliary>>, LinkError> {
        Ok(Box::new(topic::Sink::new(&self.auxiliary)?))
    }

    fn auxiliary_source(&self) -> Result<Box<dyn Subscriber<Auxiliary>>, LinkError> {
        Ok(Box::new(topic::Source::new(&self.auxiliary)?))
    }

    fn feedback_sink(&self) -> Result<Box<dyn Publisher<Feedback>>, LinkError> {
        Ok(Box::new(topic::Sink::new(&self.feedback)?))
    }

    fn feedback_source(&self) -> Result<Box<dyn Subscriber<Feedback>>, LinkError> {
        Ok(Box::new(topic::Source::new(&self.feedback)?))
    }

    fn jog_sink(&self) -> Result<Box<dyn Publisher<JogDemand>>, LinkError> {
        Ok(Box::new(topic::Sink::new(&self.jog)?))
    }

    fn jog_source(&self) -> Result<Box<dyn Subscriber<JogDemand>>, LinkError> {
        Ok(Box::new(topic::Source::new(&self.jog)?))
    }

    fn command_client(&self) -> Result<Box<dyn Client<CommandRequest, CommandReply>>, LinkError> {
        Ok(Box::new(request::Asking::new(&self.commands)?))
    }

    fn command_server(&self) -> Result<Box<dyn Server<CommandRequest, CommandReply>>, LinkError> {
        Ok(Box::new(request::Answering::new(&self.commands)?))
    }

    fn segment_client(&self) -> Result<Box<dyn Client<SegmentRequest, SegmentReply>>, LinkError> {
        Ok(Box::new(request::Asking::new(&self.segments)?))
    }

    fn segment_server(&self) -> Result<Box<dyn Server<SegmentRequest, SegmentReply>>, LinkError> {
        Ok(Box::new(request::Answering::new(&self.segments)?))
    }

    fn job_client(&self) -> Result<Box<dyn Client<JobRequest, JobReply>>, LinkError> {
        Ok(Box::new(request::Asking::new(&self.jobs)?))
    }

    fn job_server(&self) -> Result<Box<dyn Server<JobRequest, JobReply>>, LinkError> {
        Ok(Box::new(request::Answering::new(&self.jobs)?))
    }

    fn lines_client(&self) -> Result<Box<dyn Client<LinesRequest, LinesReply>>, LinkError> {
        Ok(Box::new(request::Asking::new(&self.lines)?))
    }

    fn lines_server(&self) -> Result<Box<dyn Server<LinesRequest, LinesReply>>, LinkError> {
        Ok(Box::new(request::Answering::new(&self.lines)?))
    }

    fn clean_up_dead_peers(&self) -> Result<usize, LinkError> {
        Ok(0) // A port that ends says so when it is dropped, and nothing ends without that here.
    }

    fn stands(&self) -> Result<(), LinkError> {
        Ok(()) // It is found by clones of itself.
    }

    fn interpolator_process(&self) -> Option<i32> {
        None
    }
}
