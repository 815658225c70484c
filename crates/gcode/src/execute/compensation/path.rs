//! The path of the tool beside the contour: offset elements, joined at its corners.

use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::{Item, ItemKind, PathMode};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::compensation::element::{Element, Point, distance, meet, turn};
use crate::execute::helix_share::share_of_arc;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Speed;
use crate::syntax::modes::Side;

/// Offset elements whose ends are as near as this are joined, mm: coordinates of programs are
/// rounded, so that a tangent is none to the last digit.
const SMOOTH_MM: f64 = 2e-3;
/// Directions that differ from a reversal by less are one, radians.
const REVERSAL_RAD: f64 = 1e-6;
/// Most events and moves outside the plane held back.
pub(crate) const MAX_HELD: usize = 10_000;

/// One contour move.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContourMove {
    pub(crate) line: u32,
    /// The programmed contour, in the plane.
    pub(crate) contour: Element,
    /// Where it ends; in the plane: the programmed end.
    pub(crate) to: AxisVector,
    pub(crate) speed: Speed,
    /// The speed is that of an arc in the plane; the path of a helix is longer.
    pub(crate) feeds_plane: bool,
    pub(crate) mode: PathMode,
    /// Where a diagnostic points.
    pub(crate) span: SourceSpan,
}

/// The move held back.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pending {
    pub(super) of: ContourMove,
    /// Path of the tool's centre, with the corners found so far. The first move goes straight from
    /// where the tool is to its end.
    pub(super) path: Element,
    /// It is the first move, and leads straight to the beginning of the next one.
    pub(super) leads_to_next: bool,
}

/// What comes after the move held back, and goes with it.
#[derive(Debug, Clone)]
enum Held {
    Item(Item),
    /// A move that does not move in the plane.
    Still(ContourMove),
}

/// Compensation that is on, with a radius above zero.
#[derive(Debug, Clone)]
pub(crate) struct Compensation {
    pub(super) plane: Plane,
    /// Tool radius, positive to the left of the contour, mm.
    pub(super) left: f64,
    /// From the centre of the tool radius to the point that is programmed, in the plane.
    pub(super) tip: Point,
    /// Where the moves given out so far end.
    pub(super) tool: AxisVector,
    pub(super) pending: Option<Pending>,
    held: Vec<Held>,
    pub(super) entered: bool,
    /// The first move ends beside the beginning of the second one, and not beside its own end.
    pub(super) enters_beside_next: bool,
    /// Round convex corners the tool goes in straight lines, and not on arcs.
    pub(super) corners_of_lines: bool,
}

impl Compensation {
    /// Starts at the tool's place. `orientation` is that of a turning tool, 0 for a mill.
    pub(crate) fn new(
        plane: Plane,
        side: Side,
        radius: f64,
        orientation: u8,
        tool: AxisVector,
    ) -> Self {
        let (z, x) = match orientation {
            1 => (1.0, -1.0),
            2 => (-1.0, -1.0),
            3 => (-1.0, 1.0),
            4 => (1.0, 1.0),
            5 => (1.0, 0.0),
            6 => (0.0, -1.0),
            7 => (-1.0, 0.0),
            8 => (0.0, 1.0),
            _ => (0.0, 0.0),
        };
        let sign = if side == Side::Left { 1.0 } else { -1.0 };
        let left = sign * radius;
        let radius = radius.abs();
        let tip = if plane == Plane::Zx {
            [z * radius, x * radius]
        } else {
            [0.0, 0.0]
        };
        Self {
            plane,
            left,
            tip,
            tool,
            pending: None,
            held: Vec::new(),
            entered: false,
            enters_beside_next: false,
            corners_of_lines: false,
        }
    }

    /// The same, of a control whose first move ends beside the beginning of the second one.
    pub(crate) const fn entering_beside_next(mut self, is_so: bool) -> Self {
        self.enters_beside_next = is_so;
        self
    }

    /// The same, of a control that goes round convex corners in straight lines.
    pub(crate) const fn with_corners_of_lines(mut self, is_so: bool) -> Self {
        self.corners_of_lines = is_so;
        self
    }

    /// The same compensation, as if it had been turned on where the tool is.
    pub(crate) fn again(self, tool: AxisVector) -> Self {
        Self {
            tool,
            pending: None,
            held: Vec::new(),
            entered: false,
            ..self
        }
    }

    /// Tool radius, mm.
    pub(crate) const fn radius(&self) -> f64 {
        self.left.abs()
    }

    /// Tool radius, positive to the left, and the tip.
    pub(crate) const fn side_and_tip(&self) -> (f64, Point) {
        (self.left, self.tip)
    }

    /// True once a move was made.
    pub(crate) const fn is_entered(&self) -> bool {
        self.entered
    }

    /// Where the moves given out so far end.
    pub(crate) const fn tool(&self) -> AxisVector {
        self.tool
    }

    pub(crate) fn is_overfull(&self) -> bool {
        self.held.len() > MAX_HELD
    }

    /// An event or dwell.
    pub(crate) fn push_item(&mut self, item: Item, out: &mut Vec<Item>) {
        if self.pending.is_some() {
            self.held.push(Held::Item(item));
        } else {
            out.push(item);
        }
    }

    /// A move outside the plane.
    pub(crate) fn push_still(&mut self, still: ContourMove) {
        self.held.push(Held::Still(still));
    }

