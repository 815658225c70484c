//! An override in the middle of a program leads to the motion that a plan at that feed has.

use glidepath_link::Command;
use glidepath_program::Override;

use crate::desk::{Desk, HORIZON, Job, assert_limits, jobs};

/// How much longer or shorter it may take than the plan, besides a horizon: what was published before
/// is played at the override's rate, also where the feed did not bind.
const PART: f64 = 0.02;
/// Ticks from the first to the last frame.
fn ticks_of(desk: &mut Desk<'_, '_, '_>, feed_r: f64) -> u64 {
    desk.command(Command::FeedOverride(feed_r));
    desk.play(60_000);
    assert!(desk.is_over());
    let first = desk.setpoints.iter().position(|s| s.sequence > 0).unwrap();
    let last = desk.frames.last().unwrap().sequence;
    let end = desk.setpoints.iter().position(|s| s.sequence == last);
    (end.unwrap() - first + 1) as u64
}

#[test]
#[allow(clippy::cast_precision_loss, reason = "numbers of ticks")]
fn a_program_under_an_override_takes_as_long_as_one_planned_with_it() {
    for (name, effort) in jobs() {
        let job = Job::bench(name, effort);
        for feed_r in [1.0, 0.5, 2.0] {
            let planned = job.planned_periods(Override {
                feed_r,
                rapid_r: 1.0,
            });
            let (ticks, report) = job.at_desk(|desk| {
                let ticks = ticks_of(desk, feed_r);
                // It begins at 100 %.
                (ticks, desk.audit(&job.settings, feed_r.max(1.0)))
            });
            eprintln!("{name:20} {effort:?} {feed_r:3.1}: {ticks:6} ticks, planned {planned:6}");
            assert_limits(&report);
            let most = if feed_r == 1.0 {
                0.0
            } else {
                PART * planned as f64 + HORIZON as f64
            };
            assert!(
                ticks.abs_diff(planned) as f64 <= most,
                "{name} at {feed_r}: {ticks} ticks, planned {planned}"
            );
        }
    }
}
