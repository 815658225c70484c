//! The rules of a stream, request by request.

use glidepath_geometry::{Arc, Plane};
use glidepath_program::{PathMode, Rate};

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
    StreamItem::Item(Item {
        block: 0,
        line: 1,
        kind,
    })
}

fn line(from: f64, to: f64) -> StreamItem {
    go(Segment::line(point(from), point(to)))
}

fn opened(limits: Option<SoftLimits>) -> Stream {
    let open = request(SESSION, 0, StreamItem::Open { asked_ns: 0 });
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
fn an_axis_that_stands_outside_may_come_inwards() {
    let limits = SoftLimits {
        low: point(-5.0),
        high: point(5.0),
    };
    let open = request(SESSION, 0, StreamItem::Open { asked_ns: 0 });
    let mut stream = Stream::open(&open, point(7.0), Some(limits)).unwrap();
    assert_eq!(stream.answer(&open).outcome(), Ok(Ok(())));
    assert_refused(&mut stream, line(7.0, 7.5), SegmentRefusal::SoftLimit);
    let inwards = request(SESSION, 1, line(7.0, 6.0));
    assert_eq!(stream.answer(&inwards).outcome(), Ok(Ok(())));
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
    let reply = stream.answer(&request(SESSION + 1, 0, StreamItem::Open { asked_ns: 0 }));
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

#[test]
fn a_stream_cannot_probe() {
    let mut stream = opened(None);
    let probe = StreamItem::Item(Item {
        block: 0,
        line: 1,
        kind: ItemKind::Event(Event::Probe { release: false }),
    });
    assert_refused(&mut stream, probe, SegmentRefusal::Malformed);
    let item = line(0.0, 5.0);
    let goes_on = stream.answer(&request(SESSION, stream.accepted(), item));
    assert_eq!(goes_on.outcome(), Ok(Ok(())));
}
