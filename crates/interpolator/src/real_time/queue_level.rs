//! The level of the frame queue: whether there are enough to go on.
//!
//! That the motion can stop on the frames at hand is the business of the stop in reserve (see
//! `rate`). Once it was taken, or the motion stands for want of frames, it is not worth while to go
//! on for each frame that drips in: it goes on when as many are ahead as three stops from full speed
//! take (`STOPS_AHEAD`; program time runs at half rate on average while r falls to 0 in V/A + A/J)
//! and a few more, or when the frames end at rest. The planner publishes no more than its horizon, so
//! three quarters of that are always enough. The same holds where the motion stands because the
//! operator wanted it to.

use crate::real_time::differences::Differences;
use crate::real_time::limited_joints::LimitedJoints;
use crate::real_time::rate::Rate;
use crate::real_time::track::Track;
use crate::shared::config::Config;
use glidepath_program::Limits;

/// Frames ahead to go on with, in stops.
const STOPS_AHEAD: f64 = 3.0;
/// Frames on top of that, for very short stops. No measurement of it is kept, nor of [`QUIET_TICKS`].
const SPARE: u64 = 10;

/// Ticks without a new frame after which no more are expected soon.
const QUIET_TICKS: u64 = 5;

/// The longest time an axis or a joint takes to stop from full speed, s.
fn stop_t(config: &Config) -> f64 {
    let of_joints = LimitedJoints::of(config);
    let joints_t = of_joints.map_or(0.0, |joints| slowest_t(&joints.limits));
    slowest_t(&config.limits).max(joints_t)
}

/// The longest time one of some axes, or joints, takes to stop from full speed, s.
fn slowest_t(limits: &Limits) -> f64 {
    let by_axis = limits.velocity.component_div(&limits.acceleration)
        + limits.acceleration.component_div(&limits.jerk);
    // An axis without limits stops in no time; it would only hide the others.
    by_axis
        .iter()
        .zip(limits.velocity.iter())
        .filter(|(_, v)| **v < Limits::UNLIMITED)
        .map(|(stop, _)| *stop)
        .fold(0.0, f64::max)
}

/// The fewest frames ahead that a machine can do with: one stop to stop on, one for what comes in
/// meanwhile, one to go on with.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative; the cast saturates"
)]
pub(crate) fn least_horizon(config: &Config) -> u64 {
    const ROUNDING: f64 = 1e-9;
    (STOPS_AHEAD * stop_t(config) / config.period_t() - ROUNDING).ceil() as u64
}

/// Watch over the frames ahead.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QueueLevel {
    /// Frames ahead with which motion goes on once there were too few.
    enough: u64,
    /// Frames a stop from full speed takes.
    stop_frames: u64,
    /// Frames ahead that are about as many as the planner ever publishes.
    full: u64,
    /// What [`Self::is_short`], [`Self::is_fully_supplied`], [`Self::is_out`] and [`Self::is_barred`] say.
    short: bool,
    fully: bool,
    out: bool,
    barred: bool,
    /// Sequence after the newest frame, and for how many ticks it has been that.
    end: u64,
    quiet_ticks: u64,
    /// For how many ticks the motion has been held up, and after how many the planner is lost.
    starved_ticks: u64,
    patience_ticks: u64,
}

impl QueueLevel {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of ticks; the cast saturates"
    )]
    pub(crate) fn new(config: &Config) -> Self {
        let stop_t = stop_t(config);
        // Program time runs at half rate on average while it comes to rest.
        let stop_frames = (0.5 * stop_t / config.period_t()).ceil().min(1e6);
        let enough = (STOPS_AHEAD * stop_frames) as u64 + SPARE;
        let patience_ticks = config.planner_lost_after.map_or(u64::MAX, |patience| {
            (patience.as_nanos() / u128::from(config.period_ns.max(1)))
                .try_into()
                .unwrap_or(u64::MAX)
        });
        Self {
            // What the planner never publishes ahead cannot be waited for.
            enough: enough.min(config.horizon_frames * 3 / 4),
            stop_frames: stop_frames as u64,
            full: config.horizon_frames * 9 / 10,
            short: false,
            fully: false,
            out: false,
            barred: false,
            end: 0,
            quiet_ticks: 0,
            starved_ticks: 0,
            patience_ticks,
        }
    }

    /// Frames a stop from full speed takes.
    pub(crate) const fn stop_frames(&self) -> u64 {
        self.stop_frames
    }

    /// An epoch begins: it starts when there are frames enough.
    pub(crate) const fn begin_epoch(&mut self) {
        self.short = true;
        self.out = false;
        self.starved_ticks = 0;
    }

    /// An epoch ends: nothing is waited for.
    pub(crate) const fn end_epoch(&mut self) {
        self.short = false;
        self.out = false;
        self.starved_ticks = 0;
    }

    /// The planner gave a sign of life: the machine waits on.
    pub(crate) const fn planner_lives(&mut self) {
        self.starved_ticks = 0;
    }

    /// True if the motion has to stop, or to stay, for want of frames.
    pub(crate) const fn is_short(&self) -> bool {
        self.short
    }

    /// True if the motion cannot go on with what is left of frames of which there are no more.
    pub(crate) const fn is_at_end(&self) -> bool {
        self.short && self.quiet_ticks > QUIET_TICKS
    }

    /// True if the motion stands at a barrier.
    pub(crate) const fn is_barred(&self) -> bool {
        self.barred
    }

    /// True at rest at the end of the frames, where the plan rests too.
    pub(crate) const fn is_out(&self) -> bool {
        self.out
    }

    /// True if the frames ahead are about as many as the planner ever publishes.
    pub(crate) const fn is_fully_supplied(&self) -> bool {
        self.fully
    }

    /// Looks at the frames ahead. Returns true once if the planner must be taken for lost: the
    /// motion was held up in the middle of its way for too long.
    ///
    /// While the operator `holds` the motion, it is not held up by the planner.
    pub(crate) fn watch(
        &mut self,
        track: &Track,
        rate: &Rate,
        published: &Differences,
        holds: bool,
    ) -> bool {
        let time = rate.now().time;
        let ahead = track.end().saturating_sub(time.sequence + 1);
        self.fully = ahead >= self.full;
        let is_barred = track.barrier() == Some(time.sequence);
        self.quiet_ticks = if track.end() == self.end {
            self.quiet_ticks + 1
        } else {
            0
        };
        self.end = track.end();
        let stands = || rate.now().rate <= 0.0 && published.is_at_rest();
        // Frames that end at rest while more are coming in are no reason to go: motion would only
        // stand again where they end.
        let is_all = track.ends_at_last() || self.quiet_ticks >= QUIET_TICKS;
        if ahead >= self.enough || (track.ends_at_rest() && is_all) {
            self.short = false;
        } else if rate.has_taken_reserve() || is_barred || (!holds && stands()) {
            self.short = true;
        }
        self.out = track.ends_at_rest() && ahead == 0;
        // It is known how to go on from a barrier only when it is known how to stop after it.
        self.barred = is_barred && !track.ends_at_rest();
        let waits = self.short || (!holds && (self.barred || (self.out && !track.ends_at_last())));
        if waits && published.is_at_rest() {
            self.starved_ticks += 1;
        } else {
            self.starved_ticks = 0;
        }
        self.starved_ticks == self.patience_ticks.max(1)
    }
}
