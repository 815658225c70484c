//! The promises about the frame queue.

use super::{CAPACITY, Fixture, WATCHDOG, drain, frame, take, wait_for};
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use glidepath_link::{Delivery, FrameSink, LinkError, SetpointFrame, Subscriber, Transport};
use std::time::Instant;

/// Offers and drains in turn until both ends have found each other, and leaves the queue empty.
fn meet(sink: &mut dyn FrameSink, source: &mut dyn Subscriber<SetpointFrame>) {
    wait_for(|| {
        let delivered = sink.offer(&frame(u64::MAX)).unwrap() == Delivery::Delivered;
        let arrived = source.take().unwrap().is_some();
        (delivered && arrived).then_some(())
    });
    drain(source);
}

pub(crate) fn frames_arrive_in_order_without_gaps<F: Fixture>(fixture: &F) {
    const FRAMES: u64 = 2000;
    let planner = fixture.connect();
    let mut sink = planner.frame_sink().unwrap();
    let interpolator = fixture.connect();
    let mut source = interpolator.frame_source().unwrap();
    let (mut next, mut expected, mut fulls) = (0, 0, 0_u64);
    let started = Instant::now();
    while expected < FRAMES {
        // The consumer is slower than the planner would be, in bursts of different lengths.
        while next < FRAMES {
            match sink.offer(&frame(next)).unwrap() {
                Delivery::Delivered => next += 1,
                Delivery::Full => {
                    fulls += 1;
                    break;
                }
                Delivery::NoConsumer => {
                    source.take().unwrap();
                    break;
                }
            }
        }
        for _ in 0..=(expected % 7) {
            if let Some(frame) = source.take().unwrap() {
                assert_eq!(frame.sequence, expected);
                expected += 1;
            }
        }
        assert!(started.elapsed() < WATCHDOG);
    }
    assert!(
        fulls > 0,
        "the queue never filled: nothing was shown about back-pressure"
    );
    assert_eq!(source.take().unwrap(), None);
}

pub(crate) fn a_full_queue_is_reported_and_loses_nothing<F: Fixture>(fixture: &F) {
    let planner = fixture.connect();
    let mut sink = planner.frame_sink().unwrap();
    let interpolator = fixture.connect();
    let mut source = interpolator.frame_source().unwrap();
    meet(&mut *sink, &mut *source);
    let mut accepted = 0;
    while sink.offer(&frame(accepted)).unwrap() == Delivery::Delivered {
        accepted += 1;
        assert!(
            accepted <= 2 * CAPACITY.frames as u64,
            "the queue has no end"
        );
    }
    assert_eq!(accepted, CAPACITY.frames as u64);
    for _ in 0..3 {
        assert_eq!(sink.offer(&frame(accepted)).unwrap(), Delivery::Full);
    }
    assert_eq!(take(&mut *source).sequence, 0);
    assert_eq!(sink.offer(&frame(accepted)).unwrap(), Delivery::Delivered);
    let rest: Vec<u64> = drain(&mut *source)
        .iter()
        .map(|frame| frame.sequence)
        .collect();
    assert_eq!(rest, (1..=accepted).collect::<Vec<_>>());
}

pub(crate) fn waiting_for_room_ends_by_time_and_by_the_stop_flag<F: Fixture>(fixture: &F) {
    let planner = fixture.connect();
    let mut sink = planner.frame_sink().unwrap();
    let never = AtomicBool::new(false);
    let short = Duration::from_millis(5);
    assert_eq!(
        sink.send(&frame(0), short, &never).unwrap(),
        Delivery::NoConsumer
    );
    let interpolator = fixture.connect();
    let mut source = interpolator.frame_source().unwrap();
    meet(&mut *sink, &mut *source);
    while sink.offer(&frame(0)).unwrap() == Delivery::Delivered {}
    assert_eq!(sink.send(&frame(0), short, &never).unwrap(), Delivery::Full);
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(20));
            stop.store(true, Ordering::Relaxed);
        });
        assert_eq!(
            sink.send(&frame(0), WATCHDOG, &stop).unwrap(),
            Delivery::Full
        );
    });
}

