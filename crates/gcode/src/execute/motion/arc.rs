//! Arcs: from end point and centre, or end point and radius, to a swept angle.
//!
//! *Centre format* gives the centre by I, J, K (of the two axes of the plane). Programs round
//! their coordinates, so start and end are never at exactly the same distance from it. As
//! LinuxCNC does, an arc is accepted if the two radii differ by at most 0.0127 mm (0.0005 in), or
//! by at most 0.1 % and 1.27 mm.
//!
//! *Radius format* gives R: of the two circles through both ends, a positive R means the arc of
//! at most half a turn, a negative R the other. An R that is too small by no more than rounding
//! (0.00127 mm) makes a half circle.

use glidepath_geometry::{Arc, Axis, AxisVector, LINEAR_XYZ, Plane, Segment};
use glidepath_program::Item;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::arc_ends::{Ends, center_from_radius, check_radii, sweep};
use crate::execute::motion::settled::settled;
use crate::execute::motion::speed::Pace;
use crate::execute::state::frame::PlaneImage;
use crate::execute::state::offsets::Offsets;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Distance, Motion};
use crate::syntax::word_check::whole;

/// Most turns of one arc.
const MAX_TURNS: u32 = 10_000;

impl Interpreter {
    pub(crate) fn arc(
        &mut self,
        block: &Block,
        motion: Motion,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let named = self.state.modal.plane;
        let PlaneImage {
            plane,
            scale,
            is_mirrored,
        } = self
            .offsets
            .plane(named)
            .ok_or_else(|| tilted(block.motion_span()))?;
        let (first, second) = plane.axes();
        if self.state.leaving_contour {
            return Err(arc_off_contour(block.motion_span()));
        }
        let compensated = self.compensation.is_some();
        let start = if compensated {
            self.state.position
        } else {
            self.state.path_end
        };
        let target = self.target(block)?;
        let end = settled(start, target, [Some(first), Some(second)]);
        self.check_plane(block, plane, &start, &end)?;
        check_center_words(block, named)?;

        let ends = Ends {
            start: [start[first.index()], start[second.index()]],
            end: [end[first.index()], end[second.index()]],
        };
        let counterclockwise = (motion == Motion::ArcCounterclockwise) != is_mirrored;
        let center = match block.get(b'R') {
            Some(radius) => {
                let radius = radius * self.state.modal.units.mm() * scale;
                center_from_radius(block, ends, radius, counterclockwise)?
            }
            None => self.center_from_words(block, named, plane, ends)?,
        };
        let turns = turns(block, ends.is_closed())?;
        let sweep_rad = sweep(ends, center, counterclockwise, turns);
        let arc = Arc {
            start,
            end,
            plane,
            center,
            sweep_rad,
        };
        let segment = Segment::Arc(arc);
        let speed = self.speed(block, &segment, Pace::Feed)?;
        if compensated {
            self.state.position = target;
            return self.contour_move(block, segment, speed, out);
        }
        let (low, high) = arc.bounding_box();
        self.check_limits(block, &low, &high, "a point")?;
        self.state.position = target;
        self.push_move(segment, speed, out);
        Ok(())
    }

    /// Refuses arcs that are no arcs in the machine's coordinates.
    fn check_plane(
        &self,
        block: &Block,
        plane: Plane,
        start: &AxisVector,
        end: &AxisVector,
    ) -> Outcome<()> {
        let span = block.motion_span();
        if self.offsets.is_rotated() && matches!(plane, Plane::Zx | Plane::Yz) {
            let message = "an arc outside the XY plane in a rotated coordinate system";
            return Err(Fault::new(DiagnosticCode::ArcPlane, span, message)
                .because("its plane would be no coordinate plane of the machine")
                .help("set the rotation to zero (G10 L2 R0), or use G17"));
        }
        let of_uvw = matches!(plane, Plane::Uv | Plane::Wu | Plane::Vw);
        if of_uvw
            && LINEAR_XYZ
                .into_iter()
                .any(|axis| (end[axis] - start[axis]).abs() > 0.0)
        {
            let message = "X, Y or Z moves along with an arc of U, V, W";
            return Err(Fault::new(DiagnosticCode::ArcPlane, span, message)
                .because("the feedrate would be that of X, Y, Z, which go straight")
                .help("write two blocks"));
        }
        Ok(())
    }

