//! The superposition: the motion of an axis in addition to that of the program, by an input (the height of a torch, a
//! follower that touches) or a handwheel.
//!
//! Plans keep the share of the axis' limits free that the superposition has, and its range of the travel, so that both
//! motions together are inside the limits whatever the input says. The offset is added last, where axes become joints:
//! everything before that, the program's positions included, is without it.
//!
//! ```text
//!            switch off, path moves             switch on
//!   Off ◄──── Returns ◄───────────── Frozen ◄─────────────► Follows
//!                                          path slow, at rest, rapid, thread, probing, no input
//! ```
//!
//! The offset moves only while the motion goes along its path: in a hold, at a stop, in a jog it stands. Where an epoch
//! ends (the program, an abort, a contact of the probe) both have come to rest, and the offset becomes part of the
//! position: nothing moves by that. The axis may then stand outside of what programs have of its travel; the next epoch
//! may leave it there or bring it inwards, and its offset has what is left of the range on that side.

use crate::real_time::jog::Wheel;
use crate::shared::config::SoftLimits;
use crate::shared::config::superposition::{Superposition, SuperpositionControl};
use crate::shared::message::jog_demand::Demand;
use crate::shared::message::superposition_demand::SuperpositionDemand;
use crate::shared::tracker::{Bounds, Motion, Target, Tracker};
use glidepath_geometry::Axis;
use glidepath_link::{FreezeReason, Setpoint, SuperpositionState};
use glidepath_program::{Event, FrameFlags};

/// Slower than this is at rest, mm/s or °/s: what rounding leaves of an input at its target.
const SLOWEST_V: f64 = 1e-6;

/// What the motion along the path lets it do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathMotion {
    /// It goes on along the path, forward and unhindered.
    pub(crate) goes_on: bool,
    /// Nothing is added to what it is about: it looks for a contact.
    pub(crate) is_probing: bool,
    /// The part of the programmed feed that is executed.
    pub(crate) feed_r: f64,
}

/// The superposition in the real-time thread.
#[derive(Debug)]
pub(crate) struct SuperposedAxis {
    settings: Superposition,
    /// The travel of the axis that programs have.
    travel: [f64; 2],
    /// The offset at least and at most, in this epoch.
    range: [f64; 2],
    bounds: Bounds,
    period_t: f64,
    freeze_ticks: u64,
    /// Ticks for which it still stands behind a slow place.
    frozen_ticks: u64,
    is_on: bool,
    state: SuperpositionState,
    /// Why it stands still, if it is frozen.
    freeze_reason: FreezeReason,
    tracker: Tracker,
    wheel: Wheel,
    /// Where the wheel has turned the offset to.
    turned_to: f64,
}

