//! The work of planning: instructions for a block, and for a period of motion. Figures that other
//! load on the host does not change.
//!
//! The test runs itself under callgrind, with a length of path and with twice as much; the
//! difference is what the path took. It counts optimised code only, and is skipped without
//! valgrind:
//!
//! ```text
//! cargo test --release -p glidepath-motion --test work -- --nocapture
//! ```
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test, and a measurement"
)]

#[path = "../../../tests/counted/mod.rs"]
mod counted;
mod support;

use counted::{cannot_count, counted, number};
use glidepath_audit::{Audit, AuditSettings};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::Planner;
use glidepath_program::{Item, ItemKind, Rate, Settings};
use std::hint::black_box;
use support::{FREE, at, mill, optimal};

/// The test that is counted.
const TEST: &str = "a_block_takes_few_instructions";
/// In the environment of the process that is counted: the case, and the number of blocks.
const CASE: &str = "GLIDEPATH_COUNTED_CASE";
const BLOCKS: &str = "GLIDEPATH_COUNTED_BLOCKS";

/// What is counted: an effort, a path, how many blocks of it, and the most instructions of one on
/// average.
struct Case {
    name: &'static str,
    settings: fn() -> Settings,
    path: fn(u32) -> AxisVector,
    feed_v: f64,
    /// Whether the auditor goes along.
    is_audited: bool,
    blocks: u32,
    most: u64,
}

const CASES: [Case; 6] = [
    Case {
        name: "fast, dense lines",
        settings: mill,
        path: dense,
        feed_v: 100.0,
        is_audited: false,
        blocks: 5000,
        // A parametrisation is a quarter of it: on this wave limits bind, and it takes 1.47 s instead
        // of 2.03 s by S-curves.
        most: 5_200,
    },
    Case {
        name: "fast, with the audit, lines of fifty periods each",
        settings: mill,
        path: slow,
        feed_v: 5.0,
        is_audited: true,
        blocks: 400,
        // A solve or two more for what a window leaves the next are a hundredth of it, to keep the curve at
        // its radius two, and coordinates that are left alone three. A tenth is what the audit has of the
        // shape: stops, corners, straight lines; a fiftieth what it has of speed in the middle of moves.
        most: 300_000,
    },
    Case {
        name: "fast, corners",
        settings: mill,
        path: zigzag,
        feed_v: 100.0,
        is_audited: false,
        blocks: 100,
        most: 96_500,
    },
    Case {
        name: "optimal, dense lines",
        settings: optimal,
        path: dense,
        feed_v: 100.0,
        is_audited: false,
        blocks: 5000,
        // Ten thousand of them are a stretch that is raced: searched twice, and planned along the path.
        most: 790_000,
    },
    Case {
        name: "optimal, dense lines at the feed",
        settings: optimal,
        path: round,
        feed_v: 100.0,
        is_audited: false,
        blocks: 40_000,
        // Too long to be raced: planned as it comes, line by line.
        most: 23_500,
    },
    Case {
        name: "optimal, corners",
        settings: optimal,
        path: zigzag,
        feed_v: 100.0,
        is_audited: false,
        blocks: 120,
        most: 50_000_000,
    },
];

/// Lines of a hundredth of a millimetre along a wave.
fn dense(k: u32) -> AxisVector {
    let x = 0.01 * f64::from(k);
    at(x, (0.5 * x).sin())
}

/// Lines of a hundredth of a millimetre round a circle.
fn round(k: u32) -> AxisVector {
    let angle = 2e-4 * f64::from(k);
    at(50.0 * angle.cos() - 50.0, 50.0 * angle.sin())
}

/// Lines of a millimetre along a wave.
fn slow(k: u32) -> AxisVector {
    let x = f64::from(k);
    at(x, 5.0 * (0.1 * x).sin())
}

/// Lines of two millimetres there and back.
fn zigzag(k: u32) -> AxisVector {
    at(0.2 * f64::from(k), 2.0 * f64::from(k % 2))
}

fn plan(case: &Case, blocks: u32) {
    let settings = (case.settings)();
    let mut planner = Planner::new(settings, (case.path)(0));
    let mut audit = case
        .is_audited
        .then(|| Audit::new(&AuditSettings::from(&settings)));
    let take_all = |planner: &mut Planner, audit: &mut Option<Audit>| {
        while planner.make_frame().unwrap() {
            match audit {
                Some(audit) => audit.frame(planner.frame()),
                None => {
                    black_box(planner.frame());
                }
            }
        }
    };
    for k in 0..blocks {
        let segment = Segment::line((case.path)(k), (case.path)(k + 1));
        let kind = ItemKind::Move {
            segment,
            rate: Rate::Feed(case.feed_v),
            mode: FREE,
        };
        let item = Item {
            block: 0,
            line: k + 1,
            kind,
        };
        planner.push(&item).unwrap();
        if let Some(audit) = &mut audit {
            audit.program(&item);
        }
        take_all(&mut planner, &mut audit);
    }
    planner.finish();
    take_all(&mut planner, &mut audit);
    if let Some(audit) = audit {
        assert!(audit.finish().is_clean());
    }
}

#[test]
fn a_block_takes_few_instructions() {
    if let (Some(case), Some(blocks)) = (number(CASE), number(BLOCKS)) {
        plan(&CASES[case as usize], blocks);
        return;
    }
    if cannot_count() {
        return;
    }
    for (k, case) in CASES.iter().enumerate() {
        let blocks = case.blocks;
        let case_number = u32::try_from(k).unwrap();
        let total = |blocks| counted(TEST, &[(CASE, case_number), (BLOCKS, blocks)]);
        let each = (total(2 * blocks) - total(blocks)) / u64::from(blocks);
        println!("{}: {each} instructions a block", case.name);
        assert!(each <= case.most, "{}: {each} > {}", case.name, case.most);
    }
}
