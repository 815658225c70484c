//! What is in force in a FANUC program beside the modes that every control has.

use crate::syntax::modes::Motion;

/// Modes of FANUC alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FanucModal {
    /// The motion code that is in force behind cycles: G0 at first.
    pub(crate) before_cycles: Motion,
    /// The last H and D.
    pub(crate) length_offset: Option<u32>,
    pub(crate) radius_offset: u32,
    /// G43 or G44 is in force, and which of them.
    pub(crate) length_sign: Option<f64>,
    /// G16.
    pub(crate) polar: Option<Polar>,
    /// A macro is called behind every move (G66).
    pub(crate) calls_macro: bool,
}

impl Default for FanucModal {
    fn default() -> Self {
        Self {
            before_cycles: Motion::Rapid,
            length_offset: None,
            radius_offset: 0,
            length_sign: None,
            polar: None,
            calls_macro: false,
        }
    }
}

/// A radius and an angle, and about which point of the program, mm and degrees.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Polar {
    pub(crate) centre: [f64; 2],
    pub(crate) radius_mm: f64,
    pub(crate) degrees: f64,
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
