//! Turning compensation on and off, and what it makes of the interpreter's moves.

use core::f64::consts::TAU;

use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::{Item, ItemKind};

use super::element::{along, direction, distance, minus};
use super::{Compensation, ContourMove, Element, Pending};
use crate::block::Block;
use crate::codes::Coded;
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::interpreter::Interpreter;
use crate::modes::{Contour, CutterRadius, Motion, Once, Side};
use crate::moves::{MIN_MOVE, Pace, Speed, motion_span, settled};
use crate::words::{missing, whole};

/// How far back an entry line reaches when its corner is looked for, mm.
const ENTRY_MM: f64 = 1e4;

impl Compensation {
    /// The first move.
    fn enter(&mut self, first: ContourMove, out: &mut Vec<Item>) -> Outcome<()> {
        let radius = self.radius();
        let contour = first.contour;
        if distance(contour.start, contour.end) <= radius {
            let message = format!(
                "the first move with cutter radius compensation is not longer than the tool radius, {radius} mm"
            );
            return Err(Fault::new(Code::CutterRadius, first.span, message)
                .because("it leads the tool from the programmed point to beside the contour")
                .help("start further away, or move in the plane first"));
        }
        let Some(mut path) = contour.offset(self.left) else {
            return Err(super::too_small(first.span, radius));
        };
        if let Some((center, sweep)) = contour.arc {
            path = entry_arc(&contour, center, sweep, path.end)
                .ok_or_else(|| super::too_small(first.span, radius))?;
            // The tip of a turning tool goes to where its centre was: else the arc would be none.
            let aside = Element {
                start: contour.start,
                end: contour.start,
                arc: None,
            };
            self.emit(&first, &aside, self.tool, out);
        } else {
            // The tool comes from anywhere: a concave corner behind the entry always has its place.
            let tangent = direction(path.start, path.end);
            path.start = along(path.end, tangent, -ENTRY_MM);
        }
        self.entered = true;
        self.pending = Some(Pending { of: first, path });
        Ok(())
    }
}

/// The arc from where the tool is to `end`, with the tangent of the contour there.
fn entry_arc(contour: &Element, center: [f64; 2], sweep: f64, end: [f64; 2]) -> Option<Element> {
    // The new centre is on the line from the end to the old one, as far from both ends.
    let toward = direction(end, center);
    let chord = minus(contour.start, end);
    let half = 0.5 * super::dot(chord, chord);
    let reach = half / super::dot(chord, toward);
    if !reach.is_finite() || reach <= MIN_MOVE {
        return None;
    }
    let center = along(end, toward, reach);
    let (a, b) = (minus(contour.start, center), minus(end, center));
    let mut turn = super::turn(a, b);
    if turn * sweep < 0.0 {
        turn += TAU.copysign(sweep);
    }
    // Full turns of the contour stay.
    let turns = ((sweep.abs() - turn.abs()) / TAU).round().max(0.0);
    Some(Element {
        start: contour.start,
        end,
        arc: Some((center, turn + turns * TAU.copysign(sweep))),
    })
}

/// Cutter radius compensation that is in force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Compensated {
    /// Radius, positive to the left, and the tip of a turning tool; `None`: a radius of zero.
    of: Option<(f64, super::Point)>,
}

impl Interpreter {
    /// G40, G41, G42, G41.1, G42.1.
    pub(crate) fn cutter_radius(
        &mut self,
        block: &Block,
        coded: Coded<CutterRadius>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = coded.span;
        let (side, diameter, orientation) = match coded.code {
            CutterRadius::Off => {
                self.end_compensation(out)?;
                self.state.on_contour = false;
                return Ok(());
            }
            CutterRadius::FromTable(side) => {
                let tool = self.named_tool(block, b'D', span)?;
                (side, tool.diameter_mm, tool.orientation)
            }
            CutterRadius::FromWord(side) => {
                let diameter = block
                    .get(b'D')
                    .ok_or_else(|| missing(span, "G41.1", "D", "the tool's diameter"))?;
                let orientation = whole(block, b'L', 9)?.unwrap_or(0);
                let orientation = u8::try_from(orientation).unwrap_or_default();
                (side, diameter * self.state.modal.units.mm(), orientation)
            }
        };
        self.begin_compensation(block, span, side, 0.5 * diameter, orientation)
    }

    fn begin_compensation(
        &mut self,
        block: &Block,
        span: Span,
        side: Side,
        radius: f64,
        orientation: u8,
    ) -> Outcome<()> {
        if self.state.on_contour {
            let message = "cutter radius compensation is on already";
            return Err(Fault::new(Code::CutterRadius, span, message)
                .because("where the tool is would not be clear if its side or radius changed")
                .help("write G40 and a move in between"));
        }
        let plane = self.state.modal.plane;
        if !matches!(plane, Plane::Xy | Plane::Zx) {
            let message = "cutter radius compensation outside G17 and G18";
            return Err(Fault::new(Code::CutterRadius, span, message)
                .because("it is made in the XY and the ZX plane")
                .help("write G17 or G18"));
        }
        if plane != Plane::Zx && block.get(b'L').is_some_and(|l| l != 0.0) {
            let message = "a tool orientation outside G18";
            return Err(Fault::new(Code::CutterRadius, block.span(b'L'), message)
                .because("only turning tools have one")
                .help("remove L, or write G18"));
        }
        if plane == Plane::Zx && self.offsets.is_rotated() {
            let message = "cutter radius compensation in G18 in a rotated coordinate system";
            return Err(Fault::new(Code::CutterRadius, span, message)
                .because("the plane of the contour would be no plane of the machine")
                .help("set the rotation to zero (G10 L2 R0)"));
        }
        self.state.on_contour = true;
        if radius != 0.0 {
            let tool = self.state.path_end;
            self.compensation = Some(Compensation::new(plane, side, radius, orientation, tool));
        }
        Ok(())
    }

