//! The feedrate of a block's move.

use glidepath_geometry::Segment;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::{Pace, Speed};
use crate::syntax::block::Block;
use crate::syntax::modes::FeedMode;

impl Interpreter {
    /// Speed of a move along a segment, or one like it.
    pub(crate) fn speed(&self, block: &Block, segment: &Segment, pace: Pace) -> Outcome<Speed> {
        if pace == Pace::Rapid {
            return Ok(Speed::Rapid);
        }
        let modal = &self.state.modal;
        if modal.feed_mode == FeedMode::InverseTime {
            let per_minute = block.get(b'F').ok_or_else(|| {
                BlockDiagnostic::new(
                    DiagnosticCode::MissingFeed,
                    block.motion_span(),
                    "no F in an inverse-time block",
                )
                .because("with G93 every feed move has its own F: one over its minutes")
                .help("add the F word, or go back to G94")
            })?;
            return Ok(Speed::Moves(per_minute));
        }
        let feed = modal.feed.ok_or_else(|| {
            BlockDiagnostic::new(
                DiagnosticCode::MissingFeed,
                block.motion_span(),
                "a feed move without a feedrate",
            )
            .because("no F word came before it since the program, or its feed mode, began")
            .help("write an F word")
        })?;
        let feed = match segment {
            Segment::Arc(_) => feed.linear_v,
            _ => feed.of_line(&segment.start(), &segment.end()),
        };
        if modal.feed_mode == FeedMode::PerMinute {
            return Ok(Speed::Feed(feed));
        }
        let speed = self.state.spindle.speed;
        if speed <= 0.0 {
            let message = "a feed per revolution (G95) of a spindle without a speed";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Spindle,
                block.motion_span(),
                message,
            )
            .because("the move would never end")
            .help("write an S word above zero, or go back to G94"));
        }
        let feed_v = feed * speed / 60.0;
        Ok(match self.options.threading {
            Some(_) => Speed::PerRevolution(feed_v),
            None => Speed::Feed(feed_v),
        })
    }
}
