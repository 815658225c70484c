//! Straight moves by their direction: SINUMERIK's ANG, FANUC's `,A`.
//!
//! ```text
//!   one block:   G1 X20 ANG=30      the other coordinate follows
//!   two blocks:  G1 ANG=45          the corner is where both lines meet
//!                X20 Y0 ANG=315
//! ```
//!
//! The angle counts from the first axis of the plane (on a lathe from +Z), in degrees.

use glidepath_geometry::{AXES, Axis};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::corner::CornerMove;
use crate::execute::motion::speed::Pace;
use crate::execute::state::open_line::OpenLine;
use crate::syntax::block::Block;
use crate::syntax::modes::{Distance, Motion};
use crate::syntax::named_word::Named;

/// Sines below this are of directions that are the same.
const PARALLEL: f64 = 1e-9;

/// The two axes of the plane.
type PlaneAxes = [Axis; 2];

impl Interpreter {
    fn plane_pair(&self) -> PlaneAxes {
        let (first, second) = self.state.modal.plane.axes();
        [first, second]
    }

    /// Which of the two axes of the plane the block names.
    fn names(&self, block: &Block) -> Outcome<[bool; 2]> {
        let values = self.written_values(block)?;
        Ok(self.plane_pair().map(|axis| values[axis.index()].is_some()))
    }

    /// The coordinate that follows from the direction, where the block has the other one.
    pub(crate) fn resolve_line_angle(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let Some(angle) = block.named.find(Named::LineAngle) else {
            return Ok(());
        };
        let [first, second] = self.plane_pair().map(Axis::index);
        let here = self.state.offsets.to_program(self.state.position);
        let incremental = self.state.modal.distance == Distance::Incremental;
        let base = |axis: usize| if incremental { 0.0 } else { here[axis] };
        let (sin, cos) = angle.value.to_radians().sin_cos();
        let (from, to, along, across) = match (values[first], values[second]) {
            (Some(value), None) => (value - base(first), second, cos, sin),
            (None, Some(value)) => (value - base(second), first, sin, cos),
            // The corner before was made by both angles.
            _ => return Ok(()),
        };
        if along.abs() < PARALLEL {
            return Err(refused(
                angle.span,
                "an angle that does not lead to the coordinate",
                "the line goes along the other axis of the plane",
            ));
        }
        values[to] = Some(base(to) + from * across / along);
        Ok(())
    }

    /// Before a block: makes a line of which the direction alone is known, up to the one in this
    /// block.
    pub(crate) fn settle_line(
        &mut self,
        block: &Block,
        motion: Option<Motion>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let angle = block.named.find(Named::LineAngle);
        let names = self.names(block)?;
        let Some(open) = self.state.open.line.take() else {
            return match angle {
                Some(angle) if names == [true, true] => Err(refused(
                    angle.span,
                    "an angle beside both coordinates of the plane",
                    "it is of the second of two lines, whose first one has an angle alone",
                )),
                _ => Ok(()),
            };
        };
        let is_end = motion == Some(Motion::Linear) && names == [true, true];
        let Some(angle) = angle.filter(|_| is_end) else {
            return Err(refused(
                block.first_span(),
                "a line whose end is not given",
                "the block before has an angle alone: this one needs an angle and both coordinates of the plane",
            ));
        };
        self.make_line(block, &open, angle.value, angle.span, out)
    }

    /// Holds a straight move of which the direction alone is known; false if the block has none.
    pub(crate) fn hold_line(&mut self, block: &Block) -> Outcome<bool> {
        let Some(angle) = block.named.find(Named::LineAngle) else {
            return Ok(false);
        };
        match self.names(block)? {
            [false, false] if block.axes().next().is_some() => Err(refused(
                angle.span,
                "an angle beside an axis outside of the plane",
                "the line goes in the plane",
            )),
            [false, false] => {
                self.state.open.line = Some(Box::new(OpenLine {
                    block: block.clone(),
                    degrees: angle.value,
                    feed: self.state.modal.feed,
                    line: self.line,
                }));
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    /// Makes the first of two lines, up to where they meet.
    fn make_line(
        &mut self,
        block: &Block,
        open: &OpenLine,
        degrees: f64,
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let axes = self.plane_pair().map(Axis::index);
        if self.state.modal.distance == Distance::Incremental {
            return Err(refused(
                span,
                "two lines by their angles with incremental distances (G91)",
                "the end of both is absolute",
            ));
        }
        let values = self.axis_values(block)?;
        let here = self.state.offsets.to_program(self.state.position);
        let end = axes.map(|axis| values[axis].unwrap_or(here[axis]));
        let start = axes.map(|axis| here[axis]);
        let Some(corner) = crossing(start, open.degrees, end, degrees) else {
            return Err(refused(
                span,
                "two lines that do not meet",
                "the first one goes on from where the tool is, the second one leads to the end",
            ));
        };
        let mut at = values.map(|_| None);
        for (axis, value) in axes.into_iter().zip(corner) {
            at[axis] = Some(value);
        }
        let target = self.absolute_target(&at);
        let (line, feed) = (self.line, self.state.modal.feed);
        self.line = open.line;
        self.state.modal.feed = open.feed;
        let made = if self.has_corners(&open.block) {
            self.move_between_corners(&open.block, CornerMove { target, arc: None }, out)
        } else {
            self.straight(&open.block, target, Pace::Feed, out)
        };
        self.state.modal.feed = feed;
        self.line = line;
        made
    }

    /// The end of the program: a line has to have its end.
    pub(crate) fn check_line_complete(&self) -> Outcome<()> {
        match &self.state.open.line {
            None => Ok(()),
            Some(_) => Err(refused(
                SourceSpan::default(),
                "a line whose end is not given",
                "the last move has an angle alone",
            )),
        }
    }
}

/// Where a line from `start` meets one that leads to `end`, ahead of the one and before the other.
fn crossing(start: [f64; 2], degrees: f64, end: [f64; 2], degrees_to: f64) -> Option<[f64; 2]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (sin_to, cos_to) = degrees_to.to_radians().sin_cos();
    let turn = cos * sin_to - sin * cos_to;
    if turn.abs() < PARALLEL {
        return None;
    }
    let way = [end[0] - start[0], end[1] - start[1]];
    let along = (way[0] * sin_to - way[1] * cos_to) / turn;
    let behind = (cos * way[1] - sin * way[0]) / turn;
    (along > 0.0 && behind > 0.0).then(|| [start[0] + along * cos, start[1] + along * sin])
}

#[cold]
fn refused(span: SourceSpan, message: &str, reason: &str) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::Polar, span, message)
        .because(reason)
        .help("write the coordinates of the end, or correct the angle")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_lines_by_hand() {
        let near = |a: Option<[f64; 2]>, b: [f64; 2]| {
            a.is_some_and(|a| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12)
        };
        assert!(near(
            crossing([0.0, 0.0], 45.0, [20.0, 0.0], 315.0),
            [10.0, 10.0]
        ));
        assert!(near(
            crossing([5.0, 1.0], 0.0, [9.0, 4.0], 90.0),
            [9.0, 1.0]
        ));
        assert_eq!(crossing([0.0, 0.0], 45.0, [20.0, 0.0], 225.0), None);
        assert_eq!(crossing([0.0, 0.0], 225.0, [20.0, 0.0], 315.0), None);
        assert_eq!(crossing([0.0, 0.0], 45.0, [20.0, 0.0], 135.0), None);
    }
}
