//! The helpers of tests: moves as items, and the frames of items.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::Planner;
use glidepath_program::{Frame, Item, ItemKind, PathMode, Rate, Settings};

/// Lines from point to point.
pub(crate) fn moves(points: &[AxisVector], feed_v: f64, mode: PathMode) -> Vec<ItemKind> {
    points
        .windows(2)
        .map(|pair| ItemKind::Move {
            segment: Segment::line(pair[0], pair[1]),
            rate: Rate::Feed(feed_v),
            mode,
        })
        .collect()
}

/// Each on a line of its own.
pub(crate) fn numbered(kinds: Vec<ItemKind>) -> Vec<Item> {
    (1..)
        .zip(kinds)
        .map(|(line, kind)| Item {
            block: 0,
            line,
            kind,
        })
        .collect()
}

/// All frames, taken after every `every`-th item and at the end.
pub(crate) fn plan(items: &[Item], settings: Settings, every: usize) -> Vec<Frame> {
    let mut planner = Planner::new(settings, AxisVector::zeros());
    let mut frames = Vec::new();
    for (i, item) in items.iter().enumerate() {
        planner.push(item).expect("valid item");
        if i % every == 0 {
            frames.extend(std::iter::from_fn(|| {
                planner.pop_frame().expect("a motion")
            }));
        }
    }
    planner.finish();
    frames.extend(std::iter::from_fn(|| {
        planner.pop_frame().expect("a motion")
    }));
    frames
}
