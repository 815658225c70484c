//! Tests of planning ahead: the frames are those of a planner that does not work ahead, to the bit.

#![allow(
    clippy::panic,
    clippy::print_stderr,
    reason = "a test that fails may panic, and a skipped one says so"
)]

mod bounds;
#[path = "../../../tests/it/support/mill.rs"]
mod mill;
mod silence;

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use glidepath_gcode::Options;
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Effort, Event, Frame, Item, ItemKind, Override, PathMode, Rate};
use proptest::prelude::*;

use super::{FrameQueue, Next, planned_ahead};
use crate::plan::pipeline::Pipeline;
use crate::plan::step::Step;
use crate::run::refusal::Refusal;
use crate::source::file::FileSource;
use crate::source::item_source::{ItemSource, Supply};
use mill::mill;

/// Frames that wait before the first one is given out.
const HEAD_START: usize = 112;

/// Another override after so many frames.
#[derive(Debug, Clone, Copy)]
struct Change {
    after: u64,
    wanted: Override,
}

fn change(after: u64, feed_r: f64, rapid_r: f64) -> Change {
    let wanted = Override { feed_r, rapid_r };
    Change { after, wanted }
}

/// What became of a program.
#[derive(Debug, PartialEq)]
struct Planned {
    frames: Vec<Frame>,
    refusal: Option<String>,
}

/// Pulled frame by frame; the override changes right after a frame was made.
fn pulled<S: ItemSource>(mut pipeline: Pipeline<S>, changes: &[Change], most: usize) -> Planned {
    let mut frames = Vec::new();
    let mut is_new = true;
    let refusal = loop {
        if is_new {
            let at = |change: &&Change| change.after == frames.len() as u64;
            // Of several after the same frame only the last has an effect.
            if let Some(change) = changes.iter().rfind(at) {
                pipeline.follow_override(change.wanted);
            }
        }
        is_new = false;
        match pipeline.step() {
            _ if frames.len() == most => break None,
            Ok(Step::Frame) => {
                frames.push(*pipeline.frame());
                is_new = true;
            }
            Ok(Step::Item | Step::Pending) => {}
            Ok(Step::End) => break None,
            Err(refusal) => break Some(refusal.to_string()),
        }
    };
    Planned { frames, refusal }
}

/// Planned ahead, and taken with a pause after each frame.
fn ahead<S: ItemSource + Send>(
    mut pipeline: Pipeline<S>,
    changes: &[Change],
    most: usize,
    capacity: usize,
    mut pause: impl FnMut(&FrameQueue, usize),
) -> Planned {
    let take = |queue: &FrameQueue| {
        let mut frames = Vec::new();
        let mut changes = changes.iter().peekable();
        loop {
            while let Some(change) = changes.next_if(|change| change.after <= frames.len() as u64) {
                if change.after == frames.len() as u64 {
                    queue.replan(change.wanted);
                }
            }
            if frames.len() == most {
                return (frames, None);
            }
            queue.ask_again(true);
            match queue.next() {
                Next::Frame(frame) => {
                    frames.push(frame);
                    pause(queue, frames.len());
                }
                Next::Busy => {
                    queue.wait(Duration::from_millis(50));
                }
                Next::Pending => std::thread::yield_now(),
                Next::End(end) => return (frames, end.err().map(|refusal| refusal.to_string())),
                Next::Died => panic!("the planning thread died"),
            }
        }
    };
    let (frames, refusal) = planned_ahead(&mut pipeline, (capacity, HEAD_START), take).unwrap();
    Planned { frames, refusal }
}

/// Programs of the bench and, where there are some, of other origin.
fn programs() -> Vec<PathBuf> {
    let bench = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/bench");
    let mut programs: Vec<PathBuf> = ["butterfly_g1_mill", "zigzag_mill", "star_mill"]
        .iter()
        .map(|name| bench.join(name).with_extension("ngc"))
        .collect();
    if let Some(corpus) = glidepath_testing::corpus_beside_others() {
        programs.extend(
            [
                "dense/trochoidal.ngc",
                "dense/random-lines-0.001in.ngc",
                "dense/finish-flower-mold.nc",
                "spline/nurbs-g52-dolphin.ngc",
                "laser/arcs-arrows.nc",
                "macro/qpocket.ngc",
                "tp-regress/rgh.ngc",
            ]
            .map(|name| corpus.join(name)),
        );
    }
    programs
}