impl SuperposedAxis {
    pub(crate) fn new(settings: Superposition, soft_limits: &SoftLimits, period_t: f64) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "some seconds, and not below 0"
        )]
        let freeze_ticks = (settings.freeze_for_t / period_t).ceil() as u64;
        let axis = settings.axis.index();
        Self {
            travel: [soft_limits.lowest[axis], soft_limits.highest[axis]],
            range: settings.range,
            settings,
            bounds: Bounds {
                v: settings.velocity,
                a: settings.acceleration,
                j: settings.jerk,
            },
            period_t,
            freeze_ticks,
            frozen_ticks: 0,
            is_on: settings.switch.is_none(),
            state: SuperpositionState::Off,
            freeze_reason: FreezeReason::None,
            tracker: Tracker::new(Motion::at(0.0)),
            // Its velocity is nothing here.
            wheel: Wheel::new(0),
            turned_to: 0.0,
        }
    }

    pub(crate) const fn axis(&self) -> Axis {
        self.settings.axis
    }

    /// What it does, and why it stands still where it is frozen.
    pub(crate) const fn state(&self) -> (SuperpositionState, FreezeReason) {
        (self.state, self.freeze_reason)
    }

    /// The offset now.
    pub(crate) fn now(&self) -> Motion {
        self.tracker.now()
    }

    /// Whether the offset stands still.
    pub(crate) fn is_at_rest(&self) -> bool {
        let Motion { v, a, .. } = self.tracker.now();
        v == 0.0 && a == 0.0
    }

    /// A program begins: it has to switch it on.
    pub(crate) const fn begin_program(&mut self) {
        self.is_on = self.settings.switch.is_none();
    }

    /// An epoch begins with the axis here. Where that is outside of what programs have of its travel, because of an
    /// offset that became part of the position, so much less is left for another one.
    pub(crate) fn begin_epoch(&mut self, at: f64) {
        let [lowest, highest] = self.settings.range;
        let [low, high] = self.travel;
        self.range = [
            (lowest + (low - at).max(0.0)).min(0.0),
            (highest - (at - high).max(0.0)).max(0.0),
        ];
    }

    /// The offset is part of the position now, or the position was taken from the drives.
    pub(crate) fn forget(&mut self) {
        self.tracker = Tracker::new(Motion::at(0.0));
        self.turned_to = 0.0;
        (self.frozen_ticks, self.state) = (0, SuperpositionState::Off);
        self.freeze_reason = FreezeReason::None;
    }

    /// Hears what a wheel says. What it turns while the offset stands is not made up for later.
    pub(crate) fn turn(&mut self, demand: &Demand, now_ns: u64) {
        if self.settings.control != SuperpositionControl::Wheel {
            return;
        }
        let turned = self.wheel.turn(demand, now_ns);
        let turned = turned.get(self.settings.axis.index()).copied();
        if self.state == SuperpositionState::Follows && !demand.is_outdated {
            let [low, high] = self.range;
            self.turned_to = (self.turned_to + turned.unwrap_or(0.0)).clamp(low, high);
        }
    }

    /// Hears what happens with a setpoint: the switch.
    pub(crate) fn hear(&mut self, setpoint: &Setpoint) {
        for event in setpoint.events() {
            if let Ok(Event::DigitalOutput { number, on }) = event.event()
                && self.settings.switch == Some(number)
            {
                self.is_on = on;
            }
        }
    }

    /// A period goes by.
    pub(crate) fn step(
        &mut self,
        setpoint: &Setpoint,
        path: PathMotion,
        demand: SuperpositionDemand,
    ) -> Motion {
        self.watch_feed(path.feed_r);
        let frozen = self.freezes(setpoint, path, demand);
        self.freeze_reason = frozen.unwrap_or(FreezeReason::None);
        let (state, target, bounds) = match frozen {
            Some(_) => (SuperpositionState::Frozen, Target::Speed(0.0), self.bounds),
            None => self.choose(demand),
        };
        self.state = state;
        if state != SuperpositionState::Follows {
            self.turned_to = self.tracker.now().x;
        }
        self.tracker.aim(target, bounds);
        let motion = self.tracker.advance(self.period_t);
        if self.is_at_rest() && motion.x == 0.0 && !self.is_on {
            self.state = SuperpositionState::Off;
            self.freeze_reason = FreezeReason::None;
        }
        motion
    }

    fn watch_feed(&mut self, feed_r: f64) {
        self.frozen_ticks = if feed_r < self.settings.freeze_below {
            self.freeze_ticks + 1
        } else {
            self.frozen_ticks.saturating_sub(1)
        };
    }

    /// Why it stands still, if it does whatever is demanded of it.
    fn freezes(
        &self,
        setpoint: &Setpoint,
        path: PathMotion,
        demand: SuperpositionDemand,
    ) -> Option<FreezeReason> {
        let is_slow = path.feed_r < self.settings.freeze_below || self.frozen_ticks > 0;
        let has_input = self.settings.control != SuperpositionControl::Wheel;
        if !path.goes_on {
            Some(FreezeReason::NotOnward)
        } else if path.is_probing {
            Some(FreezeReason::Probing)
        } else if setpoint.has(FrameFlags::SYNC) {
            Some(FreezeReason::FollowsSpindle)
        } else if !self.is_on {
            (!self.settings.returns).then_some(FreezeReason::SwitchedOff)
        } else if setpoint.has(FrameFlags::RAPID) {
            Some(FreezeReason::Rapid)
        } else if is_slow {
            Some(FreezeReason::Slow)
        } else if has_input && demand == SuperpositionDemand::Barred {
            Some(FreezeReason::NotEnabled)
        } else {
            None
        }
    }

    /// What it does that is not frozen, where to, and how fast at most.
    fn choose(&self, demand: SuperpositionDemand) -> (SuperpositionState, Target, Bounds) {
        use SuperpositionState::{Follows, Returns, Silent};
        let bounds = self.bounds;
        let stands = |state| (state, Target::Speed(0.0), bounds);
        if !self.is_on {
            return (Returns, Target::Rest(0.0), bounds);
        }
        if self.settings.control == SuperpositionControl::Wheel {
            return (Follows, Target::Rest(self.turned_to), bounds);
        }
        let SuperpositionDemand::Value(value) = demand else {
            return stands(Silent);
        };
        let value = self.settings.wanted(value);
        let [low, high] = self.range;
        match self.settings.control {
            SuperpositionControl::Offset | SuperpositionControl::Wheel => {
                (Follows, Target::Rest(value.clamp(low, high)), bounds)
            }
            SuperpositionControl::Velocity => {
                // Towards the end of the range, where it comes to rest by itself.
                let end = if value > 0.0 { high } else { low };
                let speed = value.abs().min(bounds.v);
                if speed > SLOWEST_V {
                    (Follows, Target::Rest(end), bounds.with_speed(speed))
                } else {
                    stands(Follows)
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
