//! The rules of one stream of segments from another program, without the transport.
//!
//! ```text
//!  client                          planner
//!    Open ─────────────────────────▶ machine ready? → accepted 1, position where to start
//!    Item 1, Item 2, … ────────────▶ checked, queued → accepted n, credit left
//!    Item n (again, as heartbeat) ─▶ known already   → accepted n + 1, nothing changes
//!    End ──────────────────────────▶ the motion comes to rest at the end of what was accepted
//! ```
//!
//! Every request is numbered and answered. A request that was accepted before is answered in the
//! same way again, so a client repeats what it got no answer to, and a client with nothing to send
//! repeats its last request to show that it lives. A refused request changes nothing; the client
//! may mend it and send it under the same number.
//!
//! The motion begins with the end of the stream, or once a request comes when its first frame is ready, so that nothing
//! begins for a client that has died meanwhile. From then on what was accepted is executed: if the client dies or falls
//! silent, the stream ends where it is, and the machine comes to rest on the path at the last accepted segment.

use std::cmp::Ordering::Equal;
use std::collections::VecDeque;

use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_link::{LongText, SegmentRefusal, SegmentReply, SegmentRequest, StreamItem};
use glidepath_program::{Event, Item, ItemKind};

#[cfg(test)]
mod tests;

/// Items a stream may be ahead of the planner.
pub const STREAM_QUEUE: usize = 1024;

/// Smallest and largest coordinate of every axis, machine coordinates, mm or degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoftLimits {
    /// Smallest.
    pub low: AxisVector,
    /// Largest.
    pub high: AxisVector,
}

impl SoftLimits {
    /// Those of a stream that begins at a place: an axis that stands outside may stay there or come inwards.
    fn beginning_at(self, place: &AxisVector) -> Self {
        Self {
            low: self.low.inf(place),
            high: self.high.sup(place),
        }
    }

    /// The first axis on which a segment leaves the limits.
    fn broken_by(&self, segment: &Segment) -> Option<(Axis, f64)> {
        let (low, high) = segment.bounding_box();
        Axis::ALL.into_iter().find_map(|axis| {
            let i = axis.index();
            if low[i] < self.low[i] {
                Some((axis, low[i]))
            } else if high[i] > self.high[i] {
                Some((axis, high[i]))
            } else {
                None
            }
        })
    }
}

/// How far a stream has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// More may come.
    Open,
    /// The client said that this was all.
    Ended,
    /// Nothing more is accepted.
    Closed(SegmentRefusal),
}

/// A stream that was opened.
#[derive(Debug)]
pub(crate) struct Stream {
    session: u64,
    /// Number of the next request expected.
    accepted: u64,
    /// Where the next segment must start.
    position: AxisVector,
    limits: Option<SoftLimits>,
    queue: VecDeque<Item>,
    /// Whether anything was accepted that is to be done.
    has_items: bool,
    phase: Phase,
    /// Why nothing more is accepted, for people.
    closed_because: String,
}

/// A refusal and the text for people.
pub(crate) type Refused = (SegmentRefusal, String);

impl Stream {
    /// When the stream was asked for that `request` opens; 0 if it does not say.
    ///
    /// # Errors
    /// Why the request does not open a stream.
    pub(crate) fn asked_ns(request: &SegmentRequest) -> Result<u64, Refused> {
        match request.item() {
            Ok(StreamItem::Open { asked_ns }) => Ok(asked_ns),
            Ok(_) => Err((
                SegmentRefusal::NotOpen,
                "no stream is open: open one first".to_owned(),
            )),
            Err(error) => Err((SegmentRefusal::Malformed, error.to_string())),
        }
    }

    /// The stream that `request` opens for a machine at rest at `position`.
    ///
    /// # Errors
    /// Why the request does not open a stream.
    pub(crate) fn open(
        request: &SegmentRequest,
        position: AxisVector,
        limits: Option<SoftLimits>,
    ) -> Result<Self, Refused> {
        let _asked_ns = Self::asked_ns(request)?;
        Ok(Self {
            session: request.session,
            accepted: 0,
            position,
            limits: limits.map(|limits| limits.beginning_at(&position)),
            queue: VecDeque::with_capacity(STREAM_QUEUE),
            has_items: false,
            phase: Phase::Open,
            closed_because: String::new(),
        })
    }

    /// Answers a request, taking over what it carries if it is acceptable.
    pub(crate) fn answer(&mut self, request: &SegmentRequest) -> SegmentReply {
        let outcome = self.take(request);
        let (refusal, message) = match &outcome {
            Ok(()) => (0, ""),
            Err((refusal, message)) => (refusal.code(), message.as_str()),
        };
        SegmentReply {
            session: request.session,
            number: request.number,
            accepted: if request.session == self.session {
                self.accepted
            } else {
                0
            },
            credit: self.credit(),
            refusal,
            position: self.position.into(),
            message: LongText::new(message),
        }
    }

