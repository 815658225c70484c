//! A ramp: the rate of program time from one value to another.
//!
//! The rate r is in periods of program time per tick, its slope ṙ per tick, its bend r̈ per tick².
//! A ramp is the shortest way from (r₀, ṙ₀) to (r₁, 0) with |ṙ| ≤ α and |r̈| ≤ β: bend one way,
//! keep the slope if α is reached, bend back.
//!
//! ```text
//!  r ──╮                 ṙ ─╮      ╭─
//!       ╲                    ╲____╱             bend  −β   0   +β
//!        ╲___ r₁                                lasts t₁   t₂  t₃
//! ```
//!
//! Program time is the integral of r: a cubic in each part.

/// Bounds of a ramp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    /// Largest slope, per tick.
    pub(crate) alpha: f64,
    /// Bend, per tick².
    pub(crate) beta: f64,
}

impl Bounds {
    /// The same curve stretched in time by `1 / pace`.
    pub(crate) fn paced(self, pace: f64) -> Self {
        Self {
            alpha: self.alpha * pace,
            beta: self.beta * pace * pace,
        }
    }
}

const SIXTH: f64 = 1.0 / 6.0;

/// Rate, slope, and program time since the start of the ramp, at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Instant {
    pub(crate) elapsed: f64,
    pub(crate) rate: f64,
    pub(crate) slope: f64,
}

impl Instant {
    fn elapsed_later(self, t: f64, bend: f64) -> f64 {
        self.elapsed + t * (self.rate + t * (0.5 * self.slope + t * (bend * SIXTH)))
    }

    fn later(self, t: f64, bend: f64) -> Self {
        Self {
            elapsed: self.elapsed_later(t, bend),
            rate: self.rate + t * (self.slope + t * 0.5 * bend),
            slope: self.slope + t * bend,
        }
    }
}

/// A way of the rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ramp {
    /// Start of each part, and of the steady rate after them.
    starts: [Instant; 4],
    durations: [f64; 3],
    bend: f64,
    target: f64,
}

impl Ramp {
    /// Room for a ramp, before there is one.
    pub(crate) const NONE: Self = {
        let rest = Instant {
            elapsed: 0.0,
            rate: 0.0,
            slope: 0.0,
        };
        Self {
            starts: [rest; 4],
            durations: [0.0; 3],
            bend: 0.0,
            target: 0.0,
        }
    };

    /// The shortest way from a rate and slope to a target within bounds. `None` if it would leave
    /// 0 ≤ r ≤ 1 on the way.
    pub(crate) fn plan(rate: f64, slope: f64, target: f64, bounds: Bounds) -> Option<Self> {
        let Bounds { beta, .. } = bounds;
        let alpha = bounds.alpha.max(slope.abs());
        // Where the rate would end if the slope were taken back at once.
        let released = rate + slope * slope.abs() / (2.0 * beta);
        let direction = if target >= released { 1.0 } else { -1.0 };
        let way = direction * (target - rate);
        // Bent to a slope p and back at once a ramp covers (2p² − ṙ₀²)/2β: the slope with which that is the way,
        // and, of the slope that there is, how much is covered by bending.
        let steepest = (0.5 * slope * slope + beta * way).max(0.0).sqrt();
        let peak = steepest.min(alpha);
        let start_slope = direction * slope;
        let bent = (2.0 * peak * peak - slope * slope) / (2.0 * beta);
        let keep = if steepest > alpha {
            ((way - bent) / alpha).max(0.0)
        } else {
            0.0
        };
        let durations = [((peak - start_slope) / beta).max(0.0), keep, peak / beta];
        if start_slope < 0.0 && !(0.0..=1.0).contains(&released) {
            return None;
        }
        let bend = direction * beta;
        let start = Instant {
            elapsed: 0.0,
            rate,
            slope,
        };
        let kept = start.later(durations[0], bend);
        let back = kept.later(durations[1], 0.0);
        let end = Instant {
            rate: target,
            slope: 0.0,
            ..back.later(durations[2], -bend)
        };
        Some(Self {
            starts: [start, kept, back, end],
            durations,
            bend,
            target,
        })
    }

    /// One tick, from a rate and slope to another slope, with the steps in program time of the
    /// ticks before and after: what is between its two ends is not asked for. `None` if the rate
    /// would leave 0 ≤ r ≤ 1.
    pub(crate) fn tick_to(rate: f64, slope: f64, to: f64) -> Option<Self> {
        let start = Instant {
            elapsed: 0.0,
            rate,
            slope,
        };
        // A slope is what a step is more than the one before; the rate is that between two steps.
        let step = rate - 0.5 * slope + to;
        let end = Instant {
            elapsed: step,
            rate: step + 0.5 * to,
            slope: to,
        };
        let stays = (0.0..=1.0).contains(&end.rate) && step >= 0.0;
        stays.then_some(Self {
            starts: [start, start, start, end],
            durations: [0.0, 0.0, 1.0],
            bend: to - slope,
            target: end.rate,
        })
    }

