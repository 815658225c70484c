//! `[squareness]` and `[straightness.ZX]`: what axes are off by where others are.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{RawSquareness, RawStraightness};
use crate::config::settings::AxisConfig;
use core::ops::Range as Bytes;
use glidepath_geometry::Axis;
use glidepath_kinematics::{
    CompensationError, CrossCompensation, CrossTable, JointLimit, Mechanism,
};
use std::collections::BTreeMap;
use toml::Spanned;

/// Travel that is left for programs at least, mm or degrees.
const LEAST_TRAVEL: f64 = 1.0;
/// The length that a squareness is given for, mm.
const METRE: f64 = 1000.0;

/// The tables as they are written.
type RawCross<'a> = (
    &'a RawSquareness,
    &'a BTreeMap<Spanned<String>, Spanned<RawStraightness>>,
);

/// A table, and where the file has it.
struct Written {
    key: String,
    span: Bytes<usize>,
    table: CrossTable,
}

impl Judge {
    /// What is added to axes by where others are. The mechanism gets it, and the axes the limits and the travel that are
    /// left for them.
    pub(super) fn cross_compensation(
        &mut self,
        (squareness, straightness): RawCross<'_>,
        mechanism: &mut Mechanism,
        axes: &mut [AxisConfig],
    ) {
        let mut written = self.squareness(squareness);
        for (name, table) in straightness {
            written.extend(self.straightness(name, table));
        }
        let Some(first) = written.first() else {
            return;
        };
        let Mechanism::Trivial(trivial) = mechanism else {
            let (key, span) = (first.key.clone(), first.span.clone());
            let help = "the dimensions of other mechanisms are measured instead: `glidepath calibrate --help`";
            self.refuse_cross(
                key,
                "only joints that are axes (kinematics = \"trivial\") are compensated across each other",
                help,
                span,
            );
            return;
        };
        if !self.has_axes(&written, axes) || self.has_found(&["axis", "compensation"]) {
            return;
        }
        let limits: Vec<_> = axes.iter().map(|axis| (axis.axis, limit(axis))).collect();
        let tables: Vec<_> = written.iter().map(|one| one.table.clone()).collect();
        let made = match CrossCompensation::new(&tables, &limits) {
            Ok(made) => made,
            Err((number, error)) => {
                let Written { key, span, .. } = &written[number];
                self.refuse_cross(key.clone(), &error.to_string(), help(&error), span.clone());
                return;
            }
        };
        for axis in axes {
            if let Some(left) = made.left(axis.axis) {
                let last = written.iter().rfind(|one| one.table.corrected == axis.axis);
                self.take(axis, left, last);
            }
        }
        // Read by the real-time thread as long as the process lives.
        trivial.cross = Some(Box::leak(Box::new(made)));
    }

    fn squareness(&mut self, raw: &RawSquareness) -> Vec<Written> {
        let range = Range {
            min: -10.0,
            max: 10.0,
            unit: "mm/m",
            help: "what is added to the first axis for each metre of the second",
        };
        let pairs = [
            ("XY", &raw.xy, Axis::X, Axis::Y),
            ("XZ", &raw.xz, Axis::X, Axis::Z),
            ("YZ", &raw.yz, Axis::Y, Axis::Z),
        ];
        let mut given = Vec::new();
        for (name, value, corrected, along) in pairs {
            let Some(value) = value else { continue };
            let key = format!("squareness.{name}");
            let added = self.number(&key, value, &range);
            let table = CrossTable {
                corrected,
                along,
                points: vec![(0.0, 0.0), (METRE, added)],
            };
            given.extend((added != 0.0).then(|| Written {
                key,
                span: value.span(),
                table,
            }));
        }
        given
    }

    fn straightness(
        &mut self,
        name: &Spanned<String>,
        raw: &Spanned<RawStraightness>,
    ) -> Option<Written> {
        let key = format!("straightness.{}", name.as_ref());
        let mut letters = name.as_ref().chars().map(Axis::from_letter);
        let (Some(Some(corrected)), Some(Some(along)), None) =
            (letters.next(), letters.next(), letters.next())
        else {
            let message = format!("{} is no pair of axes", name.as_ref());
            let help = "name the axis that is corrected, and the one along which it was measured: [straightness.ZX]";
            self.refuse_cross(key, &message, help, name.span());
            return None;
        };
        if corrected == along {
            let message = format!("{along} is to be corrected along itself");
            let help = "the error of an axis along itself is that of its screw: positions and corrections of \
                        [compensation.J0]";
            self.refuse_cross(key, &message, help, name.span());
            return None;
        }
        let table = raw.as_ref();
        let columns = [
            ("positions", &table.positions, 1e6),
            ("corrections", &table.corrections, 10.0),
        ];
        let columns = columns.map(|(column, value, most)| {
            self.straightness_column((&key, raw.span()), column, value.as_ref(), most)
        });
        let [Some(places), Some(added)] = columns else {
            return None;
        };
        if places.len() != added.len() {
            let message = format!(
                "{} positions have {} corrections",
                places.len(),
                added.len()
            );
            self.refuse_cross(
                key,
                &message,
                "give each position its correction",
                raw.span(),
            );
            return None;
        }
        Some(Written {
            key,
            span: raw.span(),
            table: CrossTable {
                corrected,
                along,
                points: places.into_iter().zip(added).collect(),
            },
        })
    }

