//! `[axis.X]`: limits and travel of an axis.

use super::axis_share::travel_of;
use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawAxis};
use crate::config::settings::{AxisConfig, MOST_OF_AXES};
use glidepath_geometry::Axis;
use glidepath_kinematics::{AloneLimits, JointLimits, Mechanism};
use toml::Spanned;

impl Judge {
    pub(super) fn axis(&mut self, axis: Axis, raw: &Spanned<RawAxis>) -> AxisConfig {
        let table = raw.as_ref();
        let unit = Units::of(axis);
        let mut limit = |name: &str, value: &Optional<f64>, unit: &'static str, max: f64| {
            let help = "a limit of the drive, in any direction of motion";
            // One that is left out is that of the joints, or is missed once it is known that there are none.
            let value = value.as_ref()?;
            Some(self.number(
                &format!("axis.{axis}.{name}"),
                value,
                &Range {
                    min: 1e-3,
                    max,
                    unit,
                    help,
                },
            ))
        };
        let [most_v, most_a, most_j] = MOST_OF_AXES;
        let given = [
            limit("max_velocity", &table.max_velocity, unit.velocity, most_v),
            limit(
                "max_acceleration",
                &table.max_acceleration,
                unit.acceleration,
                most_a,
            ),
            limit("max_jerk", &table.max_jerk, unit.jerk, most_j),
        ];
        let [max_velocity, max_acceleration, max_jerk] =
            [0, 1, 2].map(|k| given[k].unwrap_or(MOST_OF_AXES[k]));
        let travel = self.travel(axis, raw);
        AxisConfig {
            axis,
            travel,
            max_velocity,
            max_acceleration,
            max_jerk,
            has_own: given.map(|limit| limit.is_some()),
        }
    }

    /// Completes axes by what joints let them do, where these are others; else tells what is missing.
    pub(super) fn complete(
        &mut self,
        axes: &mut [AxisConfig],
        raw_axes: &[(Axis, &Spanned<RawAxis>)],
        (mechanism, joints): (&Mechanism, &JointLimits),
    ) {
        let is_complete = |axis: &AxisConfig| axis.has_own == [true; 3];
        if axes.iter().all(is_complete) {
            return;
        }
        if matches!(mechanism, Mechanism::Trivial(_)) {
            for (axis, (_, raw)) in axes.iter().zip(raw_axes) {
                self.miss_limits(axis, raw);
            }
            return;
        }
        // Looked for all over the travel, so only of a machine that can be.
        if self.has_found(&["axis", "joint", "machine"]) {
            return;
        }
        let alone = AloneLimits::over(mechanism, joints, &travel_of(axes));
        for axis in axes {
            let i = axis.axis.index();
            let own = [
                &mut axis.max_velocity,
                &mut axis.max_acceleration,
                &mut axis.max_jerk,
            ];
            let by_joints = [alone.velocity[i], alone.acceleration[i], alone.jerk[i]];
            for (k, limit) in own.into_iter().enumerate() {
                if !axis.has_own[k] {
                    *limit = by_joints[k].min(MOST_OF_AXES[k]);
                }
            }
        }
    }

    fn miss_limits(&mut self, axis: &AxisConfig, raw: &Spanned<RawAxis>) {
        let names = ["max_velocity", "max_acceleration", "max_jerk"];
        let missing = names.iter().zip(axis.has_own).filter(|(_, has)| !has);
        for (missing, _) in missing {
            // A name that is nearly this one was told already.
            let meant = format!("did you mean `{missing}`");
            let is_told = |found: &ConfigDiagnostic| {
                found
                    .help
                    .as_ref()
                    .is_some_and(|help| help.starts_with(&meant))
            };
            if self.diagnostics.iter().any(is_told) {
                continue;
            }
            self.diagnostics.push(ConfigDiagnostic {
                key: format!("axis.{}.{missing}", axis.axis),
                message: format!("the key `{missing}` is missing"),
                help: Some(format!(
                    "add `{missing} = …` to [axis.{}]; only where joints are not the axes, and have \
                     limits of their own, it may be left out",
                    axis.axis
                )),
                span: Some(raw.span()),
            });
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
