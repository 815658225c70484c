//! Overrides that the program switches: M48 to M53.

use glidepath_program::{CodeWord, Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::setup::options::AdaptiveFeed;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::refused::refused_m;
use crate::syntax::word_check::whole;

/// Refuses a code that switches one override: M50 to M53.
#[cold]
fn override_refused(code: u32, block: &Block, span: SourceSpan) -> Box<BlockDiagnostic> {
    let (what, help) = match code {
        50 => ("the feed override", "remove it, or write M48 after an M49"),
        51 => (
            "the spindle override",
            "remove it, or write M48 after an M49",
        ),
        52 if block.get(b'P') == Some(0.0) => (
            "adaptive feed",
            "remove it, or remove always = true from [adaptive_feed] of the configuration",
        ),
        52 => (
            "adaptive feed",
            "remove it, or write the table [adaptive_feed] into the configuration",
        ),
        _ => (
            "the feed stop input",
            "remove it; the operator holds the motion",
        ),
    };
    let switch = if block.get(b'P') == Some(0.0) {
        "off"
    } else {
        "on"
    };
    let message = format!("M{code} that switches {what} {switch} is not supported");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "nothing here switches it alone, and skipping it could change what the machine does",
        )
        .help(help)
}

impl Interpreter {
    /// M48 to M53. An override that is as the block wants it needs nothing.
    pub(super) fn overrides(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(Coded { code, span }) = block.codes.overrides else {
            return Ok(());
        };
        if matches!(code, 48 | 49) {
            self.state.overrides_off = code == 49;
            self.push_passing_code(code, out);
            return Ok(());
        }
        if block.dialect != Dialect::LinuxCnc {
            return Err(refused_m(code, f64::from(code), span));
        }
        let on = whole(block, b'P', 1)? != Some(0);
        let adaptive = self.options.adaptive_feed;
        if code == 52 && adaptive == AdaptiveFeed::Switched {
            let value = f64::from(u8::from(on));
            let word = CodeWord::P;
            self.push(out, ItemKind::Event(Event::CodeWord { word, value }));
            self.push(out, ItemKind::Event(Event::MCode(code)));
            return Ok(());
        }
        let is_so = match code {
            50 | 51 => on && !self.state.overrides_off,
            52 => on == (adaptive == AdaptiveFeed::Always),
            _ => !on,
        };
        if is_so {
            Ok(())
        } else {
            Err(override_refused(code, block, span))
        }
    }
}