    /// Gives out the moves held back; the tool stays where it is.
    pub(crate) fn end_compensation(&mut self, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(mut compensation) = self.compensation.take() else {
            return Ok(());
        };
        let from = out.len();
        compensation.flush(out);
        self.state.leaving_contour = compensation.is_entered();
        self.check_given(None, out.get(from..).unwrap_or_default())?;
        self.state.path_end = compensation.tool();
        Ok(())
    }

    /// What is in force, if any.
    pub(crate) fn compensated(&self) -> Option<Compensated> {
        self.state.on_contour.then(|| Compensated {
            of: self.compensation.as_ref().map(Compensation::side_and_tip),
        })
    }

    /// Refuses what is not possible while compensation is on.
    pub(crate) fn check_compensated(&self, block: &Block) -> Outcome<()> {
        if !self.state.on_contour
            || matches!(
                block.codes.cutter_radius,
                Some(Coded {
                    code: CutterRadius::Off,
                    ..
                })
            )
        {
            return Ok(());
        }
        let codes = &block.codes;
        let once = codes
            .once
            .filter(|once| !matches!(once.code, Once::Dwell | Once::SetReference(_)));
        let motion = codes.motion.filter(|motion| match motion.code {
            Some(Motion::Contour(contour)) => contour != Contour::Finish,
            code => matches!(code, Some(Motion::Cycle(_) | Motion::Probe(_))),
        });
        let plane = codes
            .plane
            .filter(|plane| plane.code != self.state.modal.plane);
        let refused = [
            once.map(|c| (c.span, "changing coordinates or going to references")),
            motion.map(|c| (c.span, "a cycle or a probing move")),
            plane.map(|c| (c.span, "another plane")),
            codes.system.map(|c| (c.span, "another coordinate system")),
            codes.tool_length.map(|c| (c.span, "another tool length")),
            codes.tool_change.map(|c| (c.span, "a tool change")),
            codes
                .diameter
                .map(|c| (c.span, "changing the diameter mode")),
        ];
        if let Some((span, what)) = refused.into_iter().flatten().next() {
            let message = format!("{what} with cutter radius compensation on");
            return Err(Fault::new(Code::CutterRadius, span, message)
                .because("the tool stands beside the programmed point, at a place that depends on the next move")
                .help("write G40 and a move before it"));
        }
        if self
            .compensation
            .as_ref()
            .is_some_and(Compensation::is_overfull)
        {
            let message = format!(
                "more than {} blocks without a move in the plane",
                super::MAX_HELD
            );
            return Err(Fault::new(Code::CutterRadius, Span::default(), message)
                .because(
                    "with cutter radius compensation on they wait for the next move in the plane",
                )
                .help("write G40 before them"));
        }
        Ok(())
    }

    /// A straight move while compensation is on.
    pub(crate) fn compensated_straight(
        &mut self,
        block: &Block,
        target: AxisVector,
        pace: Pace,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let start = self.state.position;
        let end = settled(start, target, [None, None]);
        self.state.position = target;
        if end == start {
            self.count_zero_length(pace);
            return Ok(());
        }
        let segment = Segment::line(start, end);
        let speed = self.speed(block, &segment, pace)?;
        self.contour_move(block, segment, speed, out)
    }

    /// A move of the contour, given by its programmed segment.
    pub(crate) fn contour_move(
        &mut self,
        block: &Block,
        segment: Segment,
        speed: Speed,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let line = self.line;
        let mode = self.state.modal.path_mode;
        let Some(compensation) = &mut self.compensation else {
            return Ok(());
        };
        let (first, second) = compensation.plane.axes();
        let in_plane = |v: &AxisVector| [v[first.index()], v[second.index()]];
        let arc = match &segment {
            Segment::Arc(Arc {
                center, sweep_rad, ..
            }) => Some((*center, *sweep_rad)),
            _ => None,
        };
        let next = ContourMove {
            line,
            contour: Element {
                start: in_plane(&segment.start()),
                end: in_plane(&segment.end()),
                arc,
            },
            to: segment.end(),
            speed,
            mode,
            span: motion_span(block),
        };
        let from = out.len();
        let still = arc.is_none() && distance(next.contour.start, next.contour.end) <= MIN_MOVE;
        if !compensation.entered {
            compensation.enter(next, out)?;
        } else if still {
            compensation.push_still(next);
        } else {
            compensation.push_move(next, out)?;
        }
        self.check_given(Some(block), out.get(from..).unwrap_or_default())
    }

    /// Soft limits of moves just given out.
    fn check_given(&mut self, block: Option<&Block>, given: &[Item]) -> Outcome<()> {
        let none = Block::default();
        let block = block.unwrap_or(&none);
        for item in given {
            let ItemKind::Move { segment, .. } = &item.kind else {
                continue;
            };
            let (low, high) = match segment {
                Segment::Arc(arc) => arc.bounding_box(),
                other => (other.end(), other.end()),
            };
            self.check_limits(block, &low, &high, "a point of the compensated path")?;
            self.state.path_end = segment.end();
        }
        Ok(())
    }
}
