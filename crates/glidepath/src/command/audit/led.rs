//! The detection of setpoints that are led by the drives: nobody has asked for that motion.

use glidepath_link::{MachineState, Setpoint};

/// Follows which drives are to have power.
#[derive(Debug, Default)]
pub(super) struct Led {
    /// Drives were told to have power before.
    knows_power: bool,
}

impl Led {
    /// Without power, and while drives look for their home by themselves, setpoints repeat what the
    /// drives report. A fault takes the power and keeps its own state. (Rows of a CSV file do not
    /// tell of power at all.)
    pub(super) fn see(&mut self, setpoint: &Setpoint) -> bool {
        let has_power = setpoint.enable != 0;
        self.knows_power |= has_power;
        let state = setpoint.state();
        let tells = self.knows_power || state == Ok(MachineState::Faulted);
        setpoint.home != 0 || state == Ok(MachineState::Off) || (tells && !has_power)
    }
}
