//! Tests of overrides: they change the speed of what is still to come, never the limits or the
//! path.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::support::{FREE, at, cases, efforts, mill, optimal};
use glidepath_audit::{Audit, AuditSettings, Sample, ViolationKind};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_motion::{PlanError, Planner};
use glidepath_program::{
    Event, Frame, FrameFlags, Item, ItemKind, Override, PathMode, Rate, Settings,
};
use proptest::prelude::*;

fn item(line: u32, segment: Segment, rate: Rate) -> Item {
    Item {
        block: 0,
        line,
        kind: ItemKind::Move {
            segment,
            rate,
            mode: FREE,
        },
    }
}

/// Plans with overrides that are given before certain frames, in rising order.
fn plan(items: &[Item], settings: Settings, changes: &[(u64, Override)]) -> Vec<Frame> {
    let mut planner = Planner::new(settings, AxisVector::zeros());
    let mut frames: Vec<Frame> = Vec::new();
    let mut changes = changes.iter().peekable();
    let mut rest = items.iter();
    loop {
        while let Some((_, wanted)) = changes.next_if(|(when, _)| *when <= frames.len() as u64) {
            planner.set_override(*wanted).expect("a valid override");
        }
        match planner.pop_frame().expect("a motion") {
            Some(frame) => frames.push(frame),
            None => match rest.next() {
                Some(item) => planner.push(item).expect("a valid item"),
                None => {
                    planner.finish();
                    match planner.pop_frame().expect("a motion") {
                        Some(frame) => frames.push(frame),
                        None => return frames,
                    }
                }
            },
        }
        assert!(
            frames.len() < 1_000_000,
            "the motion crawls: {:?}",
            frames.last()
        );
    }
}

fn feed(feed_r: f64) -> Override {
    Override {
        feed_r,
        rapid_r: 1.0,
    }
}

/// A long line, an arc, and a stretch of short chords, at 40 mm/s.
fn part() -> Vec<Item> {
    let rate = Rate::Feed(40.0);
    let mut items = vec![item(1, Segment::line(at(0.0, 0.0), at(60.0, 0.0)), rate)];
    let arc = Arc {
        start: at(60.0, 0.0),
        end: at(60.0, 30.0),
        plane: Plane::Xy,
        center: [60.0, 15.0],
        sweep_rad: core::f64::consts::PI,
    };
    items.push(item(2, Segment::Arc(arc), rate));
    let mut from = at(60.0, 30.0);
    for i in 1..=400_u32 {
        let x = f64::from(i) * 0.15;
        let to = at(60.0 - x, 30.0 + 2.0 * (x / 8.0).sin());
        items.push(item(2 + i, Segment::line(from, to), rate));
        from = to;
    }
    items
}

#[test]
fn an_override_from_the_start_gives_the_plan_of_that_feed() {
    for settings in efforts() {
        for factor in [0.5, 2.0] {
            let overridden = plan(&part(), settings, &[(0, feed(factor))]);
            let scaled: Vec<_> = part()
                .into_iter()
                .map(|item| match item.kind {
                    ItemKind::Move { segment, .. } => {
                        self::item(item.line, segment, Rate::Feed(40.0 * factor))
                    }
                    _ => item,
                })
                .collect();
            let programmed = plan(&scaled, settings, &[]);
            assert_eq!(overridden.len(), programmed.len(), "{factor}");
        }
    }
}

#[test]
fn an_override_on_the_way_takes_effect_within_a_horizon() {
    for settings in efforts() {
        let frames = |changes: &[(u64, Override)]| plan(&part(), settings, changes);
        let full = frames(&[]);
        for when in [50_usize, 200, 400, 700] {
            let from_s = full[when].path_s;
            for factor in [0.5, 2.0] {
                let other = frames(&[(0, feed(factor))]);
                let left = other.iter().filter(|frame| frame.path_s > from_s).count();
                let expected = (when + left) as f64;
                let actual = frames(&[(when as u64, feed(factor))]).len() as f64;
                let horizon = 0.5 / 0.004;
                assert!(
                    (actual - expected).abs() <= 0.02 * expected + horizon,
                    "{factor} at {when}: {actual} frames, expected about {expected}"
                );
            }
        }
    }
}

#[test]
fn frames_tell_their_override() {
    for settings in efforts() {
        let frames = plan(&part(), settings, &[(300, feed(1.5))]);
        let told: Vec<_> = frames.iter().map(|frame| frame.planned_override).collect();
        let change = told
            .iter()
            .position(|&r| r > 1.25)
            .expect("the override arrives");
        assert!((300..400).contains(&change), "arrives at {change}");
        assert!(
            told[..change].iter().all(|&r| (r - 1.0).abs() < 1e-12),
            "before"
        );
        assert!(
            told[change..].iter().all(|&r| (r - 1.5).abs() < 1e-12),
            "after"
        );
    }
}

