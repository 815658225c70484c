//! CT of SINUMERIK: an arc that goes on in the direction of the move before it, to its end.
//!
//! ```text
//!   d: from the start to the end, n: to the left of the direction, at a right angle
//!   r = d² / 2 d·n        the centre is r to the left; below zero to the right
//! ```

use glidepath_geometry::{Arc, AxisVector, Segment};
use glidepath_program::{Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::arc_ends::{Ends, sweep};
use crate::execute::motion::settled::settled;
use crate::execute::motion::speed::Pace;
use crate::syntax::block::Block;

/// Parts of the way to the left below this are none.
const STRAIGHT: f64 = 1e-9;

/// The direction in which the last move among items ends.
pub(crate) fn direction_behind(items: &[Item]) -> Option<AxisVector> {
    items.iter().rev().find_map(|item| match &item.kind {
        ItemKind::Move { segment, .. } => Some(segment.jet(segment.length()).d1),
        _ => None,
    })
}

impl Interpreter {
    /// CT.
    pub(crate) fn tangent_arc(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        let refuse = |message: &str, reason: &str| {
            BlockDiagnostic::new(DiagnosticCode::ArcWithoutCenter, span, message)
                .because(reason)
                .help("write G2 or G3 with the radius CR=")
        };
        if self.state.open.compensation.is_some() || self.state.leaving_contour {
            return Err(refuse(
                "CT with cutter radius compensation",
                "the move before it is not known yet",
            ));
        }
        let Some(direction) = self.state.tangent else {
            return Err(refuse(
                "CT without a move before it",
                "the arc goes on in the direction of that move",
            ));
        };
        let Some(image) = self.state.offsets.plane(self.state.modal.plane) else {
            return Err(refuse(
                "CT in a plane that a frame has tilted",
                "it is made in the XY, ZX or YZ plane of the machine",
            ));
        };
        let plane = image.plane;
        let (first, second) = plane.axes();
        let start = self.state.path_end;
        let target = self.target(block)?;
        let end = settled(start, target, [Some(first), Some(second)]);
        let flat = |place: &AxisVector| [place[first.index()], place[second.index()]];
        let ends = Ends {
            start: flat(&start),
            end: flat(&end),
        };
        let way = [ends.end[0] - ends.start[0], ends.end[1] - ends.start[1]];
        let along = flat(&direction);
        let length = along[0].hypot(along[1]);
        let square = way[0] * way[0] + way[1] * way[1];
        if length <= STRAIGHT || square <= 0.0 {
            return Err(refuse(
                "CT without a direction in the plane, or without an end",
                "the move before it goes in the plane of the arc, and the arc ends elsewhere",
            ));
        }
        let left = (along[0] * way[1] - along[1] * way[0]) / length;
        if left.abs() <= STRAIGHT * square.sqrt() {
            if along[0] * way[0] + along[1] * way[1] < 0.0 {
                return Err(refuse(
                    "CT that leads straight back",
                    "no arc goes on in that direction to its end",
                ));
            }
            return self.straight(block, target, Pace::Feed, out);
        }
        let radius = square / (2.0 * left);
        let center = [
            ends.start[0] - radius * along[1] / length,
            ends.start[1] + radius * along[0] / length,
        ];
        let arc = Arc {
            start,
            end,
            plane,
            center,
            sweep_rad: sweep(ends, center, radius > 0.0, 1.0),
        };
        let segment = Segment::Arc(arc);
        let speed = self.speed(block, &segment, Pace::Feed)?;
        let (low, high) = arc.bounding_box();
        self.check_limits(block, &low, &high, "a point")?;
        self.state.position = target;
        self.push_move(segment, speed, out);
        Ok(())
    }
}
