//! Tests of overrides: one in the middle of a program leads to the motion that a plan at that feed
//! has.

use glidepath_link::Command;
use glidepath_program::Override;

use crate::supervisor::{HORIZON, Job, Supervisor, assert_limits, jobs};

/// How much longer or shorter it may take than the plan, besides a horizon: what was published
/// before is played at the override's rate, also where the feed did not bind.
const PART: f64 = 0.02;
/// Ticks from the first to the last frame.
fn ticks_of(supervisor: &mut Supervisor<'_, '_, '_>, feed_r: f64) -> u64 {
    supervisor.command(Command::FeedOverride(feed_r));
    supervisor.play(60_000);
    assert!(supervisor.is_over());
    let first = supervisor
        .setpoints
        .iter()
        .position(|s| s.sequence > 0)
        .unwrap();
    let last = supervisor.planned.frames.last().unwrap().sequence;
    let end = supervisor.setpoints.iter().position(|s| s.sequence == last);
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
            let (ticks, report) = job.supervised(|supervisor| {
                let ticks = ticks_of(supervisor, feed_r);
                // It begins at 100 %.
                (ticks, supervisor.audit(&job.settings, feed_r.max(1.0)))
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
