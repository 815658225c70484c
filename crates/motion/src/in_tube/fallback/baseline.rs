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
use crate::joints::JointRows;
use crate::scurve::{PathLimits, Profile};
use glidepath_geometry::feed_length;
use glidepath_program::Limits;
use std::collections::VecDeque;

/// What a motion on knots may lose against an S-curve to the same rest, periods.
pub(crate) const TRUST_PERIODS: f64 = 1.0;
/// Share of a velocity that may point elsewhere than to the end of the piece. No measurement of it is kept.
const ASIDE: f64 = 0.02;
/// By what share rounding may make a phase shorter.
const ROUNDING: f64 = 1e-9;

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
        machine: (&Limits, Option<&JointRows>),
        reference_path: &ReferencePath,
        index: usize,
    ) -> Option<f64> {
        while self.first + self.ends_t.len() <= index {
            let next = self.first + self.ends_t.len();
            let piece = reference_path.get(next)?;
            let leg = StopLeg::new(machine, piece.start, next, piece);
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
    } = piece.within_joints(directional(limits, &along), 1.0);
    let accel_a = (acceleration.dot(&along) / unit_2).clamp(-path.accel_a, path.accel_a);
    let top_v = top_v(piece, &displacement, rest_s).min(axes_v);
    rising_on(&path, top_v, (rest_s, speed_v, accel_a))
        .or_else(|| easing_first(&path, top_v, (rest_s, speed_v, accel_a)))
}

/// How long it takes to rest `rest_s` ahead if the acceleration, which rises, goes on to: then the state
/// is one on an S-curve that began a little before. `None` if it is on none.
fn rising_on(
    path: &PathLimits,
    top_v: f64,
    (rest_s, speed_v, accel_a): (f64, f64, f64),
) -> Option<f64> {
    let rising_t = accel_a / path.jerk_j;
    let entry_v = speed_v - 0.5 * accel_a * rising_t;
    if rising_t <= 0.0 || entry_v < 0.0 || entry_v > top_v {
        return None;
    }
    let risen_s = rising_t * (speed_v - accel_a * rising_t / 3.0);
    let profile = Profile::new(entry_v, 0.0, risen_s + rest_s, top_v, *path)?;
    let [rises_t, ..] = profile.phase_durations_t();
    (rises_t >= (1.0 - ROUNDING) * rising_t).then(|| profile.duration_t() - rising_t)
}

/// The same if the acceleration goes to zero first.
fn easing_first(
    path: &PathLimits,
    top_v: f64,
    (rest_s, speed_v, accel_a): (f64, f64, f64),
) -> Option<f64> {
    let easing_t = accel_a.abs() / path.jerk_j;
    let eased_v = speed_v + 0.5 * accel_a * easing_t;
    let eased_s = easing_t * (speed_v + accel_a * easing_t / 3.0);
    if eased_v < 0.0 || eased_s > rest_s {
        return None;
    }
    let profile = Profile::new(eased_v, 0.0, rest_s - eased_s, top_v.max(eased_v), *path)?;
    Some(easing_t + profile.duration_t())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::expect_used, reason = "a test")]

    use super::*;
    use crate::in_tube::path::Reference;
    use crate::programmed_rate::PieceRate;
    use glidepath_geometry::AxisVector;

    #[test]
    fn a_state_that_still_speeds_up_has_the_rest_of_its_leg_before_it() {
        let limits = Limits::uniform(200.0, 2000.0, 40_000.0);
        let mut end = AxisVector::zeros();
        end[0] = 30.0;
        let mut path = ReferencePath::new(AxisVector::zeros());
        path.push(Reference {
            end,
            rate: PieceRate::by_feed(200.0),
            tolerance_mm: 0.02,
            tolerance_deg: 0.02,
            sagitta_vector: AxisVector::zeros(),
            straight: None,
            beyond_mm: 0.0,
            is_rapid: false,
            tag: 0,
        });
        path.finish();
        let piece = path.get(0).expect("a piece");
        let leg = StopLeg::new((&limits, None), piece.start, 0, piece).expect("a leg");
        // Rising, constant and, by then, falling acceleration.
        for t in [0.01, 0.045, 0.06, 0.08, 0.12] {
            let state = leg.at(t);
            let state = State {
                position: state.position,
                velocity: state.velocity,
                acceleration: state.acceleration,
            };
            let rest_t = leg.duration_t() - t;
            let arrival_t = arrival_t(&limits, piece, &state).expect("it can stop");
            assert!(arrival_t >= rest_t - 1e-9, "{t}: {arrival_t}, {rest_t}");
            if t < 0.1 {
                assert!(arrival_t <= rest_t + 1e-9, "{t}: {arrival_t}, {rest_t}");
            }
        }
    }
}