pub(crate) fn a_frame_counts_as_delivered_only_with_a_consumer<F: Fixture>(fixture: &F) {
    let planner = fixture.connect();
    let mut sink = planner.frame_sink().unwrap();
    for _ in 0..3 {
        assert_eq!(sink.offer(&frame(0)).unwrap(), Delivery::NoConsumer);
    }
    let interpolator = fixture.connect();
    let mut source = interpolator.frame_source().unwrap();
    // From here each frame reported as delivered arrives, the first one included.
    let mut next = 0;
    let arrived = wait_for(|| {
        if sink.offer(&frame(next)).unwrap() == Delivery::Delivered {
            next += 1;
        }
        let arrived = drain(&mut *source);
        (!arrived.is_empty()).then_some(arrived)
    });
    assert_eq!(arrived.len() as u64, next);
    assert_eq!(arrived[0].sequence, 0);
}

pub(crate) fn a_consumer_that_went_away_is_reported_and_may_come_back<F: Fixture>(fixture: &F) {
    let planner = fixture.connect();
    let mut sink = planner.frame_sink().unwrap();
    for life in 0..3 {
        let interpolator = fixture.connect();
        let mut source = interpolator.frame_source().unwrap();
        meet(&mut *sink, &mut *source);
        for sequence in 0..3 {
            assert_eq!(
                sink.offer(&frame(sequence)).unwrap(),
                Delivery::Delivered,
                "life {life}"
            );
        }
        assert_eq!(take(&mut *source).sequence, 0);
        drop(source);
        drop(interpolator);
        assert_eq!(sink.offer(&frame(3)).unwrap(), Delivery::NoConsumer);
    }
}

pub(crate) fn frames_of_a_planner_that_went_away_still_arrive<F: Fixture>(fixture: &F) {
    let planner = fixture.connect();
    let mut sink = planner.frame_sink().unwrap();
    let interpolator = fixture.connect();
    let mut source = interpolator.frame_source().unwrap();
    meet(&mut *sink, &mut *source);
    for sequence in 0..3 {
        assert_eq!(sink.offer(&frame(sequence)).unwrap(), Delivery::Delivered);
    }
    drop(sink);
    drop(planner);
    let arrived: Vec<u64> = drain(&mut *source)
        .iter()
        .map(|frame| frame.sequence)
        .collect();
    assert_eq!(arrived, [0, 1, 2]);
    let planner = fixture.connect();
    let mut sink = planner.frame_sink().unwrap();
    meet(&mut *sink, &mut *source);
}

pub(crate) fn there_is_one_consumer_of_frames<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let _source = interpolator.frame_source().unwrap();
    let another = fixture.connect();
    assert!(matches!(
        another.frame_source(),
        Err(LinkError::Taken { .. })
    ));
}

pub(crate) fn there_are_two_publishers_of_setpoints_at_most<F: Fixture>(fixture: &F) {
    let ends = [fixture.connect(), fixture.connect(), fixture.connect()];
    let [one, two, three] = &ends;
    let setpoints = (one.setpoint_sink().unwrap(), two.setpoint_sink().unwrap());
    assert!(matches!(
        three.setpoint_sink(),
        Err(LinkError::Taken { .. })
    ));
    drop(setpoints);
    three.setpoint_sink().unwrap();
}

pub(crate) fn there_is_one_planner<F: Fixture>(fixture: &F) {
    let planner = fixture.connect();
    let sink = planner.frame_sink().unwrap();
    let another = fixture.connect();
    assert!(matches!(another.frame_sink(), Err(LinkError::Taken { .. })));
    drop(sink);
    let _sink = another.frame_sink().unwrap();
}
