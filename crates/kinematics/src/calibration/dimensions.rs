//! The dimensions of a mechanism as a list of numbers, and the mechanism of such a list.

use crate::{
    FiveAxis, FiveBar, Hexapod, JOINTS, JointVector, Kinematics as _, LinearDelta, Mechanism,
    Rotaries, RotaryDelta, Scara, TranslationalHexapod,
};
use core::fmt;
use nalgebra::{DVector, Vector3};

/// The unit of a dimension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DimensionUnit {
    /// Millimetres; only above 0.
    Length,
    /// Millimetres.
    Offset,
    /// Degrees.
    Angle,
}

impl DimensionUnit {
    /// As it is written behind a number.
    #[must_use]
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Length | Self::Offset => "mm",
            Self::Angle => "°",
        }
    }
}

/// The name of a dimension: a key of the mechanism's table, or a joint's zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DimensionName {
    /// A number of the table.
    Key {
        /// The key.
        key: &'static str,
        /// What it is.
        unit: DimensionUnit,
    },
    /// One of three numbers that are the value of a key.
    Of {
        /// The key.
        key: &'static str,
        /// Which of them, from 0.
        index: usize,
        /// What it is.
        unit: DimensionUnit,
    },
    /// What a joint is further than it says.
    Zero {
        /// The joint.
        joint: usize,
        /// What it is.
        unit: DimensionUnit,
    },
}

impl DimensionName {
    /// The unit.
    #[must_use]
    pub const fn unit(self) -> DimensionUnit {
        match self {
            Self::Key { unit, .. } | Self::Of { unit, .. } | Self::Zero { unit, .. } => unit,
        }
    }
}

impl fmt::Display for DimensionName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Key { key, .. } => f.write_str(key),
            Self::Of { key, index, .. } => write!(f, "{key}[{index}]"),
            Self::Zero { joint, .. } => write!(f, "zero of J{joint}"),
        }
    }
}

const fn key(key: &'static str, unit: DimensionUnit) -> DimensionName {
    DimensionName::Key { key, unit }
}

const fn three(key: &'static str, unit: DimensionUnit) -> [DimensionName; 3] {
    [
        DimensionName::Of {
            key,
            index: 0,
            unit,
        },
        DimensionName::Of {
            key,
            index: 1,
            unit,
        },
        DimensionName::Of {
            key,
            index: 2,
            unit,
        },
    ]
}

/// A mechanism whose dimensions are numbers.
pub(super) struct Model {
    mechanism: Mechanism,
    names: Vec<DimensionName>,
    /// How many of them are of the mechanism's table; the rest are zeros of joints.
    of_table: usize,
}

impl Model {
    /// None where the joints are the axes.
    pub(super) fn new(mechanism: &Mechanism) -> Option<Self> {
        let mut names = names_of_table(mechanism);
        if names.is_empty() {
            return None;
        }
        let of_table = names.len();
        names.extend(
            units_of_joints(mechanism)
                .iter()
                .enumerate()
                .map(|(joint, unit)| DimensionName::Zero { joint, unit: *unit }),
        );
        Some(Self {
            mechanism: *mechanism,
            names,
            of_table,
        })
    }

    pub(super) fn names(&self) -> &[DimensionName] {
        &self.names
    }

    /// The values of the mechanism as it is, and zeros that are 0.
    pub(super) fn values(&self) -> DVector<f64> {
        let mut values = values_of_table(&self.mechanism);
        values.resize(self.names.len(), 0.0);
        DVector::from_vec(values)
    }

    /// The mechanism with other values; none if a length is not above 0.
    pub(super) fn mechanism(&self, values: &DVector<f64>) -> Option<Mechanism> {
        let is_length = |(name, value): (&DimensionName, &f64)| {
            value.is_finite() && (name.unit() != DimensionUnit::Length || *value > 0.0)
        };
        if !self.names.iter().zip(values.iter()).all(is_length) {
            return None;
        }
        let mut numbers = values.iter().take(self.of_table).copied();
        Some(with_values(&self.mechanism, &mut numbers))
    }