fn pipeline(program: &Path, effort: Effort) -> Pipeline<FileSource> {
    let options = Options {
        default_feed_mm_min: Some(3000.0),
        ..Options::default()
    };
    let settings = mill(effort);
    let source = FileSource::unchecked(program, options, &settings).unwrap();
    Pipeline::new(source, settings, AxisVector::zeros())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(40) })]

    /// Overrides change at random while the queue is as full as may be, and as empty.
    #[test]
    fn frames_do_not_depend_on_how_far_planning_is_ahead(
        program in any::<prop::sample::Index>(),
        is_fast in any::<bool>(),
        drawn in prop::collection::vec((0_u64..1500, 1_u8..9, 1_u8..5), 0..8),
        capacity in prop::sample::select(vec![1, 7, 60, 400, 3000]),
        slow_every in 1_usize..200,
    ) {
        const MOST: usize = 1500;
        let programs = programs();
        let program = &programs[program.index(programs.len())];
        let effort = if is_fast { Effort::Fast } else { Effort::Optimal };
        let mut changes: Vec<Change> = drawn
            .into_iter()
            .map(|(after, feed, rapid)| {
                change(after, 0.25 * f64::from(feed), 0.25 * f64::from(rapid))
            })
            .collect();
        changes.sort_by_key(|change| change.after);
        // One more at the same frame, which the next one makes void.
        if let Some(&first) = changes.first() {
            changes.insert(0, change(first.after, 0.1, 0.1));
        }
        let expected = pulled(pipeline(program, effort), &changes, MOST);
        prop_assert!(!expected.frames.is_empty() || expected.refusal.is_some());
        let found = ahead(pipeline(program, effort), &changes, MOST, capacity, |_, taken| {
            if taken.is_multiple_of(slow_every) {
                std::thread::sleep(Duration::from_millis(2));
            }
        });
        let differs = expected.frames.iter().zip(&found.frames).position(|(a, b)| a != b);
        prop_assert_eq!(differs, None, "{} {:?} {:?}", program.display(), effort, changes);
        prop_assert_eq!(expected.frames.len(), found.frames.len());
        prop_assert_eq!(expected.refusal, found.refusal);
    }
}

#[test]
fn an_override_that_is_taken_back_before_a_frame_leaves_no_trace() {
    for effort in [Effort::Fast, Effort::Optimal] {
        let program = &programs()[0];
        let expected = pulled(pipeline(program, effort), &[], usize::MAX);
        let changes =
            [100, 200, 300].map(|after| [change(after, 0.5, 1.0), change(after, 1.0, 1.0)]);
        let found = ahead(
            pipeline(program, effort),
            changes.as_flattened(),
            usize::MAX,
            2500,
            |_, _| {},
        );
        assert!(expected == found, "{effort:?}");
    }
}

/// A source that ends with an error, and then is not to be asked again.
struct Failing(Vec<Item>);

impl ItemSource for Failing {
    fn next_item(&mut self) -> Supply {
        if self.0.is_empty() {
            return Supply::Refused(Refusal::Read(std::io::Error::other("the pipe burst")));
        }
        Supply::Item(self.0.remove(0))
    }

    fn lines_read(&self) -> u64 {
        0
    }
}

#[test]
fn an_error_met_ahead_comes_after_the_last_frame_and_only_once() {
    let line = |from: f64, to: f64| {
        let at = |x: f64| {
            let mut at = AxisVector::zeros();
            at[0] = x;
            at
        };
        Item {
            block: 0,
            line: 1,
            kind: ItemKind::Move {
                segment: Segment::line(at(from), at(to)),
                rate: Rate::Feed(50.0),
                mode: PathMode::Continuous { tolerance_mm: None },
            },
        }
    };
    // The pipe bursts; the last item has a gap before it.
    for last in [vec![], vec![line(70.0, 80.0)]] {
        let mut items = vec![line(0.0, 50.0), line(50.0, 60.0)];
        items.extend(last);
        let settings = mill(Effort::Fast);
        let make = || Pipeline::new(Failing(items.clone()), settings, AxisVector::zeros());
        // The error is known long before the override changes.
        let changes = [change(50, 0.5, 1.0), change(120, 2.0, 1.0)];
        let expected = pulled(make(), &changes, usize::MAX);
        let found = ahead(make(), &changes, usize::MAX, 2500, |_, number| {
            if number == 50 || number == 120 {
                std::thread::sleep(Duration::from_millis(50));
            }
        });
        assert!(expected.refusal.is_some());
        assert!(expected == found, "{:?}", found.refusal);
    }
}

/// An event at rest, and after a while a move.
struct Thinking(u32, Receiver<()>);

impl ItemSource for Thinking {
    fn next_item(&mut self) -> Supply {
        self.0 += 1;
        let kind = match self.0 {
            1 => ItemKind::Event(Event::MCode(6)),
            2 => {
                let mut end = AxisVector::zeros();
                end[0] = 60.0;
                let _ = self.1.recv();
                ItemKind::Move {
                    segment: Segment::line(AxisVector::zeros(), end),
                    rate: Rate::Feed(50.0),
                    mode: PathMode::Continuous { tolerance_mm: None },
                }
            }
            _ => return Supply::End,
        };
        let (block, line) = (0, self.0);
        Supply::Item(Item { block, line, kind })
    }

    fn lines_read(&self) -> u64 {
        0
    }
}

#[test]
fn rests_before_a_motion_that_takes_long_to_plan_are_given_out_with_it() {
    let (think, thought) = channel();
    let source = Thinking(0, thought);
    let mut pipeline = Pipeline::new(source, mill(Effort::Fast), AxisVector::zeros());
    let take = |queue: &FrameQueue| {
        while queue.waiting() < 2 {
            std::thread::yield_now();
        }
        // The first frame and that of the event are there, and would be used up.
        assert!(!queue.wait(Duration::from_millis(20)));
        assert!(matches!(queue.next(), Next::Busy));
        think.send(()).unwrap();
        while matches!(queue.next(), Next::Busy) {
            queue.wait(Duration::from_millis(50));
        }
        let mut frames = 1;
        while matches!(queue.next(), Next::Frame(_)) {
            frames += 1;
        }
        frames
    };
    let given = planned_ahead(&mut pipeline, (2500, HEAD_START), take).unwrap();
    assert!(given >= HEAD_START, "{given} frames at once");
}
