//! The faults that a test injects into a device, and the end of them.

/// A fault of a device, or the end of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InjectedFault {
    /// The drive finds a fault, with this number of its own.
    Fault(u16),
    /// The drive sends an emergency by its mailbox, and does nothing else.
    Emergency(u16),
    /// The device leaves OP for SAFE-OP by itself, with this code.
    Drop(u16),
    /// The drive is told to enable and does not (true), or does again.
    RefusesPower(bool),
    /// The main voltage is not there (true), or is again.
    NoVoltage(bool),
    /// Nothing moves the motor any more (true), or it moves again.
    Stuck(bool),
    /// The units of its touch probe are off (true), or do what they are asked to again.
    ProbeOff(bool),
    /// The device lost its supply for a moment: it begins anew, where its motor stands.
    Reboot,
}
