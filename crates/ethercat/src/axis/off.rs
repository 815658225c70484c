//! The state of a drive without power: the target goes with the joint.

use super::step::{DISABLE_VOLTAGE, Next, Step};
use crate::bus_fault::BusFault;

pub(super) const fn step(step: &mut Step<'_>) -> Next {
    step.stand(DISABLE_VOLTAGE);
    if let Some((apart, stays)) = step.drive_inputs.apart
        && step.drive_command.enable
    {
        return Next::Refuse(BusFault::EncodersApart(step.settings.joint, apart, stays));
    }
    if step.drive_command.enable && step.drive_inputs.is_present {
        Next::Enable
    } else {
        Next::Stay
    }
}
