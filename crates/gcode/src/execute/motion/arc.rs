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

use glidepath_geometry::{Arc, AxisVector, LINEAR_XYZ, Plane, Segment};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::arc_center::check_center_words;
use crate::execute::motion::arc_ends::{Ends, center_from_radius, check_radii, sweep};
use crate::execute::motion::corner::CornerMove;
use crate::execute::motion::pole::is_polar;
use crate::execute::motion::settled::settled;
use crate::execute::motion::speed::Pace;
use crate::execute::state::frame::PlaneImage;
use crate::setup::firmware::Firmware;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Distance, Motion};
use crate::syntax::named_word::Named;
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
        if self.state.leaving_contour {
            return Err(arc_off_contour(block.motion_span()));
        }
        self.check_firmware(block)?;
        let named = self.plane_of_arc(block)?;
        check_center_words(block, named)?;
        let Some(PlaneImage {
            plane,
            scale,
            is_mirrored,
        }) = self.state.offsets.plane(named)
        else {
            return self.tilted_arc(block, motion, named, out);
        };
        let (first, second) = plane.axes();
        let compensated = self.state.open.compensation.is_some();
        // A corner that is open is where the arc begins.
        let start = if compensated || self.state.open.corner.is_some() {
            self.state.position
        } else {
            self.state.path_end
        };
        let (mut target, farther) = self.lengthened_arc(block, named, self.target(block)?)?;
        let counterclockwise = (motion == Motion::ArcCounterclockwise) != is_mirrored;
        let flat = |place: &AxisVector| [place[first.index()], place[second.index()]];
        if let Some(angle_rad) = angle_without_end(block, named)? {
            let center = self.center_point(block, named, plane)?;
            let end = turned_about(center, flat(&start), angle_rad, counterclockwise);
            (target[first.index()], target[second.index()]) = (end[0], end[1]);
        }
        let end = settled(start, target, [Some(first), Some(second)]);
        self.check_plane(block, plane, &start, &end)?;
        let ends = Ends {
            start: flat(&start),
            end: flat(&end),
        };
        let center = match radius_word(block, ends)? {
            Some(radius) if block.get(b'R').is_some() => {
                let radius = radius * self.state.modal.units.mm() * scale;
                center_from_radius(block, ends, radius, counterclockwise)?
            }
            Some(radius_mm) => center_from_radius(block, ends, radius_mm, counterclockwise)?,
            None => {
                let center = self.center_point(block, named, plane)?;
                let center = [center[0] + farther[0], center[1] + farther[1]];
                check_radii(block, ends, center)?;
                center
            }
        };
        let turns = turns(block, ends)?;
        let sweep_rad = sweep(ends, center, counterclockwise, turns);
        let arc = Arc {
            start,
            end,
            plane,
            center,
            sweep_rad,
        };
        if self.has_corners(block) {
            let next = CornerMove {
                target: end,
                arc: Some((center, sweep_rad)),
            };
            return self.move_between_corners(block, next, out);
        }
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

    /// Refuses arcs that the firmware of a printer does not make.
    fn check_firmware(&self, block: &Block) -> Outcome<()> {
        if self.state.firmware != Some(Firmware::Klipper) {
            return Ok(());
        }
        if self.state.modal.distance == Distance::Incremental {
            return Err(arc_in_increments(block.motion_span()));
        }
        if block.get(b'R').is_some() {
            return Err(arc_by_radius(block.span(b'R')));
        }
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
        if self.state.offsets.is_rotated() && matches!(plane, Plane::Zx | Plane::Yz) {
            let message = "an arc outside the XY plane in a rotated coordinate system";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::ArcPlane, span, message)
                    .because("its plane would be no coordinate plane of the machine")
                    .help("set the rotation of the coordinate system to zero, or use G17"),
            );
        }
        let of_uvw = matches!(plane, Plane::Uv | Plane::Wu | Plane::Vw);
        if of_uvw
            && LINEAR_XYZ
                .into_iter()
                .any(|axis| (end[axis] - start[axis]).abs() > 0.0)
        {
            let message = "X, Y or Z moves along with an arc of U, V, W";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::ArcPlane, span, message)
                    .because("the feedrate would be that of X, Y, Z, which go straight")
                    .help("write two blocks"),
            );
        }
        Ok(())
    }

    /// An arc whose plane is none of the machine: in program coordinates, which a frame then tilts.
    fn tilted_arc(
        &mut self,
        block: &Block,
        motion: Motion,
        plane: Plane,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if self.state.open.corner.is_some() || block.corner.is_some() {
            return Err(no_corner(block.motion_span()));
        }
        if !self.state.offsets.keeps_circles(plane) {
            return Err(stretched(block.motion_span()));
        }
        let (first, second) = plane.axes();
        let start = self.state.offsets.to_program(self.state.path_end);
        let mut target = self.target(block)?;
        let mut end = self.state.offsets.to_program(target);
        let counterclockwise = motion == Motion::ArcCounterclockwise;
        let flat = |place: &AxisVector| [place[first.index()], place[second.index()]];
        if let Some(angle_rad) = angle_without_end(block, plane)? {
            let center = self.program_center(block, plane)?;
            let to = turned_about(center, flat(&start), angle_rad, counterclockwise);
            (end[first.index()], end[second.index()]) = (to[0], to[1]);
            target = self.state.offsets.to_machine(end);
        }
        let ends = Ends {
            start: flat(&start),
            end: flat(&end),
        };
        let center = match radius_word(block, ends)? {
            Some(radius) if block.get(b'R').is_some() => {
                let radius_mm = radius * self.state.modal.units.mm();
                center_from_radius(block, ends, radius_mm, counterclockwise)?
            }
            Some(radius_mm) => center_from_radius(block, ends, radius_mm, counterclockwise)?,
            None => {
                let center = self.program_center(block, plane)?;
                check_radii(block, ends, center)?;
                center
            }
        };
        let turns = turns(block, ends)?;
        let sweep_rad = sweep(ends, center, counterclockwise, turns);
        self.arc_in_tilted_frame(block, plane, (start, end), (center, sweep_rad), out)?;
        self.state.position = target;
        Ok(())
    }
}

