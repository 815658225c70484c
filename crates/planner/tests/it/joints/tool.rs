//! How the rotary axes of a machine turn its tool, for the auditor.

use glidepath_audit::{AxisTurn, ToolAxis};
use glidepath_geometry::Axis;
use glidepath_kinematics::{Mechanism, Rotaries, Tilt};

pub(crate) fn tool_axis(mechanism: &Mechanism) -> Option<ToolAxis> {
    let turn = |axis, about: [f64; 3], sign: f64| AxisTurn {
        axis,
        about: about.map(|x| sign * x),
    };
    match mechanism {
        Mechanism::FiveAxis(machine) => {
            let about = match &machine.tilt {
                Tilt::A => [1.0, 0.0, 0.0],
                Tilt::B => [0.0, 1.0, 0.0],
                Tilt::Skewed(skewed) => (*skewed.direction()).into(),
            };
            // A table turns the work, and so the tool the other way.
            let [tilt, rotary] = match machine.rotaries {
                Rotaries::TableTable { .. } => [-1.0, -1.0],
                Rotaries::HeadHead { .. } => [1.0, 1.0],
                Rotaries::TableHead { .. } => [1.0, -1.0],
            };
            let sign = |reversed| if reversed { -1.0 } else { 1.0 };
            Some(ToolAxis::new(&[
                turn(
                    Axis::C,
                    [0.0, 0.0, 1.0],
                    rotary * sign(machine.rotary_reversed),
                ),
                turn(
                    machine.tilt_axis(),
                    about,
                    tilt * sign(machine.tilt_reversed),
                ),
            ]))
        }
        Mechanism::Hexapod(_) => Some(ToolAxis::new(&[
            turn(Axis::C, [0.0, 0.0, 1.0], 1.0),
            turn(Axis::B, [0.0, 1.0, 0.0], 1.0),
            turn(Axis::A, [1.0, 0.0, 0.0], 1.0),
        ])),
        _ => None,
    }
}
