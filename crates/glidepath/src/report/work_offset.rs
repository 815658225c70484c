//! The coordinate system in force, in which positions are those of programs.

use crate::persistence::convert::axis_words;
use glidepath_gcode::PositionOffsets;
use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_kinematics::FiveAxis;
use serde_json::{Map, Value, json};

/// A coordinate system.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkOffset {
    /// Its name, as G54.
    pub name: String,
    /// Its zero, in machine coordinates, mm or degrees.
    pub origin: [f64; AXES],
    /// How far X and Y are turned about Z, degrees.
    pub rotation_deg: f64,
    /// What is in force beside it.
    pub beside: PositionOffsets,
    /// The five axes, where the machine has them: along the tool is another way than along Z there.
    pub five_axis: Option<FiveAxis>,
}

impl WorkOffset {
    /// A machine position in this system: the tip of the tool, as programs have it.
    pub(super) fn work(&self, machine: &[f64; AXES]) -> [f64; AXES] {
        let tip = self
            .beside
            .without_tool(&AxisVector::from(*machine), self.five_axis);
        let mut work: [f64; AXES] = tip.into();
        for (place, origin) in work.iter_mut().zip(&self.origin) {
            *place -= origin;
        }
        let (sin, cos) = self.rotation_deg.to_radians().sin_cos();
        let [x, y, ..] = work;
        if self.rotation_deg != 0.0 {
            [work[0], work[1]] = [x * cos + y * sin, y * cos - x * sin];
        }
        for (place, shift) in work.iter_mut().zip(self.beside.shift.iter()) {
            *place -= shift;
        }
        work
    }

    /// Its name, and that it is shifted, in as few letters as a column has.
    pub(super) fn short(&self) -> String {
        match self.shift_words().as_str() {
            "" => self.name.clone(),
            _ => format!("{} + G92", self.name),
        }
    }

    /// The shift in the words of an axis each, without what rounding has left.
    fn shift_words(&self) -> String {
        axis_words(&self.beside.shift.map(|by| (by * 1e4).round() / 1e4).into())
    }

    /// It in words: its name, and that it is shifted, which its zero does not tell.
    pub(super) fn said(&self) -> String {
        match self.shift_words().as_str() {
            "" => self.name.clone(),
            shift => format!("{}, shifted by {shift} (G92 or G52)", self.name),
        }
    }

    /// Whether positions depend on where the rotary axes stand.
    const fn is_mapped(&self) -> bool {
        self.five_axis.is_some() && !self.beside.tip.is_plain()
    }

    /// It as an object, and a machine position in it, by the axes that the machine has.
    #[must_use]
    pub fn objects(&self, position: &[f64; AXES], axes: &[Axis]) -> [Value; 2] {
        let by_axis = |values: &[f64; AXES]| -> Map<String, Value> {
            let axes = axes.iter();
            axes.filter_map(|axis| Some((axis.to_string(), (*values.get(axis.index())?).into())))
                .collect()
        };
        let offset = json!({
            "system": self.name,
            "origin": by_axis(&self.origin),
            "rotation_deg": self.rotation_deg,
            "shift": by_axis(&self.beside.shift.into()),
            "tool_length": by_axis(&self.beside.tool.into()),
            "turns_with_rotary_axes": self.is_mapped(),
        });
        [offset, by_axis(&self.work(position)).into()]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "values are exact")]

    use super::*;
    use glidepath_gcode::Tip;
    use glidepath_kinematics::{Rotaries, Tilt};
    use nalgebra::Vector3;

    fn offset() -> WorkOffset {
        WorkOffset {
            name: "G55".to_owned(),
            origin: [0.0; AXES],
            rotation_deg: 0.0,
            beside: PositionOffsets::default(),
            five_axis: None,
        }
    }

    #[test]
    fn a_turned_system_turns_positions_back() {
        let offset = WorkOffset {
            rotation_deg: 90.0,
            ..offset()
        };
        let mut machine = [0.0; AXES];
        machine[1] = 5.0;
        let work = offset.work(&machine);
        assert!((work[0] - 5.0).abs() < 1e-12 && work[1].abs() < 1e-12);
    }

    #[test]
    fn what_g92_has_shifted_is_shown_as_programs_have_it() {
        let mut offset = WorkOffset {
            rotation_deg: 90.0,
            ..offset()
        };
        offset.origin[0] = 10.0;
        offset.beside.shift[1] = 2.0;
        let mut machine = [0.0; AXES];
        machine[0] = 7.0;
        // Three from the zero in machine -X, which is +Y of the turned system.
        let work = offset.work(&machine);
        assert!(work[0].abs() < 1e-12 && (work[1] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn positions_are_those_of_the_tip_of_the_tool() {
        let mut offset = offset();
        (offset.origin[2], offset.beside.tool[2]) = (-100.0, 40.0);
        let mut machine = [0.0; AXES];
        machine[2] = -50.0;
        assert_eq!(offset.work(&machine)[2], 10.0);
    }

    #[test]
    fn on_five_axes_a_length_counts_along_the_tool() {
        let mut offset = offset();
        offset.five_axis = Some(FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::zeros(),
                rotary_point: Vector3::zeros(),
            },
            tilt: Tilt::A,
            tilt_reversed: false,
            rotary_reversed: false,
            tool_mm: 50.0,
        });
        offset.beside.tip = Tip::Follows { longer_mm: 10.0 };
        let mut machine = [0.0; AXES];
        machine[3] = 30.0;
        let work = offset.work(&machine);
        // On the work, the tool leans by -30 degrees about X.
        let (sin, cos) = 30.0_f64.to_radians().sin_cos();
        assert!((work[1] + 10.0 * sin).abs() < 1e-12 && (work[2] + 10.0 * cos).abs() < 1e-12);
    }
}
