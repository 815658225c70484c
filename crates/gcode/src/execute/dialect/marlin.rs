//! Functions of a printer's machine: heaters, fans, messages.

use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;

/// True for an M code whose line goes on with text to show.
const fn shows_text(number: u32) -> bool {
    matches!(number, 117 | 118)
}

impl Interpreter {
    /// A block with a function of the machine: nothing else of it is executed.
    pub(crate) fn machine_function(
        &mut self,
        block: &Block,
        number: u32,
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let other = block.codes.motion.map(|c| c.span);
        let other = other.or_else(|| block.codes.non_modal.map(|c| c.span));
        if let Some(span) = other {
            let message = format!("a G code beside M{number}");
            return Err(Fault::new(DiagnosticCode::AmbiguousWord, span, message)
                .because("M codes of printers take the words of their block")
                .help("write two blocks"));
        }
        if number == 400 || shows_text(number) {
            // M400 waits for the end of the motion, and a message is shown at rest.
            self.push(out, ItemKind::Event(Event::MCode(number)));
            return Ok(());
        }
        self.require_connection(span, "heater, fan or printer setting")?;
        self.push(out, ItemKind::Event(Event::MCode(number)));
        Ok(())
    }
}
