//! MCALL: a cycle or a subprogram that is called behind every move.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::dialect::siemens::steps::ModalCall;
use crate::execute::dialect::siemens::subprogram::arguments_ahead;
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::callee::{Callee, callee};
use crate::syntax::dialect::siemens::statement::{Statement, name_at, statement};

impl<R: BufRead> Program<R> {
    /// MCALL: the cycle behind it is made at the end of every move from now on, or none.
    pub(super) fn siemens_modal_call(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        if input.is_at_end() {
            self.siemens.modal_call = None;
            return Ok(());
        }
        let start = input.at;
        let tail = text.get(start..).unwrap_or_default();
        if statement(tail) != (Statement::Cycle, 0) {
            let is_name = statement(tail).0 == Statement::Block;
            if is_name && self.siemens_modal_subprogram(text, start)? {
                return Ok(());
            }
            let name = name_at(text, start);
            let span = SourceSpan::new(start, start + name.len().max(1));
            let shown = String::from_utf8_lossy(name).into_owned();
            let message = format!("MCALL of {shown} is not supported");
            return Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because(
                    "cycles of holes, pockets and spigots, and subprograms can be called at every move",
                )
                .help("use one of these"));
        }
        let (call, span) = self.siemens_call(text, start)?;
        // What is wrong with it is said here, not at the next move.
        self.cycle_lines(Arguments { call: &call, span })?;
        self.siemens.modal_call = Some(ModalCall::Cycle(call));
        Ok(())
    }

    /// MCALL of a subprogram; false if it is none.
    fn siemens_modal_subprogram(&mut self, text: &[u8], start: usize) -> Outcome<bool> {
        let tail = text.get(start..).unwrap_or_default();
        let Some(callee) = callee(tail).filter(|callee| callee.start == 0) else {
            return Ok(false);
        };
        let callee = Callee {
            start,
            end: start + callee.end,
            ..callee
        };
        let Some(first) = self.siemens_subprogram(&callee)? else {
            return Ok(false);
        };
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, callee.end);
        let mut arguments = arguments_ahead(&mut input)?;
        check_end(&mut input)?;
        // A variable may be gone where a move calls it, so it has the value of now.
        for argument in arguments.iter_mut().flatten() {
            argument.variable = None;
        }
        // What is wrong with it is said here, not at the next move.
        let span = SourceSpan::new(callee.start, callee.end);
        self.siemens_check_arguments(first, &arguments, span)?;
        self.siemens.modal_call = Some(ModalCall::Subprogram(first, arguments));
        Ok(true)
    }

    /// Makes what MCALL calls at the end of a move.
    pub(super) fn siemens_call_again(&mut self, span: SourceSpan) -> Outcome<()> {
        match self.siemens.modal_call.clone() {
            Some(ModalCall::Cycle(call)) => self.siemens_begin(&call, span),
            Some(ModalCall::Subprogram(first, arguments)) => {
                // Its own moves call nothing.
                let modal = self.siemens.modal_call.take();
                self.siemens_enter((first, 1), arguments, modal, span)
            }
            None => Ok(()),
        }
    }
}