    /// The oldest item not yet taken.
    pub(crate) fn pop(&mut self) -> Option<Item> {
        self.queue.pop_front()
    }

    /// Whether more items may come.
    pub(crate) fn is_open(&self) -> bool {
        self.phase == Phase::Open
    }

    /// Whether the client said that this was all.
    pub(crate) fn is_ended(&self) -> bool {
        self.phase == Phase::Ended
    }

    /// Whether anything was accepted that is to be done.
    pub(crate) const fn has_items(&self) -> bool {
        self.has_items
    }

    /// Requests accepted so far, that which opened the stream included.
    pub(crate) const fn accepted(&self) -> u64 {
        self.accepted
    }

    /// The client's number of the stream.
    pub(crate) const fn session(&self) -> u64 {
        self.session
    }

    /// Accepts nothing more, and tells the client why. What was accepted stays.
    pub(crate) fn close(&mut self, refusal: SegmentRefusal, because: String) {
        self.phase = Phase::Closed(refusal);
        self.closed_because = because;
    }

    fn credit(&self) -> u32 {
        if self.phase == Phase::Open {
            u32::try_from(STREAM_QUEUE - self.queue.len()).unwrap_or(0)
        } else {
            0
        }
    }

    fn take(&mut self, request: &SegmentRequest) -> Result<(), Refused> {
        if request.session != self.session {
            return Err((
                SegmentRefusal::Busy,
                "another client's stream is open: one at a time".to_owned(),
            ));
        }
        if let Phase::Closed(refusal) = self.phase {
            return Err((refusal, self.closed_because.clone()));
        }
        if request.number < self.accepted {
            return Ok(());
        }
        if request.number > self.accepted {
            return Err((
                SegmentRefusal::OutOfOrder,
                format!("request {} came, {} is next", request.number, self.accepted),
            ));
        }
        let item = request
            .item()
            .map_err(|error| (SegmentRefusal::Malformed, error.to_string()))?;
        self.take_next(item)?;
        self.accepted += 1;
        Ok(())
    }

    /// Takes the content of the request that is due.
    fn take_next(&mut self, item: StreamItem) -> Result<(), Refused> {
        match (self.phase, item) {
            (Phase::Open, StreamItem::Open { .. }) if self.accepted == 0 => Ok(()),
            (Phase::Open, StreamItem::Item(item)) => self.enqueue(item),
            (Phase::Open, StreamItem::End) => {
                self.phase = Phase::Ended;
                Ok(())
            }
            (_, StreamItem::Open { .. }) => Err((
                SegmentRefusal::OutOfOrder,
                "the stream is open already".to_owned(),
            )),
            (_, _) => Err((SegmentRefusal::NotOpen, "the stream has ended".to_owned())),
        }
    }

    fn enqueue(&mut self, item: Item) -> Result<(), Refused> {
        if self.queue.len() >= STREAM_QUEUE {
            return Err((
                SegmentRefusal::NoCredit,
                "no room: send it again later".to_owned(),
            ));
        }
        match &item.kind {
            ItemKind::Move { segment, .. } => {
                self.check(segment)?;
                self.position = segment.end();
            }
            // Where it ends is answered to programs, and to nobody else.
            ItemKind::Event(Event::Probe { .. }) => {
                let why = "a stream is not told what a probe finds: run the program from a file";
                return Err((SegmentRefusal::Malformed, why.to_owned()));
            }
            ItemKind::Event(_) | ItemKind::Dwell(_) => {}
        }
        self.queue.push_back(item);
        self.has_items = true;
        Ok(())
    }

    fn check(&self, segment: &Segment) -> Result<(), Refused> {
        let start = segment.start();
        let jump = Axis::ALL.into_iter().find(|axis| {
            start[axis.index()].partial_cmp(&self.position[axis.index()]) != Some(Equal)
        });
        if let Some(axis) = jump {
            let i = axis.index();
            return Err((
                SegmentRefusal::Discontinuous,
                format!(
                    "starts at {axis}{}, the path ends at {axis}{}",
                    start[i], self.position[i]
                ),
            ));
        }
        if let Some((axis, value)) = self.limits.and_then(|limits| limits.broken_by(segment)) {
            return Err((
                SegmentRefusal::SoftLimit,
                format!("goes to {axis}{value}, outside the axis' travel"),
            ));
        }
        Ok(())
    }
}

/// The answer to a request that belongs to no stream.
pub(crate) fn refuse(request: &SegmentRequest, (refusal, message): &Refused) -> SegmentReply {
    SegmentReply {
        session: request.session,
        number: request.number,
        accepted: 0,
        credit: 0,
        refusal: refusal.code(),
        position: AxisVector::zeros().into(),
        message: LongText::new(message),
    }
}
