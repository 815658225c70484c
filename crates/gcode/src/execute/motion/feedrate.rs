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
use crate::execute::helix_share::share_of_arc;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::{Pace, Speed};
use crate::execute::state::modal::Feed;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::FeedMode;

impl Interpreter {
    /// Speed of a move along a segment, or one like it.
    pub(crate) fn speed(&self, block: &Block, segment: &Segment, pace: Pace) -> Outcome<Speed> {
        if pace == Pace::Rapid {
            return Ok(Speed::Rapid);
        }
        let share = self.share_of_feed(block, segment);
        if let Segment::Arc(arc) = segment {
            let radius_mm = 0.5 * (arc.start_radius() + arc.end_radius());
            return self.speed_of_arc(block, radius_mm, share);
        }
        if self.state.modal.feed_mode == FeedMode::InverseTime {
            return self.moves_per_minute(block).map(Speed::Moves);
        }
        let feed = self.feed_in_force(block)?;
        self.speed_at(
            block,
            feed.of_line(&segment.start(), &segment.end()) * share,
        )
    }

    /// Speed of an arc of that radius, whose path is `share` times as long as its way in the plane.
    pub(super) fn speed_of_arc(&self, block: &Block, radius_mm: f64, share: f64) -> Outcome<Speed> {
        if self.state.modal.feed_mode != FeedMode::InverseTime {
            let feed = self.feed_in_force(block)?;
            return self.speed_at(block, feed.linear_v * share);
        }
        let per_minute = self.moves_per_minute(block)?;
        if self.has_feeds_of_fanuc(block) {
            return Ok(Speed::Feed(per_minute * radius_mm / 60.0 * share));
        }
        if block.dialect == Dialect::Fanuc && !self.options.fanuc.is_haas() && self.follows_tip() {
            return Err(timed_arc(block));
        }
        Ok(Speed::Moves(per_minute))
    }

    /// F of a block in G93.
    fn moves_per_minute(&self, block: &Block) -> Outcome<f64> {
        block.get(b'F').ok_or_else(|| {
            BlockDiagnostic::new(
                DiagnosticCode::MissingFeed,
                block.motion_span(),
                "no F in an inverse-time block",
            )
            .because("with G93 every feed move has its own F: one over its minutes")
            .help("add the F word, or go back to G94")
        })
    }

    fn feed_in_force(&self, block: &Block) -> Outcome<Feed> {
        self.state.modal.feed.ok_or_else(|| {
            let why = if self.state.fanuc.lead_mm.is_some() {
                "the F in force is the lead of a thread, and what that is as a feed per minute is not known here"
            } else {
                "no F word came before it since the program, or its feed mode, began"
            };
            BlockDiagnostic::new(
                DiagnosticCode::MissingFeed,
                block.motion_span(),
                "a feed move without a feedrate",
            )
            .because(why)
            .help("write an F word")
        })
    }

    /// Speed at a feed along the path, per minute or per revolution.
    fn speed_at(&self, block: &Block, feed: f64) -> Outcome<Speed> {
        if self.state.modal.feed_mode == FeedMode::PerMinute {
            return Ok(Speed::Feed(feed));
        }
        let speed = self.state.spindle.speed;
        // Programs of Haas' lathes have G53 behind M5 with G1 in force.
        if self.state.spindle.is_stopped && !block.has_machine_coordinates() {
            let message = "a feed per revolution of a spindle that stands";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Spindle,
                block.motion_span(),
                message,
            )
            .because("M5 has stopped it, and the control would wait for it")
            .help("write M3 or M4 before the move, or a feed per minute (G94; G98 on a FANUC's lathe)"));
        }
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
    /// followed F is its feed. A tilted plane is a frame: F is what it is without one.
    pub(crate) fn has_feeds_of_fanuc(&self, block: &Block) -> bool {
        block.dialect == Dialect::Fanuc && !self.options.fanuc.is_haas() && !self.follows_tip()
    }

    /// True where the program has the tip of the tool followed (G43.4).
    fn follows_tip(&self) -> bool {
        let state = &self.state;
        self.options.five_axis.is_some() && state.tip.follows() && state.tilted.is_none()
    }

    /// The rate of path position over F.
    fn share_of_feed(&self, block: &Block, segment: &Segment) -> f64 {
        if !self.has_feeds_of_fanuc(block) {
            return 1.0;
        }
        let all = match segment {
            Segment::Arc(arc) => return share_of_arc(arc),
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
            Segment::Curve(_) => return 1.0,
        };
        if all > 0.0 {
            segment.length() / all
        } else {
            1.0
        }
    }
}

#[cold]
fn timed_arc(block: &Block) -> Box<BlockDiagnostic> {
    let message = "an arc in inverse time (G93) with the tip of the tool followed";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, block.motion_span(), message)
        .because(
            "F over the radius, or one over the minutes of the whole move: which of them F is beside G43.4 is not known",
        )
        .help("write G94, or the arc in lines")
}
