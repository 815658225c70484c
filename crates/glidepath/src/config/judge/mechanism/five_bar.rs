//! `[machine.five-bar]`.

use super::ranges::LENGTH;
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::judge::values::Judge;
use crate::config::raw::RawFiveBar;
use glidepath_geometry::Axis;
use glidepath_kinematics::{FiveBar, Mechanism};
use toml::Spanned;

impl Judge {
    pub(super) fn five_bar(&mut self, raw: &Spanned<RawFiveBar>, axes: &[Axis]) -> Mechanism {
        let raw = raw.as_ref();
        let before = self.diagnostics.len();
        let mut length = |name: &str, value: &Spanned<f64>| {
            self.number(&format!("machine.five-bar.{name}"), value, &LENGTH)
        };
        let distance_mm = length("shoulder_distance", &raw.shoulder_distance);
        let upper_arm_mm = length("upper_arm", &raw.upper_arm);
        let forearm_mm = length("forearm", &raw.forearm);
        let reach_mm = upper_arm_mm + forearm_mm;
        if self.diagnostics.len() == before && distance_mm >= 2.0 * reach_mm {
            self.diagnostics.push(ConfigDiagnostic {
                key: "machine.five-bar.shoulder_distance".to_owned(),
                message: format!(
                    "arms of {reach_mm} mm do not meet, with shoulders {distance_mm} mm apart"
                ),
                help: Some("give longer arms, or shoulders nearer to each other".to_owned()),
                span: Some(raw.shoulder_distance.span()),
            });
        }
        Mechanism::FiveBar(FiveBar::new(distance_mm, upper_arm_mm, forearm_mm, axes))
    }
}
