//! `[spindle]`: whether its angle is known, and how it taps.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::RawSpindle;
use crate::config::spindle::SpindleConfig;

impl Judge {
    /// The spindle, if programs may follow its angle. `is_axes`: the joints are the axes.
    pub(super) fn spindle(&mut self, raw: &RawSpindle, is_axes: bool) -> Option<SpindleConfig> {
        let range = Range {
            min: 0.1,
            max: 10_000.0,
            unit: "rev/s²",
            help: "the speed of the spindle, in rev/s, over the time it takes to stop",
        };
        let acceleration = raw
            .acceleration
            .as_ref()
            .map(|value| self.number("spindle.acceleration", value, &range));
        let rigid_tapping = raw.rigid_tapping.as_ref().filter(|taps| *taps.get_ref());
        let encoder = raw.encoder.as_ref().filter(|encoder| *encoder.get_ref());
        let Some(encoder) = encoder else {
            if let Some(taps) = rigid_tapping {
                self.diagnostics.push(ConfigDiagnostic {
                    key: "spindle.rigid_tapping".to_owned(),
                    message: "a rigid tap follows the spindle, whose angle nobody tells".to_owned(),
                    help: Some("set spindle.encoder = true, or leave it out".to_owned()),
                    span: Some(taps.span()),
                });
            }
            return None;
        };
        if !is_axes {
            self.diagnostics.push(ConfigDiagnostic {
                key: "spindle.encoder".to_owned(),
                message: "threads are cut only where every joint is an axis".to_owned(),
                help: Some("leave it out, or set machine.kinematics = \"trivial\"".to_owned()),
                span: Some(encoder.span()),
            });
        }
        Some(SpindleConfig {
            rigid_tapping: rigid_tapping.is_some(),
            acceleration,
        })
    }
}
