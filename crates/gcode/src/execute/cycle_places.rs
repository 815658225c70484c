//! Where the holes of a block are: in the plane, and at the angles of rotary axes.
//!
//! A block of FANUC's cycles may have words of rotary axes: they turn on the way to the hole, and a
//! block with nothing else makes one, too. With K0 or L0 a block makes none, and keeps its words.

use glidepath_geometry::{AXES, Axis};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::Distance;

/// Places nearer than this to where the tool is are there, mm or degrees.
const HERE: f64 = 1e-6;

impl Interpreter {
    /// True for an axis that turns on the way to a hole: of FANUC's mills, where the tip of the tool does
    /// not follow it, and C of its lathes.
    pub(super) fn turns_to_hole(&self, block: &Block, axis: Axis) -> bool {
        let turns = match axis {
            Axis::A | Axis::B => !block.is_lathe,
            Axis::C => true,
            _ => false,
        };
        turns && block.dialect == Dialect::Fanuc && self.options.five_axis.is_none()
    }

    /// The places of a block's holes, program coordinates.
    pub(super) fn places(&self, block: &Block, holes: u32) -> Outcome<Vec<[Option<f64>; AXES]>> {
        let (first, second) = self.state.modal.plane.axes();
        let values = self.axis_values(block)?;
        let incremental = self.state.modal.distance == Distance::Incremental;
        let program = self.state.offsets.to_program(self.state.position);
        let of_place = Axis::ALL
            .into_iter()
            .filter(|axis| [first, second].contains(axis) || self.turns_to_hole(block, *axis))
            .map(Axis::index);
        let mut place = [None; AXES];
        for axis in of_place.clone() {
            place[axis] = values[axis].map(|value| if incremental { program[axis] } else { value });
        }
        let mut places = Vec::new();
        for _ in 0..holes {
            if incremental {
                for axis in of_place.clone() {
                    place[axis] = place[axis].zip(values[axis]).map(|(at, by)| at + by);
                }
            }
            places.push(place);
        }
        Ok(places)
    }

    /// Refuses another place than that of the tool in a block that makes no hole.
    pub(super) fn check_stored_place(&self, block: &Block) -> Outcome<()> {
        let program = self.state.offsets.to_program(self.state.position);
        let normal = self.state.modal.plane.normal();
        let places = self.places(block, 1)?;
        let is_elsewhere = |axis: &Axis| {
            let index = axis.index();
            places
                .iter()
                .any(|place| place[index].is_some_and(|to| (to - program[index]).abs() > HERE))
        };
        match Axis::ALL
            .into_iter()
            .filter(|axis| *axis != normal)
            .find(is_elsewhere)
        {
            Some(axis) => Err(stored_place(block, axis)),
            None => Ok(()),
        }
    }
}

/// A place beside K0 or L0: on some controls the tool goes there, and on others it stands.
#[cold]
fn stored_place(block: &Block, axis: Axis) -> Box<BlockDiagnostic> {
    let message = format!("{axis} in a cycle that is only stored (K0, L0)");
    BlockDiagnostic::new(
        DiagnosticCode::AmbiguousWord,
        block.axis_span(axis),
        message,
    )
    .because("whether the tool goes to the place of a hole that is not made depends on the control")
    .help("write the place into a block of its own before the cycle, or leave it out")
}