    fn straightness_column(
        &mut self,
        (table, span): (&str, Bytes<usize>),
        name: &str,
        value: Option<&Spanned<Vec<f64>>>,
        most: f64,
    ) -> Option<Vec<f64>> {
        let key = format!("{table}.{name}");
        let Some(value) = value else {
            let help = format!("add `{name} = […]` to [{table}]: as many as of the other one");
            let message = format!("the key `{name}` is missing");
            self.refuse_cross(key, &message, &help, span);
            return None;
        };
        let range = Range {
            min: -most,
            max: most,
            unit: "mm or °",
            help: "positions of the one axis ascend; corrections are added to the other one there",
        };
        let each = |number: &f64| self.number(&key, &Spanned::new(value.span(), *number), &range);
        Some(value.as_ref().iter().map(each).collect())
    }

    /// Whether the machine has the axes of tables, and each that a correction goes along has ends.
    fn has_axes(&mut self, written: &[Written], axes: &[AxisConfig]) -> bool {
        let before = self.diagnostics.len();
        for Written { key, span, table } in written {
            let of = |axis: Axis| axes.iter().find(|of| of.axis == axis);
            let missing = [table.corrected, table.along]
                .into_iter()
                .find(|axis| of(*axis).is_none());
            if let Some(axis) = missing {
                let message = format!("the machine has no axis {axis}");
                let help = "name axes that have a table, such as [axis.Z]";
                self.refuse_cross(key.clone(), &message, help, span.clone());
            } else if of(table.along).is_some_and(|axis| axis.travel.is_none()) {
                let message = format!(
                    "{} turns without end, and the correction along it would grow without end",
                    table.along
                );
                let help = "give the axis min_position and max_position";
                self.refuse_cross(key.clone(), &message, help, span.clone());
            }
        }
        self.diagnostics.len() == before
    }

    /// An axis gets what its corrections leave of its limits and of its travel.
    fn take(&mut self, axis: &mut AxisConfig, left: &JointLimit, last: Option<&Written>) {
        axis.max_velocity = left.velocity;
        axis.max_acceleration = left.acceleration;
        axis.max_jerk = left.jerk;
        let Some((min, max)) = &mut axis.travel else {
            return;
        };
        (*min, *max) = (left.min_position, left.max_position);
        if let Some(Written { key, span, .. }) = last.filter(|_| *max - *min < LEAST_TRAVEL) {
            let message = format!(
                "the corrections of {} are larger than its travel",
                axis.axis
            );
            let help = "corrections are what an axis is off by, in mm or °";
            self.refuse_cross(key.clone(), &message, help, span.clone());
        }
    }

    fn refuse_cross(&mut self, key: String, message: &str, help: &str, span: Bytes<usize>) {
        self.diagnostics.push(ConfigDiagnostic {
            key,
            message: message.to_owned(),
            help: Some(help.to_owned()),
            span: Some(span),
        });
    }
}

/// What the joint of an axis may do.
fn limit(axis: &AxisConfig) -> JointLimit {
    let (min_position, max_position) = axis.travel.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    JointLimit {
        min_position,
        max_position,
        velocity: axis.max_velocity,
        acceleration: axis.max_acceleration,
        jerk: axis.max_jerk,
    }
}

const fn help(error: &CompensationError) -> &'static str {
    match error {
        CompensationError::Points(_) | CompensationError::Order(..) => {
            "positions are those of the axis that the other one was measured along, each once, from the lowest to the \
             highest"
        }
        CompensationError::TooSteep(_) | CompensationError::Exchanged(_) => {
            "corrections are what is added to the axis, in mm or °, all that are given for it together: less than 0 where it \
             was too far up"
        }
        CompensationError::TooRough { .. } => "leave points out, or smooth the measurement",
    }
}
