//! G66: a macro that is called behind every block that moves, until G67. Blocks of subprograms (M98, M97)
//! are such blocks, too; those of macros are not. Its local variables are set in the block of G66 alone: each call
//! finds them as the one before has left them (FANUC, B-63944EN, modal call).

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::macro_call::{Arguments, ModalMacro};
use crate::execute::dialect::tape::TapePlace;
use crate::execute::program::Program;
use crate::syntax::dialect::fanuc::{Call, Statement, statement};
use crate::syntax::dialect::line_body::body;
use crate::syntax::modes::NonModal;

impl<R: BufRead> Program<R> {
    pub(super) fn begin_modal_macro(
        &mut self,
        first: TapePlace,
        turns: u32,
        arguments: Arguments,
        span: SourceSpan,
    ) -> Outcome<()> {
        if self.modal_macro.is_some() {
            let message = "a second G66 before G67";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("macros that call each other behind their moves are not made")
                    .help("write G67 before it"),
            );
        }
        self.modal_macro = Some(ModalMacro {
            first,
            turns,
            arguments,
            level: self.tape.calls.len(),
        });
        self.interpreter.state.fanuc.calls_macro = true;
        Ok(())
    }

    /// G67, and the other words of its block: behind their move no macro is called any more.
    pub(super) fn end_modal_macro(&mut self, text: &[u8], call: Call) -> Outcome<bool> {
        let blank = |(at, byte): (usize, &u8)| {
            let is_code = (call.start..call.end).contains(&at);
            if is_code { b' ' } else { *byte }
        };
        let rest: Vec<u8> = text.iter().enumerate().map(blank).collect();
        if let Statement::Call(other) = statement(&rest).0 {
            let span = SourceSpan::new(other.start, other.end);
            let message = "another call in the block of G67";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("which of them comes first is not clear")
                    .help("write it into a block of its own"),
            );
        }
        let before = self.modal_macro.take();
        let calls_macro = core::mem::take(&mut self.interpreter.state.fanuc.calls_macro);
        if body(&rest) >= rest.trim_ascii_end().len() {
            return Ok(true);
        }
        let made = self.fanuc_text(self.line_of_program(), &rest);
        if made.is_err() {
            self.modal_macro = before;
            self.interpreter.state.fanuc.calls_macro = calls_macro;
        }
        made
    }

    /// Refuses a move in the block of another call: the macro would come between the two.
    pub(super) fn check_move_beside_call(&self, span: SourceSpan) -> Outcome<()> {
        if self.modal_macro.is_none() || !self.block.has_axes() {
            return Ok(());
        }
        let message = "a move in the block of a call while G66 is in force";
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("the macro of G66 is called behind it, before the call of its block")
                .help("write the move into a block before the call"),
        )
    }

    /// Calls the macro behind a block that moved.
    pub(super) fn call_modal_macro(&mut self) -> Outcome<()> {
        let codes = &self.block.codes;
        let moves = self.block.has_axes()
            && codes
                .non_modal
                .is_none_or(|code| code.code == NonModal::MachineCoordinates)
            && codes.frame.is_none();
        let is_within = |called: &&ModalMacro| {
            let calls = self.tape.calls.get(called.level..);
            calls.is_some_and(|calls| calls.iter().all(|call| !call.own_parameters))
        };
        let called = self.modal_macro.as_ref().filter(|_| moves);
        let Some(called) = called.filter(is_within) else {
            return Ok(());
        };
        let ModalMacro {
            first,
            turns,
            arguments,
            ..
        } = called.clone();
        self.enter_subprogram(first, turns, Some(&arguments))
            .inspect_err(|_| self.end())?;
        if let Some(call) = self.tape.calls.last_mut().filter(|_| turns > 0) {
            call.keeps_locals = true;
        }
        Ok(())
    }

    /// Keeps the locals of the macro, whose call was the last one and has ended.
    pub(super) fn keep_locals_of_modal_macro(&mut self) {
        let depth = self.tape.calls.len();
        // A G66 of the macro itself is deeper.
        if let Some(called) = self
            .modal_macro
            .as_mut()
            .filter(|called| called.level <= depth)
        {
            called.arguments = self.parameters.locals();
        }
    }
}
