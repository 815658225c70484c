//! The inputs of a drive in one cycle, and the command to it.

use crate::image::Inputs;
use crate::state;
use glidepath_link::DriveState;
use glidepath_link::servo::JointState;

/// The inputs of a drive in one cycle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DriveInputs {
    /// ns of `CLOCK_MONOTONIC`.
    pub(crate) now_ns: u64,
    /// Time between two targets that reach the drive, ns: longer than the period after frames that
    /// were lost.
    pub(crate) since_ns: u64,
    pub(crate) inputs: Inputs,
    /// Whether it is in OP. What it told last is old otherwise.
    pub(crate) is_present: bool,
    /// How far the two encoders of the joint are apart, mm or degrees, if that is too much, and whether it stays so
    /// until the process ends.
    pub(crate) apart: Option<(f64, bool)>,
    /// The fault that it reports, 0 for none.
    pub(crate) fault: u16,
}

impl DriveInputs {
    pub(crate) const fn state(&self) -> DriveState {
        state::of(self.inputs.status)
    }

    pub(crate) const fn is_faulted(&self) -> bool {
        matches!(self.state(), DriveState::Fault | DriveState::FaultReaction)
    }

    pub(crate) const fn has(&self, bits: u16) -> bool {
        self.inputs.status & bits == bits
    }
}

/// The command to a drive.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DriveCommand {
    /// Power.
    pub(crate) enable: bool,
    /// That it finds its home, and stays there.
    pub(crate) home: bool,
    /// That it begins to look for it: those before it are home.
    pub(crate) may_home: bool,
    /// All drives are ready for power.
    pub(crate) are_all_ready: bool,
    /// Where it is to be, mm or degrees, and how it moves there; `None` to stay.
    pub(crate) demand: Option<JointState>,
    /// That a fault is reset: true for one cycle.
    pub(crate) reset: bool,
}
