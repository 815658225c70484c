//! Feed mode and F.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::execute::interpreter::Interpreter;
use crate::execute::state::modal::Feed;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{FeedMode, Motion};

impl Interpreter {
    /// Feed mode and F.
    pub(crate) fn feed(&mut self, block: &Block, motion: Option<Motion>) -> Outcome<()> {
        let modal = &mut self.state.modal;
        if let Some(Coded { code, .. }) = block.codes.feed_mode {
            if modal.feed_mode != code {
                // The F of one mode means nothing in the other.
                modal.feed = None;
            }
            modal.feed_mode = code;
        }
        // On a FANUC the F of a thread is its pitch.
        let is_pitch = block.dialect == Dialect::Fanuc
            && matches!(motion, Some(Motion::Thread | Motion::ThreadCycle));
        let Some(feed) = block.get(b'F').filter(|_| !is_pitch) else {
            return Ok(());
        };
        if feed <= 0.0 {
            let message = format!("the feedrate F{feed} is not above zero");
            return Err(
                Fault::new(DiagnosticCode::BadFeed, block.span(b'F'), message)
                    .because("a move at that feedrate would never end")
                    .help("write a positive feedrate; use M0 to stop"),
            );
        }
        let per_second = match modal.feed_mode {
            FeedMode::PerMinute => 60.0,
            FeedMode::PerRevolution => 1.0,
            FeedMode::InverseTime => return Ok(()),
        };
        modal.feed = Some(Feed {
            linear_v: feed * modal.units.mm() / per_second,
            rotary_v: feed / per_second,
        });
        Ok(())
    }
}
