//! Probing: G38.2 to G38.5.
//!
//! No probe is read here, so these are refused unless the program is read with
//! [`crate::Connections::Simulated`]. Then the probe makes contact exactly at the end of its move:
//! the move is a feed move that comes to rest, and `#5061` to `#5070` tell of it.

use glidepath_geometry::AXES;
use glidepath_program::{Item, PathMode};

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::execute::state::probe_result::ProbeResult;
use crate::setup::options::Connections;
use crate::syntax::block::Block;
use crate::syntax::modes::FeedMode;

impl Interpreter {
    pub(crate) fn probe(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        if self.options.connections == Connections::Real {
            return Err(no_probe(span));
        }
        self.require_connection(span, "probe")?;
        if self.state.modal.feed_mode != FeedMode::PerMinute {
            let message = "probing needs a feedrate per minute";
            return Err(Fault::new(DiagnosticCode::MissingFeed, span, message)
                .because("the move ends where contact is made, so its time is not known")
                .help("write G94"));
        }
        let target = self.target(block)?;
        let far = (0..AXES).any(|axis| (target[axis] - self.state.position[axis]).abs() > MIN_MOVE);
        if !far {
            let message = "the probe would not move";
            return Err(Fault::new(DiagnosticCode::InvalidValue, span, message)
                .because("the end of the move is where the machine stands")
                .help("write an end in the direction of the part"));
        }
        let mode = core::mem::replace(&mut self.state.modal.path_mode, PathMode::ExactStop);
        let moved = self.straight(block, target, Pace::Feed, out);
        self.state.modal.path_mode = mode;
        moved?;
        self.state.probe = ProbeResult {
            contact: self.offsets.to_program(target),
            made: true,
        };
        Ok(())
    }
}

fn no_probe(span: SourceSpan) -> Box<Fault> {
    Fault::new(DiagnosticCode::NotConnected, span, "no probe is connected")
        .because("inputs are the machine's, and no probe is read among them")
        .help("remove the block, or read the program with simulated inputs and outputs")
}
