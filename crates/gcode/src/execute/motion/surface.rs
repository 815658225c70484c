//! Straight moves with a cutting speed (G96): in parts, so that the spindle is told on the way.
//!
//! ```text
//!   n │            ┌──   D
//!     │        ┌───┘
//!     │  ┌─────┘          S / (2 π |x|), told anew where it differs by a hundredth from what
//!     │──┘                was told, no sooner than after a twentieth of a second
//!     └──────────────▶ way to the middle
//! ```

use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::{Pace, Speed};
use crate::syntax::block::Block;

/// The least time between two speeds, s.
const LEAST_T: f64 = 0.05;
/// Most places of a move at which the speed is looked at.
const MOST_PLACES: f64 = 10_000.0;

impl Interpreter {
    /// A straight move at feed from where the tool is, in the parts that G96 cuts it into.
    pub(crate) fn straight_at_surface(
        &mut self,
        block: &Block,
        end: AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let start = self.state.path_end;
        let whole = Segment::line(start, end);
        let speed = self.speed(block, &whole, Pace::Feed)?;
        let (Speed::Feed(feed_v) | Speed::PerRevolution(feed_v)) = speed else {
            // The time of the move is given.
            self.push_move(whole, speed, out);
            return Ok(());
        };
        let places = (whole.length() / (LEAST_T * feed_v)).floor();
        let places = places.clamp(1.0, MOST_PLACES);
        let mut place = 1.0;
        while place < places {
            let here = start + (end - start) * (place / places);
            if self.is_surface_speed_new(here) {
                self.push_to(block, here, out)?;
                self.follow_surface_at(here, out);
            }
            place += 1.0;
        }
        self.push_to(block, end, out)
    }

    fn push_to(&mut self, block: &Block, end: AxisVector, out: &mut Vec<Item>) -> Outcome<()> {
        let segment = Segment::line(self.state.path_end, end);
        let speed = self.speed(block, &segment, Pace::Feed)?;
        self.push_move(segment, speed, out);
        Ok(())
    }
}
