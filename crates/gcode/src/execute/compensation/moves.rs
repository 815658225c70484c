//! The compensated moves: what compensation makes of the moves of a program.

use glidepath_geometry::{Arc, AxisVector, Segment};
use glidepath_program::{Item, ItemKind};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::compensation::element::{Element, distance};
use crate::execute::compensation::path::ContourMove;
use crate::execute::helix_share::share_of_arc;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::{MIN_MOVE, settled};
use crate::execute::motion::speed::{Pace, Speed};
use crate::syntax::block::Block;

impl Interpreter {
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
        let mode = self.path_mode();
        let arc_feed = self.state.arc_feed;
        let flat = match &segment {
            Segment::Arc(arc) if self.has_feeds_of_fanuc(block) => Some(arc),
            _ => None,
        };
        // F of a helix is that of its arc in the plane, beside the contour as on it.
        let speed = flat.map_or(speed, |arc| speed.times(1.0 / share_of_arc(arc)));
        let feeds_plane = flat.is_some();
        let Some(compensation) = &mut self.state.open.compensation else {
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
        let contour = Element {
            start: in_plane(&segment.start()),
            end: in_plane(&segment.end()),
            arc,
        };
        // What has no offset is refused below.
        let share =
            arc.zip(contour.offset(compensation.left))
                .map_or(1.0, |((center, _), of_center)| {
                    let radius = |element: &Element| distance(element.start, center);
                    arc_feed.share(radius(&of_center), radius(&contour))
                });
        let next = ContourMove {
            line,
            contour,
            to: segment.end(),
            speed: speed.times(share),
            feeds_plane,
            mode,
            span: block.motion_span(),
        };
        let from = out.len();
        let still = arc.is_none() && distance(next.contour.start, next.contour.end) <= MIN_MOVE;
        if still && !compensation.entered && compensation.enters_beside_next {
            compensation.move_before_entry(&next, out);
        } else if !compensation.entered {
            compensation.enter(next, out)?;
        } else if still {
            compensation.push_still(next);
        } else {
            compensation.push_move(next, out)?;
        }
        self.check_given(Some(block), out.get(from..).unwrap_or_default())
    }

    /// Soft limits of moves just given out.
    pub(super) fn check_given(&mut self, block: Option<&Block>, given: &[Item]) -> Outcome<()> {
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
