//! The state of a drive with power: the target is the demand, and never far from the one before.

use super::step::{ENABLE_OPERATION, Next, Step};
use crate::bus_fault::BusFault;
use crate::feed_forward::Offsets;
use crate::image::CYCLIC_POSITION;
use crate::state::FOLLOWS;
use glidepath_link::DriveState;

/// Cycles that a drive may say that it does not follow, after a change of mode.
const GRACE: u32 = 5;

#[derive(Debug, Clone)]
pub(super) struct Following {
    target: i64,
    /// Whether demands are followed: the first one was where the joint stands.
    is_led: bool,
    strayed: u32,
}

impl Following {
    pub(super) const fn new(target: i64) -> Self {
        Self {
            target,
            is_led: false,
            strayed: 0,
        }
    }

    pub(super) fn step(&mut self, step: &mut Step<'_>) -> Next {
        let (settings, drive_inputs, drive_command) =
            (step.settings, step.drive_inputs, step.drive_command);
        let joint = settings.joint;
        step.outputs.control = ENABLE_OPERATION;
        step.outputs.mode = CYCLIC_POSITION;
        step.outputs.target = self.target;
        // What stands takes nothing.
        step.outputs.offsets = Offsets::NONE;
        let state = drive_inputs.state();
        if !drive_inputs.is_present {
            return Next::Stop(None);
        }
        if state != DriveState::OperationEnabled {
            return Next::Stop(Some(BusFault::PowerLost(joint, state)));
        }
        let follows = drive_inputs.has(FOLLOWS) && drive_inputs.inputs.mode == CYCLIC_POSITION;
        self.strayed = if follows { 0 } else { self.strayed + 1 };
        if self.strayed > GRACE {
            return Next::Stop(Some(BusFault::PowerLost(joint, state)));
        }
        if !drive_command.enable {
            return Next::Stop(None);
        }
        if let Some((apart, stays)) = drive_inputs.apart {
            return Next::Stop(Some(BusFault::EncodersApart(joint, apart, stays)));
        }
        if drive_command.home && settings.homing.is_some() {
            return if drive_command.may_home {
                Next::Home
            } else {
                Next::Stay
            };
        }
        let Some(demand) = drive_command.demand else {
            // Nobody leads: the joint stays where it was told to be.
            self.is_led = false;
            return Next::Stay;
        };
        if !self.is_led {
            let apart = demand.position - settings.place(self.target);
            if apart.abs() > settings.enable_window {
                return Next::Stop(Some(BusFault::Apart(joint, apart)));
            }
            self.is_led = true;
        }
        match self.judge(step, demand.position) {
            Ok(target) => {
                (self.target, step.outputs.target) = (target, target);
                step.outputs.offsets = settings.offsets(demand.velocity, demand.acceleration);
                Next::Stay
            }
            Err(trouble) => Next::Stop(Some(trouble)),
        }
    }

    fn judge(&self, step: &Step<'_>, demand: f64) -> Result<i64, BusFault> {
        let (settings, joint) = (step.settings, step.settings.joint);
        let target = settings.counts(demand).ok_or(BusFault::Range(joint))?;
        #[allow(clippy::cast_precision_loss, reason = "a step")]
        let stepped = (target - self.target) as f64;
        let most = settings.guard_counts(step.drive_inputs.since_ns);
        if stepped.abs() > most {
            return Err(BusFault::Step(joint, stepped, most));
        }
        Ok(target)
    }
}
