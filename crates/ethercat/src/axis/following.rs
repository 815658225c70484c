//! The state of a drive with power: the target is the demand, and never far from the one before.

use super::step::{ENABLE_OPERATION, Next, Step};
use crate::image::CYCLIC_POSITION;
use crate::state::FOLLOWS;
use crate::trouble::Trouble;
use glidepath_link::DriveState;

/// Cycles that a drive may say that it does not follow, after a change of mode.
const GRACE: u32 = 5;

#[derive(Debug, Clone)]
pub(super) struct Following {
    target: i32,
    /// Whether demands are followed: the first one was where the joint stands.
    is_led: bool,
    strayed: u32,
}

impl Following {
    pub(super) const fn new(target: i32) -> Self {
        Self {
            target,
            is_led: false,
            strayed: 0,
        }
    }

    pub(super) fn step(&mut self, step: &mut Step<'_>) -> Next {
        let (settings, sight, wish) = (step.settings, step.sight, step.wish);
        let joint = settings.joint;
        step.outputs.control = ENABLE_OPERATION;
        step.outputs.mode = CYCLIC_POSITION;
        step.outputs.target = self.target;
        let state = sight.state();
        if !sight.is_present {
            return Next::Stop(None);
        }
        if state != DriveState::OperationEnabled {
            return Next::Stop(Some(Trouble::PowerLost(joint, state)));
        }
        let follows = sight.has(FOLLOWS) && sight.inputs.mode == CYCLIC_POSITION;
        self.strayed = if follows { 0 } else { self.strayed + 1 };
        if self.strayed > GRACE {
            return Next::Stop(Some(Trouble::PowerLost(joint, state)));
        }
        if !wish.enable {
            return Next::Stop(None);
        }
        if wish.home && settings.homing.is_some() {
            return if wish.may_home {
                Next::Home
            } else {
                Next::Stay
            };
        }
        let Some(demand) = wish.demand else {
            // Nobody leads: the joint stays where it was told to be.
            self.is_led = false;
            return Next::Stay;
        };
        if !self.is_led {
            let apart = demand - settings.place(self.target);
            if apart.abs() > settings.enable_window {
                return Next::Stop(Some(Trouble::Apart(joint, apart)));
            }
            self.is_led = true;
        }
        match self.judge(step, demand) {
            Ok(target) => {
                (self.target, step.outputs.target) = (target, target);
                Next::Stay
            }
            Err(trouble) => Next::Stop(Some(trouble)),
        }
    }

    fn judge(&self, step: &Step<'_>, demand: f64) -> Result<i32, Trouble> {
        let (settings, joint) = (step.settings, step.settings.joint);
        let target = settings.counts(demand).ok_or(Trouble::Range(joint))?;
        let stepped = f64::from(target) - f64::from(self.target);
        let most = settings.guard_counts(step.sight.since_ns);
        if stepped.abs() > most {
            return Err(Trouble::Step(joint, stepped, most));
        }
        Ok(target)
    }
}
