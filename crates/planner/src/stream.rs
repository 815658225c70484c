//! One stream of segments from another program: the rules, without the transport.
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
//! repeats its last request to show that it lives. A refused request changes nothing; the client may
//! mend it and send it under the same number.
//!
//! What was accepted is executed: if the client dies or falls silent, the stream ends where it is,
//! and the machine comes to rest on the path at the last accepted segment.

use std::cmp::Ordering::Equal;
use std::collections::VecDeque;

use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_link::{SegmentRefusal, SegmentReply, SegmentRequest, StreamItem, Text};
use glidepath_motion::{Item, ItemKind};

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
    /// The first axis on which a segment leaves the limits.
    fn broken_by(&self, segment: &Segment) -> Option<(Axis, f64)> {
        let (low, high) = match segment {
            Segment::Line(line) => (line.start.inf(&line.end), line.start.sup(&line.end)),
            Segment::Arc(arc) => arc.bounding_box(),
        };
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
    phase: Phase,
    /// Why nothing more is accepted, for people.
    closed_because: String,
}

/// A refusal and the text for people.
pub(crate) type Refused = (SegmentRefusal, String);

impl Stream {
    /// The stream that `request` opens for a machine at rest at `position`.
    ///
    /// # Errors
    /// Why the request does not open a stream.
    pub(crate) fn open(
        request: &SegmentRequest,
        position: AxisVector,
        limits: Option<SoftLimits>,
    ) -> Result<Self, Refused> {
        match request.item() {
            Ok(StreamItem::Open) => Ok(Self {
                session: request.session,
                accepted: 0,
                position,
                limits,
                queue: VecDeque::with_capacity(STREAM_QUEUE),
                phase: Phase::Open,
                closed_because: String::new(),
            }),
            Ok(_) => Err((
                SegmentRefusal::NotOpen,
                "no stream is open: open one first".to_owned(),
            )),
            Err(error) => Err((SegmentRefusal::Malformed, error.to_string())),
        }
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
            message: Text::new(message),
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
            (Phase::Open, StreamItem::Open) if self.accepted == 0 => Ok(()),
            (Phase::Open, StreamItem::Item(item)) => self.enqueue(item),
            (Phase::Open, StreamItem::End) => {
                self.phase = Phase::Ended;
                Ok(())
            }
            (_, StreamItem::Open) => Err((
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
        if let ItemKind::Move { segment, .. } = &item.kind {
            self.check(segment)?;
            self.position = segment.end();
        }
        self.queue.push_back(item);
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
        message: Text::new(message),
    }
}

#[cfg(test)]
mod tests {
    use glidepath_geometry::{Arc, Plane};
    use glidepath_motion::{PathMode, Rate};

    use super::*;

    const SESSION: u64 = 9;

    fn point(x: f64) -> AxisVector {
        let mut point = AxisVector::zeros();
        point[0] = x;
        point
    }

    fn request(session: u64, number: u64, item: StreamItem) -> SegmentRequest {
        SegmentRequest::new(session, number, &item)
    }

    fn go(segment: Segment) -> StreamItem {
        let mode = PathMode::Continuous { tolerance_mm: None };
        let kind = ItemKind::Move {
            segment,
            rate: Rate::Feed(10.0),
            mode,
        };
        StreamItem::Item(Item { line: 1, kind })
    }

    fn line(from: f64, to: f64) -> StreamItem {
        go(Segment::line(point(from), point(to)))
    }

    fn opened(limits: Option<SoftLimits>) -> Stream {
        let open = request(SESSION, 0, StreamItem::Open);
        let mut stream = Stream::open(&open, point(0.0), limits).unwrap();
        assert_eq!(stream.answer(&open).outcome(), Ok(Ok(())));
        stream
    }

    /// Sends the next request and expects it to be refused without effect.
    fn assert_refused(stream: &mut Stream, item: StreamItem, refusal: SegmentRefusal) {
        let before = stream.accepted();
        let reply = stream.answer(&request(SESSION, before, item));
        assert_eq!(
            reply.outcome(),
            Ok(Err(refusal)),
            "{}",
            reply.message.as_str()
        );
        assert!(!reply.message.as_str().is_empty());
        assert_eq!((reply.accepted, stream.accepted()), (before, before));
    }

    #[test]
    fn accepts_in_order_and_tells_the_credit_left() {
        let mut stream = opened(None);
        let reply = stream.answer(&request(SESSION, 1, line(0.0, 1.0)));
        assert_eq!(reply.outcome(), Ok(Ok(())));
        assert_eq!(
            (reply.accepted, reply.credit as usize),
            (2, STREAM_QUEUE - 1)
        );
        assert_eq!(AxisVector::from(reply.position), point(1.0));
        assert!(matches!(stream.pop(), Some(Item { line: 1, .. })));
        assert!(stream.pop().is_none());
    }

    #[test]
    fn a_repeated_request_is_answered_alike_and_has_no_effect() {
        let mut stream = opened(None);
        let first = stream.answer(&request(SESSION, 1, line(0.0, 1.0)));
        let again = stream.answer(&request(SESSION, 1, line(0.0, 1.0)));
        assert_eq!(first, again);
        assert!(stream.pop().is_some());
        assert!(stream.pop().is_none());
    }

    #[test]
    fn refuses_what_is_out_of_order_and_goes_on() {
        let mut stream = opened(None);
        let reply = stream.answer(&request(SESSION, 2, line(1.0, 2.0)));
        assert_eq!(reply.outcome(), Ok(Err(SegmentRefusal::OutOfOrder)));
        assert_eq!(reply.accepted, 1);
        for (number, item) in [(1, line(0.0, 1.0)), (2, line(1.0, 2.0))] {
            assert_eq!(
                stream.answer(&request(SESSION, number, item)).outcome(),
                Ok(Ok(()))
            );
        }
    }

    #[test]
    fn refuses_a_gap_and_what_leaves_the_travel() {
        let limits = SoftLimits {
            low: point(-5.0),
            high: point(5.0),
        };
        let mut stream = opened(Some(limits));
        assert_refused(&mut stream, line(0.5, 1.0), SegmentRefusal::Discontinuous);
        assert_refused(&mut stream, line(0.0, 5.5), SegmentRefusal::SoftLimit);
        // Both ends of the arc are inside, its bulge is not.
        let arc = Arc {
            start: point(0.0),
            end: point(0.0),
            plane: Plane::Xy,
            center: [-3.0, 0.0],
            sweep_rad: std::f64::consts::TAU,
        };
        assert_refused(
            &mut stream,
            go(Segment::Arc(arc)),
            SegmentRefusal::SoftLimit,
        );
        assert_refused(&mut stream, line(0.0, f64::NAN), SegmentRefusal::Malformed);
        assert_eq!(
            stream
                .answer(&request(SESSION, 1, line(0.0, 5.0)))
                .outcome(),
            Ok(Ok(()))
        );
    }

    #[test]
    fn a_full_queue_gives_no_credit_until_something_is_taken() {
        let mut stream = opened(None);
        let mut x = 0.0;
        for number in 1..=STREAM_QUEUE as u64 {
            let reply = stream.answer(&request(SESSION, number, line(x, x + 1.0)));
            assert_eq!(reply.outcome(), Ok(Ok(())));
            x += 1.0;
        }
        assert_refused(&mut stream, line(x, x + 1.0), SegmentRefusal::NoCredit);
        stream.pop().unwrap();
        let next = request(SESSION, stream.accepted(), line(x, x + 1.0));
        assert_eq!(stream.answer(&next).outcome(), Ok(Ok(())));
    }

    #[test]
    fn one_client_at_a_time() {
        let mut stream = opened(None);
        let reply = stream.answer(&request(SESSION + 1, 0, StreamItem::Open));
        assert_eq!(reply.outcome(), Ok(Err(SegmentRefusal::Busy)));
        assert_eq!(reply.accepted, 0);
    }

    #[test]
    fn nothing_is_accepted_after_the_end_or_a_closing() {
        let mut stream = opened(None);
        let end = request(SESSION, 1, StreamItem::End);
        assert_eq!(stream.answer(&end).outcome(), Ok(Ok(())));
        assert_eq!(
            stream.answer(&end).outcome(),
            Ok(Ok(())),
            "the end, repeated"
        );
        assert_refused(&mut stream, line(0.0, 1.0), SegmentRefusal::NotOpen);
        stream.close(SegmentRefusal::Stopped, "aborted".to_owned());
        let reply = stream.answer(&end);
        assert_eq!(reply.outcome(), Ok(Err(SegmentRefusal::Stopped)));
        assert_eq!(reply.message.as_str(), "aborted");
    }

    #[test]
    fn only_an_open_request_opens() {
        let refused = Stream::open(&request(SESSION, 0, line(0.0, 1.0)), point(0.0), None);
        assert_eq!(refused.unwrap_err().0, SegmentRefusal::NotOpen);
    }
}
