//! By how much the direction of a tool turns when the rotary axes do.
//!
//! The direction d(α) has a derivative by each rotary axis; with all of them together it turns by no more than K·|dα|₂
//! where K² bounds the larger eigenvalue of J Jᵀ, J having these derivatives as columns:
//!
//! ```text
//!   tilt about x or y, and C        columns at right angles, of lengths 1 and sin β           K = 1
//!   tilt about a skewed axis, C     lengths sin α and sin β, at any angle: the trace          K² = sin²α + sin²β
//!   A, B, C about x, y, z in turn   J Jᵀ = [1 + sin²B, −sA sB cB; ·, ≤ 1], by its rows          K² = 1 + sin²B + sin A sin B
//! ```
//!
//! β is how far the tool leans, α the angle of the tilt axis to z.

use crate::tilt::{SkewedTilt, Tilt};
use crate::{FiveAxis, Mechanism};
use glidepath_geometry::{Axis, AxisVector};

/// What the sine of an angle is at most between two ends, degrees.
fn most_sine(ends_deg: [f64; 2]) -> f64 {
    let most_deg = ends_deg[0].abs().max(ends_deg[1].abs());
    // Written so that no ends at all are 90 degrees.
    if most_deg < 90.0 {
        most_deg.to_radians().sin()
    } else {
        1.0
    }
}

impl SkewedTilt {
    fn direction_gain(&self, ends_deg: [f64; 2]) -> f64 {
        let skew = self.direction().x.hypot(self.direction().y);
        let most_deg = ends_deg[0].abs().max(ends_deg[1].abs()).min(180.0);
        let half_lean = skew * (0.5 * most_deg).to_radians().sin();
        let lean_rad = 2.0 * half_lean.min(1.0).asin();
        let lean = if lean_rad < core::f64::consts::FRAC_PI_2 {
            lean_rad.sin()
        } else {
            1.0
        };
        skew.hypot(lean)
    }
}

impl Mechanism {
    /// By how many degrees the direction of the tool turns at most where the rotary axes turn by one together (the root
    /// of their sum of squares), inside their travel: lowest and highest positions, degrees, infinite where there is
    /// no end. 1 where no axis turns the tool.
    #[must_use]
    pub fn direction_gain(&self, lowest: &AxisVector, highest: &AxisVector) -> f64 {
        let ends = |axis: Axis| [lowest[axis.index()], highest[axis.index()]];
        match self {
            Self::FiveAxis(FiveAxis {
                tilt: Tilt::Skewed(skewed),
                ..
            }) => skewed.direction_gain(ends(skewed.axis_letter())),
            Self::Hexapod(_) => {
                let [a, b] = [Axis::A, Axis::B].map(|axis| most_sine(ends(axis)));
                (1.0 + b * b + a * b).sqrt()
            }
            _ => 1.0,
        }
    }
}
