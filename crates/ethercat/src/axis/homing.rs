//! The state of a drive that looks for its home by itself (CiA 402, mode 6).
//!
//! Afterwards it counts anew, so its position jumps: it is told to be where it says it is, and goes on
//! in cyclic position from there. It stays until it is not to look for its home any more. How
//! long it may look is the interpolator's to say.

use super::step::{ENABLE_OPERATION, Next, START_HOMING, Step};
use crate::bus_fault::BusFault;
use crate::feed_forward::Offsets;
use crate::image::{CYCLIC_POSITION, HOMING};
use crate::state::{FOLLOWS, HOMING_ERROR, REACHED};
use glidepath_link::DriveState;

/// How long the drive may take to change its mode.
const MODE_NS: u64 = 1_000_000_000;
/// Cycles in which it may still show bits of before.
const GRACE: u32 = 5;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Homing mode comes.
    Entering,
    /// It looks, for so many cycles.
    Under(u32),
    /// Cyclic position comes; home was found, or it was told to leave off.
    Leaving(bool),
    /// It stays.
    There,
}

#[derive(Debug, Clone)]
pub(super) struct Homing {
    part: Part,
    since_ns: u64,
    target: i64,
}

impl Homing {
    pub(super) const fn new(since_ns: u64) -> Self {
        Self {
            part: Part::Entering,
            since_ns,
            target: 0,
        }
    }

    pub(super) const fn is_under_way(&self) -> bool {
        !matches!(self.part, Part::There)
    }

    pub(super) fn step(&mut self, step: &mut Step<'_>) -> Next {
        let (drive_inputs, joint) = (step.drive_inputs, step.settings.joint);
        let state = drive_inputs.state();
        if !drive_inputs.is_present || !step.drive_command.enable {
            return Next::Stop(None);
        }
        if state != DriveState::OperationEnabled {
            return Next::Stop(Some(BusFault::PowerLost(joint, state)));
        }
        let waited_ns = drive_inputs.now_ns.saturating_sub(self.since_ns);
        let actual = drive_inputs.inputs.actual;
        step.outputs.target = actual;
        step.outputs.offsets = Offsets::NONE;
        let give_up = Next::Stop(Some(BusFault::NoHome(joint)));
        match self.part {
            Part::Entering => {
                (step.outputs.control, step.outputs.mode) = (ENABLE_OPERATION, HOMING);
                if drive_inputs.inputs.mode == HOMING {
                    (self.part, self.since_ns) = (Part::Under(0), drive_inputs.now_ns);
                } else if waited_ns > MODE_NS {
                    return give_up;
                }
            }
            Part::Under(cycles) => {
                (step.outputs.control, step.outputs.mode) = (START_HOMING, HOMING);
                self.part = Part::Under(cycles.saturating_add(1));
                let says = |bits| cycles > GRACE && drive_inputs.has(bits);
                if says(HOMING_ERROR) {
                    return give_up;
                }
                let is_found = says(REACHED | FOLLOWS);
                if is_found || !step.drive_command.home {
                    (self.part, self.since_ns) = (Part::Leaving(is_found), drive_inputs.now_ns);
                }
            }
            Part::Leaving(is_found) => {
                (step.outputs.control, step.outputs.mode) = (ENABLE_OPERATION, CYCLIC_POSITION);
                self.target = actual;
                if drive_inputs.inputs.mode == CYCLIC_POSITION && drive_inputs.has(FOLLOWS) {
                    self.part = Part::There;
                    return if is_found { Next::Found } else { Next::Follow };
                }
                if waited_ns > MODE_NS {
                    return give_up;
                }
            }
            Part::There => {
                step.outputs.target = self.target;
                if !step.drive_command.home {
                    return Next::Follow;
                }
            }
        }
        Next::Stay
    }
}