    /// The zeros among values.
    pub(super) fn zeros(&self, values: &DVector<f64>) -> JointVector {
        let mut zeros = JointVector::zeros();
        for (name, value) in self.names.iter().zip(values.iter()) {
            if let DimensionName::Zero { joint, .. } = name {
                zeros[*joint] = *value;
            }
        }
        zeros
    }
}

/// The units of the joints whose zeros are looked for: those that the mechanism's dimensions move.
fn units_of_joints(mechanism: &Mechanism) -> Vec<DimensionUnit> {
    use DimensionUnit::{Angle, Offset};
    let mut units = match mechanism {
        Mechanism::Trivial(_) | Mechanism::CoreXy(_) => Vec::new(),
        Mechanism::LinearDelta(_) => vec![Offset; 3],
        Mechanism::RotaryDelta(_) => vec![Angle; 3],
        Mechanism::Scara(_) => vec![Angle, Angle, Offset, Angle],
        Mechanism::FiveBar(_) => vec![Angle; 2],
        Mechanism::FiveAxis(_) => vec![Offset, Offset, Offset, Angle, Angle],
        Mechanism::Hexapod(_) | Mechanism::Translational(_) => vec![Offset; 6],
    };
    units.truncate(mechanism.joints().min(JOINTS));
    units
}

fn names_of_table(mechanism: &Mechanism) -> Vec<DimensionName> {
    use DimensionUnit::{Angle, Length, Offset};
    match mechanism {
        Mechanism::Trivial(_) | Mechanism::CoreXy(_) => Vec::new(),
        Mechanism::LinearDelta(_) => [
            &[key("rod", Length), key("radius", Length)][..],
            &three("tower_angles", Angle),
        ]
        .concat(),
        Mechanism::RotaryDelta(_) => [
            &[
                key("base_radius", Length),
                key("platform_radius", Length),
                key("upper_arm", Length),
                key("forearm", Length),
            ][..],
            &three("arm_angles", Angle),
        ]
        .concat(),
        Mechanism::Scara(_) => vec![
            key("upper_arm", Length),
            key("forearm", Length),
            key("tool", Offset),
            key("height", Offset),
        ],
        Mechanism::FiveBar(_) => vec![
            key("shoulder_distance", Length),
            key("upper_arm", Length),
            key("forearm", Length),
        ],
        Mechanism::FiveAxis(machine) => {
            let points: &[&str] = match machine.rotaries {
                Rotaries::TableTable { .. } => &["tilt_point", "rotary_point"],
                Rotaries::HeadHead { .. } => &["rotary_to_tilt", "tilt_to_spindle"],
                Rotaries::TableHead { .. } => &["rotary_point"],
            };
            let mut names = vec![key("tool", Offset)];
            names.extend(points.iter().flat_map(|point| three(point, Offset)));
            names
        }
        Mechanism::Hexapod(_) => [
            &[
                key("base_radius", Length),
                key("platform_radius", Length),
                key("half_angle", Angle),
                key("base_z", Offset),
            ][..],
            &three("tool", Offset),
        ]
        .concat(),
        Mechanism::Translational(_) => {
            vec![key("radius_difference", Length), key("base_z", Offset)]
        }
    }
}

