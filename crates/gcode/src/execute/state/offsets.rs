//! Coordinate systems: from program to machine coordinates and back.
//!
//! ```text
//! machine = tool offset(G43) + origin(G54 …) + R(θ) · (frame(program) + offset(G92, G52))
//! ```
//!
//! R turns X and Y about the Z axis by the angle of the coordinate system (G10 L2 R); the frame is
//! what SINUMERIK programs make of their coordinates (TRANS, ROT, MIRROR, SCALE). Everything
//! is in mm and degrees, and the machine coordinates are the truth: a change of offsets moves
//! nothing, it gives the same place another name.

use glidepath_geometry::{AXES, AxisVector, Plane};
use serde::{Deserialize, Serialize};

use crate::execute::state::fanuc_offsets::{FIRST_KEY, FanucOffsets, system_key};
use crate::execute::state::frame::{Frame, PlaneImage};
use crate::setup::work_offsets::{CoordinateSystem, SYSTEMS, WorkOffsets};

/// Every offset a program can set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Offsets {
    pub(crate) systems: [CoordinateSystem; SYSTEMS],
    /// Index of the active system.
    pub(crate) active: usize,
    /// Tool offset in force (G43), machine axes.
    pub(crate) tool: AxisVector,
    /// Offset of G92 or G52 in force.
    pub(crate) shift: AxisVector,
    /// The offset G92.3 brings back.
    pub(crate) saved_shift: AxisVector,
    /// Machine positions of G28 and G30.
    pub(crate) reference: [AxisVector; 2],
    /// What the program has made of its coordinates.
    #[serde(skip)]
    pub(crate) frame: Frame,
    /// The part of it that is a tilted plane, in which the others count.
    #[serde(skip)]
    pub(crate) tilted: Frame,
    /// What FANUC's offsets have besides.
    pub(crate) fanuc: FanucOffsets,
}

impl Default for Offsets {
    fn default() -> Self {
        Self::of(&WorkOffsets::default())
    }
}

impl Offsets {
    /// Sets a coordinate system of SINUMERIK: one of the machine's, or one that the program has beside
    /// them.
    pub(crate) fn keep_system(&mut self, index: usize, system: CoordinateSystem) {
        match self.systems.get_mut(index) {
            Some(kept) => *kept = system,
            None => {
                self.fanuc.extended.insert(system_key(index), system);
            }
        }
    }

    /// The offsets a program begins with: no tool offset is in force.
    pub(crate) fn of(set_up: &WorkOffsets) -> Self {
        let WorkOffsets {
            systems,
            active,
            reference,
            shift,
            saved_shift,
        } = *set_up;
        Self {
            systems,
            active,
            tool: AxisVector::zeros(),
            shift,
            saved_shift,
            reference,
            frame: Frame::default(),
            tilted: Frame::default(),
            fanuc: FanucOffsets::default(),
        }
    }

    /// What of them outlasts the program.
    pub(crate) const fn set_up(&self) -> WorkOffsets {
        WorkOffsets {
            systems: self.systems,
            active: self.active,
            reference: self.reference,
            shift: self.shift,
            saved_shift: self.saved_shift,
        }
    }

    /// The coordinate system in force.
    pub(crate) fn system(&self) -> &CoordinateSystem {
        if let Some(extended) = self.fanuc.system() {
            return extended;
        }
        // `active` is set from a G5x code; what an operator set up may be anything.
        &self.systems[if self.active < SYSTEMS {
            self.active
        } else {
            0
        }]
    }

    /// The name of the coordinate system in force, as a program calls it.
    pub(crate) fn system_name(&self) -> String {
        match self.fanuc.active.filter(|_| self.fanuc.system().is_some()) {
            None => system_code(self.active),
            Some(number) if number < FIRST_KEY => format!("G54.1 P{number}"),
            Some(number) => format!("system {}", number - FIRST_KEY + 1),
        }
    }

    /// True where the coordinate system is turned.
    pub(crate) fn is_rotated(&self) -> bool {
        self.system().rotation_deg != 0.0
    }

    /// True where the axes of the program are not those of the machine.
    pub(crate) fn is_turned(&self) -> bool {
        self.is_rotated() || self.frame.is_turned()
    }

