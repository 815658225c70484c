//! The client of a listening planner: streams the items of any source, as another program would.
//!
//! Requests go out in rounds of as many as the link lets be unanswered. What a round's answers do
//! not accept, because the planner has no room, goes out again in the next.

use std::collections::VecDeque;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{
    Client, LinkError, MAX_UNANSWERED, Record, SegmentRefusal, SegmentReply, SegmentRequest,
    StreamItem, Transport,
};
use thiserror::Error;

use crate::interval::Interval;
use crate::{Control, ItemSource, Refusal, Supply};

/// Between two looks for answers.
const POLL: Duration = Duration::from_micros(200);

/// Before a request is sent again for which there was no room.
const RETRY: Duration = Duration::from_millis(5);

/// Between two signs of life while there is nothing to send.
const HEARTBEAT: Duration = Duration::from_millis(100);

/// A planner that does not answer for so long is gone.
const PATIENCE: Duration = Duration::from_secs(5);

/// Why a stream was not executed to its end.
#[derive(Debug, Error)]
pub enum FeedError {
    /// The program was refused, here or by the planner's check of an item.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The planner refused a request.
    #[error("stream refused{}: {message}", AtLine(*.line))]
    RefusedByPlanner {
        /// Source line of what was refused, 0 if it has none.
        line: u32,
        /// Why.
        refusal: SegmentRefusal,
        /// The same in words.
        message: String,
    },
    /// The planner did not answer.
    #[error("the planner does not answer; `glidepath planner --listen` starts it")]
    PlannerLost,
    /// No interpolator tells where the machine stands.
    #[error("no interpolator tells where the machine stands; `glidepath interpolator` starts one")]
    MachineLost,
    /// The machine moved between the reading of the program and the start.
    #[error("the machine moved while the program was read; start again")]
    Moved,
    /// The caller's stop flag ended it. The machine stops at the end of what was accepted.
    #[error("interrupted")]
    Interrupted,
    /// A port failed.
    #[error(transparent)]
    Link(#[from] LinkError),
}

struct AtLine(u32);

impl std::fmt::Display for AtLine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0 > 0 {
            write!(f, " at line {}", self.0)
        } else {
            Ok(())
        }
    }
}

/// What was streamed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fed {
    /// Items accepted.
    pub items: u64,
    /// Lines read.
    pub lines: u64,
}

/// Streams a program to a listening planner and waits until it is executed. `asked_ns` is when that was asked for, by
/// the host's steady clock: a stop of the machine after it ends the stream, whenever its planner hears of it. `make_source`
/// opens the program for a machine at the given position; nothing is streamed if it refuses.
///
/// # Errors
/// [`FeedError`]. If the source fails midway, the stream ends after the last good item, and that is
/// executed before the error is returned.
pub fn feed<S: ItemSource>(
    transport: &dyn Transport,
    asked_ns: u64,
    make_source: impl FnOnce(AxisVector) -> Result<S, Refusal>,
    control: &mut Control<'_>,
) -> Result<Fed, FeedError> {
    let position = machine_position(transport, control)?;
    let mut source = make_source(position)?;
    let mut feeder = Feeder::new(transport, asked_ns)?;
    feeder.open(position, control)?;
    let refusal = match feeder.stream(&mut source, control) {
        Err(error @ FeedError::RefusedByPlanner { .. }) => {
            // What was accepted is executed; better to say at once that there is no more.
            feeder.outbox.clear();
            let _ended = feeder.deliver(StreamItem::End, control);
            return Err(error);
        }
        result => result?,
    };
    let items = feeder.accepted - 1;
    feeder.deliver(StreamItem::End, control)?;
    feeder.wait_until_executed(control)?;
    match refusal {
        None => Ok(Fed {
            items,
            lines: source.lines_read(),
        }),
        Some(refusal) => Err(refusal.into()),
    }
}

/// Where the machine stands, from its status.
fn machine_position(
    transport: &dyn Transport,
    control: &mut Control<'_>,
) -> Result<AxisVector, FeedError> {
    let mut status = transport.status_source()?;
    let mut waited = Duration::ZERO;
    while waited < PATIENCE {
        if let Some(status) = status.take()? {
            status.check().map_err(LinkError::from)?;
            return Ok(AxisVector::from(status.position));
        }
        pause(POLL, control)?;
        waited += POLL;
    }
    Err(FeedError::MachineLost)
}

fn pause(time: Duration, control: &mut Control<'_>) -> Result<(), FeedError> {
    if control.is_stopped() {
        return Err(FeedError::Interrupted);
    }
    (control.pause)(time);
    Ok(())
}

struct Feeder {
    client: Box<dyn Client<SegmentRequest, SegmentReply>>,
    session: u64,
    open: StreamItem,
    /// Not yet known to be accepted; the first has the number `accepted`.
    outbox: VecDeque<StreamItem>,
    accepted: u64,
}

impl Feeder {
    fn new(transport: &dyn Transport, asked_ns: u64) -> Result<Self, LinkError> {
        Ok(Self {
            client: transport.segment_client()?,
            // The hasher's keys are random: no two clients take each other's stream for theirs.
            session: RandomState::new().build_hasher().finish(),
            open: StreamItem::Open { asked_ns },
            outbox: VecDeque::with_capacity(MAX_UNANSWERED),
            accepted: 0,
        })
    }

