//! The tracker: motion from any state to a velocity, or to rest at a place, under limits of
//! velocity, acceleration and jerk.
//!
//! This is what moves axes that follow no program: in a jog, on the way back to the path. A
//! [`Tracker`] is solved when its target or its limits change, and evaluated otherwise; both are
//! bounded work without allocation, and the same numbers give the same motion.
//!
//! The motion is continuous up to the acceleration, whenever it is solved anew, with a jerk inside
//! its limit. So its samples on the grid of the period are inside the limits by finite differences,
//! which are averages of the derivatives. Only a limit that is lowered is exceeded for a while:
//! what was allowed before comes down without delay.

mod motion;
mod profile;
mod rest;
mod speed;

pub(crate) use motion::{Bounds, Motion};
pub(crate) use profile::Profile;

/// The target of a tracker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Target {
    /// A velocity, whose amount is at most that of the bounds.
    Speed(f64),
    /// Rest at a place.
    Rest(f64),
}

/// A motion and how far it has come.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tracker {
    profile: Profile,
    elapsed_t: f64,
    aim: Option<(Target, Bounds)>,
}

impl Tracker {
    /// At rest at a place, or on from any other state.
    pub(crate) fn new(start: Motion) -> Self {
        Self {
            profile: Profile::steady(start),
            elapsed_t: 0.0,
            aim: None,
        }
    }

    /// The present state.
    pub(crate) fn now(&self) -> Motion {
        self.profile.at(self.elapsed_t)
    }

    /// Sets out for a target, if it is another one or by other bounds than before.
    pub(crate) fn aim(&mut self, target: Target, bounds: Bounds) {
        if self.aim == Some((target, bounds)) {
            return;
        }
        let now = self.now();
        self.profile = match target {
            Target::Rest(place) if bounds.v > 0.0 => rest::profile(now, place, &bounds),
            // A place that nothing may move to.
            Target::Rest(_) => Profile::to_stop(now, &bounds),
            Target::Speed(v) => Profile::to_speed(now, v.max(-bounds.v).min(bounds.v), &bounds),
        };
        self.elapsed_t = 0.0;
        self.aim = Some((target, bounds));
    }

    /// Lets time pass, s.
    pub(crate) fn advance(&mut self, t: f64) -> Motion {
        self.elapsed_t += t;
        self.now()
    }

    /// The stop from here.
    pub(crate) fn stop(&self, bounds: &Bounds) -> Profile {
        Profile::to_stop(self.now(), bounds)
    }

    /// How long it takes from where it set out last.
    pub(crate) fn duration_t(&self) -> f64 {
        self.profile.duration_t()
    }

    /// True once the target is reached.
    pub(crate) fn has_arrived(&self) -> bool {
        self.elapsed_t >= self.profile.duration_t()
    }
}

#[cfg(test)]
mod tests;
