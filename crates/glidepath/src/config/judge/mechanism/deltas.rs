//! `[machine.linear-delta]` and `[machine.rotary-delta]`.

use super::ranges::{DIRECTION, LENGTH};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::judge::values::Judge;
use crate::config::raw::{RawLinearDelta, RawRotaryDelta};
use glidepath_geometry::Axis;
use glidepath_kinematics::{LinearDelta, Mechanism, RotaryDelta};
use toml::Spanned;

/// Where towers and arms stand unless the file says otherwise, degrees.
const THIRDS_DEG: [f64; 3] = [90.0, 210.0, 330.0];
/// Least angle between two arms of a rotary delta, degrees.
const LEAST_APART_DEG: f64 = 10.0;

impl Judge {
    pub(super) fn linear_delta(
        &mut self,
        raw: &Spanned<RawLinearDelta>,
        axes: &[Axis],
    ) -> Mechanism {
        let raw = raw.as_ref();
        let rod = self.number("machine.linear-delta.rod", &raw.rod, &LENGTH);
        let radius = self.number("machine.linear-delta.radius", &raw.radius, &LENGTH);
        let towers = self.three(
            "machine.linear-delta.tower_angles",
            &raw.tower_angles,
            &DIRECTION,
            THIRDS_DEG,
        );
        Mechanism::LinearDelta(LinearDelta::new(rod, radius, towers, axes))
    }

    pub(super) fn rotary_delta(&mut self, raw: &Spanned<RawRotaryDelta>) -> Mechanism {
        let raw = raw.as_ref();
        let before = self.diagnostics.len();
        let mut length = |name: &str, value: &Spanned<f64>| {
            self.number(&format!("machine.rotary-delta.{name}"), value, &LENGTH)
        };
        let delta = RotaryDelta {
            base_radius_mm: length("base_radius", &raw.base_radius),
            platform_radius_mm: length("platform_radius", &raw.platform_radius),
            upper_arm_mm: length("upper_arm", &raw.upper_arm),
            forearm_mm: length("forearm", &raw.forearm),
            arm_deg: self.three(
                "machine.rotary-delta.arm_angles",
                &raw.arm_angles,
                &DIRECTION,
                THIRDS_DEG,
            ),
        };
        // What is said of numbers together would be said of others than those in the file, if one
        // of them is in no range.
        if self.diagnostics.len() == before {
            self.reach_of_arms(&delta, raw);
            if let Some(angles) = &raw.arm_angles {
                self.directions_of_arms(&delta.arm_deg, angles);
            }
        }
        Mechanism::RotaryDelta(delta)
    }

    /// Whether arms and forearms are long enough to meet at the platform at all.
    fn reach_of_arms(&mut self, delta: &RotaryDelta, raw: &RawRotaryDelta) {
        let gap_mm = (delta.base_radius_mm - delta.platform_radius_mm).abs();
        let (upper_arm_mm, forearm_mm) = (delta.upper_arm_mm, delta.forearm_mm);
        if gap_mm >= upper_arm_mm + forearm_mm {
            self.diagnostics.push(ConfigDiagnostic {
                key: "machine.rotary-delta.forearm".to_owned(),
                message: format!(
                    "upper_arm = {upper_arm_mm} mm and forearm = {forearm_mm} mm together are too \
                     short for platform and base, whose radii differ by {gap_mm} mm"
                ),
                help: Some("give longer arms, or radii that differ less".to_owned()),
                span: Some(raw.forearm.span()),
            });
        }
    }

    /// Whether the arms point in three directions: two arms side by side do not hold the platform.
    fn directions_of_arms(&mut self, arm_deg: &[f64; 3], angles: &Spanned<[f64; 3]>) {
        let [a, b, c] = *arm_deg;
        let apart_deg = |a: f64, b: f64| {
            let turn = (a - b).rem_euclid(360.0);
            turn.min(360.0 - turn)
        };
        let is_apart = |(a, b)| apart_deg(a, b) >= LEAST_APART_DEG;
        if ![(a, b), (b, c), (c, a)].into_iter().all(is_apart) {
            self.diagnostics.push(ConfigDiagnostic {
                key: "machine.rotary-delta.arm_angles".to_owned(),
                message: format!(
                    "machine.rotary-delta.arm_angles = [{a}, {b}, {c}] ° are not three directions"
                ),
                help: Some(format!(
                    "give three angles from +X that are at least {LEAST_APART_DEG} ° apart, such as \
                     [90, 210, 330]"
                )),
                span: Some(angles.span()),
            });
        }
    }
}
