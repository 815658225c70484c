//! Tests of what a plan promises besides the limits: order, stops, events, and nothing but the
//! program in it.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::planned::{moves, numbered, plan};
use crate::support::{FREE, at, cases, efforts, mill, optimal};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::Planner;
use glidepath_program::{
    Corners, EVENTS_MOST, Event, Frame, FrameFlags, Item, ItemKind, Limits, PathMode, Rate,
    Settings, Smoothing,
};
use proptest::prelude::*;

fn time_t(frames: &[Frame]) -> f64 {
    let moving = |frame: &&Frame| frame.path_v > 0.0;
    frames.iter().filter(moving).count() as f64
}

/// A closed curve of many short chords, with a few sharp corners.
fn rosette(count: u32) -> Vec<AxisVector> {
    let start = at(14.0, 0.0);
    (0..=count)
        .map(|i| {
            let phi = f64::from(i) / f64::from(count) * core::f64::consts::TAU;
            let radius = 10.0 + 4.0 * (5.0 * phi).cos().abs();
            at(radius * phi.cos(), radius * phi.sin()) - start
        })
        .collect()
}

#[test]
fn frames_are_numbered_and_start_and_end_at_rest() {
    for settings in efforts() {
        let frames = plan(&numbered(moves(&rosette(300), 80.0, FREE)), settings, 1);
        for (sequence, frame) in (0..).zip(&frames) {
            assert_eq!(frame.sequence, sequence, "gap");
        }
        let (first, last) = (frames[0], frames[frames.len() - 1]);
        assert_eq!(first.flags, FrameFlags::FIRST, "first flag");
        assert_eq!(last.flags, FrameFlags::LAST, "last flag");
        assert_eq!(
            (first.path_v, last.path_v),
            (0.0, 0.0),
            "at rest at both ends"
        );
        assert!(
            last.position.amax() < 1e-12,
            "closed curve ends at {}",
            last.position
        );
        let backwards = frames
            .windows(2)
            .filter(|pair| pair[1].path_s < pair[0].path_s)
            .count();
        assert_eq!(backwards, 0, "path position never falls");
    }
}

#[test]
fn frames_do_not_depend_on_when_they_are_taken() {
    for settings in efforts() {
        let items = numbered(moves(&rosette(2000), 80.0, FREE));
        let one_by_one = plan(&items, settings, 1);
        for every in [7, 100, 100_000] {
            assert_eq!(
                one_by_one,
                plan(&items, settings, every),
                "taken every {every} items"
            );
        }
    }
}

#[test]
fn frames_come_before_the_program_ends_and_memory_stays_bounded() {
    let whole = |settings| Planner::new(settings, at(0.0, 0.0));
    let (first_after, frames) = first_frames(whole(mill()), 60_000);
    assert!(
        first_after < 10_000,
        "first moving frame only after {first_after} segments"
    );
    assert!(frames > 1000, "{frames} frames before the end");
    // Five seconds at their rate may be planned as a whole.
    let (first_after, frames) = first_frames(whole(optimal()), 7000);
    assert!(
        first_after < 5500,
        "first moving frame only after {first_after} segments"
    );
    assert!(frames > 200, "{frames} frames before the end");
    let (first_after, frames) = first_frames(whole(optimal()).of_stream(), 3000);
    assert!(
        first_after < 1500,
        "first moving frame only after {first_after} segments"
    );
    assert!(frames > 200, "{frames} frames before the end");
}

/// The segment after which the first moving frame comes, and how many come before the program ends.
fn first_frames(mut planner: Planner, count: u32) -> (u32, u32) {
    let mut first_after = None;
    let mut frames = 0_u32;
    let mut position = at(0.0, 0.0);
    for i in 0..count {
        let next = position + at(0.05, if i % 2 == 0 { 0.01 } else { -0.01 });
        let segment = Segment::line(position, next);
        let kind = ItemKind::Move {
            segment,
            rate: Rate::Feed(50.0),
            mode: FREE,
        };
        planner
            .push(&Item {
                block: 0,
                line: i + 1,
                kind,
            })
            .expect("valid item");
        position = next;
        while planner.pop_frame().expect("a motion").is_some() {
            frames += 1;
            first_after = first_after.or(Some(i)).filter(|_| frames > 1);
        }
    }
    (first_after.expect("frames before the end"), frames)
}