/// AR where the block has no end in the plane: the end follows from the centre, radians.
fn angle_without_end(block: &Block, plane: Plane) -> Outcome<Option<f64>> {
    let Some(word) = block.named.find(Named::ArcAngle) else {
        return Ok(None);
    };
    let (first, second) = plane.axes();
    let has_end = block
        .axes()
        .any(|(axis, _)| axis == first || axis == second)
        || is_polar(block);
    let has_center = block.has_any(Letters::of(b"IJK"));
    let refuse = |message: &str, reason: &str, help: &str| {
        Err(
            BlockDiagnostic::new(DiagnosticCode::ArcOverdetermined, word.span, message)
                .because(reason)
                .help(help),
        )
    };
    if !(word.value > 0.0 && word.value < 360.0) {
        return refuse(
            "AR is not above 0 and below 360",
            "it is the angle in degrees that the arc goes through",
            "write an angle between them; whole circles have I, J and K",
        );
    }
    if has_end == has_center || block.get(b'R').is_some() {
        return refuse(
            "AR with both the end and the centre of an arc, or with neither",
            "an arc is given by the angle and one of them",
            "write the end, or I and J, and no CR",
        );
    }
    Ok(has_center.then_some(word.value.to_radians()))
}

/// The radius of an arc that is given by it and the end: R as it is written, or what AR says, mm. Below
/// zero it is of the longer arc.
fn radius_word(block: &Block, ends: Ends) -> Outcome<Option<f64>> {
    if let Some(radius) = block.get(b'R') {
        return Ok(Some(radius));
    }
    if block.has_any(Letters::of(b"IJK")) {
        return Ok(None);
    }
    let Some(word) = block.named.find(Named::ArcAngle) else {
        return Ok(None);
    };
    if ends.is_closed() {
        let message = "an angle, and an end point that is the start point";
        return Err(BlockDiagnostic::new(
            DiagnosticCode::ArcFullCircleWithRadius,
            word.span,
            message,
        )
        .because("every circle through the point would do")
        .help("give the centre by I, J or K"));
    }
    let half = 0.5 * word.value.to_radians();
    let radius_mm = 0.5 * ends.chord() / half.sin();
    // A half circle is as long either way.
    Ok(Some(if word.value > 180.0 {
        -radius_mm
    } else {
        radius_mm
    }))
}

/// A point turned about another one.
fn turned_about(
    center: [f64; 2],
    point: [f64; 2],
    angle_rad: f64,
    counterclockwise: bool,
) -> [f64; 2] {
    let (sin, cos) = if counterclockwise {
        angle_rad
    } else {
        -angle_rad
    }
    .sin_cos();
    let (u, v) = (point[0] - center[0], point[1] - center[1]);
    [center[0] + u * cos - v * sin, center[1] + u * sin + v * cos]
}

#[cold]
fn arc_in_increments(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "an arc with incremental distances (G91)";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("Klipper makes no arcs there")
        .help("write G90 and the end of the arc")
}

#[cold]
fn arc_by_radius(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "an arc by its radius";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("Klipper takes the centre of an arc alone, and stops at R")
        .help("write I and J")
}

/// Turns of an arc: P.
fn turns(block: &Block, ends: Ends) -> Outcome<f64> {
    let is_circle = ends.is_closed();
    match whole(block, b'P', MAX_TURNS)? {
        // Slicers write P1 for one circle, and a Marlin that is not made for P leaves it out.
        Some(1) if block.dialect == Dialect::Marlin && is_circle => Ok(1.0),
        Some(2..) if block.dialect == Dialect::Marlin && is_circle => {
            let message = "a circle of several turns";
            Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'P'), message)
                    .because(
                        "one Marlin makes one turn more than P, another one turn whatever P is",
                    )
                    .help("write a circle for each turn"),
            )
        }
        // Marlin counts the circles in front of the arc.
        turns if block.dialect == Dialect::Marlin => Ok(f64::from(turns.unwrap_or(0) + 1)),
        Some(0) => {
            let message = "an arc of no turns";
            Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.span(b'P'), message)
                    .help("write P1 or more, or leave P out"),
            )
        }
        turns => Ok(f64::from(turns.unwrap_or(1))),
    }
}

#[cold]
fn no_corner(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a corner that is broken beside an arc in a tilted plane";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("both moves have to be in a plane of the machine's axes")
        .help("write the chamfer or arc out")
}

#[cold]
fn stretched(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "an arc in a frame that makes an ellipse of it";
    BlockDiagnostic::new(DiagnosticCode::ArcPlane, span, message)
        .because("the frame scales the axes of the plane differently, and circles do not stay ones")
        .help("scale both axes of the plane alike, or write short lines")
}

#[cold]
fn arc_off_contour(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "an arc as the first move after cutter radius compensation";
    BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
        .because("the tool stands beside the programmed point, where the arc does not begin")
        .help("make a straight move first")
}
