//! The identity of an event, by which it is acknowledged.

use iceoryx2::prelude::ZeroCopySend;

/// The identity of an event: no two have the same.
#[repr(C)]
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend,
)]
pub struct EventId {
    /// The life of the interpolator that published it.
    pub boot_id: u64,
    /// The epoch it happened in.
    pub epoch: u64,
    /// The sequence of its frame.
    pub sequence: u64,
}
