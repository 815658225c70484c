//! Whether there are frames enough to go on.
//!
//! The motion must be able to stop on the frames at hand. Two thresholds on the number of frames
//! ahead, in units of the frames a stop from full speed takes (program time runs at half rate on
//! average while r falls to 0 in V/A + A/J):
//!
//! ```text
//! 0 ────────── low ─────────── high ──────────── horizon
//!   stop now     |  go on as before  |   go on, also from rest
//! ```
//!
//! Frames that end at rest are always enough: the plan stops by itself.

use crate::config::Config;
use crate::differences::Differences;
use crate::rate::Advance;
use crate::track::Track;

/// Room for the stop to begin late, where the plan is at its limits, in stops.
const STOPS_AHEAD: f64 = 2.0;
/// Frames on top of that, for very short stops.
const SPARE: u64 = 8;

/// Watch over the frames ahead.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Supply {
    low: u64,
    high: u64,
    reach: u64,
    short: bool,
    out: bool,
    starved_ticks: u64,
    patience_ticks: u64,
}

impl Supply {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of ticks; the cast saturates"
    )]
    pub(crate) fn new(config: &Config) -> Self {
        let limits = &config.limits;
        let by_axis = limits.velocity.component_div(&limits.acceleration)
            + limits.acceleration.component_div(&limits.jerk);
        // An axis without limits stops in no time; it would only hide the others.
        let stop_t = by_axis
            .iter()
            .zip(limits.velocity.iter())
            .filter(|(_, v)| **v < glidepath_motion::Limits::UNLIMITED)
            .map(|(stop, _)| *stop)
            .fold(0.0, f64::max);
        let reach = (0.5 * stop_t / config.period_t()).ceil().min(1e6);
        let low = ((STOPS_AHEAD * reach) as u64 + SPARE).min(config.horizon_frames * 3 / 4);
        let patience_ticks = config.planner_lost_after.map_or(u64::MAX, |patience| {
            (patience.as_nanos() / u128::from(config.period_ns.max(1)))
                .try_into()
                .unwrap_or(u64::MAX)
        });
        Self {
            low,
            high: (low + low / 4 + 1).min(config.horizon_frames),
            reach: reach as u64,
            short: false,
            out: false,
            starved_ticks: 0,
            patience_ticks,
        }
    }

    /// Frames whose speed matters for a stop that begins now.
    pub(crate) const fn reach(&self) -> u64 {
        self.reach
    }

    /// An epoch begins: it starts when there are frames enough.
    pub(crate) const fn begin(&mut self) {
        self.short = true;
        self.out = false;
        self.starved_ticks = 0;
    }

    pub(crate) const fn end(&mut self) {
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

    /// True at rest at the end of the frames, where the plan rests too.
    pub(crate) const fn is_out(&self) -> bool {
        self.out
    }

    /// Looks at the frames ahead. Returns true once if the planner must be taken for lost: the
    /// motion was held up in the middle of its way for too long.
    pub(crate) fn watch(&mut self, track: &Track, now: Advance, published: &Differences) -> bool {
        let ahead = track.end().saturating_sub(now.time.sequence + 1);
        let ends_at_rest = track.stop().is_some();
        if ends_at_rest || ahead >= self.high {
            self.short = false;
        } else if ahead < self.low {
            self.short = true;
        }
        self.out = ends_at_rest && ahead == 0;
        if self.short && published.is_at_rest() {
            self.starved_ticks += 1;
        } else {
            self.starved_ticks = 0;
        }
        self.starved_ticks == self.patience_ticks.max(1)
    }
}
