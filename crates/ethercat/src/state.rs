//! The state of a drive, as its statusword tells (CiA 402, IEC 61800-7-201).

use glidepath_link::DriveState;

/// The drive obeys the bus, and nobody at its own panel.
pub(crate) const REMOTE: u16 = 1 << 9;
/// Homing: the target is reached.
pub(crate) const REACHED: u16 = 1 << 10;
/// In cyclic position: the drive follows the target. Homing: home was found.
pub(crate) const FOLLOWS: u16 = 1 << 12;
/// Homing: home was not found.
pub(crate) const HOMING_ERROR: u16 = 1 << 13;

/// The state of a statusword. One that is none of the standard's counts as not ready.
pub(crate) const fn of(status: u16) -> DriveState {
    match (status & 0x4f, status & 0x6f) {
        (0x40, _) => DriveState::SwitchOnDisabled,
        (0x0f, _) => DriveState::FaultReaction,
        (0x08, _) => DriveState::Fault,
        (_, 0x21) => DriveState::Ready,
        (_, 0x23) => DriveState::SwitchedOn,
        (_, 0x27) => DriveState::OperationEnabled,
        (_, 0x07) => DriveState::QuickStop,
        _ => DriveState::NotReady,
    }
}

/// Its name, as drives' manuals have it.
pub(crate) const fn name(state: DriveState) -> &'static str {
    match state {
        DriveState::Unknown => "unknown",
        DriveState::NotReady => "not ready to switch on",
        DriveState::SwitchOnDisabled => "switch on disabled",
        DriveState::Ready => "ready to switch on",
        DriveState::SwitchedOn => "switched on",
        DriveState::OperationEnabled => "operation enabled",
        DriveState::QuickStop => "quick stop active",
        DriveState::FaultReaction => "fault reaction active",
        DriveState::Fault => "fault",
    }
}

#[cfg(test)]
mod tests {
    use super::{DriveState, of};

    #[test]
    fn statuswords_that_real_masters_and_drives_have_shown() {
        for (status, state) in [
            (0x0250, DriveState::SwitchOnDisabled),
            (0x0040, DriveState::SwitchOnDisabled),
            (0x0231, DriveState::Ready),
            (0x0233, DriveState::SwitchedOn),
            (0x1237, DriveState::OperationEnabled),
            (0x0217, DriveState::QuickStop),
            (0x021f, DriveState::FaultReaction),
            (0x0218, DriveState::Fault),
            (0x0200, DriveState::NotReady),
        ] {
            assert_eq!(of(status), state, "{status:#06x}");
        }
    }
}
