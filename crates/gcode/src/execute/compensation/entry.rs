//! The entry move: the first one with compensation on.

use core::f64::consts::TAU;

use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::compensation::element::{
    self, Element, along, direction, distance, dot, minus,
};
use crate::execute::compensation::path::{Compensation, ContourMove, Pending, too_small};
use crate::execute::motion::settled::MIN_MOVE;

/// How far back an entry line reaches when its corner is looked for, mm.
const ENTRY_MM: f64 = 1e4;

impl Compensation {
    /// The first move.
    pub(super) fn enter(&mut self, first: ContourMove, out: &mut Vec<Item>) -> Outcome<()> {
        let radius = self.radius();
        let contour = first.contour;
        if contour.arc.is_some() && self.enters_beside_next {
            let message = "cutter radius compensation that begins with an arc";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CutterRadius, first.span, message)
                    .because("this control begins it with a straight move alone")
                    .help("write G41 or G42 into the straight move before the arc"),
            );
        }
        if !self.enters_beside_next && distance(contour.start, contour.end) <= radius {
            let message = format!(
                "the first move with cutter radius compensation is not longer than the tool radius, {radius} mm"
            );
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CutterRadius, first.span, message)
                    .because("it leads the tool from the programmed point to beside the contour")
                    .help("start further away, or move in the plane first"),
            );
        }
        let Some(mut path) = contour.offset(self.left) else {
            return Err(too_small(first.span, radius));
        };
        if let Some((center, sweep)) = contour.arc {
            path = entry_arc(&contour, center, sweep, path.end)
                .ok_or_else(|| too_small(first.span, radius))?;
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
        self.pending = Some(Pending {
            of: first,
            path,
            leads_to_next: self.enters_beside_next && contour.arc.is_none(),
        });
        Ok(())
    }
}

/// The arc from where the tool is to `end`, with the tangent of the contour there.
fn entry_arc(contour: &Element, center: [f64; 2], sweep: f64, end: [f64; 2]) -> Option<Element> {
    // The new centre is on the line from the end to the old one, as far from both ends.
    let toward = direction(end, center);
    let chord = minus(contour.start, end);
    let half = 0.5 * dot(chord, chord);
    let reach = half / dot(chord, toward);
    if !reach.is_finite() || reach <= MIN_MOVE {
        return None;
    }
    let center = along(end, toward, reach);
    let (a, b) = (minus(contour.start, center), minus(end, center));
    let mut turn = element::turn(a, b);
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
