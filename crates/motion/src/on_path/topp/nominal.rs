//! Path position by nominal time: the time of the S-curves, as what a parametrisation is sought over.
//!
//! From a rest at constant jerk, b = v² ~ s^(4/3) has a second derivative beyond all bounds, which no parabola
//! follows. The S-curves s = S(τ) come to rest as the motion does. So where joints are not axes, b is the
//! square of dτ/dt, the rate at which the motion goes through the time τ of the S-curves. It is 1 on these, next
//! to a rest too, where any constant rate r has a jerk of r³ times theirs. The path has derivatives by τ then,
//! those of s(τ) by the chain rule, and the problem is the same.

use super::interval::BETWEEN_R;
use super::parametrisation::Parametrisation;
use crate::on_path::speed::Leg;
use crate::scurve::PathState;
use glidepath_geometry::Jet;

/// Times that differ by less are the same, s.
const ROUNDING_T: f64 = 1e-9;

/// The motion by S-curves, which nominal time is that of.
#[derive(Debug)]
pub(super) struct Nominal {
    motion: Parametrisation,
}

/// Path position and its derivatives by nominal time.
#[derive(Debug, Clone, Copy)]
pub(super) struct NominalPlace {
    pub(super) state: PathState,
    jerk_j: f64,
}

impl Nominal {
    pub(super) fn new(legs: &[Leg]) -> Option<Self> {
        let motion = Parametrisation::slowed(legs, 1.0)?;
        (motion.duration_t() > 0.0).then_some(Self { motion })
    }

    pub(super) const fn duration_t(&self) -> f64 {
        self.motion.duration_t()
    }

    /// That motion.
    pub(super) fn motion(&self) -> Parametrisation {
        self.motion.clone()
    }

    /// The phase of constant jerk at a time.
    pub(super) fn phase_at(&self, time_t: f64) -> usize {
        let passed = self.motion.phases.partition_point(|p| p.from_t <= time_t);
        passed.saturating_sub(1)
    }

    /// The S-curves at a time, of which a phase is given: at its ends jerk is the one on it.
    pub(super) fn place(&self, phase: usize, time_t: f64) -> NominalPlace {
        let phase = &self.motion.phases[phase];
        NominalPlace {
            state: phase.at(time_t - phase.from_t),
            jerk_j: phase.jerk_j,
        }
    }

    /// Times of knots: where phases meet and where pieces do, and others `knot_t` apart at most.
    pub(super) fn knots(&self, legs: &[Leg], junctions_s: &[f64], knot_t: f64) -> Vec<f64> {
        let duration_t = self.duration_t();
        let mut given: Vec<f64> = self.motion.phases.iter().map(|p| p.from_t).collect();
        let mut legs_t = Vec::with_capacity(legs.len());
        let mut from_t = 0.0;
        for leg in legs {
            legs_t.push(from_t);
            from_t += leg.profile.duration_t();
        }
        let time_at = |s: f64| {
            let own = legs.partition_point(|leg| leg.from_s <= s).checked_sub(1)?;
            Some(legs_t[own] + legs[own].profile.time_at(s - legs[own].from_s))
        };
        given.extend(junctions_s.iter().filter_map(|s| time_at(*s)));
        given.push(duration_t);
        given.sort_by(f64::total_cmp);
        let mut knots = vec![0.0];
        let mut from_t = 0.0;
        for to_t in given {
            let gap_t = to_t - from_t;
            let is_last = duration_t - to_t <= ROUNDING_T;
            if gap_t <= ROUNDING_T || (is_last && to_t < duration_t) {
                continue;
            }
            let steps = (gap_t / knot_t).ceil();
            let mut k = 1.0;
            while k < steps {
                knots.push(from_t + gap_t * k / steps);
                k += 1.0;
            }
            knots.push(to_t);
            from_t = to_t;
        }
        knots
    }
}

impl NominalPlace {
    /// Derivatives by nominal time, from those by path position.
    pub(super) fn jet(&self, path: &Jet) -> Jet {
        let PathState {
            speed_v: v,
            accel_a: a,
            ..
        } = self.state;
        Jet {
            position: path.position,
            d1: path.d1 * v,
            d2: path.d2 * (v * v) + path.d1 * a,
            d3: path.d3 * (v * v * v) + path.d2 * (3.0 * v * a) + path.d1 * self.jerk_j,
        }
    }

    /// The rate at which the motion has a speed by path position there. Where the S-curves change theirs, the rates
    /// of a top speed are no parabola: a bit less, for what is between knots.
    pub(super) fn rate(&self, speed_v: f64) -> f64 {
        let is_steady = self.state.accel_a.abs() <= 0.0 && self.jerk_j.abs() <= 0.0;
        let between_r = if is_steady { 1.0 } else { BETWEEN_R };
        between_r * speed_v / self.state.speed_v
    }

    /// The same of path position itself, first to third.
    pub(super) const fn derivatives(&self) -> [f64; 3] {
        [self.state.speed_v, self.state.accel_a, self.jerk_j]
    }
}
