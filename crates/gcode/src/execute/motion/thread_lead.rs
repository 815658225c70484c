//! The lead of FANUC's threads: F, which stays in force as every F of that control does.
//!
//! ```text
//! G32 W-74.5 F4.      the first pass
//! G0 …
//! G32 W-74.5          the next one: F is still 4
//! ```
//!
//! There is one F. Per revolution (G99, in systems B and C and on mills G95) that of a thread is the feed of what
//! follows, and the other way round. Per minute the lead stays for threads alone, until a feed is written, and
//! what the F of a thread is as a feed per minute is not known: a move at feed behind it needs an F of its own.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::modes::{FeedMode, Motion};
use crate::syntax::word_check::missing;

const MEANING: &str = "the way of a revolution";

impl Interpreter {
    /// The lead of a thread, mm: F of the block, or the F in force.
    ///
    /// # Errors
    ///
    /// There is no F, the one in force counts per minute, or the thread is G32 of a Haas in G98.
    pub(crate) fn fanuc_lead_mm(&self, block: &Block, name: &str) -> Outcome<f64> {
        let modal = &self.state.modal;
        let is_per_minute = modal.feed_mode == FeedMode::PerMinute;
        let is_g98 = is_per_minute && !self.state.fanuc.is_feed_unsaid;
        let is_plain = block
            .codes
            .motion
            .is_some_and(|coded| coded.code == Some(Motion::Thread));
        if block.is_lathe && is_plain && is_g98 && self.options.fanuc.is_haas() {
            return Err(per_minute_of_haas(block, name));
        }
        if let Some(lead) = block.get(b'F') {
            return Ok(lead * modal.units.mm());
        }
        let per_revolution = modal
            .feed
            .filter(|_| modal.feed_mode == FeedMode::PerRevolution)
            .map(|feed| feed.linear_v);
        // A feed that was written since took its place, in whichever way its line was read.
        let of_threads = self.state.fanuc.lead_mm;
        let of_threads = of_threads.filter(|_| is_per_minute && modal.feed.is_none());
        if let Some(lead_mm) = per_revolution.or(of_threads) {
            return Ok(lead_mm);
        }
        let mut found = missing(block.motion_span(), name, "F", MEANING);
        if modal.feed.is_some() {
            found = found.because(format!(
                "{name} needs F: {MEANING}; the F in force is a feed per minute, and what such a feed is to a \
                 thread is not known here"
            ));
        }
        Err(found)
    }

    /// Takes F of a thread for the one in force.
    pub(crate) fn keep_lead(&mut self, block: &Block, lead: f64) {
        if lead <= 0.0 {
            return;
        }
        let units = block.codes.units.map(|coded| coded.code);
        let mm = units.unwrap_or(self.state.modal.units).mm();
        let is_feed = self.state.modal.feed_mode == FeedMode::PerRevolution;
        self.state.modal.feed = self.feed_of(block, lead).filter(|_| is_feed);
        self.state.fanuc.lead_mm = Some(lead * mm);
    }
}

/// The code of a thread of one block or several, as its program writes it.
pub(super) const fn thread_name(block: &Block) -> &'static str {
    if block.has_increments() { "G32" } else { "G33" }
}

#[cold]
fn per_minute_of_haas(block: &Block, name: &str) -> Box<BlockDiagnostic> {
    let message = format!("{name} of a Haas with a feed per minute (G98)");
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.motion_span(), message)
        .because("its manual asks for G99 there, and does not say what F is without it")
        .help("write G99 before it")
}
