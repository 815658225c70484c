//! `[machine.hexapod]` and `[machine.translational-hexapod]`.

use super::ranges::{ANGLE, LENGTH, OFFSET};
use crate::config::judge::values::{Judge, Range};
use crate::config::raw::{RawHexapod, RawTranslational};
use glidepath_kinematics::{Guards, Hexapod, Mechanism, TranslationalHexapod};
use toml::Spanned;

impl Judge {
    pub(super) fn hexapod(&mut self, raw: &Spanned<RawHexapod>) -> Mechanism {
        let raw = raw.as_ref();
        let key = |name: &str| format!("machine.hexapod.{name}");
        let base = self.number(&key("base_radius"), &raw.base_radius, &LENGTH);
        let platform = self.number(&key("platform_radius"), &raw.platform_radius, &LENGTH);
        let half_angle = Range {
            min: 0.5,
            max: 29.0,
            unit: "°",
            help: "half the angle of a pair of joints; at 30° the struts leave the platform free",
        };
        let half_angle = self.number(&key("half_angle"), &raw.half_angle, &half_angle);
        let base_z = self.number_or(&key("base_z"), &raw.base_z, &OFFSET, 0.0);
        let mut hexapod = Hexapod::paired(base, platform, half_angle);
        for joint in &mut hexapod.base {
            joint.z = base_z;
        }
        hexapod.tool = self
            .three(&key("tool"), &raw.tool, &OFFSET, [0.0; 3])
            .into();
        let free = Guards::NONE;
        hexapod.guards = Guards {
            max_base_angle_deg: self.number_or(
                &key("max_base_angle"),
                &raw.max_base_angle,
                &ANGLE,
                free.max_base_angle_deg,
            ),
            max_platform_angle_deg: self.number_or(
                &key("max_platform_angle"),
                &raw.max_platform_angle,
                &ANGLE,
                free.max_platform_angle_deg,
            ),
            min_strut_distance_mm: self.number_or(
                &key("min_strut_distance"),
                &raw.min_strut_distance,
                &LENGTH,
                free.min_strut_distance_mm,
            ),
        };
        Mechanism::Hexapod(hexapod)
    }

    pub(super) fn translational(&mut self, raw: &Spanned<RawTranslational>) -> Mechanism {
        let raw = raw.as_ref();
        let key = |name: &str| format!("machine.translational-hexapod.{name}");
        let difference = key("radius_difference");
        Mechanism::Translational(TranslationalHexapod {
            radius_difference_mm: self.number(&difference, &raw.radius_difference, &LENGTH),
            base_z_mm: self.number_or(&key("base_z"), &raw.base_z, &OFFSET, 0.0),
        })
    }
}
