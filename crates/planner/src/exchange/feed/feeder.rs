//! The requests of one stream, and what is answered to them.

use std::collections::VecDeque;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::time::{Duration, Instant};

use glidepath_geometry::AxisVector;
use glidepath_link::{
    Client, LinkError, MAX_UNANSWERED, Record, SegmentRefusal, SegmentReply, SegmentRequest,
    StreamItem, Transport,
};

use super::FeedError;
use super::reader::Reader;
use super::wait::{POLL, pause};
use crate::run::control::Control;
use crate::run::interval::Interval;
use crate::run::refusal::Refusal;
use crate::source::item_source::Supply;

/// Before a request is sent again for which there was no room.
const RETRY: Duration = Duration::from_millis(5);

/// Between two signs of life while there is nothing to send. The motion of a stream that goes on begins with one.
const HEARTBEAT: Duration = Duration::from_millis(20);

/// A planner that does not answer for so long is gone.
pub(super) const PATIENCE: Duration = Duration::from_secs(5);

/// How long the end of a stream is waited for that was called off.
const END_PATIENCE: Duration = Duration::from_millis(600);

/// One stream.
pub(super) struct Feeder {
    client: Box<dyn Client<SegmentRequest, SegmentReply>>,
    session: u64,
    open: StreamItem,
    /// Requests whose answer has not come.
    unanswered: usize,
    /// Not yet known to be accepted; the first has the number `accepted`.
    outbox: VecDeque<StreamItem>,
    accepted: u64,
}

impl Feeder {
    pub(super) fn new(transport: &dyn Transport, asked_ns: u64) -> Result<Self, LinkError> {
        Ok(Self {
            client: transport.segment_client()?,
            // The hasher's keys are random: no two clients take each other's stream for theirs.
            session: RandomState::new().build_hasher().finish(),
            open: StreamItem::Open { asked_ns },
            unanswered: 0,
            outbox: VecDeque::with_capacity(MAX_UNANSWERED),
            accepted: 0,
        })
    }

    /// Items accepted so far.
    pub(super) const fn items(&self) -> u64 {
        self.accepted.saturating_sub(1)
    }

    /// Opens the stream; where the machine stands, which is the stream's from now on.
    /// Waits a while for a planner or machine that is not ready yet.
    pub(super) fn open(&mut self, control: &mut Control<'_>) -> Result<AxisVector, FeedError> {
        let began = Instant::now();
        loop {
            let reply = match self.repeat(self.open, control) {
                Err(FeedError::Link(LinkError::NoServer { .. })) if began.elapsed() < PATIENCE => {
                    pause(RETRY, control)?;
                    continue;
                }
                reply => reply?,
            };
            match reply.outcome().map_err(LinkError::from)? {
                Ok(()) => {
                    self.accepted = 1;
                    return Ok(AxisVector::from(reply.position));
                }
                Err(SegmentRefusal::Stopped) if began.elapsed() < PATIENCE => {
                    pause(RETRY, control)?;
                }
                Err(refusal) => return Err(refused(0, refusal, &reply)),
            }
        }
    }

    /// Waits until the program is open, and shows meanwhile that this client lives.
    pub(super) fn wait_for(
        &mut self,
        reader: &mut Reader,
        control: &mut Control<'_>,
    ) -> Result<(), FeedError> {
        let mut silent = Interval::new(HEARTBEAT);
        while !reader.is_open()? {
            pause(POLL, control)?;
            if silent.is_over_after(POLL) {
                self.heartbeat(control)?;
                silent.restart();
            }
        }
        Ok(())
    }

