//! The map from the coordinates of a program to the axes of a machine with five axes.
//!
//! The axes X, Y and Z of such a machine are the tip of the tool on the work ([`FiveAxis`]). Other
//! controls have them follow the tip between G43.4 and G49 or behind TRAORI alone; elsewhere a program
//! moves the machine's own axes:
//!
//! ```text
//!   Stands          linear joints = place + what they are at zero      axes = forward(joints)
//!   Follows, l      axes = place + l · direction of the tool           l: longer than the known tool
//! ```
//!
//! With the rotary axes at rest either map is a shift or a turn in space: lines stay lines, arcs stay
//! arcs. While they turn, a straight move becomes a curve, which is given out in chords.

use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{FiveAxis, JointVector, Kinematics as _};
use nalgebra::Vector3;

use crate::execute::state::frame::Frame;
use crate::execute::state::tip::Tip;

/// Angles below this are zero, degrees.
const ZERO_DEG: f64 = 1e-9;

/// What a place of the program is to the machine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipMap {
    machine: FiveAxis,
    tip: Tip,
    /// From places of a tilted plane to those of the work.
    plane: Option<Frame>,
}

impl TipMap {
    /// The map; `None` where places are the axes themselves.
    pub(crate) fn new(machine: Option<FiveAxis>, tip: Tip) -> Option<Self> {
        machine.filter(|_| !tip.is_plain()).map(|machine| Self {
            machine,
            tip,
            plane: None,
        })
    }

    /// The map of places that may be the axes themselves.
    pub(super) const fn of_axes(machine: FiveAxis, tip: Tip) -> Self {
        Self {
            machine,
            tip,
            plane: None,
        }
    }

    /// The map of places in a tilted plane.
    pub(crate) const fn of_plane(machine: FiveAxis, tip: Tip, plane: Frame) -> Self {
        Self {
            machine,
            tip,
            plane: Some(plane),
        }
    }

    /// The angles of the tilt and of C at a place.
    pub(crate) fn angles(&self, place: &AxisVector) -> [f64; 2] {
        [
            place[self.machine.tilt_axis().index()],
            place[Axis::C.index()],
        ]
    }

    /// True where a place is the same for the axes.
    pub(crate) fn is_plain_at(&self, place: &AxisVector) -> bool {
        self.plane.is_none() && self.tip_is_plain_at(place)
    }

    fn tip_is_plain_at(&self, place: &AxisVector) -> bool {
        let at_zero = || {
            self.angles(place)
                .iter()
                .all(|angle| angle.abs() <= ZERO_DEG)
        };
        self.tip.is_plain() || self.tip == Tip::Stands && at_zero()
    }

    /// The axes at a place of the program.
    pub(crate) fn axes(&self, place: &AxisVector) -> AxisVector {
        let place = &self.plane.map_or(*place, |plane| plane.apply(*place));
        if self.tip_is_plain_at(place) {
            return *place;
        }
        let mut axes = *place;
        match self.tip {
            Tip::Follows { longer_mm } => {
                let way = self.direction(place) * longer_mm;
                for i in 0..3 {
                    axes[i] += way[i];
                }
            }
            Tip::Stands => {
                let mut joints = self.joints(&self.at_zero(place));
                let [tilt, rotary] = self.angles(place);
                (joints[3], joints[4]) = (tilt, rotary);
                self.put(&joints, &mut axes);
            }
        }
        axes
    }

    /// The place of the program where the axes stand.
    pub(crate) fn place(&self, axes: &AxisVector) -> AxisVector {
        let place = self.place_on_work(axes);
        self.plane.map_or(place, |plane| plane.undo(place))
    }

    fn place_on_work(&self, axes: &AxisVector) -> AxisVector {
        if self.tip_is_plain_at(axes) {
            return *axes;
        }
        let mut place = *axes;
        match self.tip {
            Tip::Follows { longer_mm } => {
                let way = self.direction(axes) * longer_mm;
                for i in 0..3 {
                    place[i] -= way[i];
                }
            }
            Tip::Stands => {
                let mut joints = self.joints(axes);
                (joints[3], joints[4]) = (0.0, 0.0);
                self.put(&joints, &mut place);
            }
        }
        place
    }