#[test]
fn an_exact_stop_has_a_frame_exactly_at_its_corner() {
    for settings in efforts() {
        let corner = at(3.0, 0.1);
        let points = [at(0.0, 0.0), corner, at(5.0, 2.0)];
        let frames = plan(
            &numbered(moves(&points, 60.0, PathMode::ExactStop)),
            settings,
            1,
        );
        let stop = frames
            .iter()
            .find(|frame| frame.flags.contains(FrameFlags::EXACT_STOP));
        let stop = stop.expect("a stop");
        assert_eq!(
            (stop.position, stop.velocity),
            (corner, AxisVector::zeros()),
            "rests at the corner"
        );
    }
}

#[test]
fn exact_path_passes_through_every_corner_and_does_not_stop_on_a_straight() {
    for settings in efforts() {
        let points = [at(0.0, 0.0), at(5.0, 0.0), at(10.0, 0.0), at(10.0, 7.0)];
        let frames = plan(
            &numbered(moves(&points, 60.0, PathMode::ExactPath)),
            settings,
            1,
        );
        let nearest = |point: AxisVector| {
            frames
                .iter()
                .map(|f| (f.position - point).norm())
                .fold(f64::INFINITY, f64::min)
        };
        assert!(nearest(at(10.0, 0.0)) < 1e-3, "{}", nearest(at(10.0, 0.0)));
        let on_line = frames
            .iter()
            .all(|f| f.position[1].abs() < 1e-9 || f.position[0] > 10.0 - 1e-9);
        assert!(on_line, "leaves the path");
        let halfway = frames
            .iter()
            .find(|f| f.position[0] >= 5.0)
            .expect("passes the middle");
        assert!(
            halfway.path_v > 50.0,
            "slows to {} on a straight",
            halfway.path_v
        );
    }
}

#[test]
fn events_happen_in_order_and_m_codes_at_rest() {
    efforts().into_iter().for_each(check_events);
}

fn check_events(settings: Settings) {
    let leg = |from: AxisVector, to: AxisVector| moves(&[from, to], 60.0, FREE).remove(0);
    let (a, b, c, d) = (at(0.0, 0.0), at(10.0, 0.0), at(20.0, 0.0), at(30.0, 0.0));
    let items = numbered(vec![
        ItemKind::Event(Event::SpindleSpeed(1000.0)),
        ItemKind::Event(Event::MCode(3)),
        leg(a, b),
        ItemKind::Event(Event::SpindleSpeed(2000.0)),
        leg(b, c),
        ItemKind::Dwell(0.1),
        ItemKind::Event(Event::ProgramStop(0)),
        leg(c, d),
        ItemKind::Event(Event::MCode(5)),
    ]);
    let frames = plan(&items, settings, 1);
    let seen: Vec<_> = frames
        .iter()
        .flat_map(|f| f.events.as_slice().iter().map(move |told| (told.event, f)))
        .collect();
    let events: Vec<_> = seen.iter().map(|(event, _)| *event).collect();
    let expected = [
        Event::SpindleSpeed(1000.0),
        Event::MCode(3),
        Event::SpindleSpeed(2000.0),
        Event::ProgramStop(0),
        Event::MCode(5),
    ];
    assert_eq!(events, expected, "order of events");
    for (event, frame) in seen {
        match event {
            Event::SpindleSpeed(speed) if speed > 1500.0 => {
                assert!(frame.path_v > 30.0, "S alone does not stop");
                assert!(
                    (frame.position[0] - 10.0).abs() < 60.0 * 0.004,
                    "S at its place"
                );
            }
            _ => assert!(frame.path_v <= 0.0, "{event:?} at rest"),
        }
    }
    let stop = frames
        .iter()
        .filter(|f| f.flags.contains(FrameFlags::PROGRAM_STOP))
        .count();
    assert_eq!(stop, 1, "one frame asks for the operator");
    for (line, end) in [(5, 20.0_f64), (8, 30.0)] {
        let arrives = frames.iter().find(|f| f.line == line && f.path_v <= 0.0);
        let arrives = arrives.map(|f| (f.position[0].to_bits(), f.events.at_rest()));
        assert_eq!(arrives, Some((end.to_bits(), None)), "it ends at rest");
    }
    let dwell = frames
        .iter()
        .filter(|f| f.flags.contains(FrameFlags::DWELL))
        .count();
    assert!(
        (25..=27).contains(&dwell),
        "0.1 s are 25 periods, got {dwell}"
    );
}

