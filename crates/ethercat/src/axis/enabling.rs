//! The enabling of a drive: on the way to power, one state after the other. The last step is taken
//! when all drives are ready for it: all of them, or none.

use super::step::{DISABLE_VOLTAGE, ENABLE_OPERATION, Next, SHUTDOWN, SWITCH_ON, Step};
use crate::bus_fault::BusFault;
use crate::image::CYCLIC_POSITION;
use crate::state::{FOLLOWS, REMOTE};
use glidepath_link::DriveState;

/// How long all of it may take: a contactor, a charging DC link, a brake.
const PATIENCE_NS: u64 = 5_000_000_000;

#[derive(Debug, Clone)]
pub(super) struct Enabling {
    since_ns: u64,
}

impl Enabling {
    pub(super) const fn new(since_ns: u64) -> Self {
        Self { since_ns }
    }

    pub(super) fn step(&self, step: &mut Step<'_>) -> Next {
        let (drive_inputs, joint) = (step.drive_inputs, step.settings.joint);
        let state = drive_inputs.state();
        step.stand(match state {
            DriveState::SwitchOnDisabled => SHUTDOWN,
            DriveState::Ready => SWITCH_ON,
            DriveState::SwitchedOn if !step.drive_command.are_all_ready => SWITCH_ON,
            DriveState::SwitchedOn | DriveState::OperationEnabled => ENABLE_OPERATION,
            _ => DISABLE_VOLTAGE,
        });
        if !step.drive_command.enable || !drive_inputs.is_present {
            return Next::Stop(None);
        }
        if let Some((apart, stays)) = drive_inputs.apart {
            return Next::Stop(Some(BusFault::EncodersApart(joint, apart, stays)));
        }
        let is_on = state == DriveState::OperationEnabled;
        if is_on && drive_inputs.inputs.mode == CYCLIC_POSITION && drive_inputs.has(FOLLOWS) {
            return Next::Follow;
        }
        if drive_inputs.now_ns.saturating_sub(self.since_ns) > PATIENCE_NS {
            return Next::Stop(Some(if drive_inputs.has(REMOTE) {
                BusFault::NotEnabled(joint, state)
            } else {
                BusFault::NotRemote(joint)
            }));
        }
        Next::Stay
    }
}
