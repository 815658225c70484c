//! Tests of the rate: random holds, resumes and overrides over motions at their limits.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    clippy::cast_possible_wrap,
    clippy::float_cmp,
    clippy::unwrap_used,
    unreachable_pub,
    reason = "a test: numbers are small, bits are compared on purpose, failures are panics"
)]

use super::greedy_slow_down::{GreedySlowDown, SlowDownOutcome};
use super::kept_stop::{DelayedRamp, KeptStop, SlowDownSlopes};
use super::steady_rate::SteadyRate;
use super::*;
use crate::real_time::differences::{Allowed, Differences, MachinePosition};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::track::Track;
use crate::shared::rest::is_at_rest;
use crate::shared::track_capacity::TRACK_CAPACITY;
use crate::testing::{audit, mill, plan, records};
use glidepath_geometry::AxisVector;
use glidepath_link::SetpointFrame;
use glidepath_program::Limits;
use proptest::prelude::*;

const PERIOD_T: f64 = 0.004;

/// Publishes positions as the real-time thread does, without its states.
struct Player {
    frames: Vec<SetpointFrame>,
    track: Track,
    rate: Rate,
    published: Differences,
    allowed: Allowed,
    positions: Vec<AxisVector>,
    /// The rate at which it leaves a rest of the plan.
    sets_out_at: f64,
}

impl Player {
    fn new(frames: Vec<SetpointFrame>, limits: Limits) -> Self {
        let start = AxisVector::from(frames[0].position);
        let mut track = Track::new(
            PERIOD_T,
            (&limits, None),
            crate::shared::m_code_waits::MCodeWaits::NONE,
            TRACK_CAPACITY,
        );
        for frame in frames.iter().take(TRACK_CAPACITY) {
            track.push(frame);
        }
        Self {
            frames,
            track,
            rate: Rate::new(ProgramTime::at(0), 1.0),
            published: Differences::at_rest(&MachinePosition {
                axes: start,
                joints: AxisVector::zeros(),
            }),
            allowed: Allowed::new(&limits, None, PERIOD_T),
            positions: vec![start; 3],
            sets_out_at: 1.0,
        }
    }

    fn tick(&mut self, goal: f64) {
        self.track.release_before(self.rate.now().time.sequence);
        while !self.track.is_full()
            && let Some(frame) = self.frames.get(self.track.end() as usize)
        {
            self.track.push(frame);
        }
        let situation = Situation {
            track: &self.track,
            published: &self.published,
            allowed: &self.allowed,
            stop_frames: 19,
            is_fully_supplied: true,
            block_end: None,
        };
        let now = self.rate.now().time;
        let rests = now.fraction <= 0.0 && self.track.frame(now.sequence).is_some_and(is_at_rest);
        if rests && self.published.is_at_rest() {
            if self.rate.take_found_no_stop() {
                self.sets_out_at *= 0.4;
            }
            self.rate.rest_at(now, goal.min(self.sets_out_at));
        } else {
            self.rate.choose_ramp(goal, &situation);
        }
        if self.rate.ensure_stop(goal, &situation) {
            self.track.unbar();
        }
        let time = self.rate.advance().time.held_at(self.track.holding_frame());
        if time != self.rate.now().time {
            self.rate.rest_at(time, self.rate.now().rate);
        }
        let position = self.track.position(time).unwrap();
        self.published.go_to(&position);
        self.positions.push(position);
    }

    fn at_end(&self) -> bool {
        self.rate.now().time == ProgramTime::at(self.frames.len() as u64 - 1)
    }
}

fn player(seed: u64, axes: usize, ticks: usize) -> Player {
    let frames = plan(seed, axes, ticks, &mill(), PERIOD_T, AxisVector::zeros());
    Player::new(records(&frames, 1, 4_000_000), mill())
}

#[test]
fn the_plan_itself_is_published_bit_for_bit() {
    let mut p = player(3, 3, 300);
    for k in 1..p.frames.len() {
        p.tick(1.0);
        assert_eq!(p.positions[k + 2], AxisVector::from(p.frames[k].position));
    }
    let ratios = audit(&p.positions, &mill(), PERIOD_T);
    assert!(ratios.iter().all(|r| *r <= 1.0 + 1e-6), "{ratios:?}");
    assert!(
        ratios[2] > 0.99,
        "the plan is at its jerk limit: {ratios:?}"
    );
}

proptest! {
    #[test]
    fn no_command_breaks_a_limit(
        seed in 0_u64..1_000_000, axes in 1_usize..6,
        goals in prop::collection::vec((1_u32..120, prop_oneof![Just(0.0), Just(1.0), 0.05_f64..1.0]), 1..12),
    ) {
        let mut p = player(seed, axes, 500);
        for (ticks, goal) in goals {
            for _ in 0..ticks {
                p.tick(goal);
            }
        }
        let mut left = 20_000;
        while !p.at_end() && left > 0 {
            p.tick(1.0);
            left -= 1;
        }
        prop_assert!(p.at_end(), "stuck at {:?} rate {}", p.rate.now(), p.rate.now().rate);
        let ratios = audit(&p.positions, &mill(), PERIOD_T);
        prop_assert!(ratios.iter().all(|r| *r <= 1.0 + 1e-6), "{ratios:?}");
    }
}

/// From anywhere on a plan that is at its limits on two axes all the time, a greedy slow-down leads to
/// rest, and what it is kept as repeats it within the limits.
#[test]
fn a_greedy_slow_down_leads_to_rest_within_the_limits() {
    let (p, mut found) = (player(5, 2, 400), 0);
    let situation = Situation {
        track: &p.track,
        published: &p.published,
        allowed: &p.allowed,
        stop_frames: 19,
        is_fully_supplied: true,
        block_end: None,
    };
    let (mut search, mut slopes) = (GreedySlowDown::new(), SlowDownSlopes::new());
    for sequence in (5..250).step_by(7) {
        let steady = SteadyRate {
            time: ProgramTime::at(sequence),
            rate: 1.0,
        };
        let mut at = steady.playback(3.0, &p.track).unwrap();
        search.begin(at, 1.0);
        let SlowDownOutcome::Rest(last) = search.go_on(&situation, &mut 100_000) else {
            continue;
        };
        found += 1;
        let mut stop = KeptStop::after(search.write(&mut slopes));
        assert!(stop.push(DelayedRamp {
            in_ticks: 0,
            ramp: last,
        }));
        let (mut now, mut slope) = (1.0, 0.0);
        let mut append = |by: f64| {
            at.time = at.time.after(by);
            assert!(p.track.append_to(&mut at.published, at.time, &p.allowed));
        };
        loop {
            let Some(ramp) = stop.count_down(now, slope, &slopes) else {
                append(now);
                continue;
            };
            if ramp.target() <= 0.0 {
                break;
            }
            append(ramp.elapsed_at(1.0));
            (now, slope) = (ramp.target(), ramp.end_slope());
        }
        assert!(now < 0.96 && stop.is_empty(), "{now}");
        let mut elapsed = 0.0;
        for tick in 1..=last.duration().ceil() as u32 {
            let to = last.elapsed_at(f64::from(tick));
            append(to - elapsed);
            elapsed = to;
        }
    }
    assert!(found > 25, "{found}");
}