#[test]
fn what_needs_no_rest_passes_at_the_feed() {
    for settings in efforts() {
        let points: Vec<_> = (0..=4).map(|i| at(20.0 * f64::from(i), 0.0)).collect();
        let plain = moves(&points, 100.0, FREE);
        let events = [
            Event::AnalogOutput {
                number: 0,
                value: 1.0,
            },
            Event::DigitalOutput {
                number: 3,
                on: true,
            },
            Event::PassingCode(8),
        ];
        let told = plain.iter().zip([None].into_iter().chain(events.map(Some)));
        let told: Vec<_> = told
            .flat_map(|(kind, event)| event.map(ItemKind::Event).into_iter().chain([*kind]))
            .collect();
        let (frames, without) = (
            plan(&numbered(told), settings, 1),
            plan(&numbered(plain), settings, 1),
        );
        assert_eq!(frames.len(), without.len(), "they take no time");
        let middle = frames
            .iter()
            .filter(|f| (5.0..75.0).contains(&f.position[0]));
        let slowest_v = middle.map(|f| f.path_v).fold(f64::INFINITY, f64::min);
        assert!(slowest_v > 99.0, "slows to {slowest_v} mm/s");
    }
}

#[test]
fn a_word_every_tenth_of_a_millimetre_is_in_its_place_at_the_feed() {
    for settings in efforts() {
        let points: Vec<_> = (0..=200).map(|i| at(0.1 * f64::from(i), 0.0)).collect();
        let words = (0_u32..).map(|i| ItemKind::Event(Event::SpindleSpeed(f64::from(i))));
        let told: Vec<_> = words
            .zip(moves(&points, 100.0, FREE))
            .flat_map(|(word, leg)| [word, leg])
            .collect();
        let frames = plan(&numbered(told), settings, 1);
        let plain = plan(
            &numbered(moves(&[points[0], points[200]], 100.0, FREE)),
            settings,
            1,
        );
        assert!(
            frames.len() <= plain.len() + 1,
            "{} periods, {} without words",
            frames.len(),
            plain.len()
        );
        let mut next = 0;
        for pair in frames.windows(2) {
            let [from, to] = [pair[0].position[0], pair[1].position[0]];
            for told in pair[1].events.as_slice() {
                assert_eq!(told.event, Event::SpindleSpeed(f64::from(next)), "in order");
                let place = 0.1 * f64::from(next);
                let found = from + (to - from) * f64::from(told.offset_ns) / 4e6;
                // Between two frames the motion is no straight line in time: a T²/8.
                let off_mm = (found - place).abs();
                assert!(off_mm < 0.005, "word {next} is off by {off_mm} mm");
                next += 1;
            }
        }
        assert_eq!(next, 200, "each of them once");
    }
}

#[test]
fn more_events_than_fit_make_the_motion_slower() {
    for settings in efforts() {
        let points: Vec<_> = (0..=300).map(|i| at(0.02 * f64::from(i), 0.0)).collect();
        let words = (0_u32..).map(|i| ItemKind::Event(Event::SpindleSpeed(f64::from(i))));
        let told: Vec<_> = words
            .zip(moves(&points, 100.0, FREE))
            .flat_map(|(word, leg)| [word, leg])
            .collect();
        let frames = plan(&numbered(told), settings, 1);
        let most = frames.iter().map(|frame| frame.events.as_slice().len());
        assert!(most.max() < Some(EVENTS_MOST), "a frame is full");
        for pair in frames.windows(2) {
            let [from, to] = [pair[0].position[0], pair[1].position[0]];
            for told in pair[1].events.as_slice() {
                let Event::SpindleSpeed(number) = told.event else {
                    panic!("{told:?}")
                };
                let found = from + (to - from) * f64::from(told.offset_ns) / 4e6;
                let off_mm = (found - 0.02 * number).abs();
                assert!(off_mm < 0.005, "word {number} is off by {off_mm} mm");
            }
        }
    }
}

