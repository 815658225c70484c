//! The thread data of the first block of FANUC's G76, for the blocks behind it.

use serde::{Deserialize, Serialize};

/// How a thread of FANUC's G76 is cut, in mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct ThreadSetup {
    /// Passes at full depth behind those that come to it.
    pub(crate) finishes: u32,
    /// Length of the way out along the thread, in leads.
    pub(crate) exit_leads: f64,
    /// Tangent of half the angle of the tool: how far a pass is shifted for its depth.
    pub(crate) tangent: f64,
    /// The least that a pass is deeper than the one before.
    pub(crate) least_mm: f64,
    /// What is left for the passes at full depth.
    pub(crate) finish_mm: f64,
}
