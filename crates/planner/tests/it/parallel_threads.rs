//! The threads of a plan on all cores: how they end, and what they wait for.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use std::num::NonZeroUsize;
use std::sync::mpsc::{Sender, channel};
use std::time::Duration;

use crate::parallel::{same, settings};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::PlanError;
use glidepath_planner::{ItemSource, ParallelPipeline, Refusal, Supply};
use glidepath_program::{Effort, Item, ItemKind, PathMode, Rate};

/// Items, and how they end.
struct Listed(std::vec::IntoIter<Item>, Option<Refusal>);

impl ItemSource for Listed {
    fn next_item(&mut self) -> Supply {
        match (self.0.next(), self.1.take()) {
            (Some(item), refusal) => {
                self.1 = refusal;
                Supply::Item(item)
            }
            (None, Some(refusal)) => Supply::Refused(refusal),
            (None, None) => Supply::End,
        }
    }

    fn lines_read(&self) -> u64 {
        0
    }
}

/// Moves of half a millimetre, a dwell after every tenth.
fn listed(count: u32) -> Vec<Item> {
    let at = |number: u32| {
        let mut at = AxisVector::zeros();
        at[0] = 0.5 * f64::from(number);
        at
    };
    let mut items = Vec::new();
    for number in 0..count {
        let kind = ItemKind::Move {
            segment: Segment::line(at(number), at(number + 1)),
            rate: Rate::Feed(50.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        let item = |kind| Item {
            block: 0,
            line: number + 1,
            kind,
        };
        items.push(item(kind));
        if number % 10 == 9 {
            items.push(item(ItemKind::Dwell(0.01)));
        }
    }
    items
}

#[test]
fn what_ends_a_program_early_is_told_after_its_motion() {
    for effort in [Effort::Fast, Effort::Optimal] {
        // A move that does not begin where the last one ended, right after a rest and elsewhere.
        for wrong in [20, 22, 44, 45, 58] {
            let mut items = listed(60);
            items.remove(wrong);
            let make = || Listed(items.clone().into_iter(), None);
            let parts = same("a gap", make, effort, &[1, 3]);
            assert!(parts > 1 || wrong < 44, "{wrong}: {parts}");
        }
        for count in [0, 10, 37] {
            let refusal = || Some(Refusal::Plan(PlanError::NotFinite { line: 7 }));
            let make = || Listed(listed(count).into_iter(), refusal());
            same("a source that fails", make, effort, &[1, 3]);
        }
    }
}

#[test]
fn a_plan_that_nobody_takes_ends_its_threads() {
    let make = || Listed(listed(20_000).into_iter(), None);
    for taken in [0, 1, 5000] {
        let workers = NonZeroUsize::new(2).expect("two");
        let (settings, start) = (settings(Effort::Fast), AxisVector::zeros());
        let mut cores =
            ParallelPipeline::start(make(), settings, start, None, workers).expect("threads");
        for _ in 0..taken {
            cores.step().expect("a step");
        }
        // Returns when they have ended.
        drop(cores);
    }
}

/// Items, and where it is told that all of them were read.
struct Told(Listed, Sender<()>);

impl ItemSource for Told {
    fn next_item(&mut self) -> Supply {
        let supply = self.0.next_item();
        if matches!(supply, Supply::End) {
            self.1.send(()).expect("somebody waits");
        }
        supply
    }

    fn lines_read(&self) -> u64 {
        self.0.lines_read()
    }
}

/// Otherwise a second thread would have nothing to do until the first part is nearly planned.
#[test]
fn a_part_is_read_to_its_end_however_far_its_plan_is() {
    // 33 minutes of motion without a rest: more frames than wait for their taker.
    let mut items = listed(2000);
    items.retain(|item| matches!(item.kind, ItemKind::Move { .. }));
    for item in &mut items {
        if let ItemKind::Move { rate, .. } = &mut item.kind {
            *rate = Rate::Feed(0.5);
        }
    }
    let (sender, read) = channel();
    let source = Told(Listed(items.into_iter(), None), sender);
    let workers = NonZeroUsize::new(2).expect("two");
    let (settings, start) = (settings(Effort::Optimal), AxisVector::zeros());
    let cores = ParallelPipeline::start(source, settings, start, None, workers).expect("threads");
    read.recv_timeout(Duration::from_secs(60))
        .expect("all of it is read while nothing is taken");
    drop(cores);
}
