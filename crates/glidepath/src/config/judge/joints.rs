//! `[joint.J0]`: limits of the joints.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawJoint};
use glidepath_kinematics::{JointLimit, JointLimits, Kinematics as _, Mechanism};
use std::collections::BTreeMap;
use toml::Spanned;

impl Judge {
    /// The limits of every joint; each must have a table, unless joints are axes.
    pub(super) fn joints(
        &mut self,
        raw: &BTreeMap<Spanned<String>, Spanned<RawJoint>>,
        mechanism: &Mechanism,
    ) -> JointLimits {
        let mut limits = JointLimits::NONE;
        let count = match mechanism {
            Mechanism::Trivial(_) => 0,
            other => other.joints(),
        };
        let names: Vec<String> = (0..count).map(|joint| format!("J{joint}")).collect();
        for name in raw.keys().filter(|name| !names.contains(name.as_ref())) {
            let help = match names.last() {
                Some(last) => format!("the joints are J0 to {last}"),
                None => "the limits of its axes are those of its joints".to_owned(),
            };
            self.diagnostics.push(ConfigDiagnostic {
                key: format!("joint.{}", name.as_ref()),
                message: format!("the machine has no joint {} of its own", name.as_ref()),
                help: Some(help),
                span: Some(name.span()),
            });
        }
        for (limit, name) in limits.0.iter_mut().zip(&names) {
            let found = raw.iter().find(|(known, _)| known.as_ref() == name);
            match found {
                Some((_, raw)) => *limit = self.joint(name, raw.as_ref()),
                None => self.diagnostics.push(ConfigDiagnostic {
                    key: format!("joint.{name}"),
                    message: format!("the table [joint.{name}] is missing"),
                    help: Some("give every joint its limits".to_owned()),
                    span: None,
                }),
            }
        }
        limits
    }

    fn joint(&mut self, name: &str, raw: &RawJoint) -> JointLimit {
        let mut limit = |key: &str, value: &Spanned<f64>, unit: &'static str, max: f64| {
            let range = Range {
                min: 1e-3,
                max,
                unit,
                help: "a limit of the drive",
            };
            self.number(&format!("joint.{name}.{key}"), value, &range)
        };
        let velocity = limit("max_velocity", &raw.max_velocity, "mm/s or °/s", 1e5);
        let acceleration = limit(
            "max_acceleration",
            &raw.max_acceleration,
            "mm/s² or °/s²",
            1e7,
        );
        let jerk = limit("max_jerk", &raw.max_jerk, "mm/s³ or °/s³", 1e10);
        let range = Range {
            min: -1e6,
            max: 1e6,
            unit: "mm or °",
            help: "the end of the joint's range",
        };
        let mut end = |key: &str, value: &Optional<f64>, none: f64| {
            self.number_or(&format!("joint.{name}.{key}"), value, &range, none)
        };
        JointLimit {
            min_position: end("min_position", &raw.min_position, f64::NEG_INFINITY),
            max_position: end("max_position", &raw.max_position, f64::INFINITY),
            velocity,
            acceleration,
            jerk,
        }
    }
}
