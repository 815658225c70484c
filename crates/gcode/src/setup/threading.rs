//! The data of a machine that threads are planned with.

use glidepath_geometry::{AxisVector, limit_along};
use glidepath_program::{Limits, TAP_OVERTRAVEL};

/// A pass of a thread is planned for a spindle that turns faster than programmed by this factor, so
/// that the axes can follow one that does.
pub(crate) const SPEED_RESERVE: f64 = 1.1;
/// Periods at a steady speed that a pass has at least.
const STEADY_PERIODS: f64 = 4.0;

/// A machine whose axes can follow the angle of its spindle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threading {
    /// What its axes can do.
    pub limits: Limits,
    /// Interpolation period, s, > 0.
    pub period_t: f64,
    /// G84 and G74 tap rigidly; else they are for a tap in a holder that gives way.
    pub rigid_tapping: bool,
    /// How fast the speed of the spindle changes when it turns back, rev/s², > 0: it is told to so
    /// much before the bottom of a hole. `None`: nobody knows, and it is told at the bottom.
    pub spindle_a: Option<f64>,
    /// Revolutions for which a tap goes on at most from where the spindle is told to turn back, > 0:
    /// the machine stops it there, and there it has to be inside its travel.
    pub overtravel: f64,
}

impl Threading {
    /// A machine with these limits and this period, s, > 0, which taps rigidly by G33.1 alone.
    #[must_use]
    pub const fn new(limits: Limits, period_t: f64) -> Self {
        Self {
            limits,
            period_t,
            rigid_tapping: false,
            spindle_a: None,
            overtravel: TAP_OVERTRAVEL,
        }
    }

    /// How far a tap goes on while a spindle of so many rev/s comes to rest, mm.
    pub(crate) fn run_on_mm(&self, pitch_mm: f64, speed: f64) -> f64 {
        self.spindle_a
            .map_or(0.0, |a| 0.5 * pitch_mm * speed * speed / a)
    }

    /// The highest speed along a direction of length 1, mm/s.
    pub(crate) fn most_v(&self, direction: &AxisVector) -> f64 {
        limit_along(direction, &self.limits.velocity)
    }

    /// The highest acceleration along a direction of length 1, mm/s².
    pub(crate) fn most_a(&self, direction: &AxisVector) -> f64 {
        limit_along(direction, &self.limits.acceleration)
    }

    /// How far the axes go along a direction of length 1 until they have a speed, mm: with the
    /// acceleration a and the jerk j there,
    ///
    /// ```text
    ///   v √(v / j)   if v ≤ a² / j,   else   v / 2 (v / a + a / j)
    /// ```
    pub(crate) fn run_in_mm(&self, direction: &AxisVector, v: f64) -> f64 {
        let path = &self.limits.path;
        let a = limit_along(direction, &self.limits.acceleration).min(path.tangential_a);
        let j = limit_along(direction, &self.limits.jerk).min(path.jerk_j);
        if v <= a * a / j {
            v * (v / j).sqrt()
        } else {
            0.5 * v * (v / a + a / j)
        }
    }

    /// By how much a corner is rounded where the velocity of the axes changes by so much, mm/s, at the
    /// acceleration and the jerk that they have: twice what is needed.
    pub(crate) fn corner_mm(&self, change: &AxisVector) -> f64 {
        let v = change.norm();
        if v <= 0.0 {
            return 0.0;
        }
        let direction = change / v;
        let a = limit_along(&direction, &self.limits.acceleration);
        let j = limit_along(&direction, &self.limits.jerk);
        let change_t = if v <= a * a / j {
            2.0 * (v / j).sqrt()
        } else {
            v / a + a / j
        };
        // Half the change on each side of the corner, for half of the time.
        0.25 * v * change_t
    }

    /// What a pass needs between its run-in and its run-out, mm.
    pub(crate) fn steady_mm(&self, v: f64) -> f64 {
        STEADY_PERIODS * self.period_t * v
    }
}
