//! The motion between two periods, as it is when time runs slower.
//!
//! At 100 % the positions at the periods are all there is. Under an override, in a hold, the motion
//! between two of them is the quintic polynomial through both states, and it bulges out of the
//! chord:
//!
//! ```text
//!        bulge ╭──·──╮      by about a·T²/8 in the middle; in n parts, by 1/n² of that
//!             ╱       ╲
//!            ●─────────●
//! ```
//!
//! And when it has run slower for a while, periods end elsewhere: then chords cut off what the
//! motion bulges out, and the vertices must be nearer to it by that.

use crate::in_tube::path::TubePiece;
use crate::in_tube::period::State;
use glidepath_geometry::AxisVector;

/// What the motion may bulge out of the chords of the parts, in tolerances.
const BULGE_R: f64 = 1e-3;
/// Cosine of the turn within a period up to which what is along the chord does not matter.
const STRAIGHT: f64 = 0.8;
/// Most parts of a period.
const MOST_PARTS: f64 = 16.0;

/// The motion of a period.
#[derive(Debug)]
pub(crate) struct BetweenPeriods<'a> {
    pub(crate) from: &'a State,
    pub(crate) to: &'a State,
    pub(crate) period_t: f64,
}

impl BetweenPeriods<'_> {
    /// What a chord of one period is off the motion in its middle, a·T²/8, at both ends; across the
    /// chord, if the motion hardly turns.
    pub(crate) fn sagittas(&self) -> [AxisVector; 2] {
        let part = self.period_t * self.period_t / 8.0;
        let [before, after] = [self.from, self.to].map(|state| state.velocity);
        // From or to a rest it does not turn.
        let is_straight = before.dot(&after) >= STRAIGHT * before.norm() * after.norm();
        [self.from, self.to].map(|state| {
            let sagitta = state.acceleration * part;
            if is_straight {
                self.across(&sagitta)
            } else {
                sagitta
            }
        })
    }

    /// The part of a vector across the chord.
    fn across(&self, vector: &AxisVector) -> AxisVector {
        let chord = self.to.position - self.from.position;
        let along = vector.dot(&chord) / chord.norm_squared();
        if along.is_finite() {
            vector - chord * along
        } else {
            *vector
        }
    }

    /// Points after the first, near enough to each other that the motion is hardly off their chords
    /// in the tolerance of a piece.
    pub(crate) fn points(&self, piece: &TubePiece) -> impl Iterator<Item = AxisVector> {
        let (from, to, t) = (self.from, self.to, self.period_t);
        let bulge = self.across(
            &((from.velocity - to.velocity) * (t * 5.0 / 32.0)
                + (from.acceleration + to.acceleration) * (t * t / 64.0)),
        );
        let parts = (piece.distance_r(&bulge) / BULGE_R)
            .sqrt()
            .ceil()
            .clamp(1.0, MOST_PARTS);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped"
        )]
        let count = parts as u32;
        (1..=count).map(move |k| {
            if k == count {
                to.position
            } else {
                self.at(f64::from(k) / parts)
            }
        })
    }

    /// The Bézier points of an axis.
    pub(crate) fn bezier(&self, axis: usize) -> [f64; 6] {
        let t = self.period_t;
        let of = |state: &State| {
            (
                state.position[axis],
                state.velocity[axis] * (t / 5.0),
                state.acceleration[axis] * (t * t / 20.0),
            )
        };
        let ((p0, v0, a0), (p1, v1, a1)) = (of(self.from), of(self.to));
        [
            p0,
            p0 + v0,
            p0 + 2.0 * v0 + a0,
            p1 - 2.0 * v1 + a1,
            p1 - v1,
            p1,
        ]
    }

    /// The position at a part of the period.
    pub(crate) fn at(&self, u: f64) -> AxisVector {
        let (from, to, t) = (self.from, self.to, self.period_t);
        let (u_2, u_3) = (u * u, u * u * u);
        let end = u_3 * (10.0 - 15.0 * u + 6.0 * u_2);
        let start_v = u - u_3 * (6.0 - 8.0 * u + 3.0 * u_2);
        let start_a = 0.5 * u_2 - u_3 * (1.5 - 1.5 * u + 0.5 * u_2);
        let end_v = -u_3 * (4.0 - 7.0 * u + 3.0 * u_2);
        let end_a = u_3 * (0.5 - u + 0.5 * u_2);
        from.position
            + (to.position - from.position) * end
            + (from.velocity * start_v + to.velocity * end_v) * t
            + (from.acceleration * start_a + to.acceleration * end_a) * (t * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_of_constant_jerk_is_its_own_quintic() {
        let at = |t: f64| {
            let mut state = State::rest(AxisVector::zeros());
            (state.position[0], state.position[1]) =
                (2.0 * t, 1.0 + t + 3.0 * t * t - 5.0 * t * t * t);
            (state.velocity[0], state.velocity[1]) = (2.0, 1.0 + 6.0 * t - 15.0 * t * t);
            state.acceleration[1] = 6.0 - 30.0 * t;
            state
        };
        let (from, to) = (at(0.0), at(0.5));
        let bend = BetweenPeriods {
            from: &from,
            to: &to,
            period_t: 0.5,
        };
        for k in 0..=10 {
            let u = f64::from(k) / 10.0;
            assert!((bend.at(u) - at(0.5 * u).position).amax() < 1e-12, "{u}");
            let mut points = bend.bezier(1);
            for degree in (1..points.len()).rev() {
                for i in 0..degree {
                    points[i] += u * (points[i + 1] - points[i]);
                }
            }
            assert!((points[0] - bend.at(u)[1]).abs() < 1e-12, "{u}");
        }
    }
}
