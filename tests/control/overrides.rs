//! An override in the middle of a program leads to the motion that a plan at that feed has.

use glidepath_link::Command;
use glidepath_motion::Override;

use crate::desk::{BENCH, HORIZON, Job};

/// How much longer or shorter it may take than the plan, besides a horizon: what was published before
/// is played at the override's rate, also where the feed did not bind.
const PART: f64 = 0.02;
/// Ticks that a change of that rate takes: to the new one, and back where the new plan begins.
const CHANGES: f64 = 20.0;

#[test]
#[allow(clippy::cast_precision_loss, reason = "numbers of ticks")]
fn a_program_under_an_override_takes_as_long_as_one_planned_with_it() {
    for name in BENCH {
        let job = Job::bench(name);
        for feed_r in [0.5, 2.0] {
            let planned = job.planned_periods(Override {
                feed_r,
                rapid_r: 1.0,
            });
            let (ticks, report) = job.at_desk(|desk| {
                desk.command(Command::FeedOverride(feed_r));
                desk.play(60_000);
                assert!(desk.is_over());
                let moving = desk.setpoints.iter().position(|s| s.sequence > 0);
                let first = moving.unwrap();
                let last = desk.frames.last().unwrap().sequence;
                let end = desk.setpoints.iter().position(|s| s.sequence == last);
                // It begins at 100 %.
                let report = desk.audit(&job.settings, feed_r.max(1.0));
                (end.unwrap() - first, report)
            });
            let difference = (ticks as f64 - planned as f64).abs();
            eprintln!("{name:20} {feed_r:3.1}: {ticks:6} ticks, planned {planned:6}");
            assert!(
                difference <= PART * planned as f64 + HORIZON as f64 + CHANGES,
                "{name} at {feed_r}: {ticks} ticks, planned {planned}"
            );
            assert!(
                report.violations.is_empty(),
                "{name}: {:#?}",
                report.violations
            );
        }
    }
}
