//! Tests of refusals: items that cannot be planned are refused, and change nothing.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::support::{FREE, at, efforts};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::{PlanError, Planner};
use glidepath_program::{Item, ItemKind, PathMode, Rate};

#[test]
fn a_bad_item_is_refused_and_changes_nothing() {
    for settings in efforts() {
        let mut planner = Planner::new(settings, AxisVector::zeros());
        let segment = Segment::line(at(0.0, 0.0), at(1.0, 0.0));
        let item = |segment, rate, mode| Item {
            block: 0,
            line: 7,
            kind: ItemKind::Move {
                segment,
                rate,
                mode,
            },
        };
        let apart = Segment::line(at(0.5, 0.0), at(1.0, 0.0));
        let infinite = Segment::line(at(0.0, 0.0), at(f64::INFINITY, 0.0));
        let tight = PathMode::Continuous {
            tolerance_mm: Some(0.0),
        };
        let refused = [
            (
                item(apart, Rate::Rapid, FREE),
                PlanError::Gap {
                    line: 7,
                    gap_mm: 0.5,
                },
            ),
            (
                item(infinite, Rate::Rapid, FREE),
                PlanError::NotFinite { line: 7 },
            ),
            (
                item(segment, Rate::Feed(0.0), FREE),
                PlanError::Feed {
                    line: 7,
                    feed_v: 0.0,
                },
            ),
            (
                item(segment, Rate::Rapid, tight),
                PlanError::Tolerance {
                    line: 7,
                    tolerance_mm: 0.0,
                },
            ),
            (
                Item {
                    block: 0,
                    line: 7,
                    kind: ItemKind::Dwell(-1.0),
                },
                PlanError::Dwell {
                    line: 7,
                    dwell_t: -1.0,
                },
            ),
        ];
        for (item, expected) in refused {
            assert_eq!(planner.push(&item), Err(expected), "{item:?}");
        }
        planner
            .push(&item(segment, Rate::Rapid, FREE))
            .expect("goes on as if nothing had been");
        planner.finish();
        let last = std::iter::from_fn(|| planner.pop_frame().expect("a motion"))
            .last()
            .expect("frames");
        assert_eq!(last.position, at(1.0, 0.0), "end");
    }
}
