//! The ports: how a process takes part in an instance, whatever the transport.
//!
//! ```text
//!   planner ──FrameSink──► Subscriber<SetpointFrame>  interpolator
//!   clients ──Client<CommandRequest, …>──► Server     interpolator
//!   clients ──Client<SegmentRequest, …>──► Server     planner
//!   operators ──Client<JobRequest, …>──► Server       planner
//!   senders ──Client<LinesRequest, …>──► Server       planner
//!   interpolator ──Publisher<Setpoint>, Publisher<Status>──► Subscriber  anybody
//!   interpolator ──Publisher<Auxiliary>──► Subscriber     spindle, coolant, tools, outputs
//!   servo stacks ──Publisher<Feedback>──► Subscriber      interpolator, anybody
//!   panels ──Publisher<JogDemand>──► Subscriber           interpolator
//! ```
//!
//! No call here waits for the other side; waiting is the caller's, who knows for how long and what
//! may end it ([`FrameSink::send`] does it for frames). Records are handed over as they arrived:
//! the receiver checks them.
//!
//! Ports belong to the thread that made them. They may allocate and make system calls; no real-time
//! thread calls them.

use crate::{
    Auxiliary, CommandReply, CommandRequest, Feedback, JobReply, JobRequest, JogDemand, LinesReply,
    LinesRequest, LinkError, SegmentReply, SegmentRequest, Setpoint, SetpointFrame, Status,
};
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::time::Instant;

/// The outcome of sending a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Delivery {
    /// It is in the consumer's queue. The consumer may still die with it there: only the executed
    /// sequence in a [`Status`] says that it was used.
    Delivered,
    /// The consumer's queue is full. The frame went nowhere; offer it again.
    Full,
    /// Nobody is connected (any more, or not yet). The frame went nowhere; offer it again.
    NoConsumer,
}

/// The planner's end of the frame queue: ordered and lossless.
pub trait FrameSink {
    /// Puts a frame into the consumer's queue if there is room, at once.
    ///
    /// # Errors
    ///
    /// A failure of the transport. The frame went nowhere.
    fn offer(&mut self, frame: &SetpointFrame) -> Result<Delivery, LinkError>;

    /// Offers a frame until it is delivered, `patience` is over, or `stop` is set, whichever comes
    /// first; the result is that of the last offer.
    ///
    /// # Errors
    ///
    /// A failure of the transport. The frame went nowhere.
    fn send(
        &mut self,
        frame: &SetpointFrame,
        patience: Duration,
        stop: &AtomicBool,
    ) -> Result<Delivery, LinkError> {
        let started = Instant::now();
        loop {
            let delivery = self.offer(frame)?;
            let over = started.elapsed() >= patience || stop.load(Ordering::Relaxed);
            if delivery == Delivery::Delivered || over {
                return Ok(delivery);
            }
            std::thread::sleep(RETRY);
        }
    }
}

/// Between two offers of the same frame: well below a period's worth of the queue.
const RETRY: Duration = Duration::from_millis(1);

/// The sending end of a topic: any number of subscribers, none of which is ever waited for.
pub trait Publisher<R> {
    /// Hands a record to every subscriber. One whose queue is full loses its oldest.
    ///
    /// # Errors
    ///
    /// A failure of the transport, never a slow or missing subscriber.
    fn publish(&mut self, record: &R) -> Result<(), LinkError>;

    /// Lets subscribers that came since the last call have the last record. To be called now and
    /// then by a publisher that may be silent for long.
    ///
    /// # Errors
    ///
    /// A failure of the transport.
    fn refresh(&mut self) -> Result<(), LinkError>;
}

/// The receiving end of a topic or of the frame queue.
pub trait Subscriber<R> {
    /// The next record, unchecked; `None` if there is none yet.
    ///
    /// # Errors
    ///
    /// A failure of the transport.
    fn take(&mut self) -> Result<Option<R>, LinkError>;
}

impl<R, S: Subscriber<R> + ?Sized> Subscriber<R> for Box<S> {
    fn take(&mut self) -> Result<Option<R>, LinkError> {
        (**self).take()
    }
}

/// Requests of one client that may be unanswered at a time.
pub const MAX_UNANSWERED: usize = 32;

/// The asking end of a request-response service.
pub trait Client<Q, A> {
    /// Sends a request. At most [`MAX_UNANSWERED`] may be unanswered at a time.
    ///
    /// # Errors
    ///
    /// [`LinkError::NoServer`], [`LinkError::TooManyRequests`], or a failure of the transport. The
    /// request went nowhere.
    fn ask(&mut self, request: &Q) -> Result<(), LinkError>;

    /// The next answer, unchecked, in the order of the requests; `None` if there is none yet.
    ///
    /// # Errors
    ///
    /// [`LinkError::NoServer`] if the server went away with a request unanswered: what was asked
    /// may or may not have been done. All requests under way are forgotten.
    fn reply(&mut self) -> Result<Option<A>, LinkError>;