#[test]
fn a_rapid_keeps_to_its_own_override() {
    for settings in efforts() {
        let rapid = [item(
            1,
            Segment::line(at(0.0, 0.0), at(200.0, 0.0)),
            Rate::Rapid,
        )];
        let slow = Override {
            feed_r: 2.0,
            rapid_r: 0.25,
        };
        let frames = plan(&rapid, settings, &[(0, slow)]);
        let peak_v = frames.iter().map(|frame| frame.path_v).fold(0.0, f64::max);
        assert!((peak_v - 50.0).abs() < 0.1, "{peak_v}");
    }
}

#[test]
fn nonsense_is_refused() {
    for settings in efforts() {
        let mut planner = Planner::new(settings, AxisVector::zeros());
        for (feed_r, rapid_r) in [
            (0.0, 1.0),
            (-1.0, 1.0),
            (f64::INFINITY, 1.0),
            (1.0, 1.5),
            (1.0, 0.0),
        ] {
            let refused = planner.set_override(Override { feed_r, rapid_r });
            assert_eq!(
                refused,
                Err(PlanError::Override { feed_r, rapid_r }),
                "{feed_r} {rapid_r}"
            );
        }
    }
}

type Steps = Vec<(f64, f64, f64, f64, u8)>;
type Changes = Vec<(u64, f64, f64)>;

fn any_steps() -> impl Strategy<Value = Steps> {
    let step = (
        -1.0..1.0_f64,
        -1.0..1.0_f64,
        -1.5..1.3_f64,
        0.7..2.0_f64,
        0..8_u8,
    );
    prop::collection::vec(step, 2..30)
}

fn any_changes() -> impl Strategy<Value = Changes> {
    prop::collection::vec((0..120_u64, 0.1..2.0_f64, 0.1..1.0_f64), 0..12)
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn overrides_at_any_time_keep_limits_and_path(steps in any_steps(), changes in any_changes()) {
        keeps_limits_and_path(steps, changes, mill())?;
    }
}

proptest! {
    #![proptest_config(cases(30))]

    #[test]
    fn overrides_of_an_optimal_plan_keep_limits_and_path(
        steps in any_steps(),
        changes in any_changes(),
    ) {
        keeps_limits_and_path(steps, changes, optimal())?;
    }
}

fn keeps_limits_and_path(
    steps: Steps,
    changes: Changes,
    settings: Settings,
) -> Result<(), TestCaseError> {
    let mut items = Vec::new();
    let mut from = AxisVector::zeros();
    for (line, (x, y, log_length, log_feed, kind)) in (1..).zip(steps) {
        let to = from + at(x, y) * 10_f64.powf(log_length);
        let feed_v = 10_f64.powf(log_feed);
        let rate = if kind == 0 {
            Rate::Rapid
        } else {
            Rate::Feed(feed_v)
        };
        items.push(item(line, Segment::line(from, to), rate));
        from = to;
    }
    let mut when = 0;
    let changes: Vec<_> = changes
        .into_iter()
        .map(|(wait, feed_r, rapid_r)| {
            when += wait;
            (when, Override { feed_r, rapid_r })
        })
        .collect();
    let frames = plan(&items, settings, &changes);
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    items.iter().for_each(|item| audit.program(item));
    frames
        .iter()
        .for_each(|frame| audit.sample(&Sample::from(frame)));
    let report = audit.finish();
    // The auditor knows the programmed feed, not the overrides: twice that, and the auditor's own
    // slack.
    let is_fast = |kind: &ViolationKind| matches!(kind, ViolationKind::Feed { ratio } if *ratio <= 2.0 * (1.0 + 1e-3));
    let found: Vec<_> = report
        .violations
        .iter()
        .filter(|v| !is_fast(&v.kind))
        .collect();
    prop_assert!(
        found.is_empty() && report.is_complete,
        "{found:?} {report:#?}"
    );
    prop_assert!((frames[frames.len() - 1].position - from).amax() < 1e-9);
    let gaps = (0..)
        .zip(&frames)
        .filter(|(i, frame)| frame.sequence != *i)
        .count();
    prop_assert_eq!(gaps, 0);
    Ok(())
}

/// A pass of a thread, and the way back: with ways in and out, it is three moves.
fn thread(moves: &[(f64, f64)]) -> Vec<Item> {
    let event = Event::Synchronise {
        pitch_mm: 1.5,
        phase: 0,
    };
    let mut items = vec![Item {
        block: 0,
        line: 1,
        kind: ItemKind::Event(event),
    }];
    let mut from = at(0.0, 0.0);
    for (x, y) in moves {
        let kind = ItemKind::Move {
            segment: Segment::line(from, at(*x, *y)),
            rate: Rate::Synchronised(24.75),
            mode: PathMode::Continuous {
                tolerance_mm: Some(0.2),
            },
        };
        items.push(Item {
            block: 0,
            line: 1,
            kind,
        });
        from = at(*x, *y);
    }
    items.push(Item {
        block: 0,
        line: 1,
        kind: ItemKind::Dwell(0.0),
    });
    items.push(item(2, Segment::line(from, at(0.0, 5.0)), Rate::Rapid));
    items
}

