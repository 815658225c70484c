//! The pieces of a curve, given out as items.

use glidepath_geometry::{Nurbs, NurbsPath, Segment};
use glidepath_program::{Item, PathMode};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::{Pace, Speed};
use crate::syntax::block::Block;

/// Share of the tolerance of G64 P that the pieces of a curve may be away from it.
const PIECE_R: f64 = 1e-3;

/// The circle of a curve that is an arc, or a helix.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    pub(super) radius_mm: f64,
    /// The length of the arc in its plane, > 0, mm.
    pub(super) flat_mm: f64,
}

impl Interpreter {
    /// The path mode of moves: what is in force, with the tolerance that this run may use.
    #[inline]
    pub(crate) const fn path_mode(&self) -> PathMode {
        match self.state.modal.path_mode {
            PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm),
            } => PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm * self.options.tolerance_ratio),
            },
            mode => mode,
        }
    }

    /// How far the pieces of a curve may be away from it, mm.
    pub(super) const fn piece_error_mm(&self) -> f64 {
        match self.path_mode() {
            PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm),
            } => PIECE_R * tolerance_mm,
            _ => self.options.spline_tolerance_mm,
        }
    }

    /// Gives out a curve, piece by piece, at the feedrate; `circle` if it is an arc. It starts where the last
    /// move ended.
    pub(super) fn push_curve(
        &mut self,
        block: &Block,
        curve: Nurbs,
        circle: Option<Circle>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let error_mm = self.piece_error_mm();
        let path = NurbsPath::new(curve);
        let start = self.state.path_end;
        let segments = path.segments(error_mm);
        let (low, high) = segments
            .iter()
            .fold((start, start), |(low, high), segment| {
                let (from, to) = segment.bounding_box();
                (low.inf(&from), high.sup(&to))
            });
        self.check_limits(block, &low, &high, "a point")?;
        let farthest = Segment::line(low, high);
        let length = path.length();
        let speed = match circle.filter(|_| self.has_feeds_of_fanuc(block)) {
            Some(Circle { radius_mm, flat_mm }) => {
                self.speed_of_arc(block, radius_mm, length / flat_mm)?
            }
            None => self.speed(block, &farthest, Pace::Feed)?,
        };
        let speed = match speed {
            // The whole curve is one move.
            Speed::Moves(per_minute) => Speed::Feed(length * per_minute / 60.0),
            speed => speed,
        };
        for segment in segments {
            self.push_move(segment, speed, out);
        }
        Ok(())
    }
}
