//! The travel of every axis: its soft limits.

use glidepath_geometry::AxisVector;

/// The travel of every axis: its soft limits, in machine coordinates, mm or degrees.
///
/// Both ends belong to it: a program may go to an end of travel, and rest there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// Lowest position; −∞ for an axis without a soft limit.
    pub lowest: AxisVector,
    /// Highest position; ∞ for an axis without a soft limit.
    pub highest: AxisVector,
}

impl Travel {
    /// What rounding may put a position beyond an end of travel, mm or degrees. All who judge a
    /// position allow as much: the reader of programs, the planner, the interpolator, the auditor.
    pub const ROUNDING: f64 = 1e-9;

    /// What a motion may swing beyond an end of travel between two periods, as a share of what jerk
    /// does in a period.
    ///
    /// A motion inside the travel, whose jerk is J at most, is known at periods; between them it is the
    /// polynomial of degree five through both states. That is off the motion itself by at most J·T³/161.7,
    /// the integral of Peano's kernel of the interpolation at half the period, and by so much it may be
    /// beyond: nanometres, or 0.4 µm at J = 10⁶ mm/s³ and 4 ms. A rest within a period, with all of the
    /// jerk, makes J·T³/768 of it.
    pub const SWING_R: f64 = 1.0 / 161.0;

    /// No soft limits.
    #[must_use]
    pub fn unlimited() -> Self {
        Self {
            lowest: AxisVector::repeat(f64::NEG_INFINITY),
            highest: AxisVector::repeat(f64::INFINITY),
        }
    }

    /// The travel of a motion from this place. An axis that stands beyond an end (by hand, or by what was
    /// superposed to it) may stay there and come inwards, but goes no further out.
    #[must_use]
    pub fn beginning_at(self, place: &AxisVector) -> Self {
        Self {
            lowest: self.lowest.inf(place),
            highest: self.highest.sup(place),
        }
    }
}
