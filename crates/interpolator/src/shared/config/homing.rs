//! The homing settings of a joint, as LinuxCNC has them, with bounds that LinuxCNC does not ask
//! for.

use crate::shared::tracker::{Bounds, Motion, Profile};

/// The homing settings of a joint. Lengths and velocities are mm or degrees, and by s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointHoming {
    /// Velocity of the search for the switch, with its sign; 0 for none.
    pub search_v: f64,
    /// Velocity at which the edge of the switch, or the index pulse, is looked for, with its sign.
    pub latch_v: f64,
    /// Velocity of the way from there to `home`, > 0.
    pub final_v: f64,
    /// Who keeps where the index pulse was; `None` if the edge of the switch is the place.
    pub index: Option<IndexPulse>,
    /// The position of the switch, the index pulse, or of zero of an absolute encoder.
    pub offset: f64,
    /// Where the joint goes in the end.
    pub home: f64,
    /// The encoder is absolute; whether the joint goes home then.
    pub absolute: Option<bool>,
    /// Groups are homed in rising order of the amount. Of a negative one the joints make their way
    /// home together.
    pub sequence: i32,
    /// Other joints use the same switch: a search does not begin on it.
    pub is_shared: bool,
    /// The joint is not homed any more once power was off.
    pub is_volatile: bool,
    /// Limit switches do not count while the joint looks for its home.
    pub ignores_limits: bool,
    /// Most way of a search, > 0.
    pub search_travel: f64,
    /// How far the joint may go past the edge of its switch, > 0.
    pub clearance: f64,
}

/// Who keeps where a joint was at the index pulse of its encoder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IndexPulse {
    /// The servo stack, which latches a digital input by itself.
    Input(u32),
    /// The joint's drive, which is asked to before the joint sets out.
    Drive,
}

/// The limits of a joint that is homed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointBounds {
    /// Highest speed, mm/s or °/s.
    pub velocity: f64,
    /// Highest acceleration, mm/s² or °/s².
    pub acceleration: f64,
    /// Highest jerk, mm/s³ or °/s³.
    pub jerk: f64,
}

/// The reason why a joint cannot be homed so.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum HomingError {
    /// A search without a latch.
    #[error("it searches a switch, but has no velocity to find its edge at")]
    NoLatch,
    /// A latch without anything to latch.
    #[error("it looks for an edge, but neither for a switch nor for an index pulse")]
    NothingToLatch,
    /// An index pulse that nobody looks for.
    #[error("it has an index pulse, but no velocity to find it at")]
    NoIndexVelocity,
    /// A bound is missing.
    #[error("{0} has to be more than 0")]
    Unbounded(&'static str),
    /// Faster than the joint.
    #[error("{0} mm/s is more than the {1} mm/s that the joint can do")]
    TooFast(f64, f64),
    /// It would go further past the switch than there is room.
    #[error(
        "at {v} mm/s it goes {overshoot:.3} mm past the edge of its switch, and there is room for \
         {clearance} mm"
    )]
    Overshoot {
        /// Velocity of the search.
        v: f64,
        /// How far it goes.
        overshoot: f64,
        /// How far it may go.
        clearance: f64,
    },
}

/// What is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Nothing: the joint is at the position of its offset.
    Here,
    /// Nothing: the encoder knows.
    Absolute,
    /// The index pulse alone.
    Index,
    /// The edge of the switch.
    Switch,
    /// The index pulse after the edge of the switch.
    SwitchThenIndex,
}

/// Periods from the closing of a switch to the first setpoint that slows down for it: one for the
/// sample, one through the threads, one until the setpoint applies.
const LATE_PERIODS: f64 = 3.0;

impl JointHoming {
    /// The distance that the joint goes past the edge of its switch: on at the velocity of the
    /// search until the first setpoint that slows down applies, and to rest from there.
    #[must_use]
    pub fn overshoot(&self, bounds: &JointBounds, period_t: f64) -> f64 {
        let v = self.search_v.abs();
        let from = Motion { x: 0.0, v, a: 0.0 };
        let bounds = Bounds {
            v,
            a: bounds.acceleration,
            j: bounds.jerk,
        };
        v * LATE_PERIODS * period_t + Profile::to_stop(from, &bounds).end().x
    }