fn values_of_table(mechanism: &Mechanism) -> Vec<f64> {
    match mechanism {
        Mechanism::Trivial(_) | Mechanism::CoreXy(_) => Vec::new(),
        Mechanism::LinearDelta(m) => [&[m.rod_mm, m.radius_mm][..], &m.tower_deg].concat(),
        Mechanism::RotaryDelta(m) => [
            &[
                m.base_radius_mm,
                m.platform_radius_mm,
                m.upper_arm_mm,
                m.forearm_mm,
            ][..],
            &m.arm_deg,
        ]
        .concat(),
        Mechanism::Scara(m) => vec![m.upper_arm_mm, m.forearm_mm, m.tool_mm, m.height_mm],
        Mechanism::FiveBar(m) => vec![m.shoulder_distance_mm, m.upper_arm_mm, m.forearm_mm],
        Mechanism::FiveAxis(m) => {
            let points = match m.rotaries {
                Rotaries::TableTable {
                    tilt_point,
                    rotary_point,
                } => vec![tilt_point, rotary_point],
                Rotaries::HeadHead {
                    rotary_to_tilt,
                    tilt_to_spindle,
                } => vec![rotary_to_tilt, tilt_to_spindle],
                Rotaries::TableHead { rotary_point } => vec![rotary_point],
            };
            let coordinates = points.iter().flat_map(|point| point.iter().copied());
            core::iter::once(m.tool_mm).chain(coordinates).collect()
        }
        Mechanism::Hexapod(m) => {
            // As `Hexapod::paired` puts them: the second base joint is half an angle from +X.
            let [base, platform] = [m.base[1], m.platform[1]];
            let half_angle_deg = base.y.atan2(base.x).to_degrees();
            [
                &[
                    base.xy().norm(),
                    platform.xy().norm(),
                    half_angle_deg,
                    base.z,
                ][..],
                m.tool.as_slice(),
            ]
            .concat()
        }
        Mechanism::Translational(m) => vec![m.radius_difference_mm, m.base_z_mm],
    }
}

/// The mechanism with other values, which are enough: those of [`values_of_table`] in number and order.
fn with_values(mechanism: &Mechanism, values: &mut impl Iterator<Item = f64>) -> Mechanism {
    let mut next = || values.next().unwrap_or_default();
    match *mechanism {
        Mechanism::Trivial(_) | Mechanism::CoreXy(_) => *mechanism,
        Mechanism::LinearDelta(m) => Mechanism::LinearDelta(LinearDelta {
            rod_mm: next(),
            radius_mm: next(),
            tower_deg: [next(), next(), next()],
            ..m
        }),
        Mechanism::RotaryDelta(_) => Mechanism::RotaryDelta(RotaryDelta {
            base_radius_mm: next(),
            platform_radius_mm: next(),
            upper_arm_mm: next(),
            forearm_mm: next(),
            arm_deg: [next(), next(), next()],
        }),
        Mechanism::Scara(m) => Mechanism::Scara(Scara {
            upper_arm_mm: next(),
            forearm_mm: next(),
            tool_mm: next(),
            height_mm: next(),
            ..m
        }),
        Mechanism::FiveBar(m) => Mechanism::FiveBar(FiveBar {
            shoulder_distance_mm: next(),
            upper_arm_mm: next(),
            forearm_mm: next(),
            ..m
        }),
        Mechanism::FiveAxis(m) => {
            let tool_mm = next();
            let mut point = || Vector3::new(next(), next(), next());
            let rotaries = match m.rotaries {
                Rotaries::TableTable { .. } => Rotaries::TableTable {
                    tilt_point: point(),
                    rotary_point: point(),
                },
                Rotaries::HeadHead { .. } => Rotaries::HeadHead {
                    rotary_to_tilt: point(),
                    tilt_to_spindle: point(),
                },
                Rotaries::TableHead { .. } => Rotaries::TableHead {
                    rotary_point: point(),
                },
            };
            Mechanism::FiveAxis(FiveAxis {
                rotaries,
                tool_mm,
                ..m
            })
        }
        Mechanism::Hexapod(m) => {
            let (base_mm, platform_mm, half_angle_deg, base_z_mm) =
                (next(), next(), next(), next());
            let mut hexapod = Hexapod::paired(base_mm, platform_mm, half_angle_deg);
            for joint in &mut hexapod.base {
                joint.z = base_z_mm;
            }
            hexapod.tool = Vector3::new(next(), next(), next());
            hexapod.guards = m.guards;
            Mechanism::Hexapod(hexapod)
        }
        Mechanism::Translational(_) => Mechanism::Translational(TranslationalHexapod {
            radius_difference_mm: next(),
            base_z_mm: next(),
        }),
    }
}
