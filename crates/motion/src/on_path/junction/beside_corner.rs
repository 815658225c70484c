//! The straight motion beside a corner: what limits it, and whether it goes on as if there were none.

use crate::joints::JointRows;
use crate::on_path::pieces::{JointRule, SpeedLimit, straight_limit};
use glidepath_geometry::{AXES, AxisVector, Jet};
use glidepath_program::{Limits, Settings, tolerance_norm};

/// What limits straight motion beside a corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct BesideCorner<'a> {
    pub(super) corner: AxisVector,
    pub(super) settings: &'a Settings,
    pub(super) joints: Option<&'a JointRows>,
}

impl BesideCorner<'_> {
    /// The speed limit in a direction.
    pub(super) fn limit(&self, tangent: &AxisVector, rate_v: f64) -> SpeedLimit {
        let of_axes = straight_limit(tangent, rate_v, &self.settings.limits);
        let of_place = |joints| JointRule::of_place(joints, self.corner, tangent);
        match self.joints.and_then(of_place) {
            Some(joints) => joints.within(of_axes),
            None => of_axes,
        }
    }

    /// The same as [`continues`] of joints.
    pub(super) fn joints_continue(&self, jets: [&Jet; 2], rate_v: f64) -> bool {
        let Some(rows) = self.joints else {
            return true;
        };
        let [Some(before), Some(after)] = jets.map(|jet| rows.along(jet)) else {
            return true;
        };
        let top_v = self.limit(&jets[0].d1, rate_v).top_v;
        let steps = [after.d1 - before.d1, after.d2 - before.d2];
        are_rounding(steps, top_v, &rows.limits, self.settings.period_t)
    }

    /// How far from the corner the chord of one period can pass if the machine rests there between two
    /// setpoints: half a period before or after the rest it is at most J·(T/2)³/6 away.
    pub(super) fn cut_by_chord_mm(&self, tangents: [&AxisVector; 2], mm_per_deg: f64) -> f64 {
        tangents
            .map(|tangent| {
                let limit = self.limit(tangent, f64::INFINITY);
                let jerk_j = limit.change.jerk_j;
                let period_t = self.settings.period_t;
                tolerance_norm(tangent, mm_per_deg) * jerk_j * period_t.powi(3) / 48.0
            })
            .into_iter()
            .fold(0.0, f64::max)
    }
}

/// True if passing from one derivative to the other at the full rate is no more than rounding: the
/// steps of velocity and acceleration it makes are below what the jerk limit resolves.
pub(super) fn continues(
    step_d1: &AxisVector,
    step_d2: &AxisVector,
    d1: &AxisVector,
    rate_v: f64,
    settings: &Settings,
) -> bool {
    let Settings {
        limits, period_t, ..
    } = settings;
    let v = straight_limit(d1, rate_v, limits).top_v;
    are_rounding([*step_d1, *step_d2], v, limits, *period_t)
}

/// Whether steps of both derivatives, passed at a speed, are no more than rounding.
fn are_rounding(
    [step_d1, step_d2]: [AxisVector; 2],
    v: f64,
    limits: &Limits,
    period_t: f64,
) -> bool {
    (0..AXES).all(|i| {
        let velocity_step_v = step_d1[i].abs() * v;
        let acceleration_step_a = step_d2[i].abs() * v * v;
        velocity_step_v / (period_t * period_t) + acceleration_step_a / period_t
            <= 1e-7 * limits.jerk[i]
    })
}