    /// Asks, and waits at most `patience` for the answer; `None` if there was none. To be used with
    /// no other request under way.
    ///
    /// # Errors
    ///
    /// As [`Client::ask`] and [`Client::reply`].
    fn call(&mut self, request: &Q, patience: Duration) -> Result<Option<A>, LinkError> {
        let started = Instant::now();
        self.ask(request)?;
        loop {
            let answer = self.reply()?;
            if answer.is_some() || started.elapsed() >= patience {
                return Ok(answer);
            }
            std::thread::sleep(RETRY);
        }
    }
}

/// The answering end of a request-response service.
pub trait Server<Q, A> {
    /// Answers the next request, if there is one, by calling `answer` with it, unchecked. Returns
    /// whether there was one.
    ///
    /// # Errors
    ///
    /// A failure of the transport. A client that went away is none.
    fn serve(&mut self, answer: &mut dyn FnMut(&Q) -> A) -> Result<bool, LinkError>;
}

/// The way to the services of one instance, for one thread.
///
/// # Errors
///
/// The functions that make ports tell why a port cannot be made.
#[allow(
    clippy::missing_errors_doc,
    reason = "said once for all functions alike"
)]
pub trait Transport {
    /// For the planner. One at a time is meant to send; a second one may connect while the first,
    /// dead, is not yet cleaned up.
    fn frame_sink(&self) -> Result<Box<dyn FrameSink>, LinkError>;
    /// For the interpolator, the only one.
    fn frame_source(&self) -> Result<Box<dyn Subscriber<SetpointFrame>>, LinkError>;
    /// For the interpolator.
    fn setpoint_sink(&self) -> Result<Box<dyn Publisher<Setpoint>>, LinkError>;
    /// For servo stacks and monitors.
    fn setpoint_source(&self) -> Result<Box<dyn Subscriber<Setpoint>>, LinkError>;
    /// For the interpolator.
    fn status_sink(&self) -> Result<Box<dyn Publisher<Status>>, LinkError>;
    /// For everybody. It holds the latest status only.
    fn status_source(&self) -> Result<Box<dyn Subscriber<Status>>, LinkError>;
    /// For the interpolator.
    fn auxiliary_sink(&self) -> Result<Box<dyn Publisher<Auxiliary>>, LinkError>;
    /// For whatever works spindle, coolant, tools and outputs. It holds the latest state only.
    fn auxiliary_source(&self) -> Result<Box<dyn Subscriber<Auxiliary>>, LinkError>;
    /// For servo stacks. Each sends what it knows of its own joints.
    fn feedback_sink(&self) -> Result<Box<dyn Publisher<Feedback>>, LinkError>;
    /// For the interpolator, and whoever wants to see what the drives do.
    fn feedback_source(&self) -> Result<Box<dyn Subscriber<Feedback>>, LinkError>;
    /// For operators' panels.
    fn jog_sink(&self) -> Result<Box<dyn Publisher<JogDemand>>, LinkError>;
    /// For the interpolator.
    fn jog_source(&self) -> Result<Box<dyn Subscriber<JogDemand>>, LinkError>;
    /// For everybody.
    fn command_client(&self) -> Result<Box<dyn Client<CommandRequest, CommandReply>>, LinkError>;
    /// For the interpolator.
    fn command_server(&self) -> Result<Box<dyn Server<CommandRequest, CommandReply>>, LinkError>;
    /// For programs that stream segments.
    fn segment_client(&self) -> Result<Box<dyn Client<SegmentRequest, SegmentReply>>, LinkError>;
    /// For a listening planner.
    fn segment_server(&self) -> Result<Box<dyn Server<SegmentRequest, SegmentReply>>, LinkError>;

    /// For operators who have lines and files executed.
    fn job_client(&self) -> Result<Box<dyn Client<JobRequest, JobReply>>, LinkError>;
    /// For the planner's service.
    fn job_server(&self) -> Result<Box<dyn Server<JobRequest, JobReply>>, LinkError>;
    /// For senders, who have lines executed as they come.
    fn lines_client(&self) -> Result<Box<dyn Client<LinesRequest, LinesReply>>, LinkError>;
    /// For the planner's service.
    fn lines_server(&self) -> Result<Box<dyn Server<LinesRequest, LinesReply>>, LinkError>;

    /// Frees what dead processes of this instance hold. To be called every 200 ms or so by a
    /// process that runs for long, outside any real-time thread. Returns how many dead it found.
    ///
    /// # Errors
    ///
    /// A failure of the transport.
    fn clean_up_dead_peers(&self) -> Result<usize, LinkError>;

    /// Looks whether other processes still find this instance. To be called now and then by a process that moves the
    /// machine: where nobody finds it, nobody can stop it.
    ///
    /// # Errors
    ///
    /// [`LinkError::Removed`]: its directory, or what it is found by, was removed.
    fn stands(&self) -> Result<(), LinkError>;

    /// The number of the process that is the interpolator, if one lives, whether it answers or not; `None`
    /// also for one in this process.
    fn interpolator_process(&self) -> Option<i32>;
}
