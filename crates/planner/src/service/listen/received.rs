//! What has been received of a stream: the side on which its client is answered, and the side on which its items are
//! planned.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use glidepath_link::{LinkError, SegmentRefusal, SegmentReply, SegmentRequest, Server};
use glidepath_motion::PlanError;

use crate::exchange::attend::{Attend, Attended};
use crate::exchange::client_watch::ClientWatch;
use crate::exchange::stream::Stream;
use crate::run::refusal::Refusal;
use crate::service::job_queue::JobQueue;
use crate::source::item_source::{ItemSource, SILENCE, Supply};

/// Requests served between two looks at the motion.
pub(super) const REQUESTS_PER_TURN: u32 = 256;

pub(super) type Segments = dyn Server<SegmentRequest, SegmentReply>;

/// What has been received of a stream: items come in on one side while they are planned on the
/// other, in another thread.
pub(super) struct Received {
    pub(super) stream: Stream,
    /// Why the stream ended without its client saying so.
    pub(super) broken: Option<Refusal>,
    /// Time since a request was accepted that was not accepted before.
    pub(super) idle: Duration,
}

impl Received {
    /// Ends the stream here: what was accepted is executed.
    fn give_up(&mut self, broken: Refusal) {
        if self.stream.is_open() {
            self.stream
                .close(SegmentRefusal::Stopped, broken.to_string());
            self.broken = Some(broken);
        }
    }
}

fn lock(received: &Mutex<Received>) -> MutexGuard<'_, Received> {
    // Nothing is left half done where a thread can panic.
    received.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The handler of the client of a stream: the side to which items come in.
pub(super) struct StreamClientHandler<'s> {
    pub(super) server: &'s mut Segments,
    pub(super) received: &'s Mutex<Received>,
    pub(super) client: ClientWatch,
    /// Where others ask for lines and files.
    pub(super) jobs: Option<&'s mut JobQueue>,
}

impl Attend for StreamClientHandler<'_> {
    /// Answers the client, and notices when it is gone.
    fn attend(&mut self, waited: Duration, _doing: &str) -> Attended {
        self.client.wait(waited);
        if let Some(jobs) = &mut self.jobs {
            // A port that fails is told when the stream is over.
            jobs.serve_busy(waited, "").ok();
        }
        let before = lock(self.received).stream.accepted();
        let served = self.serve();
        let mut received = lock(self.received);
        received.idle = if received.stream.accepted() == before {
            received.idle.saturating_add(waited)
        } else {
            Duration::ZERO
        };
        if let Err(error) = served {
            received.give_up(Refusal::StreamFailed(error));
        } else if received.stream.is_ended() && !received.stream.has_items() {
            return Attended::IsEmpty;
        } else if !received.stream.is_open() {
            return Attended::GoesOn;
        } else if let Some(why) = self.client.why_not_begun() {
            return Attended::End(why.to_owned());
        } else if self.client.is_silent() {
            let accepted = received.stream.accepted();
            received.give_up(Refusal::ClientLost { accepted });
        }
        Attended::GoesOn
    }

    fn doing(&self) -> Option<&'static str> {
        let has_items = lock(self.received).stream.has_items();
        (!has_items).then_some("waits for its client, which reads it")
    }

    fn may_begin(&mut self) -> bool {
        let received = lock(self.received);
        // The first frame is at rest, and there before anything is known that moves.
        received.stream.is_ended() || (received.stream.has_items() && self.client.may_begin())
    }
}

impl StreamClientHandler<'_> {
    /// Answers what came in.
    fn serve(&mut self) -> Result<(), LinkError> {
        let Self {
            server,
            received,
            client,
            ..
        } = self;
        for _ in 0..REQUESTS_PER_TURN {
            let any = server.serve(&mut |request| {
                let stream = &mut lock(received).stream;
                if request.session == stream.session() {
                    client.hear();
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

/// The side on which items are planned.
pub(super) struct StreamSource<'s>(pub(super) &'s Mutex<Received>);

impl ItemSource for StreamSource<'_> {
    fn next_item(&mut self) -> Supply {
        let mut received = lock(self.0);
        if let Some(item) = received.stream.pop() {
            return Supply::Item(item);
        }
        if let Some(broken) = received.broken.take() {
            return Supply::Refused(broken);
        }
        if received.stream.is_open() {
            Supply::Pending
        } else {
            Supply::End
        }
    }

    fn is_silent(&mut self) -> bool {
        lock(self.0).idle >= SILENCE
    }

    fn unplannable(&mut self, error: &PlanError) {
        lock(self.0)
            .stream
            .close(SegmentRefusal::Unplannable, error.to_string());
    }

    fn lines_read(&self) -> u64 {
        lock(self.0).stream.accepted()
    }
}
