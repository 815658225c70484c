//! How the rotary axes turn the tool, as the auditor is told: from the configuration, and not from the kinematics that
//! motion is planned with.

use super::machine::MachineConfig;
use glidepath_audit::{Audit, AuditSettings, AxisTurn, ToolAxis};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{FiveAxis, Mechanism, Rotaries, Tilt};
use glidepath_program::DirectionTolerance;

impl MachineConfig {
    /// How far the direction of the tool may be off.
    pub(super) fn direction_tolerance(&self) -> DirectionTolerance {
        let (lowest, highest) = self.travel();
        let gain_r = self.mechanism.direction_gain(&lowest, &highest);
        // What a program's directions may be changed by at the pole is not left to the motion.
        let left_r = match self.mechanism {
            Mechanism::FiveAxis(_) => 1.0 - 2.0 * DirectionTolerance::POLE_R,
            _ => 1.0,
        };
        DirectionTolerance {
            angle_deg: self.path.direction_deg,
            turn_r: gain_r / left_r,
        }
    }

    /// An audit of a motion that begins at a place, of its tool's direction where axes turn that. Joints are no part of
    /// it yet.
    pub(crate) fn audit_at(&self, start: &AxisVector) -> Audit {
        Audit::new(&self.judged_at(start)).with_tool(self.tool_axis())
    }

    /// What a motion that begins at a place is judged by.
    pub(crate) fn judged_at(&self, start: &AxisVector) -> AuditSettings {
        self.judged().beginning_at(start)
    }

    /// How the rotary axes turn the tool against the work; `None` where they turn the work or the tool for themselves,
    /// and each is judged as an axis.
    fn tool_axis(&self) -> Option<ToolAxis> {
        match &self.mechanism {
            Mechanism::FiveAxis(machine) => Some(of_five_axes(machine)),
            // The platform turns about the fixed x, then y, then z; how it is turned about the tool counts, too.
            Mechanism::Hexapod(_) => {
                let tool = ToolAxis::new(&[
                    turn(Axis::C, [0.0, 0.0, 1.0]),
                    turn(Axis::B, [0.0, 1.0, 0.0]),
                    turn(Axis::A, [1.0, 0.0, 0.0]),
                ]);
                Some(tool.with_axes())
            }
            _ => None,
        }
    }
}

const fn turn(axis: Axis, about: [f64; 3]) -> AxisTurn {
    AxisTurn { axis, about }
}

/// A table turns the work under the tool, and so the tool the other way against the work.
fn of_five_axes(machine: &FiveAxis) -> ToolAxis {
    let (axis, about) = match &machine.tilt {
        Tilt::A => (Axis::A, [1.0, 0.0, 0.0]),
        Tilt::B => (Axis::B, [0.0, 1.0, 0.0]),
        Tilt::Skewed(skewed) => (skewed.axis_letter(), (*skewed.direction()).into()),
    };
    let (tilts_work, turns_work) = match machine.rotaries {
        Rotaries::TableTable { .. } => (true, true),
        Rotaries::HeadHead { .. } => (false, false),
        Rotaries::TableHead { .. } => (false, true),
    };
    let sign = |reversed: bool, is_work: bool| if reversed == is_work { 1.0 } else { -1.0 };
    let rotary = sign(machine.rotary_reversed, turns_work);
    let tilt = sign(machine.tilt_reversed, tilts_work);
    ToolAxis::new(&[
        turn(Axis::C, [0.0, 0.0, rotary]),
        turn(axis, about.map(|x: f64| tilt * x)),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_kinematics::SkewedTilt;
    use nalgebra::Vector3;

    /// Two formulas that know nothing of each other, for every layout and sign.
    #[test]
    fn the_tool_stands_where_the_kinematics_say() {
        let skewed = SkewedTilt::new(Axis::B, &Vector3::new(0.0, 1.0, 1.0)).expect("a direction");
        let zero = Vector3::zeros();
        let layouts = [
            Rotaries::TableTable {
                tilt_point: zero,
                rotary_point: zero,
            },
            Rotaries::HeadHead {
                rotary_to_tilt: zero,
                tilt_to_spindle: zero,
            },
            Rotaries::TableHead { rotary_point: zero },
        ];
        for rotaries in layouts {
            for tilt in [Tilt::A, Tilt::B, Tilt::Skewed(skewed)] {
                for [tilt_reversed, rotary_reversed] in
                    [[false, false], [true, false], [false, true], [true, true]]
                {
                    let machine = FiveAxis {
                        rotaries,
                        tilt,
                        tilt_reversed,
                        rotary_reversed,
                        tool_mm: 80.0,
                    };
                    let judged = of_five_axes(&machine);
                    for (tilt_deg, rotary_deg) in [(30.0, 0.0), (-70.0, 110.0), (95.0, -200.0)] {
                        let mut at = AxisVector::zeros();
                        at[machine.tilt_axis().index()] = tilt_deg;
                        at[Axis::C.index()] = rotary_deg;
                        let known = machine.tool_axis(tilt_deg, rotary_deg);
                        let off = Vector3::from(judged.direction(&at)) - known;
                        assert!(off.amax() < 1e-12, "{machine:?} {tilt_deg} {rotary_deg}");
                    }
                }
            }
        }
    }
}
