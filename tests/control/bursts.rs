//! Tests of frames that come late, many at a time, from a planner that waits for a processor.

use glidepath_tests::pocket;

use crate::supervisor::{Job, assert_limits};
use crate::times;

/// A tenth of a second.
const LATE_TICKS: usize = 25;

/// It is hard to find a stop on a plan that is at its limits everywhere, and sooner or later one has to
/// be found while few frames are ahead.
#[test]
fn what_comes_in_bursts_is_played_as_it_was_planned() {
    let forms = if times() > 1 { 0..10 } else { 1..2 };
    let rows = if times() > 1 { 40 } else { 3 };
    for form in forms {
        let job = Job::text(pocket(rows, form));
        job.supervised(|supervisor| {
            supervisor.comes_every = LATE_TICKS;
            supervisor.play(60_000);
            assert!(supervisor.is_over());
            let mut played: Vec<_> = supervisor.setpoints.iter().map(|s| s.position).collect();
            played.dedup();
            let mut planned: Vec<_> = supervisor
                .planned
                .frames
                .iter()
                .map(|f| f.position)
                .collect();
            planned.dedup();
            let off = played.iter().zip(&planned).position(|(a, b)| a != b);
            let late = played.len() - planned.len();
            eprintln!(
                "form {form}: {} ticks, {late} late, off from {off:?} on",
                planned.len()
            );
            assert_eq!((off, late), (None, 0), "form {form}");
            assert_limits(&supervisor.audit(&job.settings, 1.0));
        });
    }
}
