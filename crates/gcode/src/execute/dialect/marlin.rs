//! Lines of printers, and the functions of their machines: heaters, fans, messages.

use std::io::BufRead;

use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::line_origin::LineOrigin;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::syntax::block::Block;
use crate::syntax::dialect::marlin::verified;

/// True for an M code whose line goes on with text to show.
const fn shows_text(number: u32) -> bool {
    matches!(number, 117 | 118)
}

impl<R: BufRead> Program<R> {
    /// Reads and executes the next line; false at the end.
    pub(crate) fn read_marlin(&mut self) -> Outcome<bool> {
        self.origin = LineOrigin::Stream;
        if !self.source.advance()? {
            return self.end_of_input();
        }
        if self.is_deleted() {
            return Ok(true);
        }
        let number = self.source.number();
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let text = verified(self.source.text())?;
        let parsed = self.block.parse(text, &scope);
        self.execute_parsed(number, parsed)
    }
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