    /// The centre in `plane` of the machine, from the words of the plane that the program names.
    fn center_from_words(
        &self,
        block: &Block,
        named: Plane,
        plane: Plane,
        ends: Ends,
    ) -> Outcome<[f64; 2]> {
        let (first, second) = named.axes();
        let letters = [center_letter(first), center_letter(second)];
        let scale = self.state.modal.units.mm();
        let words = letters.map(|letter| block.get(letter).map(|value| value * scale));
        let names = letters.map(char::from);
        let [a, b] = match (words, self.state.modal.arc_distance) {
            ([None, None], _) => {
                let message = "an arc without centre or radius";
                return Err(Fault::new(
                    DiagnosticCode::ArcWithoutCenter,
                    block.motion_span(),
                    message,
                )
                .because("the end point alone leaves every radius possible")
                .help(format!("add {} and {}, or R", names[0], names[1])));
            }
            ([a, b], Distance::Incremental) => [a.unwrap_or(0.0), b.unwrap_or(0.0)],
            ([Some(a), Some(b)], Distance::Absolute) => [a, b],
            ([a, _], Distance::Absolute) => {
                let absent = if a.is_none() { names[0] } else { names[1] };
                let message = format!("an absolute arc centre without {absent}");
                return Err(Fault::new(
                    DiagnosticCode::ArcWithoutCenter,
                    block.motion_span(),
                    message,
                )
                .because("with G90.1 both coordinates of the centre must be given")
                .help(format!("add {absent}, or use G91.1")));
            }
        };
        let mut point = AxisVector::zeros();
        point[first.index()] = a;
        point[second.index()] = b;
        let (first, second) = plane.axes();
        let center = match self.state.modal.arc_distance {
            Distance::Incremental => {
                let turned = self.offsets.turn(point);
                let position = &self.state.position;
                [first, second].map(|axis| position[axis.index()] + turned[axis.index()])
            }
            Distance::Absolute => machine_point(&self.offsets, point, first, second),
        };
        check_radii(block, ends, center)?;
        Ok(center)
    }
}

/// Turns of an arc: P.
fn turns(block: &Block, is_closed: bool) -> Outcome<f64> {
    match whole(block, b'P', MAX_TURNS)? {
        // Marlin counts the circles in front of the arc; where that goes nowhere they are all.
        turns if block.dialect == Dialect::Marlin => {
            let circles = turns.unwrap_or(0);
            let all = if is_closed {
                circles.max(1)
            } else {
                circles + 1
            };
            Ok(f64::from(all))
        }
        Some(0) => {
            let message = "an arc of no turns";
            Err(
                Fault::new(DiagnosticCode::InvalidValue, block.span(b'P'), message)
                    .help("write P1 or more, or leave P out"),
            )
        }
        turns => Ok(f64::from(turns.unwrap_or(1))),
    }
}

#[cold]
fn tilted(span: SourceSpan) -> Box<Fault> {
    let message = "an arc in a frame that leaves it in no plane of the machine";
    Fault::new(DiagnosticCode::ArcPlane, span, message)
        .because(
            "arcs are made in the XY, ZX or YZ plane of the machine, and as circles: a frame that \
             tilts their plane, or scales its axes differently, leaves none",
        )
        .help("turn about the axis normal to the plane, scale both of its axes alike, or write short lines")
}

#[cold]
fn arc_off_contour(span: SourceSpan) -> Box<Fault> {
    let message = "an arc as the first move after cutter radius compensation";
    Fault::new(DiagnosticCode::CutterRadius, span, message)
        .because("the tool stands beside the programmed point, where the arc does not begin")
        .help("make a straight move first")
}

/// In-plane machine coordinates of a program point.
fn machine_point(offsets: &Offsets, point: AxisVector, first: Axis, second: Axis) -> [f64; 2] {
    let machine = offsets.to_machine(point);
    [machine[first.index()], machine[second.index()]]
}

const fn center_letter(axis: Axis) -> u8 {
    match axis {
        Axis::Y | Axis::V => b'J',
        Axis::Z | Axis::W => b'K',
        _ => b'I',
    }
}

fn check_center_words(block: &Block, plane: Plane) -> Outcome<()> {
    let normal = center_letter(plane.normal());
    if block.get(normal).is_some_and(|value| value != 0.0) {
        let message = format!("{} is not in the plane of the arc", char::from(normal));
        return Err(Fault::new(
            DiagnosticCode::ArcOffsetOutsidePlane,
            block.span(normal),
            message,
        )
        .because("the centre has a coordinate on each of the two axes of the plane")
        .help("remove the word, or select the plane it belongs to (G17, G18, G19)"));
    }
    if block.get(b'R').is_some() && block.has_any(Letters::of(b"IJK")) {
        let message = "an arc with both a radius and a centre";
        return Err(
            Fault::new(DiagnosticCode::ArcOverdetermined, block.span(b'R'), message)
                .because("one of them determines the arc; the other could contradict it")
                .help("remove R, or I, J and K"),
        );
    }
    Ok(())
}
