//! `[axis.X]`: limits and travel of an axis.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::machine::AxisConfig;
use crate::config::raw::{Optional, RawAxis};
use glidepath_geometry::Axis;
use toml::Spanned;

impl Judge {
    pub(super) fn axis(&mut self, axis: Axis, raw: &Spanned<RawAxis>) -> AxisConfig {
        let table = raw.as_ref();
        let unit = Units::of(axis);
        let mut limit = |name: &str, value: &Spanned<f64>, unit: &'static str, max: f64| {
            let help = "a limit of the drive, in any direction of motion";
            self.number(
                &format!("axis.{axis}.{name}"),
                value,
                &Range {
                    min: 1e-3,
                    max,
                    unit,
                    help,
                },
            )
        };
        let max_velocity = limit("max_velocity", &table.max_velocity, unit.velocity, 1e5);
        let max_acceleration = limit(
            "max_acceleration",
            &table.max_acceleration,
            unit.acceleration,
            1e7,
        );
        let max_jerk = limit("max_jerk", &table.max_jerk, unit.jerk, 1e10);
        let travel = self.travel(axis, raw);
        AxisConfig {
            axis,
            travel,
            max_velocity,
            max_acceleration,
            max_jerk,
        }
    }

    fn travel(&mut self, axis: Axis, raw: &Spanned<RawAxis>) -> Option<(f64, f64)> {
        let unit = Units::of(axis).position;
        let table = raw.as_ref();
        let range = Range {
            min: -1e6,
            max: 1e6,
            unit,
            help: "the soft limit in machine coordinates",
        };
        let mut end = |name: &str, value: &Optional<f64>| {
            value
                .as_ref()
                .map(|value| self.number(&format!("axis.{axis}.{name}"), value, &range))
        };
        let min = end("min_position", &table.min_position);
        let max = end("max_position", &table.max_position);
        match (min, max) {
            (Some(min), Some(max)) if min < max => Some((min, max)),
            (None, None) if axis.is_rotary() => None,
            (Some(min), Some(max)) => {
                self.diagnostics.push(ConfigDiagnostic {
                    key: format!("axis.{axis}.max_position"),
                    message: format!(
                        "axis {axis} has no travel: min_position = {min} {unit} is not below \
                         max_position = {max} {unit}"
                    ),
                    help: Some("exchange the two, or mend the wrong one".to_owned()),
                    span: table.max_position.as_ref().map(Spanned::span),
                });
                None
            }
            (min, _) => {
                let missing = if min.is_none() {
                    "min_position"
                } else {
                    "max_position"
                };
                self.diagnostics.push(ConfigDiagnostic {
                    key: format!("axis.{axis}.{missing}"),
                    message: format!("the key `{missing}` of axis {axis} is missing"),
                    help: Some(format!(
                        "add `{missing} = …` ({unit}) to [axis.{axis}]; only a rotary axis may have \
                         no soft limits, and then neither of the two"
                    )),
                    span: Some(raw.span()),
                });
                None
            }
        }
    }
}

struct Units {
    position: &'static str,
    velocity: &'static str,
    acceleration: &'static str,
    jerk: &'static str,
}

impl Units {
    const fn of(axis: Axis) -> Self {
        if axis.is_rotary() {
            Self {
                position: "°",
                velocity: "°/s",
                acceleration: "°/s²",
                jerk: "°/s³",
            }
        } else {
            Self {
                position: "mm",
                velocity: "mm/s",
                acceleration: "mm/s²",
                jerk: "mm/s³",
            }
        }
    }
}
