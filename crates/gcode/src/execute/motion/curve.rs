//! The pieces of a curve, given out as items.

use glidepath_geometry::{Nurbs, NurbsPath, Segment};
use glidepath_program::{Item, PathMode};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::{Pace, Speed};
use crate::syntax::block::Block;

/// Share of the tolerance of G64 P that the pieces of a curve may be away from it.
const PIECE_R: f64 = 1e-3;

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

    /// Gives out a curve, piece by piece, at the feedrate. It starts where the last move ended.
    pub(super) fn push_curve(
        &mut self,
        block: &Block,
        curve: Nurbs,
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
        let speed = match self.speed(block, &farthest, Pace::Feed)? {
            // The whole curve is one move.
            Speed::Moves(per_minute) => Speed::Feed(path.length() * per_minute / 60.0),
            speed => speed,
        };
        for segment in segments {
            self.push_move(segment, speed, out);
        }
        Ok(())
    }
}
