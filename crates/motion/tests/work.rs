//! How much work planning is: instructions for a block, and for a period of motion. Figures that other
//! load on the host does not change.
//!
//! The test runs itself under callgrind, with a length of path and with twice as much; the difference
//! is what the path took. It counts optimised code only, and is skipped without valgrind:
//!
//! ```text
//! cargo test --release -p glidepath-motion --test work -- --nocapture
//! ```
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test, and a measurement"
)]

mod support;

use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::audit::{Audit, AuditSettings};
use glidepath_motion::{Item, ItemKind, Planner, Rate, Settings};
use std::hint::black_box;
use std::process::Command;
use support::{FREE, at, mill, optimal};

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

const CASES: [Case; 5] = [
    Case {
        name: "fast, dense lines",
        settings: mill,
        path: dense,
        feed_v: 100.0,
        is_audited: false,
        blocks: 5000,
        most: 5_500,
    },
    Case {
        name: "fast, with the audit, lines of fifty periods each",
        settings: mill,
        path: slow,
        feed_v: 5.0,
        is_audited: true,
        blocks: 400,
        most: 220_000,
    },
    Case {
        name: "fast, corners",
        settings: mill,
        path: zigzag,
        feed_v: 100.0,
        is_audited: false,
        blocks: 100,
        most: 90_000,
    },
    Case {
        name: "optimal, dense lines",
        settings: optimal,
        path: dense,
        feed_v: 100.0,
        is_audited: false,
        blocks: 5000,
        most: 810_000,
    },
    Case {
        name: "optimal, corners",
        settings: optimal,
        path: zigzag,
        feed_v: 100.0,
        is_audited: false,
        blocks: 40,
        most: 90_000_000,
    },
];

/// Lines of a hundredth of a millimetre along a wave.
fn dense(k: u32) -> AxisVector {
    let x = 0.01 * f64::from(k);
    at(x, (0.5 * x).sin())
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
    let mut audit = case.is_audited.then(|| {
        Audit::new(&AuditSettings {
            limits: settings.limits,
            period_t: settings.period_t,
            tolerance_mm: settings.tolerance_mm,
        })
    });
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
        let item = Item { line: k + 1, kind };
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

/// Instructions of this test as another process, with so many blocks.
fn counted(case: usize, blocks: u32) -> u64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "a_block_takes_few_instructions", "--nocapture"])
        .env(CASE, case.to_string())
        .env(BLOCKS, blocks.to_string())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    let total = text
        .lines()
        .find_map(|line| line.split_once("Collected :"))
        .and_then(|(_, count)| count.trim().parse().ok());
    total.unwrap_or_else(|| panic!("no count: {text}"))
}

#[test]
fn a_block_takes_few_instructions() {
    let number = |name| std::env::var(name).ok()?.parse::<u32>().ok();
    if let (Some(case), Some(blocks)) = (number(CASE), number(BLOCKS)) {
        plan(&CASES[case as usize], blocks);
        return;
    }
    if cfg!(debug_assertions) {
        println!("skipped: counts optimised code, use cargo test --release");
        return;
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("skipped: valgrind is not installed");
        return;
    }
    for (k, case) in CASES.iter().enumerate() {
        let blocks = case.blocks;
        let each = (counted(k, 2 * blocks) - counted(k, blocks)) / u64::from(blocks);
        println!("{}: {each} instructions a block", case.name);
        assert!(each <= case.most, "{}: {each} > {}", case.name, case.most);
    }
}