    /// From the tip to the spindle, on the work.
    fn direction(&self, place: &AxisVector) -> Vector3<f64> {
        let [tilt, rotary] = self.angles(place);
        self.machine.tool_axis(tilt, rotary)
    }

    fn at_zero(&self, place: &AxisVector) -> AxisVector {
        let mut place = *place;
        place[self.machine.tilt_axis().index()] = 0.0;
        place[Axis::C.index()] = 0.0;
        place
    }

    /// The joints, which these machines have at every place.
    fn joints(&self, axes: &AxisVector) -> JointVector {
        self.machine
            .inverse(axes)
            .unwrap_or_else(|_| JointVector::zeros())
    }

    /// Puts X, Y and Z at these joints into their places.
    fn put(&self, joints: &JointVector, into: &mut AxisVector) {
        if let Ok(axes) = self.machine.forward(joints, into) {
            for i in 0..3 {
                into[i] = axes[i];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_kinematics::{Rotaries, Tilt};
    use proptest::prelude::*;

    fn table(tool_mm: f64) -> FiveAxis {
        FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::new(1.0, -2.0, 30.0),
                rotary_point: Vector3::new(5.0, 6.0, 0.0),
            },
            tilt: Tilt::A,
            tilt_reversed: false,
            rotary_reversed: false,
            tool_mm,
        }
    }

    fn at(x: f64, y: f64, z: f64, a: f64, c: f64) -> AxisVector {
        let mut place = AxisVector::zeros();
        (place[0], place[1], place[2]) = (x, y, z);
        (place[Axis::A.index()], place[Axis::C.index()]) = (a, c);
        place
    }

    #[test]
    fn a_tilted_table_by_hand() {
        // The table turns about x through the origin: the joint (0, 20, 0) is the tip (0, 17.32, -10).
        let machine = FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::zeros(),
                rotary_point: Vector3::zeros(),
            },
            ..table(50.0)
        };
        let map = TipMap::new(Some(machine), Tip::Stands).expect("a map");
        let axes = map.axes(&at(0.0, 20.0, 0.0, 30.0, 0.0));
        let (sin, cos) = 30.0_f64.to_radians().sin_cos();
        assert!((axes - at(0.0, 20.0 * cos, -20.0 * sin, 30.0, 0.0)).amax() < 1e-12);
        // The tool stands along z of the machine: on the work it leans by -30 degrees about x.
        let longer = TipMap::new(Some(machine), Tip::Follows { longer_mm: 10.0 }).expect("a map");
        let axes = longer.axes(&at(0.0, 0.0, 0.0, 30.0, 0.0));
        assert!((axes - at(0.0, 10.0 * sin, 10.0 * cos, 30.0, 0.0)).amax() < 1e-12);
    }

    proptest! {
        #[test]
        fn the_way_back_leads_back(
            xyz in prop::array::uniform3(-200.0_f64..200.0),
            angles in prop::array::uniform2(-170.0_f64..170.0),
            longer_mm in -20.0_f64..80.0,
        ) {
            let place = at(xyz[0], xyz[1], xyz[2], angles[0], angles[1]);
            for tip in [Tip::Stands, Tip::Follows { longer_mm }] {
                let map = TipMap::new(Some(table(70.0)), tip);
                let map = map.expect("a map");
                prop_assert!((map.place(&map.axes(&place)) - place).amax() < 1e-9);
            }
        }

        /// A longer tool: the joints are those of kinematics that know it.
        #[test]
        fn a_longer_tool_is_another_tool(
            xyz in prop::array::uniform3(-200.0_f64..200.0),
            angles in prop::array::uniform2(-170.0_f64..170.0),
            longer_mm in 1.0_f64..80.0,
        ) {
            let place = at(xyz[0], xyz[1], xyz[2], angles[0], angles[1]);
            let map = TipMap::new(Some(table(70.0)), Tip::Follows { longer_mm });
            let axes = map.expect("a map").axes(&place);
            let known = table(70.0).inverse(&axes).expect("joints");
            let other = table(70.0 + longer_mm).inverse(&place).expect("joints");
            prop_assert!((known - other).amax() < 1e-9);
        }
    }
}
