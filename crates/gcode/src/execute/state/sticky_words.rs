//! The sticky words of canned cycles: those that later blocks keep.

use serde::{Deserialize, Serialize};

use crate::syntax::modes::CannedCycle;

/// A series of cycles, and what it keeps from block to block.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct CycleSeries {
    /// Program coordinate, along the normal axis, from before the series, mm.
    pub(crate) initial: Option<f64>,
    pub(crate) last: Option<StickyWords>,
}

/// Words of a cycle that later blocks keep, mm and s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct StickyWords {
    pub(crate) cycle: CannedCycle,
    pub(crate) r: f64,
    /// R was written.
    #[serde(default)]
    pub(crate) says_r: bool,
    pub(crate) depth: f64,
    /// R and the bottom as coordinates: on a FANUC these stay where G90 and G91 change in between.
    #[serde(default)]
    pub(crate) levels_mm: Option<[f64; 2]>,
    pub(crate) dwell_s: f64,
    /// How deep to go at a time, by how much less each time (J of Haas), and the least (K).
    pub(crate) peck: f64,
    #[serde(default)]
    pub(crate) less: f64,
    #[serde(default)]
    pub(crate) least: f64,
    /// G73 of a Haas comes out to R as often as it has gone so deep (K beside Q); 0: never.
    #[serde(default)]
    pub(crate) out_after: f64,
    /// How far fine boring (G76) goes aside at the bottom, along X and Y.
    #[serde(default)]
    pub(crate) shift_mm: [f64; 2],
    /// It taps behind the spindle.
    pub(crate) is_rigid: bool,
    /// The spindle turns in the hole alone (M29).
    pub(crate) starts_spindle: bool,
}