    /// Opens the stream, and makes sure that the machine is where the program was opened for.
    /// Waits a while for a planner or machine that is not ready yet.
    fn open(&mut self, position: AxisVector, control: &mut Control<'_>) -> Result<(), FeedError> {
        let mut waited = Duration::ZERO;
        loop {
            let reply = match self.repeat(self.open, control) {
                Err(FeedError::Link(LinkError::NoServer { .. })) if waited < PATIENCE => {
                    pause(RETRY, control)?;
                    waited += RETRY;
                    continue;
                }
                reply => reply?,
            };
            match reply.outcome().map_err(LinkError::from)? {
                Ok(()) if AxisVector::from(reply.position) == position => break,
                Ok(()) => return Err(FeedError::Moved),
                Err(SegmentRefusal::Stopped) if waited < PATIENCE => pause(RETRY, control)?,
                Err(refusal) => return Err(refused(0, refusal, &reply)),
            }
            waited += RETRY;
        }
        self.accepted = 1;
        Ok(())
    }

    /// Streams a source to its end; returns why it ended early, if it did.
    fn stream<S: ItemSource>(
        &mut self,
        source: &mut S,
        control: &mut Control<'_>,
    ) -> Result<Option<Refusal>, FeedError> {
        let mut ended = None;
        let mut silent = Interval::new(HEARTBEAT);
        loop {
            while ended.is_none() && self.outbox.len() < MAX_UNANSWERED {
                match source.next_item() {
                    Supply::Item(item) => self.outbox.push_back(StreamItem::Item(item)),
                    Supply::Pending => break,
                    Supply::Probe | Supply::End => ended = Some(None),
                    Supply::Refused(refusal) => ended = Some(Some(refusal)),
                }
            }
            if !self.outbox.is_empty() {
                self.round(control)?;
                silent.restart();
            } else if let Some(refusal) = ended {
                return Ok(refusal);
            } else {
                pause(POLL, control)?;
                if silent.is_over_after(POLL) {
                    self.heartbeat(control)?;
                    silent.restart();
                }
            }
        }
    }

    /// Sends one item and waits until it is accepted.
    fn deliver(&mut self, item: StreamItem, control: &mut Control<'_>) -> Result<(), FeedError> {
        self.outbox.push_back(item);
        while !self.outbox.is_empty() {
            self.round(control)?;
        }
        Ok(())
    }

    /// After the end of the stream was accepted: asks again until it is executed.
    fn wait_until_executed(&mut self, control: &mut Control<'_>) -> Result<(), FeedError> {
        loop {
            let reply = self.repeat(StreamItem::End, control)?;
            match reply.outcome().map_err(LinkError::from)? {
                Ok(()) => pause(HEARTBEAT, control)?,
                Err(SegmentRefusal::NotOpen) => return Ok(()),
                Err(refusal) => return Err(refused(0, refusal, &reply)),
            }
        }
    }

    /// Shows that this client lives, by a request that was accepted before.
    fn heartbeat(&mut self, control: &mut Control<'_>) -> Result<(), FeedError> {
        let reply = self.repeat(self.open, control)?;
        match reply.outcome().map_err(LinkError::from)? {
            Ok(()) => Ok(()),
            Err(refusal) => Err(refused(0, refusal, &reply)),
        }
    }

    /// Asks for the opening of the stream, or again what was accepted last.
    fn repeat(
        &mut self,
        item: StreamItem,
        control: &mut Control<'_>,
    ) -> Result<SegmentReply, FeedError> {
        let number = if item == self.open {
            0
        } else {
            self.accepted.saturating_sub(1)
        };
        self.client
            .ask(&SegmentRequest::new(self.session, number, &item))?;
        self.reply(control)
    }

    /// Sends as much of the outbox as may be unanswered, takes all answers, and keeps what was not
    /// accepted.
    fn round(&mut self, control: &mut Control<'_>) -> Result<(), FeedError> {
        let mut asked = Vec::with_capacity(MAX_UNANSWERED);
        for (number, item) in (self.accepted..).zip(self.outbox.iter().take(MAX_UNANSWERED)) {
            self.client
                .ask(&SegmentRequest::new(self.session, number, item))?;
            asked.push(line_of(item));
        }
        let (mut accepted, mut refusal) = (self.accepted, None);
        for line in asked {
            let reply = self.reply(control)?;
            match reply.outcome().map_err(LinkError::from)? {
                Ok(()) => accepted = accepted.max(reply.accepted),
                // What follows a refused request is out of order; the first refusal counts.
                Err(why) => refusal = refusal.or(Some((line, why, reply))),
            }
        }
        let news = usize::try_from(accepted - self.accepted).unwrap_or(usize::MAX);
        self.outbox.drain(..self.outbox.len().min(news));
        self.accepted = accepted;
        match refusal {
            None => Ok(()),
            Some((_, SegmentRefusal::NoCredit, _)) => pause(RETRY, control),
            Some((line, why, reply)) => Err(refused(line, why, &reply)),
        }
    }

    fn reply(&mut self, control: &mut Control<'_>) -> Result<SegmentReply, FeedError> {
        let mut waited = Duration::ZERO;
        while waited < PATIENCE {
            if let Some(reply) = self.client.reply()? {
                reply.check().map_err(LinkError::from)?;
                return Ok(reply);
            }
            pause(POLL, control)?;
            waited += POLL;
        }
        Err(FeedError::PlannerLost)
    }
}

const fn line_of(item: &StreamItem) -> u32 {
    match item {
        StreamItem::Item(item) => item.line,
        StreamItem::Open { .. } | StreamItem::End => 0,
    }
}

fn refused(line: u32, refusal: SegmentRefusal, reply: &SegmentReply) -> FeedError {
    let message = match reply.message.as_str() {
        "" => refusal.text(),
        message => message,
    };
    FeedError::RefusedByPlanner {
        line,
        refusal,
        message: message.to_owned(),
    }
}
