//! Quantiles of a time, as statuses tell them.

use iceoryx2::prelude::ZeroCopySend;

/// Quantiles of a time, ns.
#[repr(C)]
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend,
)]
pub struct Quantiles {
    /// Median.
    pub p50_ns: u64,
    /// 99 % are no longer.
    pub p99_ns: u64,
    /// 99.9 % are no longer.
    pub p999_ns: u64,
    /// The longest.
    pub max_ns: u64,
}