    /// Whether a joint can be homed so.
    ///
    /// # Errors
    /// Why not.
    pub fn check(&self, bounds: &JointBounds, period_t: f64) -> Result<(), HomingError> {
        let kind = self.kind()?;
        for v in [self.search_v, self.latch_v, self.final_v] {
            if v.abs() > bounds.velocity {
                return Err(HomingError::TooFast(v.abs(), bounds.velocity));
            }
        }
        if matches!(kind, Kind::Here | Kind::Absolute) {
            return Ok(());
        }
        if self.search_travel <= 0.0 {
            return Err(HomingError::Unbounded("search_travel"));
        }
        if kind == Kind::Index {
            return Ok(());
        }
        if self.clearance <= 0.0 {
            return Err(HomingError::Unbounded("clearance"));
        }
        let overshoot = self.overshoot(bounds, period_t);
        if overshoot > self.clearance {
            return Err(HomingError::Overshoot {
                v: self.search_v.abs(),
                overshoot,
                clearance: self.clearance,
            });
        }
        Ok(())
    }

    /// What is looked for.
    pub(crate) fn kind(&self) -> Result<Kind, HomingError> {
        let (searches, latches) = (self.search_v != 0.0, self.latch_v != 0.0);
        match (searches, latches, self.index.is_some()) {
            _ if self.absolute.is_some() => Ok(Kind::Absolute),
            (false, false, false) => Ok(Kind::Here),
            (false, true, true) => Ok(Kind::Index),
            (true, true, false) => Ok(Kind::Switch),
            (true, true, true) => Ok(Kind::SwitchThenIndex),
            (true, false, _) => Err(HomingError::NoLatch),
            (false, true, false) => Err(HomingError::NothingToLatch),
            (false, false, true) => Err(HomingError::NoIndexVelocity),
        }
    }

    /// Whether the edge is latched on the way onto the switch, not off it.
    pub(crate) fn latches_rising(&self) -> bool {
        self.search_v.is_sign_negative() == self.latch_v.is_sign_negative()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;

    const BOUNDS: JointBounds = JointBounds {
        velocity: 200.0,
        acceleration: 2_000.0,
        jerk: 40_000.0,
    };

    fn switch() -> JointHoming {
        JointHoming {
            search_v: -20.0,
            latch_v: 1.0,
            final_v: 50.0,
            index: None,
            offset: 0.0,
            home: 5.0,
            absolute: None,
            sequence: 0,
            is_shared: false,
            is_volatile: false,
            ignores_limits: false,
            search_travel: 300.0,
            clearance: 2.0,
        }
    }

    #[test]
    fn what_is_looked_for_follows_from_the_velocities() {
        let kind = |search_v: f64, latch_v: f64, index: bool| {
            JointHoming {
                search_v,
                latch_v,
                index: index.then_some(IndexPulse::Input(3)),
                ..switch()
            }
            .kind()
        };
        assert_eq!(kind(0.0, 0.0, false), Ok(Kind::Here));
        assert_eq!(kind(0.0, 1.0, true), Ok(Kind::Index));
        assert_eq!(kind(9.0, 1.0, false), Ok(Kind::Switch));
        assert_eq!(kind(9.0, -1.0, true), Ok(Kind::SwitchThenIndex));
        assert_eq!(kind(9.0, 0.0, false), Err(HomingError::NoLatch));
        assert_eq!(kind(9.0, 0.0, true), Err(HomingError::NoLatch));
        assert_eq!(kind(0.0, 1.0, false), Err(HomingError::NothingToLatch));
        assert_eq!(kind(0.0, 0.0, true), Err(HomingError::NoIndexVelocity));
    }

    #[test]
    fn an_overshoot_beyond_the_clearance_is_refused() {
        assert_eq!(switch().check(&BOUNDS, 0.004), Ok(()));
        // 3 T at 20 mm/s, and a stop of v · √(v / J).
        let expected = 20.0 * 0.012 + 20.0 * (20.0_f64 / 40_000.0).sqrt();
        let overshoot = switch().overshoot(&BOUNDS, 0.004);
        assert!((overshoot - expected).abs() < 1e-12, "{overshoot}");
        let narrow = JointHoming {
            clearance: expected - 0.001,
            ..switch()
        };
        let refused = narrow.check(&BOUNDS, 0.004).unwrap_err();
        assert!(matches!(refused, HomingError::Overshoot { .. }));
        let unbounded = JointHoming {
            search_travel: 0.0,
            ..switch()
        };
        assert!(unbounded.check(&BOUNDS, 0.004).is_err());
        let fast = JointHoming {
            final_v: 201.0,
            ..switch()
        };
        assert!(fast.check(&BOUNDS, 0.004).is_err());
    }
}
