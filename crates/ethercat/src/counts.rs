//! The counts over all cycles.

use glidepath_realtime::Histogram;

/// Counts over all cycles.
#[derive(Debug, Clone, Default)]
pub struct Counts {
    /// Cycles.
    pub cycles: u64,
    /// Frames that did not come back in time.
    pub lost: u64,
    /// Frames in which not every device took part.
    pub short: u64,
    /// Frames that came back when they were not waited for any more.
    pub stale: u64,
    /// Cycles left out because their time was past.
    pub missed: u64,
    /// Targets in motion for a time to which no setpoint led any more.
    pub coasts: u64,
    /// How often the bus was brought up after the first time.
    pub restarts: u64,
    /// How late the frames were sent, ns.
    pub lateness: Histogram,
    /// How long they were under way, ns.
    pub round_trip: Histogram,
    /// Deviation of the reference's quartz from the clock of the host, 1.
    pub quartz: f64,
}
