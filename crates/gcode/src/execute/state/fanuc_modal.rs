//! The modal state of a FANUC program beside the modes that every control has.

use crate::execute::state::open_plane::OpenPlane;
use crate::syntax::modes::{Motion, Turning};

/// Modes of FANUC alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FanucModal {
    /// While a cycle is in force, the motion code from before it: G0 at first.
    pub(crate) before_cycles: Motion,
    /// The last H and D.
    pub(crate) length_offset: Option<u32>,
    pub(crate) radius_offset: u32,
    /// The last M code, N of the block before, and the number of the program (#4113 to #4115).
    pub(crate) m_code: u32,
    pub(crate) sequence: u32,
    pub(crate) program: u32,
    /// G43 or G44 is in force, and which of them.
    pub(crate) length_sign: Option<f64>,
    /// By how much the length in force is greater than when Z moved last, mm.
    pub(crate) length_on_way_mm: f64,
    /// G43.5: I, J and K of straight moves are the direction of the tool.
    pub(crate) tip_by_vector: bool,
    /// G16.
    pub(crate) polar: Option<Polar>,
    /// A lathe that has not said yet what F is (G98, G99).
    pub(crate) is_feed_unsaid: bool,
    /// What G90, G92 or G94 of a lathe keep from block to block.
    pub(crate) turning: Option<TurningWords>,
    /// F of the last thread, mm: the F in force while there is no feed.
    pub(crate) lead_mm: Option<f64>,
    /// M24: threads of G92 have no way out at their end.
    pub(crate) ends_thread_straight: bool,
    /// What the first blocks of G71 and G72, G74 and G75 said, mm.
    pub(crate) depth_mm: Option<f64>,
    pub(crate) retract_mm: f64,
    /// What the first block of G73 said.
    pub(crate) repeating: Option<Repeating>,
    /// A macro is called behind every move (G66).
    pub(crate) calls_macro: bool,
    /// G68.2 P2 and P3 as long as blocks are to follow.
    pub(crate) open_plane: Option<OpenPlane>,
}

impl Default for FanucModal {
    fn default() -> Self {
        Self {
            before_cycles: Motion::Rapid,
            length_offset: None,
            radius_offset: 0,
            m_code: 0,
            sequence: 0,
            program: 0,
            length_sign: None,
            length_on_way_mm: 0.0,
            tip_by_vector: false,
            polar: None,
            is_feed_unsaid: false,
            turning: None,
            lead_mm: None,
            ends_thread_straight: false,
            depth_mm: None,
            retract_mm: 0.5,
            repeating: None,
            calls_macro: false,
            open_plane: None,
        }
    }
}

/// The passes of G73: how far the first one is away from the last, Z and X, mm, X as a radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Repeating {
    pub(crate) relief_mm: [f64; 2],
    pub(crate) passes: u32,
}

/// Where a cycle of one pass leads, program coordinates in mm, X as a radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurningWords {
    pub(crate) cycle: Turning,
    pub(crate) x: f64,
    pub(crate) z: f64,
    /// R: where the pass begins, less where it ends.
    pub(crate) taper: f64,
}

/// A radius and an angle, and about which point of the program, mm and degrees.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Polar {
    pub(crate) centre: [f64; 2],
    pub(crate) radius_mm: f64,
    pub(crate) degrees: f64,
    /// Whether a radius and an angle were written since G16.
    pub(crate) is_said: [bool; 2],
}

impl Polar {
    /// The point that is meant.
    pub(crate) fn point(&self) -> [f64; 2] {
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        [
            self.centre[0] + self.radius_mm * cos,
            self.centre[1] + self.radius_mm * sin,
        ]
    }
}