#[test]
fn events_of_a_move_shorter_than_a_period_all_happen_before_the_end() {
    for settings in efforts() {
        let leg = |from: AxisVector, to: AxisVector| moves(&[from, to], 60.0, FREE).remove(0);
        let items = numbered(vec![
            leg(at(0.0, 0.0), at(10.0, 0.0)),
            ItemKind::Event(Event::SpindleSpeed(1000.0)),
            ItemKind::Event(Event::SelectTool(3)),
            ItemKind::Event(Event::SpindleSpeed(2000.0)),
            leg(at(10.0, 0.0), at(10.00001, 0.0)),
        ]);
        let frames = plan(&items, settings, 1);
        let events: Vec<_> = frames
            .iter()
            .flat_map(|frame| frame.events.as_slice())
            .map(|told| told.event)
            .collect();
        let expected = [
            Event::SpindleSpeed(1000.0),
            Event::SelectTool(3),
            Event::SpindleSpeed(2000.0),
        ];
        assert_eq!(events, expected, "order of events");
        let ends = frames
            .iter()
            .filter(|f| f.flags.contains(FrameFlags::LAST))
            .count();
        assert_eq!(ends, 1, "one last frame");
        assert_eq!(
            frames[frames.len() - 1].flags,
            FrameFlags::LAST,
            "at the end"
        );
    }
}

#[test]
fn moves_below_the_resolution_are_neither_lost_nor_a_hindrance() {
    for settings in efforts() {
        let points: Vec<_> = (0..=5000).map(|i| at(f64::from(i) * 1e-7, 0.0)).collect();
        let frames = plan(&numbered(moves(&points, 60.0, FREE)), settings, 1);
        let last = frames[frames.len() - 1].position;
        assert_eq!(last, points[5000], "ends where the program ends");
        assert!(
            frames.len() < 2000,
            "{} frames for half a micrometre",
            frames.len()
        );
    }
}

/// A unit 64 times larger: a power of two, so that only a constant with a unit could change
/// anything. In micrometres lengths are rounded otherwise, and the optimum is found on another way. There are two such
/// constants: the length from which on a move is straight in its middle half, and no move here is as long; and how far
/// beyond a border the motion may be, so that there are no borders here. Tests of the tube change these with the unit.
#[test]
fn a_machine_in_another_unit_moves_alike() {
    const FACTOR: f64 = 1.0 / 64.0;
    let in_unit = |settings: Settings| Settings {
        limits: Limits {
            velocity: settings.limits.velocity * FACTOR,
            acceleration: settings.limits.acceleration * FACTOR,
            jerk: settings.limits.jerk * FACTOR,
            ..settings.limits
        },
        tolerance_mm: settings.tolerance_mm * FACTOR,
        ..settings
    };
    let points = rosette(400);
    let large: Vec<_> = points.iter().map(|p| p * FACTOR).collect();
    for settings in efforts() {
        let settings = Settings {
            corners: Corners::Either,
            ..settings
        };
        let frames = plan(&numbered(moves(&points, 80.0, FREE)), settings, 1);
        let large = numbered(moves(&large, 80.0 * FACTOR, FREE));
        let scaled = plan(&large, in_unit(settings), 1);
        assert_eq!(
            frames.len(),
            scaled.len(),
            "same number of periods, {:?}",
            settings.effort
        );
        for (a, b) in frames.iter().zip(&scaled) {
            assert!(
                (a.position * FACTOR - b.position).amax() < 1e-12,
                "{:?}, frame {}",
                settings.effort,
                a.sequence
            );
        }
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn no_plan_is_slower_than_stopping_at_every_corner(
        steps in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, -1.5..1.3_f64), 2..40),
        jerk_log in 4.3..6.0_f64,
    ) {
        let mut points = vec![at(0.0, 0.0)];
        for (x, y, log_length) in steps {
            let last = points[points.len() - 1];
            points.push(last + at(x, y) * 10_f64.powf(log_length));
        }
        let settings = Settings {
            limits: Limits::uniform(200.0, 2000.0, 10_f64.powf(jerk_log)),
            period_t: 0.001,
            ..mill()
        };
        let items = numbered(moves(&points, 100.0, FREE));
        let stopping = Settings { smoothing: Smoothing::ExactStop, ..settings };
        let (smooth_t, stop_t) =
            (time_t(&plan(&items, settings, 1)), time_t(&plan(&items, stopping, 1)));
        // Stretches of so few blocks are planned both ways, where they take less than about a
        // second. Longer ones may end in a bend that is slower than a stop. A rest falls between
        // two ticks.
        prop_assert!(smooth_t <= 1.02 * stop_t + 1.0, "{smooth_t} ticks against {stop_t}");
    }
}
