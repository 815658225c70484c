//! Tests of interleaving: frames depend on the items alone, not on how pushing and taking
//! interleave.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::planned::{moves, numbered, plan};
use crate::support::{FREE, at, cases, efforts, mill, optimal};
use glidepath_geometry::AxisVector;
use glidepath_motion::Planner;
use glidepath_program::{Event, ItemKind, PathMode};
use proptest::prelude::*;

/// Who sends a few moves through a pipe expects them to begin.
#[test]
fn a_few_moves_begin_without_waiting_for_more() {
    let square = [at(0.0, 0.0), at(12.0, 0.0), at(12.0, 12.0), at(0.0, 12.0)];
    for (settings, is_stream, count) in [
        (mill(), false, 5),
        (optimal(), true, 5),
        // 6 s at their rate.
        (optimal(), false, 20),
    ] {
        let corners: Vec<_> = square.into_iter().cycle().take(count + 1).collect();
        let mut planner = Planner::new(settings, AxisVector::zeros());
        if is_stream {
            planner = planner.of_stream();
        }
        for item in numbered(moves(&corners, 40.0, FREE)) {
            planner.push(&item).expect("valid item");
        }
        let mut frames = std::iter::from_fn(|| planner.pop_frame().expect("a motion"));
        let begins = frames.any(|frame| frame.position != AxisVector::zeros());
        assert!(begins, "{:?}", settings.effort);
    }
}

proptest! {
    #![proptest_config(cases(20))]

    #[test]
    fn frames_do_not_depend_on_how_pushing_and_taking_interleave(
        steps in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, -1.5..1.0_f64, 0..12_u8), 2..40),
        takes in prop::collection::vec(0..60_usize, 1..40),
    ) {
        let mut kinds = Vec::new();
        let mut from = at(0.0, 0.0);
        for (x, y, log_length, kind) in steps {
            let to = from + at(x, y) * 10_f64.powf(log_length);
            let mode = match kind {
                0 => PathMode::ExactStop,
                1 | 2 => PathMode::ExactPath,
                _ => FREE,
            };
            match kind {
                3 => kinds.push(ItemKind::Dwell(0.01)),
                4 => kinds.push(ItemKind::Event(Event::SpindleSpeed(x))),
                5 => kinds.push(ItemKind::Event(Event::MCode(3))),
                6 => kinds.push(ItemKind::Event(Event::PassingCode(8))),
                _ => {}
            }
            kinds.extend(moves(&[from, to], 60.0, mode));
            from = to;
        }
        let items = numbered(kinds);
        for settings in efforts() {
            let all_at_once = plan(&items, settings, usize::MAX);
            let mut planner = Planner::new(settings, AxisVector::zeros());
            let mut frames = Vec::new();
            for (item, &takes) in items.iter().zip(takes.iter().cycle()) {
                planner.push(item).expect("a valid item");
                for _ in 0..takes {
                    frames.extend(planner.pop_frame().expect("a motion"));
                }
            }
            planner.finish();
            frames.extend(std::iter::from_fn(|| planner.pop_frame().expect("a motion")));
            prop_assert_eq!(&all_at_once, &frames);
        }
    }
}
