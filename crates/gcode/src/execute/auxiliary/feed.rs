//! Feed mode and F.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::execute::interpreter::Interpreter;
use crate::execute::state::modal::Feed;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{FeedMode, Motion, Turning};

impl Interpreter {
    /// The unit of length that F counts in, mm.
    pub(crate) const fn feed_unit_mm(&self) -> f64 {
        if self.state.feeds_in_mm {
            1.0
        } else {
            self.state.modal.units.mm()
        }
    }

    /// Feed mode and F.
    pub(crate) fn feed(&mut self, block: &Block, motion: Option<Motion>) -> Outcome<()> {
        let modal = &mut self.state.modal;
        if let Some(Coded { code, .. }) = block.codes.feed_mode {
            if modal.feed_mode != code {
                // The F of one mode means nothing in the other.
                modal.feed = None;
            }
            modal.feed_mode = code;
            self.state.fanuc.is_feed_unsaid = false;
        }
        // On a FANUC the F of a thread is its pitch.
        let is_pitch = block.dialect == Dialect::Fanuc
            && matches!(
                motion,
                Some(Motion::Thread | Motion::ThreadCycle | Motion::Turning(Turning::Thread))
            );
        // On a printer the F of G61 is that of its move alone.
        let is_own = is_pitch || block.codes.kept_place.is_some();
        let Some(feed) = block.get(b'F').filter(|_| !is_own) else {
            return Ok(());
        };
        if self.state.fanuc.is_feed_unsaid && block.is_lathe {
            return Err(unsaid(block));
        }
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
        // On other controls than LinuxCNC the unit in the block counts for its F, too.
        let written = block
            .codes
            .units
            .filter(|_| block.dialect != Dialect::LinuxCnc);
        let (units, in_mm) = match written {
            Some(coded) => (coded.code, block.codes.feeds_in_mm),
            None => (modal.units, self.state.feeds_in_mm),
        };
        let unit_mm = if in_mm { 1.0 } else { units.mm() };
        modal.feed = Some(Feed {
            linear_v: feed * unit_mm / per_second,
            rotary_v: feed / per_second,
        });
        Ok(())
    }
}

#[cold]
fn unsaid(block: &Block) -> Box<Fault> {
    let message = "F before G98 or G99";
    Fault::new(DiagnosticCode::AmbiguousWord, block.span(b'F'), message)
        .because("lathes begin with a feed per revolution or per minute, as a parameter of theirs says (3402#4)")
        .help("write G99 (per revolution) or G98 (per minute) in front of it")
}