    /// Of X, Y and Z, the axes of the machine whose place depends on several of the program's when
    /// these of the program are named.
    pub(crate) fn turned_with(&self, values: &[Option<f64>; AXES]) -> &'static [usize] {
        let is_named = |axis: usize| values[axis].is_some();
        if self.frame.is_turned() && (0..3).any(is_named) {
            &[0, 1, 2]
        } else if self.is_rotated() && (0..2).any(is_named) {
            &[0, 1]
        } else {
            &[]
        }
    }

    /// A way in the program's coordinates, in the machine's.
    pub(crate) fn turn(&self, way: AxisVector) -> AxisVector {
        self.system().rotate(self.frame.turn(way), 1.0)
    }

    /// Where arcs of a plane of the program are; `None` if in no plane of the machine.
    pub(crate) fn plane(&self, plane: Plane) -> Option<PlaneImage> {
        if !self.frame.is_turned() {
            // What a rotated coordinate system allows is seen elsewhere.
            return Some(PlaneImage::of(plane));
        }
        self.frame.plane(plane, self.system().rotation_deg)
    }

    /// True where circles of a plane of the program stay circles, wherever they are.
    pub(crate) fn keeps_circles(&self, plane: Plane) -> bool {
        self.frame.keeps_circles(plane)
    }

    /// Machine coordinate of the program's zero on an axis, where nothing is turned.
    pub(crate) fn origin(&self, axis: usize) -> f64 {
        self.shift[axis]
            + self.system().origin[axis]
            + self.fanuc.external[axis]
            + self.fanuc.local[axis]
            + self.fanuc.dynamic.map_or(0.0, |dynamic| dynamic[axis])
            + self.tool[axis]
            + self.frame.shift[axis]
    }

    pub(crate) fn to_machine(&self, program: AxisVector) -> AxisVector {
        let system = self.system();
        system.rotate(self.frame.apply(program) + self.shift, 1.0)
            + (system.origin + self.fanuc.added() + self.tool)
    }

    pub(crate) fn to_program(&self, machine: AxisVector) -> AxisVector {
        self.to_program_in(self.system(), machine)
    }

    /// Coordinates as they were with another frame in force.
    pub(crate) fn to_program_by(&self, frame: &Frame, machine: AxisVector) -> AxisVector {
        frame.undo(self.before_frame(self.system(), machine))
    }

    /// Coordinates in the coordinate system of that index, without the offset of G92.
    pub(crate) fn in_fixture(&self, index: usize, machine: AxisVector) -> AxisVector {
        let system = self.systems.get(index).unwrap_or_else(|| self.system());
        self.to_program_in(system, machine) + self.shift
    }

    fn to_program_in(&self, system: &CoordinateSystem, machine: AxisVector) -> AxisVector {
        self.frame.undo(self.before_frame(system, machine))
    }

    /// What the frame has made of the program's coordinates.
    fn before_frame(&self, system: &CoordinateSystem, machine: AxisVector) -> AxisVector {
        let origin = system.origin + self.fanuc.added() + self.tool;
        system.rotate(machine - origin, -1.0) - self.shift
    }

    /// G10 L20: moves the origin of a system so that the machine position has the given program
    /// coordinates in it; axes without a value keep theirs.
    pub(crate) fn set_current(
        &mut self,
        index: usize,
        machine: AxisVector,
        wanted: &[Option<f64>; AXES],
    ) {
        let Some(mut system) = self.systems.get(index).copied() else {
            return;
        };
        let program = overlay(self.to_program_in(&system, machine), wanted);
        let origin = machine - self.tool - system.rotate(program + self.shift, 1.0);
        // An axis that was not named, and is not turned along with one that was, stays exact.
        let turned = system.rotation_deg != 0.0 && (wanted[0].is_some() || wanted[1].is_some());
        for axis in 0..AXES {
            if wanted[axis].is_some() || (turned && axis < 2) {
                system.origin[axis] = origin[axis];
            }
        }
        if let Some(slot) = self.systems.get_mut(index) {
            *slot = system;
        }
    }

    /// G92: shifts the coordinates so that the machine position has the given ones.
    pub(crate) fn set_shift(&mut self, machine: AxisVector, wanted: &[Option<f64>; AXES]) {
        let program = self.to_program(machine);
        for axis in 0..AXES {
            if let Some(value) = wanted[axis] {
                self.shift[axis] += program[axis] - value;
            }
        }
        self.saved_shift = self.shift;
    }
}

/// The code of a coordinate system by its index: G54 to G59, G59.1 and on.
pub(crate) fn system_code(index: usize) -> String {
    match index {
        0..=5 => format!("G{}", 54 + index),
        index => format!("G59.{}", index - 5),
    }
}

/// `base` with the given values written over it.
pub(crate) fn overlay(mut base: AxisVector, values: &[Option<f64>; AXES]) -> AxisVector {
    for (slot, value) in base.iter_mut().zip(values) {
        if let Some(value) = value {
            *slot = *value;
        }
    }
    base
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64, z: f64) -> AxisVector {
        let mut p = AxisVector::zeros();
        (p[0], p[1], p[2]) = (x, y, z);
        p
    }

    fn wanted(x: Option<f64>, y: Option<f64>) -> [Option<f64>; AXES] {
        let mut all = [None; AXES];
        (all[0], all[1]) = (x, y);
        all
    }

    fn rotated() -> Offsets {
        let mut offsets = Offsets::of(&WorkOffsets::default());
        offsets.systems[0].origin = point(10.0, 20.0, 30.0);
        offsets.systems[0].rotation_deg = 90.0;
        offsets.shift = point(1.0, 2.0, 3.0);
        offsets.tool = point(0.0, 0.0, 0.5);
        offsets
    }

    #[test]
    fn a_quarter_turn_by_hand() {
        // (4, 5) + (1, 2) = (5, 7), turned to (-7, 5), moved to (3, 25).
        let machine = rotated().to_machine(point(4.0, 5.0, 6.0));
        assert!((machine - point(3.0, 25.0, 39.5)).norm() < 1e-12);
        assert!((rotated().to_program(machine) - point(4.0, 5.0, 6.0)).norm() < 1e-12);
    }

    #[test]
    fn l20_gives_the_position_its_name() {
        for (x, y) in [(Some(7.0), None), (None, Some(8.0)), (Some(7.0), Some(8.0))] {
            let mut offsets = rotated();
            let machine = point(100.0, 200.0, 300.0);
            let before = offsets.to_program(machine);
            offsets.set_current(0, machine, &wanted(x, y));
            let after = offsets.to_program(machine);
            assert!((after[0] - x.unwrap_or(before[0])).abs() < 1e-9);
            assert!((after[1] - y.unwrap_or(before[1])).abs() < 1e-9);
            assert!((after[2] - before[2]).abs() < 1e-12);
        }
    }

    #[test]
    fn g92_gives_the_position_its_name() {
        let mut offsets = rotated();
        let machine = point(100.0, 200.0, 300.0);
        offsets.set_shift(machine, &wanted(Some(-1.0), None));
        assert!((offsets.to_program(machine)[0] + 1.0).abs() < 1e-9);
        assert!((offsets.saved_shift - offsets.shift).norm() < 1e-15);
    }
}
