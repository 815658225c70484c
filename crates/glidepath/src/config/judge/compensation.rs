//! `[compensation.J0]`: the errors of a joint's screw and its play.

use super::values::{Judge, Range};
use crate::config::compensation::Compensation;
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawAxis, RawCompensation};
use crate::config::settings::AxisConfig;
use glidepath_geometry::Axis;
use glidepath_kinematics::{
    CompensationError, CompensationPoint, JOINTS, JointCompensation, JointLimit, Mechanism,
};
use std::collections::BTreeMap;
use toml::Spanned;

/// The tables as they are written.
pub(super) type RawCompensations = BTreeMap<Spanned<String>, Spanned<RawCompensation>>;

/// The columns of a table.
struct Columns {
    positions: Vec<f64>,
    up: Vec<f64>,
    down: Vec<f64>,
}

impl Judge {
    /// What is taken out of where each joint is told to be. `axes` get the limits that are left for them.
    pub(super) fn compensation(
        &mut self,
        raw: &RawCompensations,
        mechanism: &Mechanism,
        axes: &mut [AxisConfig],
        raw_axes: &[(Axis, &Spanned<RawAxis>)],
    ) -> Compensation {
        let own = axes.iter().map(|axis| axis.axis);
        let has_second = |raw: &RawAxis| raw.gantry_difference.is_some();
        let second = raw_axes.iter().filter(|(_, raw)| has_second(raw.as_ref()));
        let second = second.map(|(axis, _)| *axis);
        let of_joint: Vec<Axis> = own.chain(second).take(JOINTS).collect();
        let is_trivial = matches!(mechanism, Mechanism::Trivial(_));
        let mut of_joints = Compensation::default();
        for (name, table) in raw {
            let joint = name.as_ref().strip_prefix('J');
            let joint = joint.and_then(|number| number.parse::<usize>().ok());
            let axis = joint
                .and_then(|joint| of_joint.get(joint))
                .filter(|_| is_trivial);
            let axis = axis.and_then(|axis| axes.iter_mut().find(|a| a.axis == *axis));
            let (Some(joint), Some(axis)) = (joint, axis) else {
                let last = of_joint.len().saturating_sub(1);
                let help = if is_trivial {
                    format!("the joints are J0 to J{last}, in the order of the axes")
                } else {
                    "only joints that are axes (kinematics = \"trivial\") are compensated"
                        .to_owned()
                };
                self.refuse_compensation(
                    name.as_ref(),
                    "there is no such joint to compensate".to_owned(),
                    help,
                    name.span(),
                );
                continue;
            };
            let drive = of_joints.drive(axis.axis, &of_joint).unwrap_or(JointLimit {
                velocity: axis.max_velocity,
                acceleration: axis.max_acceleration,
                jerk: axis.max_jerk,
                ..JointLimit::NONE
            });
            if let Some(made) = self.compensation_of(name.as_ref(), table, &drive) {
                let left = made.left();
                axis.max_velocity = axis.max_velocity.min(left.velocity);
                axis.max_acceleration = axis.max_acceleration.min(left.acceleration);
                axis.max_jerk = axis.max_jerk.min(left.jerk);
                of_joints.set(joint, made);
            }
        }
        of_joints
    }

    fn compensation_of(
        &mut self,
        name: &str,
        table: &Spanned<RawCompensation>,
        drive: &JointLimit,
    ) -> Option<JointCompensation> {
        let raw = table.as_ref();
        let range = Range {
            min: 0.0,
            max: 10.0,
            unit: "mm or °",
            help: "how far the motor turns before the joint follows, where it turns round",
        };
        let key = format!("compensation.{name}.backlash");
        let backlash = self.number_or(&key, &raw.backlash, &range, 0.0);
        let columns = self.columns(name, raw);
        let points = self.points(name, &columns, table.span())?;
        let made = JointCompensation::new(&points, backlash, drive);
        made.map_err(|error| {
            let help = match error {
                CompensationError::Points(_) | CompensationError::Order(..) => {
                    "`glidepath config from-screw --help` says how to make the table of a measurement".to_owned()
                }
                CompensationError::Exchanged(_) => {
                    "what is added on the way down is less, by the play; `corrections` are those of the way up"
                        .to_owned()
                }
                CompensationError::TooSteep(_) => {
                    "corrections are what is added to a position, mm or °: the position less what was measured there"
                        .to_owned()
                }
                CompensationError::TooRough { .. } => {
                    "leave points out, or smooth the measurement".to_owned()
                }
            };
            self.refuse_compensation(name, error.to_string(), help, table.span());
        })
        .ok()
    }

    fn columns(&mut self, name: &str, raw: &RawCompensation) -> Columns {
        let mut column = |last: &str, value: &Optional<Vec<f64>>, most: f64, help: &'static str| {
            let range = Range {
                min: -most,
                max: most,
                unit: "mm or °",
                help,
            };
            let key = format!("compensation.{name}.{last}");
            let value = value.as_ref()?;
            let of = |number: &f64| self.number(&key, &Spanned::new(value.span(), *number), &range);
            Some(value.as_ref().iter().map(of).collect::<Vec<f64>>())
        };
        let places = "positions of the joint in machine coordinates, ascending";
        let added = "what is added to the position there";
        let positions = column("positions", &raw.positions, 1e6, places).unwrap_or_default();
        let up = column("corrections", &raw.corrections, 10.0, added).unwrap_or_default();
        let down = column("corrections_down", &raw.corrections_down, 10.0, added);
        Columns {
            positions,
            down: down.unwrap_or_else(|| up.clone()),
            up,
        }
    }

    fn points(
        &mut self,
        name: &str,
        columns: &Columns,
        span: core::ops::Range<usize>,
    ) -> Option<Vec<CompensationPoint>> {
        let Columns {
            positions,
            up,
            down,
        } = columns;
        if up.len() != positions.len() || down.len() != positions.len() {
            self.refuse_compensation(
                name,
                format!(
                    "{} positions have {} corrections, and {} on the way down",
                    positions.len(),
                    up.len(),
                    down.len()
                ),
                "give each position its correction; corrections_down may be left out".to_owned(),
                span,
            );
            return None;
        }
        let rows = positions.iter().zip(up).zip(down);
        Some(
            rows.map(|((position, up), down)| CompensationPoint {
                position: *position,
                up: *up,
                down: *down,
            })
            .collect(),
        )
    }

    fn refuse_compensation(
        &mut self,
        name: &str,
        message: String,
        help: String,
        span: core::ops::Range<usize>,
    ) {
        self.diagnostics.push(ConfigDiagnostic {
            key: format!("compensation.{name}"),
            message,
            help: Some(help),
            span: Some(span),
        });
    }
}
