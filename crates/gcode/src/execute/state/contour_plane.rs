//! A tilted plane in which a contour is compensated (G41, G42).

use crate::execute::state::frame::Frame;

/// The plane of a contour that is in no plane of the machine. Until the contour ends the program's frame
/// is none, and moves are turned when they are given out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContourPlane {
    /// From places with that frame left out to those of the work.
    pub(crate) map: Frame,
    /// The frame that is left out.
    pub(crate) frame: Frame,
}
