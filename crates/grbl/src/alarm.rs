//! Alarms of grbl, with their numbers.

/// An alarm: why a machine is locked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Alarm {
    /// A limit switch.
    HardLimit,
    /// A move beyond the travel.
    SoftLimit,
    /// The machine was stopped in motion, or its position is in doubt.
    Stopped,
    /// The probe was not as it has to be before it sets out.
    ProbeAtFirst,
    /// The probe has not found what it looked for.
    ProbeNothing,
    /// The sender has ended the search for home.
    HomingEnded,
    /// Homing failed.
    Homing,
    /// Emergency stop.
    EmergencyStop,
    /// The spindle did not come to its speed.
    Spindle,
    /// A drive reports a fault.
    Motor,
}

impl Alarm {
    /// The number that senders know.
    #[must_use]
    pub const fn number(self) -> u8 {
        match self {
            Self::HardLimit => 1,
            Self::SoftLimit => 2,
            Self::Stopped => 3,
            Self::ProbeAtFirst => 4,
            Self::ProbeNothing => 5,
            Self::HomingEnded => 6,
            Self::Homing => 9,
            Self::EmergencyStop => 10,
            Self::Spindle => 14,
            Self::Motor => 17,
        }
    }
}
