//! A sample with its place on the program, for the rules of tremor.

use crate::piece::Piece;
use glidepath_geometry::{AXES, AxisVector};

/// A sample, matched to the program.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MatchedSample {
    pub(crate) tick: u64,
    pub(crate) line: u32,
    pub(crate) position: AxisVector,
    /// Periods since the sample before.
    pub(crate) ticks: u64,
    /// Whether program time does not run at its own rate there.
    pub(crate) is_between_frames: bool,
    /// Where the sample before was, if the machine rested there.
    pub(crate) rested_at: Option<AxisVector>,
    /// Axes that none of the moves changes on which the sample may be.
    pub(crate) still: [bool; AXES],
    /// The programmed coordinates of those.
    pub(crate) level: AxisVector,
    /// The move that it is on, if it can be on one only.
    pub(crate) piece: Option<Piece>,
    /// Speed since the sample before, and the feed programmed, mm/s.
    pub(crate) speed_v: f64,
    pub(crate) feed_v: f64,
}