#[test]
fn what_follows_the_spindle_keeps_its_rate_under_any_override() {
    for settings in efforts() {
        for length_mm in [8.0, 90.0] {
            let items = thread(&[(length_mm, 0.0)]);
            let plain = plan(&items, settings, &[]);
            let is_pass = |frame: &&Frame| frame.flags.contains(FrameFlags::SYNC);
            let pass: Vec<Frame> = plain.iter().filter(is_pass).copied().collect();
            let steady = pass
                .iter()
                .filter(|frame| (frame.path_v - 24.75).abs() < 1e-9);
            assert!(steady.count() > 60);
            assert!(
                pass.iter()
                    .all(|frame| frame.line == 1 && frame.path_v > 0.0)
            );
            for (when, feed_r) in [(0, 0.3), (20, 0.5), (40, 1.5)] {
                let changed = plan(&items, settings, &[(when, feed(feed_r))]);
                let same = changed.iter().filter(is_pass).zip(&pass);
                assert_eq!(changed.iter().filter(is_pass).count(), pass.len());
                for (frame, plain) in same {
                    let away = (frame.position - plain.position).amax();
                    assert!(away < 1e-9, "{when}: {away}");
                    assert!((frame.planned_override - 1.0).abs() < 1e-12);
                }
            }
        }
    }
}

#[test]
fn a_pass_with_ways_in_and_out_does_not_rest_under_way() {
    for settings in efforts() {
        let items = thread(&[(2.0, 0.9), (18.0, 0.9), (20.0, 0.0)]);
        let frames = plan(&items, settings, &[]);
        let speeds: Vec<f64> = frames
            .iter()
            .filter(|frame| frame.flags.contains(FrameFlags::SYNC))
            .map(|frame| frame.path_v)
            .collect();
        let last = frames
            .iter()
            .rposition(|f| f.flags.contains(FrameFlags::SYNC));
        let first = frames
            .iter()
            .position(|f| f.flags.contains(FrameFlags::SYNC));
        // Nothing else is between the first and the last of them.
        let (Some(first), Some(last)) = (first, last) else {
            panic!("no pass");
        };
        assert_eq!(last - first + 1, speeds.len());
        assert!(speeds.iter().all(|v| *v > 0.0));
    }
}

#[test]
fn frames_at_a_feed_per_revolution_say_so_and_are_those_of_a_feed() {
    let per_revolution = Rate::PerRevolution {
        feed_v: 30.0,
        most_v: f64::INFINITY,
    };
    let moves = |rate| {
        let arc = Arc {
            plane: Plane::Xy,
            start: at(30.0, 20.0),
            end: at(10.0, 20.0),
            center: [20.0, 20.0],
            sweep_rad: core::f64::consts::PI,
        };
        [
            item(1, Segment::line(at(0.0, 0.0), at(30.0, 0.0)), rate),
            item(2, Segment::line(at(30.0, 0.0), at(30.0, 20.0)), rate),
            item(3, Segment::Arc(arc), rate),
            item(4, Segment::line(at(10.0, 20.0), at(0.0, 0.0)), Rate::Rapid),
            item(
                5,
                Segment::line(at(0.0, 0.0), at(0.0, 9.0)),
                Rate::Feed(30.0),
            ),
        ]
    };
    for settings in efforts() {
        let plain = plan(&moves(Rate::Feed(30.0)), settings, &[]);
        let told = plan(&moves(per_revolution), settings, &[]);
        assert_eq!(plain.len(), told.len());
        for (plain, told) in plain.iter().zip(&told) {
            let is_told = told.flags.contains(FrameFlags::PER_REV);
            let flags = if is_told {
                plain.flags.with(FrameFlags::PER_REV)
            } else {
                plain.flags
            };
            // But for that flag, they are the same to the bit.
            assert_eq!(Frame { flags, ..*plain }, *told);
            if told.path_v > 0.0 && !told.flags.contains(FrameFlags::RAPID) {
                // A corner of both feeds goes with the spindle.
                let is_between = told.line == 4 || told.line == 5;
                assert!(is_told == (told.line <= 3) || is_between, "{told:?}");
            }
        }
        let at_last = told.iter().rev().filter(|frame| frame.line == 5).take(20);
        assert!(at_last.clone().count() == 20);
        assert!(
            at_last
                .clone()
                .all(|frame| !frame.flags.contains(FrameFlags::PER_REV))
        );
    }
}
