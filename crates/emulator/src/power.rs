//! The power states of a drive by CiA 402, and what the controlword makes of them.

/// The states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Power {
    SwitchOnDisabled,
    Ready,
    SwitchedOn,
    Enabled,
    QuickStop,
    FaultReaction,
    Fault,
}

impl Power {
    /// The bits of the statusword.
    pub(crate) const fn status(self) -> u16 {
        match self {
            Self::SwitchOnDisabled => 0x40,
            Self::Ready => 0x21,
            Self::SwitchedOn => 0x23,
            Self::Enabled => 0x27,
            Self::QuickStop => 0x07,
            Self::FaultReaction => 0x0f,
            Self::Fault => 0x08,
        }
    }

    /// Whether the motor has current.
    pub(crate) const fn drives(self) -> bool {
        matches!(self, Self::Enabled | Self::QuickStop | Self::FaultReaction)
    }

    /// What a controlword leads to, one step at a time. `resets` at the rising edge of bit 7, `may`
    /// if the drive has what it needs to give power.
    pub(crate) const fn next(self, control: u16, resets: bool, may: bool) -> Self {
        let command = control & 15;
        match self {
            Self::FaultReaction => Self::FaultReaction,
            Self::Fault if resets => Self::SwitchOnDisabled,
            Self::Fault => Self::Fault,
            Self::QuickStop if command & 2 == 0 => Self::SwitchOnDisabled,
            Self::QuickStop => Self::QuickStop,
            // Disable voltage.
            _ if command & 2 == 0 => Self::SwitchOnDisabled,
            Self::Enabled if command & 4 == 0 => Self::QuickStop,
            _ if command & 4 == 0 => Self::SwitchOnDisabled,
            // Shutdown.
            _ if command & 1 == 0 => match self {
                Self::SwitchOnDisabled if !may => self,
                _ => Self::Ready,
            },
            Self::SwitchOnDisabled => Self::SwitchOnDisabled,
            Self::Ready => Self::SwitchedOn,
            Self::SwitchedOn if command == 15 && may => Self::Enabled,
            Self::Enabled if command == 7 => Self::SwitchedOn,
            Self::SwitchedOn | Self::Enabled => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Power::{self, Enabled, Fault, QuickStop, Ready, SwitchOnDisabled, SwitchedOn};

    fn after(from: Power, controls: &[u16]) -> Power {
        let step = |state: Power, control: &u16| state.next(*control, *control & 0x80 != 0, true);
        controls.iter().fold(from, step)
    }

    #[test]
    fn power_comes_step_by_step_and_goes_at_once() {
        assert_eq!(after(SwitchOnDisabled, &[0x06]), Ready);
        assert_eq!(after(SwitchOnDisabled, &[0x0f]), SwitchOnDisabled);
        assert_eq!(after(SwitchOnDisabled, &[0x06, 0x07]), SwitchedOn);
        assert_eq!(after(SwitchOnDisabled, &[0x06, 0x07, 0x0f]), Enabled);
        assert_eq!(after(Enabled, &[0x07]), SwitchedOn);
        assert_eq!(after(Enabled, &[0x06]), Ready);
        assert_eq!(after(Enabled, &[0x02]), QuickStop);
        assert_eq!(after(Enabled, &[0x00]), SwitchOnDisabled);
        assert_eq!(after(QuickStop, &[0x0f, 0x06]), QuickStop);
    }

    #[test]
    fn a_fault_stays_until_it_is_reset() {
        assert_eq!(after(Fault, &[0x00, 0x06, 0x0f]), Fault);
        assert_eq!(after(Fault, &[0x80]), SwitchOnDisabled);
    }
}
