//! The feedrate of a block's move.
//!
//! F of a line is the feed along X, Y and Z, and the rotary axes follow. On a FANUC it is that of all axes, degrees
//! counted as millimetres (as inches in G20):
//!
//! ```text
//! G91 G1 X20 C40 F300      √(20² + 40²) / 300 minutes
//! ```
//!
//! In G93 F is one over the minutes of a move; on a FANUC F times its radius is the feed of an arc, "not from the actual
//! distance of movement in the block but from the arc radius", as its manual says.
//!
//! F of a helix is the feed along it; on a FANUC it is that of its arc in the plane, beside which the third axis goes
//! its way (parameter 1403#5 = 0).

use glidepath_geometry::{LINEAR_XYZ, ROTARY_ABC, Segment, UVW};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::{Pace, Speed};
use crate::setup::fanuc::OffsetMemory;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
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
            return Ok(match segment {
                Segment::Arc(arc) if self.has_feeds_of_fanuc(block) => {
                    let radius = 0.5 * (arc.start_radius() + arc.end_radius());
                    let feed = per_minute * radius / 60.0;
                    Speed::Feed(feed * self.share_of_feed(block, segment))
                }
                _ => Speed::Moves(per_minute),
            });
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
        let feed = feed * self.share_of_feed(block, segment);
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

    /// True where F is a FANUC's. What a Haas makes of it depends on its settings; where the tip of the tool is
    /// followed F is its feed.
    fn has_feeds_of_fanuc(&self, block: &Block) -> bool {
        let is_haas = self.options.fanuc.offset_memory == OffsetMemory::Haas;
        let follows = self.options.five_axis.is_some() && self.state.tip.follows();
        block.dialect == Dialect::Fanuc && !is_haas && !follows
    }

    /// The rate of path position over F.
    fn share_of_feed(&self, block: &Block, segment: &Segment) -> f64 {
        if !self.has_feeds_of_fanuc(block) {
            return 1.0;
        }
        let length = segment.length();
        let all = match segment {
            Segment::Arc(arc) => {
                let rise = arc.end - arc.start;
                let rise = rise[arc.plane.normal().index()];
                (length * length - rise * rise).max(0.0).sqrt()
            }
            Segment::Line(line) => {
                let way = line.end - line.start;
                let is_turn_alone = LINEAR_XYZ.chain(UVW).all(|axis| way[axis] == 0.0);
                if is_turn_alone {
                    return 1.0;
                }
                let mm = self.state.modal.units.mm();
                let squares = way.iter().enumerate().map(|(axis, way)| {
                    (if ROTARY_ABC.contains(&axis) {
                        way * mm
                    } else {
                        *way
                    })
                    .powi(2)
                });
                squares.sum::<f64>().sqrt()
            }
            _ => return 1.0,
        };
        if all > 0.0 { length / all } else { 1.0 }
    }
}
