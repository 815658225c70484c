//! The plane of an arc: on a SINUMERIK that of its centre, where it is another one than the plane in force.
//!
//! ```text
//! G17
//! G2 X20 Z-5 I10 K0      an arc in ZX, as behind G18
//! G2 Y20 Z-5 J10 K0      one in YZ
//! G2 X20 Y0 Z-5 I10 J0   a helix about Z
//! G2 X20 Z-5 CR=10       refused: either would do
//! ```

use glidepath_geometry::{Axis, Plane};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::arc_center::center_letter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::Letters;
use crate::syntax::named_word::Named;

impl Interpreter {
    /// The plane in which the program says the arc.
    pub(super) fn plane_of_arc(&self, block: &Block) -> Outcome<Plane> {
        let named = self.state.modal.plane;
        if block.dialect != Dialect::Siemens || named.normal().index() >= 3 {
            return Ok(named);
        }
        if is_of_either(block, named) {
            return Err(of_either(block, named));
        }
        let Some(plane) = plane_of_center(block, named) else {
            return Ok(named);
        };
        let reason = if self.state.open.compensation.is_some() || self.state.open.corner.is_some() {
            "cutter radius compensation and corners that are broken are of the plane in force"
        } else if block.corner.is_some()
            || block.get(b'P').is_some()
            || block.named.find(Named::ArcAngle).is_some()
        {
            "AR, TURN, RND and CHR count in the plane in force"
        } else if self.leaves_plane(block, plane)? {
            "a helix is one of the plane in force"
        } else {
            return Ok(plane);
        };
        let message = "an arc outside of the plane in force";
        Err(
            BlockDiagnostic::new(DiagnosticCode::ArcPlane, block.motion_span(), message)
                .because(reason)
                .help("write G17, G18 or G19 in a block before it"),
        )
    }

    /// True if the third axis moves along with the arc.
    fn leaves_plane(&self, block: &Block, plane: Plane) -> Outcome<bool> {
        let third = plane.normal();
        if !block.axes().any(|(axis, _)| axis == third) {
            return Ok(false);
        }
        let [from, to] = [self.state.position, self.target(block)?]
            .map(|place| self.state.offsets.to_program(place)[third.index()]);
        Ok((to - from).abs() >= MIN_MOVE)
    }
}

/// The plane that has this axis normal to it.
const fn across(axis: Axis) -> Plane {
    match axis {
        Axis::X => Plane::Yz,
        Axis::Y => Plane::Zx,
        _ => Plane::Xy,
    }
}

/// The other plane that the centre is in; `None` where it is the one in force, or none.
fn plane_of_center(block: &Block, named: Plane) -> Option<Plane> {
    let (first, second) = named.axes();
    let deep = block.get(center_letter(named.normal()))?;
    let has_end = |axis: Axis| block.axes().any(|(of, _)| of == axis);
    let ends = [first, second].map(has_end);
    if deep == 0.0 && ends == [true; 2] && !has_end(named.normal()) {
        return None;
    }
    let center = [first, second].map(|axis| block.get(center_letter(axis)));
    let is_first = match center {
        [Some(_), None] => true,
        [None, Some(_)] => false,
        [Some(a), Some(b)] if deep != 0.0 && (a == 0.0) != (b == 0.0) => a != 0.0,
        [None, None] | [Some(0.0), Some(0.0)] if ends[0] != ends[1] => ends[0],
        _ => return None,
    };
    Some(across(if is_first { second } else { first }))
}

/// True for an arc given by its radius whose end is written in one axis of the plane and the one normal to it.
fn is_of_either(block: &Block, named: Plane) -> bool {
    let (first, second) = named.axes();
    let has_end = |axis: Axis| block.axes().any(|(of, _)| of == axis);
    block.get(b'R').is_some()
        && block.get(b'P').is_none()
        && !block.has_any(Letters::of(b"IJK"))
        && has_end(named.normal())
        && has_end(first) != has_end(second)
}

#[cold]
fn of_either(block: &Block, named: Plane) -> Box<BlockDiagnostic> {
    let (first, second) = named.axes();
    let message = "an arc by CR whose end is in two axes that are not those of the plane";
    BlockDiagnostic::new(DiagnosticCode::ArcPlane, block.motion_span(), message)
        .because("it could be an arc in the plane of these two axes, or a helix")
        .help(format!(
            "write {} and {} for a helix; for an arc, select its plane by G17, G18 or G19 in a block before it",
            first.letter(),
            second.letter()
        ))
}