    /// A move outside the plane in front of the first one.
    pub(super) fn move_before_entry(&mut self, still: &ContourMove, out: &mut Vec<Item>) {
        let here = self.place();
        let path = Element {
            start: here,
            end: here,
            arc: None,
        };
        self.emit(still, &path, still.to, out);
    }

    /// A move along the contour.
    pub(crate) fn push_move(&mut self, next: ContourMove, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(path) = next.contour.offset(self.left) else {
            return Err(too_small(next.span, self.radius()));
        };
        let mut next = Pending {
            of: next,
            path,
            leads_to_next: false,
        };
        let Some(mut last) = self.pending.take() else {
            self.pending = Some(next);
            return Ok(());
        };
        let gap = distance(last.path.end, next.path.start);
        if last.leads_to_next {
            last.path.end = next.path.start;
            self.give(&last, out);
        } else if gap <= SMOOTH_MM {
            next.path.start_beside(last.path.end);
            self.give(&last, out);
        } else if self.is_concave(&last.of.contour, &next.of.contour) {
            let corner =
                meet(&last.path, &next.path).ok_or_else(|| gouge(next.of.span, self.radius()))?;
            last.path.end_at(corner);
            next.path.start_at(corner);
            self.give(&last, out);
        } else if self.corners_of_lines {
            self.go_round(last, &mut next, out);
        } else if let Some(corner) = self.mitre(&last, &next) {
            last.path.end = corner;
            next.path.start = corner;
            self.give(&last, out);
        } else {
            self.give(&last, out);
            self.round(&next, out);
        }
        self.pending = Some(next);
        Ok(())
    }

    /// Gives out everything held back.
    pub(crate) fn flush(&mut self, out: &mut Vec<Item>) {
        if let Some(last) = self.pending.take() {
            self.give(&last, out);
        }
    }

    /// True if the tool is on the inner side of the corner between two elements of the contour.
    fn is_concave(&self, last: &Element, next: &Element) -> bool {
        let (before, after) = (last.end_tangent(), next.start_tangent());
        let bend = turn(before, after);
        let side = self.left.signum();
        if core::f64::consts::PI - bend.abs() < REVERSAL_RAD {
            // A cusp: which side the next element lies on is decided by how both bend.
            return side * (last.curvature(last.end) + next.curvature(next.start)) < 0.0;
        }
        side * bend > 0.0
    }

    /// Where the centre of the tool radius is, in the plane.
    pub(super) fn place(&self) -> Point {
        let (first, second) = self.plane.axes();
        [
            self.tool[first.index()] - self.tip[0],
            self.tool[second.index()] - self.tip[1],
        ]
    }

    /// Gives out the move held back, and what goes with it.
    pub(super) fn give(&mut self, last: &Pending, out: &mut Vec<Item>) {
        self.emit(&last.of, &last.path, last.of.to, out);
        for held in core::mem::take(&mut self.held) {
            match held {
                Held::Item(item) => out.push(item),
                Held::Still(still) => {
                    let path = Element {
                        start: self.place(),
                        end: last.path.end,
                        arc: None,
                    };
                    self.emit(&still, &path, still.to, out);
                }
            }
        }
    }

    /// One move, from where the tool is; `to` gives the axes outside the plane.
    pub(super) fn emit(
        &mut self,
        of: &ContourMove,
        path: &Element,
        to: AxisVector,
        out: &mut Vec<Item>,
    ) {
        let (first, second) = self.plane.axes();
        let start = self.tool;
        let mut end = to;
        end[first.index()] = path.end[0] + self.tip[0];
        end[second.index()] = path.end[1] + self.tip[1];
        let segment = match path.arc {
            None => Segment::line(start, end),
            Some((center, sweep_rad)) => Segment::Arc(Arc {
                start,
                end,
                plane: self.plane,
                center: [center[0] + self.tip[0], center[1] + self.tip[1]],
                sweep_rad,
            }),
        };
        if path.arc.is_none() && (end - start).amax() <= MIN_MOVE {
            return;
        }
        self.tool = end;
        let speed = match &segment {
            Segment::Arc(arc) if of.feeds_plane => of.speed.times(share_of_arc(arc)),
            _ => of.speed,
        };
        out.push(Item {
            block: 0,
            line: of.line,
            kind: ItemKind::Move {
                segment,
                rate: speed.rate(&segment),
                mode: of.mode,
            },
        });
    }
}

#[cold]
pub(super) fn too_small(span: SourceSpan, radius: f64) -> Box<BlockDiagnostic> {
    let message = format!("the arc is too small for a tool radius of {radius} mm inside it");
    BlockDiagnostic::new(DiagnosticCode::Gouge, span, message)
        .because("the tool is on the inner side of the arc and would cut into it all along")
        .help("use a smaller tool, or the other side (G41, G42)")
}

#[cold]
fn gouge(span: SourceSpan, radius: f64) -> Box<BlockDiagnostic> {
    let message = format!("a tool radius of {radius} mm does not fit into the corner");
    BlockDiagnostic::new(DiagnosticCode::Gouge, span, message)
        .because(
            "the tool is on the inner side of the corner, and one of the moves beside it is too \
             short: the tool would cut into the contour",
        )
        .help("use a smaller tool, the other side (G41, G42), or longer moves")
}

/// Cutter radius compensation that is in force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Compensated {
    /// Radius, positive to the left, and the tip of a turning tool; `None`: a radius of zero.
    pub(super) of: Option<(f64, Point)>,
}
