//! Homing by the drives themselves, as the ports thread follows it.
//!
//! Who sets out for home does not know where it is any more. Drives say otherwise: some keep their
//! word of an earlier home until they have found it anew, or for good where the search was aborted.
//! So that word counts again only once this way home has ended well.

use crate::shared::message::TickReport;
use glidepath_link::Power;

/// How long the real-time thread may take to begin, ns.
const BEGIN_NS: u64 = 100_000_000;

/// The joints that look for their home by their drives, from the command to the end.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct DriveSearch {
    /// One bit each; none if nobody does.
    joints: u32,
    asked_ns: u64,
    /// The drives were told.
    has_begun: bool,
}

impl DriveSearch {
    /// Joints are sent home.
    pub(super) const fn begin(&mut self, joints: u32, now_ns: u64) {
        *self = Self {
            joints,
            asked_ns: now_ns,
            has_begun: false,
        };
    }

    /// The joints under way, one bit each.
    pub(super) const fn joints(&self) -> u32 {
        self.joints
    }

    /// Whatever comes of it, these joints are not home by it.
    pub(super) const fn give_up(&mut self, joints: u32) {
        self.joints &= !joints;
    }

    /// Takes note of a setpoint that was published. Returns the joints that have come home by it.
    pub(super) fn note(&mut self, report: &TickReport) -> u32 {
        if self.joints == 0 {
            return 0;
        }
        if report.setpoint.home != 0 {
            self.has_begun = true;
            return 0;
        }
        if !self.has_begun {
            return 0;
        }
        let is_well = report.fault.is_none() && report.power == Power::On;
        let joints = core::mem::take(&mut self.joints);
        if is_well { joints } else { 0 }
    }

    /// Gives up what does not begin.
    pub(super) const fn watch(&mut self, now_ns: u64) {
        if !self.has_begun && now_ns > self.asked_ns.saturating_add(BEGIN_NS) {
            self.joints = 0;
        }
    }
}
