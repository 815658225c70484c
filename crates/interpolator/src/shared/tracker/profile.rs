//! A motion profile of up to seven phases of constant jerk, and what follows them: it can be asked
//! for its state at any time.

use super::motion::{Bounds, Motion};
use super::speed::{Phase, change};

/// Most phases: three to the cruise speed, the cruise, three to rest.
const PHASES: usize = 7;

/// A phase with the state at its beginning.
#[derive(Debug, Clone, Copy, Default)]
struct Leg {
    from: Motion,
    begins_t: f64,
    jerk: f64,
}

/// A motion by its phases.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Profile {
    legs: [Leg; PHASES],
    len: usize,
    /// The state at the end of the phases, from where it goes on at constant velocity.
    end: Motion,
    duration_t: f64,
}

impl Profile {
    /// No phase: at constant velocity.
    pub(crate) fn steady(start: Motion) -> Self {
        Self {
            legs: [Leg::default(); PHASES],
            len: 0,
            end: start,
            duration_t: 0.0,
        }
    }

    /// The quickest change to a velocity.
    pub(crate) fn to_speed(start: Motion, to: f64, bounds: &Bounds) -> Self {
        let mut profile = Self::steady(start);
        profile.change_speed(to, bounds);
        profile
    }

    /// The quickest way to rest, wherever that is.
    pub(crate) fn to_stop(start: Motion, bounds: &Bounds) -> Self {
        Self::to_speed(start, 0.0, bounds)
    }

    /// Appends a phase.
    pub(super) fn push(&mut self, phase: Phase) {
        if phase.t <= 0.0 {
            return;
        }
        let Some(free) = self.legs.get_mut(self.len) else {
            return;
        };
        *free = Leg {
            from: self.end,
            begins_t: self.duration_t,
            jerk: phase.jerk,
        };
        self.len += 1;
        self.end = self.end.after(phase.t, phase.jerk);
        self.duration_t += phase.t;
    }

    /// Appends the quickest change to a velocity, which it then has without rounding.
    pub(super) fn change_speed(&mut self, to: f64, bounds: &Bounds) {
        for phase in change(self.end.v, self.end.a, to, bounds) {
            self.push(phase);
        }
        (self.end.v, self.end.a) = (to, 0.0);
    }

    /// Says where it ends, without rounding.
    pub(super) const fn ends_at(&mut self, x: f64) {
        self.end.x = x;
    }

    /// The state at the end of the phases.
    pub(crate) const fn end(&self) -> Motion {
        self.end
    }

    /// How long the phases take, s.
    pub(crate) const fn duration_t(&self) -> f64 {
        self.duration_t
    }

    /// The state after a time t ≥ 0.
    pub(crate) fn at(&self, t: f64) -> Motion {
        if t >= self.duration_t {
            return self.end.after(t - self.duration_t, 0.0);
        }
        let legs = self.legs.get(..self.len).unwrap_or(&[]);
        legs.iter()
            .rev()
            .find(|leg| leg.begins_t <= t)
            .map_or(self.end, |leg| leg.from.after(t - leg.begins_t, leg.jerk))
    }

    /// The least and the greatest position on the way to the end of the phases.
    pub(crate) fn extent(&self) -> (f64, f64) {
        let mut extent = (self.end.x, self.end.x);
        let mut take = |x: f64| extent = (extent.0.min(x), extent.1.max(x));
        let legs = self.legs.get(..self.len).unwrap_or(&[]);
        let ends = legs.iter().skip(1).map(|leg| leg.begins_t);
        for (leg, end_t) in legs.iter().zip(ends.chain([self.duration_t])) {
            take(leg.from.x);
            // Where it turns: v + a t + j t² / 2 = 0.
            let Motion { v, a, .. } = leg.from;
            let root = (a * a - 2.0 * leg.jerk * v).max(0.0).sqrt();
            let q = -(a + root.copysign(a));
            for t in [q / leg.jerk, 2.0 * v / q] {
                if t > 0.0 && t < end_t - leg.begins_t {
                    take(leg.from.after(t, leg.jerk).x);
                }
            }
        }
        extent
    }
}
