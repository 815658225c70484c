//! The centre of an arc: the way to it from the start, its coordinates, or the pole.

use glidepath_geometry::{Axis, AxisVector, Plane};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::pole::is_polar;
use crate::execute::state::offsets::Offsets;
use crate::syntax::block::Block;
use crate::syntax::letters::Letters;
use crate::syntax::modes::Distance;

/// What a block says of the centre of its arc, in the two axes of the plane.
enum Center {
    /// The way to it from the start, mm.
    Way([f64; 2]),
    /// Its program coordinates, mm.
    Place([f64; 2]),
    /// It is the pole of polar coordinates.
    Pole,
}

impl Interpreter {
    /// The centre in program coordinates, in the two axes of the plane.
    pub(super) fn program_center(&self, block: &Block, plane: Plane) -> Outcome<[f64; 2]> {
        let (first, second) = plane.axes();
        let here = self.state.offsets.to_program(self.state.path_end);
        Ok(match self.center_words(block, plane)? {
            Center::Pole => [first, second].map(|axis| self.state.pole.at[axis.index()]),
            Center::Way(way) => [here[first.index()] + way[0], here[second.index()] + way[1]],
            Center::Place(place) => place,
        })
    }

    /// The centre in `plane` of the machine, from the words of the plane that the program names.
    pub(super) fn center_point(
        &self,
        block: &Block,
        named: Plane,
        plane: Plane,
    ) -> Outcome<[f64; 2]> {
        let axes = |plane: Plane| {
            let (first, second) = plane.axes();
            [first, second]
        };
        let put = |values: [f64; 2]| {
            let mut point = AxisVector::zeros();
            for (axis, value) in axes(named).into_iter().zip(values) {
                point[axis.index()] = value;
            }
            point
        };
        Ok(match self.center_words(block, named)? {
            Center::Way(way) => {
                let turned = self.state.offsets.turn(put(way));
                let position = &self.state.position;
                axes(plane).map(|axis| position[axis.index()] + turned[axis.index()])
            }
            Center::Place(place) => machine_point(&self.state.offsets, put(place), axes(plane)),
            Center::Pole => {
                let mut point = self.state.offsets.to_program(self.state.position);
                for (axis, value) in self.state.pole.at.into_iter().enumerate() {
                    point[axis] = value;
                }
                machine_point(&self.state.offsets, point, axes(plane))
            }
        })
    }

    /// What a block says of the centre of its arc.
    fn center_words(&self, block: &Block, named: Plane) -> Outcome<Center> {
        let (first, second) = named.axes();
        let letters = [center_letter(first), center_letter(second)];
        let scale = self.state.modal.units.mm();
        let words = letters.map(|letter| block.get(letter).map(|value| value * scale));
        let names = letters.map(char::from);
        Ok(match (words, self.state.modal.arc_distance) {
            ([None, None], _) if is_polar(block) => Center::Pole,
            ([None, None], _) => {
                let message = "an arc without centre or radius";
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::ArcWithoutCenter,
                    block.motion_span(),
                    message,
                )
                .because("the end point alone leaves every radius possible")
                .help(format!("add {} and {}, or R", names[0], names[1])));
            }
            ([a, b], Distance::Incremental) => Center::Way([a.unwrap_or(0.0), b.unwrap_or(0.0)]),
            ([Some(a), Some(b)], Distance::Absolute) => Center::Place([a, b]),
            ([a, _], Distance::Absolute) => {
                let absent = if a.is_none() { names[0] } else { names[1] };
                let message = format!("an absolute arc centre without {absent}");
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::ArcWithoutCenter,
                    block.motion_span(),
                    message,
                )
                .because("with G90.1 both coordinates of the centre must be given")
                .help(format!("add {absent}, or use G91.1")));
            }
        })
    }
}

/// In-plane machine coordinates of a program point.
fn machine_point(offsets: &Offsets, point: AxisVector, axes: [Axis; 2]) -> [f64; 2] {
    let machine = offsets.to_machine(point);
    axes.map(|axis| machine[axis.index()])
}

pub(crate) const fn center_letter(axis: Axis) -> u8 {
    match axis {
        Axis::Y | Axis::V => b'J',
        Axis::Z | Axis::W => b'K',
        _ => b'I',
    }
}

pub(super) fn check_center_words(block: &Block, plane: Plane) -> Outcome<()> {
    let normal = center_letter(plane.normal());
    if block.get(normal).is_some_and(|value| value != 0.0) {
        let message = format!("{} is not in the plane of the arc", char::from(normal));
        return Err(BlockDiagnostic::new(
            DiagnosticCode::ArcOffsetOutsidePlane,
            block.span(normal),
            message,
        )
        .because("the centre has a coordinate on each of the two axes of the plane")
        .help("remove the word, or select the plane it belongs to (G17, G18, G19)"));
    }
    if block.get(b'R').is_some() && block.has_any(Letters::of(b"IJK")) {
        let message = "an arc with both a radius and a centre";
        return Err(BlockDiagnostic::new(
            DiagnosticCode::ArcOverdetermined,
            block.span(b'R'),
            message,
        )
        .because("one of them determines the arc; the other could contradict it")
        .help("remove R, or I, J and K"));
    }
    Ok(())
}
