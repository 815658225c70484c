//! The motion from one frame to the next: a polynomial of degree five for every axis.
//!
//! Its coefficients are computed once, when the later of the two frames arrives; an evaluation is
//! then five multiplications and additions an axis.

use crate::real_time::pairs::{self, PAIRS, Pair};
use glidepath_geometry::{AXES, AxisVector};
use glidepath_link::SetpointFrame;

/// Position and its first two derivatives by program time in periods.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kinematic {
    pub(crate) position: AxisVector,
    pub(crate) velocity: AxisVector,
    pub(crate) acceleration: AxisVector,
}

/// Coefficients for a pair of axes, constant term first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coefficients([Pair; 6]);

/// The polynomial in 0 ≤ u ≤ 1 from one frame to the next. The first axes, which every machine has,
/// lie in one cache line and the two after it.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Quintic([Coefficients; PAIRS]);

/// Position, velocity and acceleration of a pair at a frame.
type State = [Pair; 3];

/// Where axes or joints are at a frame, and how they move. Arrays, not slices: with lengths that are
/// known only as it runs, taking the states apart is twice the work of the coefficients.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MotionState<'a> {
    pub(crate) position: &'a [f64; AXES],
    pub(crate) velocity: &'a [f64; AXES],
    pub(crate) acceleration: &'a [f64; AXES],
}

impl MotionState<'_> {
    const fn of(frame: &SetpointFrame) -> MotionState<'_> {
        MotionState {
            position: &frame.position,
            velocity: &frame.velocity,
            acceleration: &frame.acceleration,
        }
    }

    fn pairs(&self) -> impl Iterator<Item = State> {
        pairs::pairs(self.position)
            .zip(pairs::pairs(self.velocity))
            .zip(pairs::pairs(self.acceleration))
            .map(|((position, velocity), acceleration)| [position, velocity, acceleration])
    }
}

impl Quintic {
    pub(crate) const fn zeros() -> Self {
        Self([Coefficients([[0.0; 2]; 6]); PAIRS])
    }

    /// Becomes the one between two frames.
    pub(crate) fn set_between(&mut self, from: &SetpointFrame, to: &SetpointFrame, period_t: f64) {
        self.set(&MotionState::of(from), &MotionState::of(to), period_t);
    }

    /// Becomes the one between two states.
    #[inline]
    pub(crate) fn set(&mut self, from: &MotionState<'_>, to: &MotionState<'_>, period_t: f64) {
        let ends = from.pairs().zip(to.pairs());
        for (pair, (from, to)) in self.0.iter_mut().zip(ends) {
            pair.set_between(from, to, period_t);
        }
    }

    pub(crate) const fn pairs(&self) -> &[Coefficients; PAIRS] {
        &self.0
    }

    pub(crate) fn position(&self, u: f64) -> AxisVector {
        let mut position = [[0.0; 2]; PAIRS];
        for (slot, pair) in position.iter_mut().zip(&self.0) {
            *slot = pair.position(u);
        }
        pairs::axes(&position)
    }

    pub(crate) fn kinematic(&self, u: f64) -> Kinematic {
        let (mut position, mut velocity) = ([[0.0; 2]; PAIRS], [[0.0; 2]; PAIRS]);
        let mut acceleration = [[0.0; 2]; PAIRS];
        let slots = position
            .iter_mut()
            .zip(&mut velocity)
            .zip(&mut acceleration);
        for (((p, v), a), pair) in slots.zip(&self.0) {
            [*p, *v, *a] = pair.kinematic(u);
        }
        Kinematic {
            position: pairs::axes(&position),
            velocity: pairs::axes(&velocity),
            acceleration: pairs::axes(&acceleration),
        }
    }
}

impl Coefficients {
    /// Not in line, so that its code is fetched once for all pairs.
    #[inline(never)]
    fn set_between(&mut self, from: State, to: State, period_t: f64) {
        let (t, tt) = (period_t, period_t * period_t);
        let ([p0, v0, a0], [p1, v1, a1]) = (from, to);
        let [c0, c1, c2, c3, c4, c5] = &mut self.0;
        for i in 0..2 {
            let (v0, v1) = (v0[i] * t, v1[i] * t);
            let (a0, a1) = (a0[i] * tt, a1[i] * tt);
            let step = p1[i] - p0[i];
            c0[i] = p0[i];
            c1[i] = v0;
            c2[i] = a0 * 0.5;
            c3[i] = step * 10.0 - v0 * 6.0 - v1 * 4.0 - a0 * 1.5 + a1 * 0.5;
            c4[i] = step * -15.0 + v0 * 8.0 + v1 * 7.0 + a0 * 1.5 - a1;
            c5[i] = step * 6.0 - (v0 + v1) * 3.0 + (a1 - a0) * 0.5;
        }
    }

    /// Positions.
    pub(crate) fn position(&self, u: f64) -> Pair {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        let next = |value, c| pairs::zip(value, c, |value, c| value * u + c);
        next(next(next(next(next(c5, c4), c3), c2), c1), c0)
    }

    /// Positions, and velocities by program time in periods.
    pub(crate) fn motion(&self, u: f64) -> (Pair, Pair) {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        let next = |value, c| pairs::zip(value, c, |value, c| value * u + c);
        // Horner's scheme for both at once.
        let p4 = next(c5, c4);
        let (v3, p3) = (next(c5, p4), next(p4, c3));
        let (v2, p2) = (next(v3, p3), next(p3, c2));
        let (v1, p1) = (next(v2, p2), next(p2, c1));
        (next(p1, c0), next(v1, p1))
    }

    /// Positions and their first two derivatives. Not in line, like
    /// [`set_between`](Self::set_between).
    #[inline(never)]
    fn kinematic(&self, u: f64) -> [Pair; 3] {
        let [_, c1, c2, c3, c4, c5] = self.0;
        let (mut velocity, mut acceleration) = ([0.0; 2], [0.0; 2]);
        for i in 0..2 {
            velocity[i] = (((c5[i] * (5.0 * u) + c4[i] * 4.0) * u + c3[i] * 3.0) * u + c2[i] * 2.0)
                * u
                + c1[i];
            acceleration[i] =
                ((c5[i] * (20.0 * u) + c4[i] * 12.0) * u + c3[i] * 6.0) * u + c2[i] * 2.0;
        }
        [self.position(u), velocity, acceleration]
    }
}
