//! The baseline that every window is held against: stopping at every vertex.
//!
//! Legs from vertex to vertex are the baseline: when it is where, is known in closed form. A window
//! is worth as much as the best state in it: from there an S-curve leads straight to rest at the
//! end of the piece, where legs can take over.
//!
//! ```text
//!   gain = time of the baseline at the end of the piece − (time of the state + S-curve from there)
//! ```
//!
//! At the rest of a window this is exact. Before that it is trusted that the windows to come lose
//! no more against the S-curve than [`TRUST_PERIODS`]: along one straight piece there is nothing
//! they could get stuck at.

use super::stop_leg::StopLeg;
use crate::in_tube::path::{Bounds, ReferencePath, TubePiece, directional, top_v};
use crate::in_tube::period::State;
use crate::scurve::Profile;
use glidepath_geometry::feed_length;
use glidepath_program::Limits;
use std::collections::VecDeque;

/// What a motion on knots may lose against an S-curve to the same rest, periods.
pub(crate) const TRUST_PERIODS: f64 = 1.0;
/// Share of a velocity that may point elsewhere than to the end of the piece.
const ASIDE: f64 = 0.02;

/// When legs from vertex to vertex are at the end of which piece, s from the start of the stretch.
#[derive(Debug, Clone)]
pub(crate) struct Baseline {
    first: usize,
    ends_t: VecDeque<f64>,
}

impl Baseline {
    /// A baseline that is at the end of a piece at some time.
    pub(crate) fn new(piece: usize, end_t: f64) -> Self {
        Self {
            first: piece,
            ends_t: VecDeque::from([end_t]),
        }
    }

    /// When it is at the end of piece `index`; `None` if that is not known, or no more.
    pub(crate) fn end_t(
        &mut self,
        limits: &Limits,
        reference_path: &ReferencePath,
        index: usize,
    ) -> Option<f64> {
        while self.first + self.ends_t.len() <= index {
            let next = self.first + self.ends_t.len();
            let piece = reference_path.get(next)?;
            let leg = StopLeg::new(limits, piece.start, next, piece);
            let leg_t = leg.map_or(0.0, |leg| leg.duration_t());
            self.ends_t.push_back(self.ends_t.back()? + leg_t);
        }
        self.ends_t.get(index.checked_sub(self.first)?).copied()
    }

    /// Drops what lies before a piece.
    pub(crate) fn forget_before(&mut self, index: usize) {
        while self.first < index && self.ends_t.len() > 1 {
            self.ends_t.pop_front();
            self.first += 1;
        }
    }
}

/// How long a state takes straight to rest at the end of a piece, s; `None` if it does not point
/// there or cannot stop before.
pub(crate) fn arrival_t(limits: &Limits, piece: &TubePiece, state: &State) -> Option<f64> {
    let State {
        position,
        velocity,
        acceleration,
    } = state;
    let displacement = piece.end - position;
    let rest_s = feed_length(&displacement);
    if rest_s <= 0.0 {
        return (velocity.amax() <= 0.0).then_some(0.0);
    }
    let along = displacement / rest_s;
    let unit_2 = along.norm_squared();
    let speed_v = velocity.dot(&along) / unit_2;
    let aside = velocity - along * speed_v;
    if speed_v < 0.0 || aside.norm_squared() > ASIDE * ASIDE * velocity.norm_squared() {
        return None;
    }
    let Bounds {
        speed_v: axes_v,
        path,
    } = directional(limits, &along);
    // First the acceleration goes to zero.
    let accel_a = (acceleration.dot(&along) / unit_2).clamp(-path.accel_a, path.accel_a);
    let easing_t = accel_a.abs() / path.jerk_j;
    let eased_v = speed_v + 0.5 * accel_a * easing_t;
    let eased_s = easing_t * (speed_v + accel_a * easing_t / 3.0);
    if eased_v < 0.0 || eased_s > rest_s {
        return None;
    }
    let top_v = top_v(piece, &displacement, rest_s).min(axes_v).max(eased_v);
    let profile = Profile::new(eased_v, 0.0, rest_s - eased_s, top_v, path)?;
    Some(easing_t + profile.duration_t())
}