    /// Streams what is read to its end; returns why it ended early, if it did.
    pub(super) fn stream(
        &mut self,
        reader: &mut Reader,
        control: &mut Control<'_>,
    ) -> Result<Option<Refusal>, FeedError> {
        let mut ended = None;
        let mut silent = Interval::new(HEARTBEAT);
        loop {
            while ended.is_none() && self.outbox.len() < MAX_UNANSWERED {
                match reader.next() {
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
    pub(super) fn deliver(
        &mut self,
        item: StreamItem,
        control: &mut Control<'_>,
    ) -> Result<(), FeedError> {
        self.outbox.push_back(item);
        while !self.outbox.is_empty() {
            self.round(control)?;
        }
        Ok(())
    }

    /// Says that there is no more than what was accepted.
    pub(super) fn give_up(&mut self, control: &mut Control<'_>) {
        self.outbox.clear();
        let _ended = self.deliver(StreamItem::End, control);
    }

    /// After the end of the stream was accepted: asks again until it is executed.
    pub(super) fn wait_until_executed(
        &mut self,
        control: &mut Control<'_>,
    ) -> Result<(), FeedError> {
        loop {
            let reply = self.repeat(StreamItem::End, control)?;
            match reply.outcome().map_err(LinkError::from)? {
                Ok(()) => pause(HEARTBEAT, control)?,
                Err(SegmentRefusal::NotOpen) => return Ok(()),
                Err(refusal) => return Err(refused(0, refusal, &reply)),
            }
        }
    }

    /// Has what was streamed aborted, and waits a moment for its end; how it has ended. The stop flag is set.
    pub(super) fn call_off(
        &mut self,
        abort: &mut dyn FnMut(),
        control: &mut Control<'_>,
    ) -> FeedError {
        let mut waited = Duration::ZERO;
        let mut is_told = false;
        while waited < END_PATIENCE {
            if self.accepted > 0 && !is_told {
                is_told = true;
                abort();
            }
            match self.ask_for_end() {
                Ok(None) => {}
                Ok(Some(end)) => return end,
                Err(error) => return error.into(),
            }
            if self.accepted == 0 && self.unanswered == 0 {
                return FeedError::Interrupted;
            }
            (control.pause)(RETRY);
            waited += RETRY;
        }
        if is_told {
            abort();
        }
        FeedError::NotEnded
    }

    /// One look whether a stream that was called off has ended, and how.
    fn ask_for_end(&mut self) -> Result<Option<FeedError>, LinkError> {
        while let Some(reply) = self.take_reply()? {
            match reply.outcome()? {
                Ok(()) => self.accepted = self.accepted.max(reply.accepted),
                Err(SegmentRefusal::NoCredit | SegmentRefusal::OutOfOrder) => {}
                // The stream may be open, and nothing of it has come.
                Err(_) if self.accepted <= 1 => return Ok(Some(FeedError::Interrupted)),
                Err(refusal) => {
                    let message = message_of(refusal, &reply);
                    return Ok(Some(FeedError::CalledOff { message }));
                }
            }
        }
        if self.accepted > 0 && self.unanswered == 0 {
            // That it was opened is known already, and is answered as long as it is open.
            self.ask(0, &self.open.clone())?;
        }
        Ok(None)
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
        self.ask(number, &item)?;
        self.reply(control)
    }

    /// Sends as much of the outbox as may be unanswered, takes all answers, and keeps what was not
    /// accepted.
    fn round(&mut self, control: &mut Control<'_>) -> Result<(), FeedError> {
        let mut asked = Vec::with_capacity(MAX_UNANSWERED);
        for place in 0..self.outbox.len().min(MAX_UNANSWERED) {
            let item = self.outbox[place];
            self.ask(self.accepted + place as u64, &item)?;
            asked.push(line_of(&item));
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

    fn ask(&mut self, number: u64, item: &StreamItem) -> Result<(), LinkError> {
        let request = SegmentRequest::new(self.session, number, item);
        self.client.ask(&request)?;
        self.unanswered += 1;
        Ok(())
    }

    fn take_reply(&mut self) -> Result<Option<SegmentReply>, LinkError> {
        let Some(reply) = self.client.reply()? else {
            return Ok(None);
        };
        self.unanswered = self.unanswered.saturating_sub(1);
        reply.check()?;
        Ok(Some(reply))
    }

    fn reply(&mut self, control: &mut Control<'_>) -> Result<SegmentReply, FeedError> {
        let began = Instant::now();
        while began.elapsed() < PATIENCE {
            if let Some(reply) = self.take_reply()? {
                return Ok(reply);
            }
            pause(POLL, control)?;
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
    FeedError::RefusedByPlanner {
        line,
        refusal,
        message: message_of(refusal, reply),
    }
}

fn message_of(refusal: SegmentRefusal, reply: &SegmentReply) -> String {
    match reply.message.as_str() {
        "" => refusal.text(),
        message => message,
    }
    .to_owned()
}
