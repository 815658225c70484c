//! What a drive and its master tell each other in a cycle.

/// The outputs of the master to the drive.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Outputs {
    pub(crate) control: u16,
    pub(crate) target: i32,
    pub(crate) mode: i8,
    /// 0x60FF, counts/s.
    pub(crate) velocity: i32,
    /// 0x6042, rev/min.
    pub(crate) speed_rpm: i16,
    /// 0x60B1, counts/s.
    pub(crate) velocity_offset: i32,
    /// 0x60B2, thousandths of the rated torque.
    pub(crate) torque_offset: i16,
    /// 0x60B8.
    pub(crate) probe: u16,
}

/// The inputs of the master from the drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Inputs {
    pub(crate) status: u16,
    pub(crate) actual: i32,
    pub(crate) mode: i8,
    pub(crate) fault: u16,
    /// 0x606C, counts/s.
    pub(crate) velocity: i32,
    /// 0x6044, rev/min.
    pub(crate) speed_rpm: i16,
    /// 0x6077, thousandths of the torque that a spindle has.
    pub(crate) torque: i16,
    /// 0x60FD.
    pub(crate) digital: u32,
    /// 0x60B9, and 0x60BA to 0x60BD.
    pub(crate) probe: (u16, [[i32; 2]; 2]),
}
