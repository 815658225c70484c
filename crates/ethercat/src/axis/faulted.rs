//! The state of a drive with a fault. It is reset once for each time that the operator asks for it,
//! never in a loop.

use super::step::{DISABLE_VOLTAGE, Next, RESET_FAULT, Step};
use glidepath_link::DriveState;

#[derive(Debug, Clone)]
pub(super) struct Faulted {
    /// It is to be reset when its reaction is over.
    is_asked: bool,
}

pub(super) const fn rest(step: &mut Step<'_>) {
    step.stand(DISABLE_VOLTAGE);
}

impl Faulted {
    /// `is_asked` if it is to be reset at once: that was asked for while nobody saw it.
    pub(super) const fn new(is_asked: bool) -> Self {
        Self { is_asked }
    }

    pub(super) const fn step(&mut self, step: &mut Step<'_>) -> Next {
        rest(step);
        self.is_asked |= step.drive_command.reset;
        if !step.drive_inputs.is_faulted() {
            return Next::Off;
        }
        if self.is_asked && matches!(step.drive_inputs.state(), DriveState::Fault) {
            self.is_asked = false;
            step.outputs.control = RESET_FAULT;
        }
        Next::Stay
    }
}
