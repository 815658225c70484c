//! G70 of a lathe: the blocks of a profile as they stand, and back to where the tool was.
//!
//! G41 or G42 may be on, or begin and end in the blocks. What is on begins with the profile, ends with
//! it, and is on again behind it.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::tape::{Finishing, TapePlace};
use crate::execute::motion::speed::Pace;
use crate::execute::program::Program;
use crate::syntax::block::Block;
use crate::syntax::letters::Letters;

impl<R: BufRead> Program<R> {
    /// G70: goes to the profile; [`Program::end_finishing`] comes back.
    pub(super) fn finish_profile(
        &mut self,
        block: &Block,
        [first, last]: [usize; 2],
    ) -> Outcome<()> {
        if let Some((letter, span)) = block.unused(Letters::of(b"PQFS")) {
            return Err(nothing_of_a_finish(letter, span));
        }
        if self.finishing.is_some() {
            let message = "a cycle in the profile of another one";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::CannedCycle,
                block.motion_span(),
                message,
            )
            .because("a profile is drawn by G0, G1, G2 and G3 alone")
            .help("write it behind block Q"));
        }
        let start = self.interpreter.state.position;
        if self.interpreter.state.open.compensation.is_some() {
            // It begins anew with the profile.
            let items = &mut self.items;
            self.interpreter
                .rapid_without_compensation(block, start, items)?;
        }
        let back = self.tape.place();
        self.finishing = Some(Finishing {
            end: TapePlace {
                line: last + 1,
                ..back
            },
            back,
            start,
        });
        self.tape.go_to(TapePlace {
            line: first,
            ..back
        });
        Ok(())
    }

    /// Behind the last block of the profile of G70: back to where the tool was.
    pub(super) fn end_finishing(&mut self) -> Outcome<()> {
        let Some(finishing) = self.finishing.take_if(|it| it.end == self.tape.place()) else {
            return Ok(());
        };
        let mut items = Vec::new();
        let block = self.block.clone();
        let span = block.first_span();
        self.interpreter
            .settle_corner_before(&block, span, &mut items)?;
        if self.interpreter.state.open.compensation.is_some() {
            self.interpreter
                .rapid_without_compensation(&block, finishing.start, &mut items)?;
        } else {
            self.interpreter
                .straight(&block, finishing.start, Pace::Rapid, &mut items)?;
        }
        self.items = items;
        self.end_of_line();
        self.tape.go_to(finishing.back);
        Ok(())
    }
}

#[cold]
fn nothing_of_a_finish(letter: char, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("{letter} in G70");
    BlockDiagnostic::new(DiagnosticCode::UnusedWord, span, message)
        .because("G70 goes along the profile as it stands: what a control would make of an allowance or a depth is not known here")
        .help("remove the word: what is to be left belongs into G71, and what is to be cut into the profile")
}
