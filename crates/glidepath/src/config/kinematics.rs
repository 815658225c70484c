//! How axes and joints belong together: `[machine]` and `[joint.J0]`.

use super::finding::Finding;
use super::judge::{Judge, Range};
use super::raw::Optional;
use core::ops::Range as Bytes;
use glidepath_geometry::Axis;
use glidepath_kinematics::{
    AxisList, CoreXy, FiveAxis, Guards, Hexapod, JointLimit, JointLimits, Kinematics as _,
    LinearDelta, Mechanism, Rotaries, Tilt, TranslationalHexapod, Trivial,
};
use nalgebra::Vector3;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "kebab-case")]
pub(super) struct RawMachine {
    kinematics: Optional<String>,
    hexapod: Optional<RawHexapod>,
    translational_hexapod: Optional<RawTranslational>,
    linear_delta: Optional<RawDelta>,
    five_axis: Optional<RawFiveAxis>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawHexapod {
    base_radius: Spanned<f64>,
    platform_radius: Spanned<f64>,
    half_angle: Spanned<f64>,
    base_z: Optional<f64>,
    tool: Optional<[f64; 3]>,
    max_base_angle: Optional<f64>,
    max_platform_angle: Optional<f64>,
    min_strut_distance: Optional<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTranslational {
    radius_difference: Spanned<f64>,
    base_z: Optional<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDelta {
    rod: Spanned<f64>,
    radius: Spanned<f64>,
    tower_angles: Optional<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFiveAxis {
    layout: Spanned<String>,
    tilt: Spanned<String>,
    #[serde(default)]
    tilt_reversed: bool,
    #[serde(default)]
    rotary_reversed: bool,
    tool: Spanned<f64>,
    #[serde(default)]
    tilt_point: [f64; 3],
    #[serde(default)]
    rotary_point: [f64; 3],
    #[serde(default)]
    rotary_to_tilt: [f64; 3],
    #[serde(default)]
    tilt_to_spindle: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawJoint {
    min_position: Optional<f64>,
    max_position: Optional<f64>,
    max_velocity: Spanned<f64>,
    max_acceleration: Spanned<f64>,
    max_jerk: Spanned<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Trivial,
    CoreXy,
    LinearDelta,
    FiveAxis,
    Hexapod,
    Translational,
}

const KINDS: [(&str, Kind); 6] = [
    ("trivial", Kind::Trivial),
    ("corexy", Kind::CoreXy),
    ("linear-delta", Kind::LinearDelta),
    ("five-axis", Kind::FiveAxis),
    ("hexapod", Kind::Hexapod),
    ("translational-hexapod", Kind::Translational),
];

const LENGTH: Range = Range {
    min: 1e-3,
    max: 1e5,
    unit: "mm",
    help: "a length of the mechanism",
};
const OFFSET: Range = Range {
    min: -1e5,
    max: 1e5,
    unit: "mm",
    help: "an offset of the mechanism",
};
const ANGLE: Range = Range {
    min: 0.0,
    max: 180.0,
    unit: "°",
    help: "an angle of the mechanism",
};

impl Judge {
    /// The mechanism; one of its own choice, with a finding, if the file describes none.
    pub(super) fn mechanism(&mut self, raw: &RawMachine, axes: &[Axis]) -> Mechanism {
        let at = raw.kinematics.as_ref().map(Spanned::span);
        let kind = self.choice("machine.kinematics", raw.kinematics.clone(), &KINDS);
        let tables = [
            (Kind::Hexapod, raw.hexapod.as_ref().map(Spanned::span)),
            (
                Kind::Translational,
                raw.translational_hexapod.as_ref().map(Spanned::span),
            ),
            (
                Kind::LinearDelta,
                raw.linear_delta.as_ref().map(Spanned::span),
            ),
            (Kind::FiveAxis, raw.five_axis.as_ref().map(Spanned::span)),
        ];
        for (of, span) in tables {
            let name = KINDS.iter().find(|(_, k)| *k == of).map_or("", |k| k.0);
            match span {
                Some(span) if of != kind => self.findings.push(Finding {
                    key: format!("machine.{name}"),
                    message: format!("[machine.{name}] describes another machine"),
                    help: Some(format!("remove it, or choose it: kinematics = \"{name}\"")),
                    span: Some(span),
                }),
                None if of == kind => self.findings.push(Finding {
                    key: format!("machine.{name}"),
                    message: format!("the table [machine.{name}] is missing"),
                    help: Some("add it with the lengths of the mechanism".to_owned()),
                    span: at.clone(),
                }),
                _ => {}
            }
        }
        let found = match kind {
            Kind::Trivial => None,
            Kind::CoreXy => Some(Mechanism::CoreXy(CoreXy::new(axes))),
            Kind::LinearDelta => raw.linear_delta.as_ref().map(|raw| self.delta(raw, axes)),
            Kind::FiveAxis => raw.five_axis.as_ref().map(|raw| self.five_axis(raw)),
            Kind::Hexapod => raw.hexapod.as_ref().map(|raw| self.hexapod(raw)),
            Kind::Translational => raw
                .translational_hexapod
                .as_ref()
                .map(|raw| self.translational(raw)),
        };
        let mechanism = found.unwrap_or(Mechanism::Trivial(Trivial {
            axes: AxisList::new(axes),
        }));
        self.axes_of(&mechanism, axes, at);
        mechanism
    }

    /// Whether the machine has the axes its mechanism moves, and no others.
    fn axes_of(&mut self, mechanism: &Mechanism, axes: &[Axis], at: Option<Bytes<usize>>) {
        use Axis::{A, B, C, X, Y, Z};
        let (wanted, may_have_more): (&[Axis], bool) = match mechanism {
            Mechanism::Trivial(_) => return,
            Mechanism::CoreXy(_) => (&[X, Y], true),
            Mechanism::LinearDelta(_) => (&[X, Y, Z], true),
            Mechanism::FiveAxis(machine) => match machine.tilt {
                Tilt::A => (&[X, Y, Z, A, C], false),
                Tilt::B => (&[X, Y, Z, B, C], false),
            },
            Mechanism::Hexapod(_) => (&[X, Y, Z, A, B, C], false),
            _ => (&[X, Y, Z], false),
        };
        let missing = wanted.iter().find(|axis| !axes.contains(axis));
        let foreign = axes.iter().find(|axis| !wanted.contains(axis));
        let message = match (missing, foreign.filter(|_| !may_have_more)) {
            (Some(axis), _) => format!("the axis {axis} of this mechanism is missing"),
            (None, Some(axis)) => format!("the mechanism does not move the axis {axis}"),
            (None, None) => return,
        };
        let list: Vec<String> = wanted.iter().map(ToString::to_string).collect();
        self.findings.push(Finding {
            key: "axis".to_owned(),
            message,
            help: Some(format!("give the axes {}", list.join(" "))),
            span: at,
        });
    }

    fn vector(&mut self, key: &str, value: &Optional<[f64; 3]>) -> Vector3<f64> {
        let Some(value) = value else {
            return Vector3::zeros();
        };
        for coordinate in value.as_ref() {
            let spanned = Spanned::new(value.span(), *coordinate);
            self.number(key, &spanned, &OFFSET);
        }
        Vector3::from(*value.as_ref())
    }

    fn hexapod(&mut self, raw: &Spanned<RawHexapod>) -> Mechanism {
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
        hexapod.tool = self.vector(&key("tool"), &raw.tool);
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

    fn translational(&mut self, raw: &Spanned<RawTranslational>) -> Mechanism {
        let raw = raw.as_ref();
        let key = |name: &str| format!("machine.translational-hexapod.{name}");
        let difference = key("radius_difference");
        Mechanism::Translational(TranslationalHexapod {
            radius_difference_mm: self.number(&difference, &raw.radius_difference, &LENGTH),
            base_z_mm: self.number_or(&key("base_z"), &raw.base_z, &OFFSET, 0.0),
        })
    }

    fn delta(&mut self, raw: &Spanned<RawDelta>, axes: &[Axis]) -> Mechanism {
        let raw = raw.as_ref();
        let rod = self.number("machine.linear-delta.rod", &raw.rod, &LENGTH);
        let radius = self.number("machine.linear-delta.radius", &raw.radius, &LENGTH);
        let towers = raw
            .tower_angles
            .as_ref()
            .map_or([90.0, 210.0, 330.0], |a| *a.as_ref());
        Mechanism::LinearDelta(LinearDelta::new(rod, radius, towers, axes))
    }

    fn five_axis(&mut self, raw: &Spanned<RawFiveAxis>) -> Mechanism {
        let raw = raw.as_ref();
        let key = |name: &str| format!("machine.five-axis.{name}");
        let layouts = [
            (
                "table-table",
                Rotaries::TableTable {
                    tilt_point: raw.tilt_point.into(),
                    rotary_point: raw.rotary_point.into(),
                },
            ),
            (
                "head-head",
                Rotaries::HeadHead {
                    rotary_to_tilt: raw.rotary_to_tilt.into(),
                    tilt_to_spindle: raw.tilt_to_spindle.into(),
                },
            ),
            (
                "table-head",
                Rotaries::TableHead {
                    rotary_point: raw.rotary_point.into(),
                },
            ),
        ];
        let rotaries = self.choice(&key("layout"), Some(raw.layout.clone()), &layouts);
        let tilts = [("A", Tilt::A), ("B", Tilt::B)];
        Mechanism::FiveAxis(FiveAxis {
            rotaries,
            tilt: self.choice(&key("tilt"), Some(raw.tilt.clone()), &tilts),
            tilt_reversed: raw.tilt_reversed,
            rotary_reversed: raw.rotary_reversed,
            tool_mm: self.number(&key("tool"), &raw.tool, &OFFSET),
        })
    }

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
            self.findings.push(Finding {
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
                None => self.findings.push(Finding {
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
