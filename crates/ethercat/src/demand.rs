//! The demand of a cycle to the drives, for measurements.

/// The demand of a cycle, and what had become of the setpoints by then: counts since the bridge began
/// to listen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Demand {
    /// The number of its datagrams.
    pub index: u8,
    /// The SYNC0 that it is for, ns of `CLOCK_MONOTONIC`.
    pub sync_ns: u64,
    /// Ticks that the interpolator missed.
    pub missed_ticks: u64,
    /// Setpoints that were published and did not arrive.
    pub lost_setpoints: u64,
    /// Targets in motion for a time to which no setpoint led any more.
    pub coasts: u64,
}
