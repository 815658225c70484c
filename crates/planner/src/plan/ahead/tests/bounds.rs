//! Tests of how far is planned ahead.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::PlanError;
use glidepath_program::{Effort, Item, ItemKind, PathMode, Rate};

use super::ahead;
use super::mill::mill;
use crate::plan::pipeline::Pipeline;
use crate::source::item_source::{ItemSource, Supply};

/// Lines without end, and how many were taken. After so many of them the motion rests.
struct Endless<'c> {
    taken: &'c AtomicU64,
    step_mm: f64,
    rests_after: u64,
}

impl ItemSource for Endless<'_> {
    fn next_item(&mut self) -> Supply {
        let number = self.taken.fetch_add(1, Ordering::Relaxed);
        if number % self.rests_after == self.rests_after - 1 {
            return Supply::Item(Item {
                block: 0,
                line: 1,
                kind: ItemKind::Dwell(0.01),
            });
        }
        let lines = number - number / self.rests_after;
        #[allow(clippy::cast_precision_loss, reason = "exact for any test")]
        let at = |number: u64| {
            let mut at = AxisVector::zeros();
            let x = number as f64 * self.step_mm;
            (at[0], at[1]) = (x, (0.1 * x).sin());
            at
        };
        Supply::Item(Item {
            block: 0,
            line: 1,
            kind: ItemKind::Move {
                segment: Segment::line(at(lines), at(lines + 1)),
                rate: Rate::Feed(50.0),
                mode: PathMode::Continuous { tolerance_mm: None },
            },
        })
    }

    fn unplannable(&mut self, error: &PlanError) {
        panic!("{error}");
    }

    fn lines_read(&self) -> u64 {
        self.taken.load(Ordering::Relaxed)
    }
}

/// What may be taken ahead: what the history keeps, and what the planner looks ahead by.
const MOST_TAKEN: u64 = LEAST_TAKEN + 2 * 4096 + 8192;
const LEAST_TAKEN: u64 = 49_152;
/// Far longer than anything here takes: only a planner that does not get there is waited for so long.
const PATIENCE: Duration = Duration::from_secs(60);

/// Waits until the planning thread is as far ahead as it is to get, on a host that lets it run, and then until it
/// gets no further.
fn settled(taken: &AtomicU64, patience: Duration, is_there: impl Fn(u64) -> bool) -> u64 {
    let begun = Instant::now();
    while !is_there(taken.load(Ordering::Relaxed)) && begun.elapsed() < patience {
        std::thread::sleep(Duration::from_millis(1));
    }
    let mut before = u64::MAX;
    loop {
        let now = taken.load(Ordering::Relaxed);
        if now == before {
            return now;
        }
        before = now;
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn what_is_planned_ahead_is_bounded_in_frames_and_in_items() {
    // Very short moves, of which very many make a second; and long ones.
    for (step_mm, capacity) in [(1e-3, 2500), (1.0, 2500)] {
        let taken = AtomicU64::new(0);
        let source = Endless {
            taken: &taken,
            step_mm,
            rests_after: u64::MAX,
        };
        let pipeline = Pipeline::new(source, mill(Effort::Fast), AxisVector::zeros());
        let (mut fullest, mut most_taken) = (0, 0);
        let planned = ahead(pipeline, &[], 4000, capacity, |queue, number| {
            if !number.is_multiple_of(500) {
                return;
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "small numbers"
            )]
            let executed = (number as f64 * 0.004 * 50.0 / step_mm) as u64;
            // Where it is not there each time, it is at the last.
            let patience = if number < 4000 {
                PATIENCE / 20
            } else {
                PATIENCE
            };
            let now = settled(&taken, patience, |now| {
                if step_mm < 0.01 {
                    most_taken.max(now.saturating_sub(executed)) > LEAST_TAKEN
                } else {
                    queue.waiting() == capacity
                }
            });
            fullest = fullest.max(queue.waiting());
            most_taken = most_taken.max(now.saturating_sub(executed));
        });
        assert_eq!(planned.frames.len(), 4000);
        assert!(fullest <= capacity, "{fullest} frames wait");
        if step_mm < 0.01 {
            assert!(most_taken <= MOST_TAKEN, "{most_taken} items ahead");
            assert!(
                most_taken > LEAST_TAKEN,
                "the test does not reach the bound"
            );
        } else {
            assert_eq!(fullest, capacity, "the test does not reach the bound");
        }
    }
}

/// A stretch of dense lines that is planned as a whole is planned while the one before it is driven.
#[test]
fn a_stretch_of_dense_lines_is_planned_while_another_is_driven() {
    let taken = AtomicU64::new(0);
    let source = Endless {
        taken: &taken,
        step_mm: 0.01,
        rests_after: 20_000,
    };
    let pipeline = Pipeline::new(source, mill(Effort::Optimal), AxisVector::zeros());
    let mut seen = Vec::new();
    let planned = ahead(pipeline, &[], 1600, 1500, |queue, number| {
        if number.is_multiple_of(400) {
            settled(&taken, PATIENCE, |_| {
                seen.len() < 2 || queue.waiting() > 1200
            });
            seen.push(queue.waiting());
        }
    });
    assert_eq!(planned.frames.len(), 1600);
    // A stretch is some thousand frames.
    assert!(
        seen.iter().skip(2).all(|waiting| *waiting > 1200),
        "{seen:?} frames wait"
    );
}
