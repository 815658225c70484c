//! The state of a device, as it says itself.

/// OP: its outputs count.
pub(crate) const OP: u8 = 8;

/// The state of a device, as it says itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DeviceState {
    /// 8 for OP.
    pub state: u8,
    /// It did not get or keep what it was asked for.
    pub has_error: bool,
    /// AL status code.
    pub code: u16,
}

impl DeviceState {
    /// A device that is in OP.
    pub(crate) const fn in_op() -> Self {
        Self {
            state: OP,
            has_error: false,
            code: 0,
        }
    }

    /// Whether its outputs count.
    pub(crate) const fn is_in_op(self) -> bool {
        self.state == OP && !self.has_error
    }
}
