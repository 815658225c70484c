//! The reading of a program line by line, and its items as an iterator.

use std::io::BufRead;
use std::mem;

use glidepath_program::Item;

use crate::diagnostic::Diagnostic;
use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::line_origin::LineOrigin;
use crate::execute::motion::tangent_arc::direction_behind;
use crate::execute::program::Program;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::other::name_dialects;

impl<R: BufRead> Program<R> {
    /// Reads the next line and executes it; its items replace those of the line before.
    ///
    /// `None` after the end. A line with a diagnostic has no effect on the state, and the next line
    /// can be read, unless what follows depends on it: a diagnostic that is fatal, or in an O word,
    /// a subroutine or a loop ends the program.
    pub(crate) fn next_line(&mut self) -> Option<Result<(), Diagnostic>> {
        self.items.clear();
        self.given = 0;
        if self.ended {
            return None;
        }
        if let Some(question) = &self.interpreter.options.question {
            self.ended = true;
            return Some(Err(question.diagnostic()));
        }
        if self.is_typed && !self.has_kept_lines() {
            match self.source.has_line() {
                Ok(true) => {}
                Ok(false) => return None,
                Err(fault) => {
                    self.ended = true;
                    return Some(Err(self.here().diagnostic(*fault)));
                }
            }
        }
        if let Some(watch) = &self.interpreter.options.watch {
            watch.come_to(self.line_of_program());
            if watch.is_to_end() {
                self.ended = true;
                return Some(Err(self.here().diagnostic(ended())));
            }
        }
        let goes_on = mem::take(&mut self.was_straight);
        let result = self.read_line(goes_on);
        self.totals.lines = self.source.number();
        match result {
            Ok(true) => Some(Ok(())),
            Ok(false) => {
                self.ended = true;
                // What cutter radius compensation still held back is given out now.
                (!self.items.is_empty()).then_some(Ok(()))
            }
            Err(mut fault) => {
                let here = self.here();
                let options = &self.interpreter.options;
                name_dialects(&mut fault, &here.text, options.dialect, &options.machine);
                let kept = matches!(self.origin, LineOrigin::Kept(..) | LineOrigin::Past(..));
                self.ended |= kept || fault.code.is_fatal();
                Some(Err(here.diagnostic(*fault)))
            }
        }
    }

    /// Whether what comes next was read before: lines of structures, of subprograms, of a pattern.
    fn has_kept_lines(&self) -> bool {
        !self.flow.activations.is_empty()
            || !self.siemens.steps.is_empty()
            || self.tape.get(self.tape.next).is_some()
    }

    // Once a line: the call alone saved and restored what a sixteenth of a plain line takes.
    #[inline(always)]
    fn read_line(&mut self, goes_on: bool) -> Outcome<bool> {
        match self.interpreter.options.dialect {
            Dialect::LinuxCnc => self.read_linuxcnc(goes_on),
            Dialect::Fanuc => {
                let read = self.read_fanuc();
                if read.is_err() {
                    // Its number is that of no block that was executed.
                    self.sequence = None;
                }
                read
            }
            Dialect::Siemens => {
                let read = self.read_siemens();
                if let Some(direction) = direction_behind(&self.items) {
                    self.interpreter.state.tangent = Some(direction);
                }
                read
            }
            Dialect::Marlin => self.read_marlin(),
        }
    }
}

/// Whoever watches has ended the reading.
fn ended() -> BlockDiagnostic {
    let message = "the reading was ended".to_owned();
    let fault = BlockDiagnostic::new(DiagnosticCode::ReadFailed, SourceSpan::default(), message);
    *fault
        .because("whoever wanted the program does not want it any more")
        .help("read it again")
}

impl<R: BufRead> Iterator for Program<R> {
    type Item = Result<Item, Diagnostic>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(item) = self.items.get(self.given) {
                if let Some(awaited) = self.awaited.before(item) {
                    return Some(Ok(awaited));
                }
                self.given += 1;
                return Some(Ok(*item));
            }
            if let Some(awaited) = self.awaited.behind_block() {
                return Some(Ok(awaited));
            }
            match self.next_line() {
                Some(Ok(())) => {}
                Some(Err(diagnostic)) => {
                    self.ended |= !self.is_typed;
                    return Some(Err(diagnostic));
                }
                // Another line may go on from here: one that was typed.
                None if self.ran_out => return self.awaited.behind_input().map(Ok),
                None => return None,
            }
        }
    }
}