    /// Slope at the end.
    pub(crate) const fn end_slope(&self) -> f64 {
        self.starts[3].slope
    }

    /// Ticks from start to end, not whole in general.
    pub(crate) fn duration(&self) -> f64 {
        self.durations.iter().sum()
    }

    pub(crate) const fn target(&self) -> f64 {
        self.target
    }

    /// The part in force `t` ≥ 0 ticks after the start: where it began, since when, and its bend.
    fn part(&self, t: f64) -> (&Instant, f64, f64) {
        let [start, kept, back, end] = &self.starts;
        let [t1, t2, t3] = self.durations;
        let (after1, after2) = (t - t1, t - t1 - t2);
        if after1 <= 0.0 {
            (start, t, self.bend)
        } else if after2 <= 0.0 {
            (kept, after1, 0.0)
        } else if after2 < t3 {
            (back, after2, -self.bend)
        } else {
            (end, after2 - t3, 0.0)
        }
    }

    /// At `t` ≥ 0 ticks after the start; after the end the rate is the target.
    pub(crate) fn at(&self, t: f64) -> Instant {
        let (start, after, bend) = self.part(t);
        let now = start.later(after, bend);
        Instant {
            rate: now.rate.clamp(0.0, 1.0),
            ..now
        }
    }

    /// Program time since the start, `t` ≥ 0 ticks after it, periods.
    pub(crate) fn elapsed_at(&self, t: f64) -> f64 {
        let (start, after, bend) = self.part(t);
        start.elapsed_later(after, bend)
    }

    /// Program time lost against a steady rate 1, for a ramp that ends there, periods.
    pub(crate) fn loss(&self) -> f64 {
        self.duration() - self.starts[3].elapsed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_stop_from_steady_rate_has_the_known_length() {
        // α not reached: two bends of √(r/β) ticks; half the time is lost.
        let ramp = Ramp::plan(
            1.0,
            0.0,
            0.0,
            Bounds {
                alpha: 1.0,
                beta: 0.01,
            },
        )
        .unwrap();
        assert!((ramp.duration() - 20.0).abs() < 1e-12);
        assert!((ramp.at(20.0).elapsed - 10.0).abs() < 1e-12);
        // α reached: r/α + α/β ticks.
        let ramp = Ramp::plan(
            1.0,
            0.0,
            0.0,
            Bounds {
                alpha: 0.05,
                beta: 0.01,
            },
        )
        .unwrap();
        assert!((ramp.duration() - 25.0).abs() < 1e-12);
    }

    #[test]
    fn no_way_may_leave_the_range() {
        let bounds = Bounds {
            alpha: 0.1,
            beta: 0.001,
        };
        assert!(Ramp::plan(0.5, -0.05, 1.0, bounds).is_none());
        assert!(Ramp::plan(0.9, 0.05, 0.0, bounds).is_none());
    }

    proptest! {
        /// The ramp starts and ends as asked, and never breaks a bound, by dense sampling.
        #[test]
        fn ramps_keep_their_bounds(
            rate in 0.0_f64..=1.0, slope in -0.1_f64..0.1, target in 0.0_f64..=1.0,
            alpha in 0.005_f64..0.2, beta in 0.001_f64..0.05,
        ) {
            let bounds = Bounds { alpha, beta };
            let Some(ramp) = Ramp::plan(rate, slope, target, bounds) else { return Ok(()) };
            let (steps, end) = (2_000, ramp.duration());
            let h = end / f64::from(steps);
            let first = ramp.at(0.0);
            prop_assert!((first.rate - rate).abs() < 1e-12 && (first.slope - slope).abs() < 1e-12);
            let mut before = first;
            for k in 1..=steps {
                let now = ramp.at(h * f64::from(k));
                prop_assert!(now.slope.abs() <= alpha.max(slope.abs()) + 1e-9);
                prop_assert!((now.slope - before.slope).abs() <= beta * h + 1e-9);
                // What the trapezoidal rule may miss where the bend changes.
                prop_assert!((now.rate - before.rate - 0.5 * h * (now.slope + before.slope)).abs() <= beta * h * h + 1e-9);
                prop_assert!((now.elapsed - before.elapsed - 0.5 * h * (now.rate + before.rate)).abs() <= beta * h * h * h + 1e-9);
                before = now;
            }
            prop_assert!((before.rate - target).abs() < 1e-9 && before.slope.abs() < 1e-7);
            let after = ramp.at(end + 3.0);
            prop_assert!((after.elapsed - before.elapsed - 3.0 * target).abs() < 1e-9);
        }
    }
}
