//! Lines of the dialects whose programs do not jump.

use std::io::BufRead;

use crate::diagnostic::fault::Outcome;
use crate::execute::line_origin::LineOrigin;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::syntax::dialect::{Dialect, marlin, siemens};

impl<R: BufRead> Program<R> {
    /// A line of a dialect without flow.
    pub(crate) fn read_without_flow(&mut self) -> Outcome<bool> {
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
        if self.interpreter.options.dialect == Dialect::Marlin {
            let text = marlin::verified(self.source.text())?;
            let parsed = self.block.parse(text, &scope);
            return self.execute_parsed(number, parsed);
        }
        let line = siemens::rewrite(self.source.text())?;
        let parsed = self.block.parse(&line.text, &scope);
        self.execute_parsed(number, parsed).map_err(|mut fault| {
            fault.span = line.origin(fault.span);
            fault
        })
    }
}
