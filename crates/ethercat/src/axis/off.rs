//! The state of a drive without power: the target goes with the joint.

use super::step::{DISABLE_VOLTAGE, Next, Step};

pub(super) const fn step(step: &mut Step<'_>) -> Next {
    step.stand(DISABLE_VOLTAGE);
    if step.drive_command.enable && step.drive_inputs.is_present {
        Next::Enable
    } else {
        Next::Stay
    }
}
