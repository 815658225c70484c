//! Tests of the reaction to a hold: how soon it begins, and how soon the machine rests.

use std::collections::BTreeMap;

use glidepath_link::{Command, MachineState, SetpointFrame};
use glidepath_program::Settings;
use proptest::test_runner::{Config, TestRunner};

use crate::supervisor::{Job, Supervisor, assert_limits, jobs};
use crate::times;

/// The most ticks until a hold begins where the plan cruises: nothing accelerates, for as long as
/// it takes to stop. Where the plan brakes sooner, both together may break a limit; then it is left
/// to the plan to slow down first.
const FROM_CRUISE: usize = 2;

/// Numbers of ticks, and how often.
#[derive(Debug, Default)]
struct Ticks(BTreeMap<usize, usize>);

impl Ticks {
    fn add(&mut self, ticks: usize) {
        *self.0.entry(ticks).or_default() += 1;
    }

    fn quantile(&self, share: f64) -> usize {
        let all: Vec<_> = self.0.iter().flat_map(|(t, n)| vec![*t; *n]).collect();
        #[allow(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "small numbers, not negative"
        )]
        let index = (share * (all.len().saturating_sub(1)) as f64) as usize;
        all.get(index).copied().unwrap_or(0)
    }
}

impl std::fmt::Display for Ticks {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [p50, p90, p99, most] = [0.5, 0.9, 0.99, 1.0].map(|share| self.quantile(share));
        write!(f, "{p50:5}{p90:5}{p99:5}{most:5}")
    }
}

#[test]
fn a_hold_begins_at_once_in_a_cruise_and_soon_everywhere() {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        proptest::test_runner::TestRng::deterministic_rng(Config::default().rng_algorithm),
    );
    let mut chance = move |low: usize, high: usize| {
        use proptest::strategy::{Strategy, ValueTree};
        (low..=high).new_tree(&mut runner).unwrap().current()
    };
    eprintln!("ticks to the first setpoint beside the plan, and to rest: median, 90 %, 99 %, most");
    let mut all = Ticks::default();
    for (name, effort) in jobs() {
        let job = Job::bench(name, effort);
        let (mut waits, mut rests, mut cruises) = <(Ticks, Ticks, Ticks)>::default();
        for _ in 0..times() {
            job.supervised(|supervisor| {
                while !supervisor.is_over() {
                    supervisor.play(chance(1, 300));
                    hold(
                        supervisor,
                        &job.settings,
                        &mut waits,
                        &mut rests,
                        &mut cruises,
                    );
                }
                let report = supervisor.audit(&job.settings, 1.0);
                assert_limits(&report);
            });
        }
        eprintln!("{name:20} {effort:?} {waits}  {rests}  cruise {cruises}");
        assert!(cruises.quantile(1.0) <= FROM_CRUISE, "{name}");
        for (ticks, count) in waits.0 {
            *all.0.entry(ticks).or_default() += count;
        }
    }
    eprintln!("{:20} {all}  {:?}", "all", all.0);
}

/// Periods the slowest axis takes to stop at a steady velocity, with jerk and acceleration at their
/// limits.
fn stopping_ticks(frame: &SetpointFrame, settings: &Settings) -> usize {
    let Settings {
        limits, period_t, ..
    } = settings;
    let times = frame
        .velocity
        .iter()
        .zip(limits.acceleration.iter())
        .zip(limits.jerk.iter());
    let longest_t = times.fold(0.0_f64, |longest, ((v, &a), &j)| {
        let v = v.abs();
        let takes = if v >= a * a / j {
            v / a + a / j
        } else {
            2.0 * (v / j).sqrt()
        };
        longest.max(takes)
    });
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few hundred at most"
    )]
    let ticks = (longest_t / period_t).ceil() as usize;
    ticks
}

/// Holds where the motion follows the plan, counts, and resumes.
fn hold(
    supervisor: &mut Supervisor<'_, '_, '_>,
    settings: &Settings,
    waits: &mut Ticks,
    rests: &mut Ticks,
    cruises: &mut Ticks,
) {
    let Some(last) = supervisor.setpoints.last().copied() else {
        return;
    };
    if !supervisor.is(MachineState::Running) || last.effective_override < 1.0 || last.feed_v <= 0.0
    {
        return;
    }
    let next = usize::try_from(last.sequence).unwrap();
    let cruise = |frame: &SetpointFrame| frame.acceleration.iter().all(|a| a.abs() < 1e-6);
    let stops_in = FROM_CRUISE + stopping_ticks(&supervisor.planned.frames[next], settings);
    let mut ahead = supervisor.planned.frames[next..].iter().take(stops_in);
    let cruises_here = ahead.len() == stops_in && ahead.all(cruise);
    supervisor.command(Command::Hold);
    let (mut wait, mut ticks) = (None, 0);
    while !supervisor.is(MachineState::Held) && !supervisor.is_over() {
        ticks += 1;
        let setpoint = supervisor.tick();
        if setpoint.effective_override < 1.0 {
            wait.get_or_insert(ticks);
        }
    }
    if supervisor.is_over() {
        return; // It ended before it could stop earlier.
    }
    let wait = wait.unwrap_or(ticks);
    waits.add(wait);
    rests.add(ticks);
    if cruises_here {
        cruises.add(wait);
    }
    supervisor.command(Command::Resume);
}
