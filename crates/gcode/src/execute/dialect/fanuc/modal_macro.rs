//! G66: a macro that is called behind every block that moves, until G67. Blocks of subprograms (M98, M97)
//! are such blocks, too; those of macros are not.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::macro_call::{Arguments, ModalMacro};
use crate::execute::dialect::tape::TapePlace;
use crate::execute::program::Program;
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

    pub(super) fn end_modal_macro(&mut self) {
        self.modal_macro = None;
        self.interpreter.state.fanuc.calls_macro = false;
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
            .inspect_err(|_| self.end())
    }
}
