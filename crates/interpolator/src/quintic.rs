//! The motion from one frame to the next: a polynomial of degree five for every axis.
//!
//! Its coefficients are computed once, when the later of the two frames arrives; an evaluation is then
//! five multiplications and additions an axis.

use glidepath_geometry::{AXES, AxisVector};
use glidepath_link::SetpointFrame;

/// Position and its first two derivatives by program time in periods.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kinematic {
    pub(crate) position: AxisVector,
    pub(crate) velocity: AxisVector,
    pub(crate) acceleration: AxisVector,
}

/// Coefficients of the polynomial in 0 ≤ u ≤ 1 from one frame to the next, constant term first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Quintic([AxisVector; 6]);

impl Quintic {
    pub(crate) fn zeros() -> Self {
        Self([AxisVector::zeros(); 6])
    }

    pub(crate) fn between(from: &SetpointFrame, to: &SetpointFrame, period_t: f64) -> Self {
        let (p0, p1) = (
            AxisVector::from(from.position),
            AxisVector::from(to.position),
        );
        let (v0, v1) = (
            AxisVector::from(from.velocity),
            AxisVector::from(to.velocity),
        );
        let (a0, a1) = (
            AxisVector::from(from.acceleration),
            AxisVector::from(to.acceleration),
        );
        let (v0, v1) = (v0 * period_t, v1 * period_t);
        let (a0, a1) = (a0 * (period_t * period_t), a1 * (period_t * period_t));
        let step = p1 - p0;
        Self([
            p0,
            v0,
            a0 * 0.5,
            step * 10.0 - v0 * 6.0 - v1 * 4.0 - a0 * 1.5 + a1 * 0.5,
            step * -15.0 + v0 * 8.0 + v1 * 7.0 + a0 * 1.5 - a1,
            step * 6.0 - (v0 + v1) * 3.0 + (a1 - a0) * 0.5,
        ])
    }

    /// Written as a loop over plain arrays: this is most of the work of a tick.
    #[allow(clippy::indexing_slicing, reason = "the index runs over the axes")]
    pub(crate) fn position(&self, u: f64) -> AxisVector {
        let [c0, c1, c2, c3, c4, c5] = &self.0;
        let mut position = [0.0; AXES];
        for i in 0..AXES {
            position[i] = ((((c5[i] * u + c4[i]) * u + c3[i]) * u + c2[i]) * u + c1[i]) * u + c0[i];
        }
        AxisVector::from(position)
    }

    /// Position, and velocity by program time in periods.
    #[allow(clippy::indexing_slicing, reason = "the index runs over the axes")]
    pub(crate) fn motion(&self, u: f64) -> (AxisVector, AxisVector) {
        let [c0, c1, c2, c3, c4, c5] = &self.0;
        let (mut position, mut velocity) = ([0.0; AXES], [0.0; AXES]);
        for i in 0..AXES {
            // Horner's scheme for both at once.
            let p4 = c5[i] * u + c4[i];
            let (v3, p3) = (c5[i] * u + p4, p4 * u + c3[i]);
            let (v2, p2) = (v3 * u + p3, p3 * u + c2[i]);
            let (v1, p1) = (v2 * u + p2, p2 * u + c1[i]);
            velocity[i] = v1 * u + p1;
            position[i] = p1 * u + c0[i];
        }
        (AxisVector::from(position), AxisVector::from(velocity))
    }

    pub(crate) fn kinematic(&self, u: f64) -> Kinematic {
        let [_, c1, c2, c3, c4, c5] = &self.0;
        Kinematic {
            position: self.position(u),
            velocity: (((c5 * (5.0 * u) + c4 * 4.0) * u + c3 * 3.0) * u + c2 * 2.0) * u + c1,
            acceleration: ((c5 * (20.0 * u) + c4 * 12.0) * u + c3 * 6.0) * u + c2 * 2.0,
        }
    }
}
