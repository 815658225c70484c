//! What new frames and tool lengths of SINUMERIK have shifted, and no move has gone yet.

use glidepath_geometry::{AXES, AxisVector};

/// Shifts below this are rounding, mm or degrees.
const NO_SHIFT: f64 = 1e-9;

/// The shifts that the next increment of each axis goes beside its own way.
///
/// Coordinates change when a frame or a length does, and the machine stands still. An increment counts
/// from the coordinate that the axis had before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Untraversed {
    /// From the coordinate that each axis has to the one that increments count from, program
    /// coordinates, mm or degrees.
    pub(crate) way: AxisVector,
    /// Axes whose coordinate a turn, a mirror or a scale has changed: from where their increments
    /// count is not known.
    pub(crate) is_unclear: [bool; AXES],
}

impl Default for Untraversed {
    fn default() -> Self {
        Self {
            way: AxisVector::zeros(),
            is_unclear: [false; AXES],
        }
    }
}

impl Untraversed {
    /// True if there is anything.
    pub(crate) fn is_any(&self) -> bool {
        self.way.iter().any(|way| *way != 0.0)
    }

    /// The coordinate of an axis became another one where the machine stands; `is_turned` if not by a
    /// shift alone.
    pub(crate) fn rename(&mut self, axis: usize, before: f64, now: f64, is_turned: bool) {
        let way = self.way[axis] + before - now;
        let is_shifted = way.abs() > NO_SHIFT;
        self.way[axis] = if is_shifted { way } else { 0.0 };
        let was_changed = (before - now).abs() > NO_SHIFT;
        self.is_unclear[axis] = is_shifted && (self.is_unclear[axis] || is_turned && was_changed);
    }

    /// The axis has gone to a coordinate of its own.
    pub(crate) fn forget(&mut self, axis: usize) {
        self.way[axis] = 0.0;
        self.is_unclear[axis] = false;
    }
}
