//! The contour that a cycle names: a subprogram, or the part of the program between two labels.
//!
//! ```text
//! CYCLE95("SHAFT", …)         SHAFT.SPF, or behind %_N_SHAFT_SPF, up to M17 or RET
//! CYCLE95("START:END", …)     from the block with START: to that with END:
//! ```
//!
//! Its blocks move nothing: they are drawn, with the values that variables have at the cycle.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::named_call::no_name;
use crate::execute::dialect::siemens::read_line::{with_block_number, without_label};
use crate::execute::dialect::tape::TapePlace;
use crate::execute::lathe_cycle::profile::LatheProfile;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::syntax::block::CornerKind;
use crate::syntax::dialect::siemens::callee::Callee;
use crate::syntax::dialect::siemens::expression::Names;
use crate::syntax::dialect::siemens::statement::{Statement, is_header, statement};
use crate::syntax::dialect::siemens::writer::rewrite;

/// The jumps of a line, told apart by a number, are remembered; this one is to where a contour begins.
const JUMP: u32 = 5;

impl<R: BufRead> Program<R> {
    /// The contour in Z and X, mm, radii; `span` is the name of it.
    pub(super) fn siemens_contour(
        &mut self,
        name: &[u8],
        span: SourceSpan,
    ) -> Outcome<LatheProfile> {
        let here = self.tape.place();
        let source = self.here();
        let state = self.interpreter.state.clone();
        let drawn = self.siemens_draw_contour(name, span);
        self.tape.go_to(here);
        self.interpreter.state = state;
        let profile = drawn?;
        // What is wrong with a block of the contour is wrong there.
        self.set_tape_origin(source.number, &source.text);
        if profile.is_open() || profile.elements().is_empty() {
            let message = "the contour is empty, or ends with a corner that is broken";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                    .because("the cycle follows the moves behind its first point")
                    .help("draw one move more"),
            );
        }
        Ok(profile)
    }

    fn siemens_draw_contour(&mut self, name: &[u8], span: SourceSpan) -> Outcome<LatheProfile> {
        let mut profile = LatheProfile::new(self.interpreter.lathe_point());
        let (first, last) = self.siemens_contour_lines(name, span)?;
        self.tape.go_to(first);
        let mut line = first.line;
        while last.is_none_or(|last| line <= last) && self.tape.reach(line, &mut self.source)? {
            let Some((number, text)) = self.tape.get(line).cloned() else {
                break;
            };
            if is_header(&text) {
                break;
            }
            self.set_tape_origin(number, &text);
            if self.siemens_draw(text, &mut profile)? {
                break;
            }
            let target = self.interpreter.lathe_target(profile.at);
            self.interpreter.state.position = target;
            line += 1;
        }
        Ok(profile)
    }

    /// The first line of a contour, and its last one if labels say where that is.
    fn siemens_contour_lines(
        &mut self,
        name: &[u8],
        span: SourceSpan,
    ) -> Outcome<(TapePlace, Option<usize>)> {
        let here = self.tape.place();
        let index = here.line.saturating_sub(1);
        let Some(colon) = name.iter().position(|byte| *byte == b':') else {
            let callee = Callee::of_path(name, span).ok_or_else(|| no_name(name, span))?;
            let first = self.siemens_subprogram(&callee)?;
            return Ok((first.ok_or_else(|| no_name(name, span))?, None));
        };
        let (from, to) = name.split_at(colon);
        let [from, to] = [from, to.get(1..).unwrap_or_default()].map(<[u8]>::trim_ascii);
        let line = self.siemens_target(index, from, JUMP, span.start)?;
        let last = self.siemens_last_line(index, line, to, span.start)?;
        Ok((TapePlace { line, ..here }, Some(last)))
    }

    /// Takes a line into the contour; true if the subprogram ends with it.
    fn siemens_draw(&mut self, text: Box<[u8]>, profile: &mut LatheProfile) -> Outcome<bool> {
        if self.interpreter.options.block_delete && text.trim_ascii_start().starts_with(b"/") {
            return Ok(false);
        }
        let text = without_label(&with_block_number(text));
        match statement(&text).0 {
            Statement::Block => {}
            Statement::Procedure => return Ok(false),
            _ => return Err(refused(SourceSpan::new(0, text.len()), "a statement")),
        }
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let names = Names {
            variables: &self.siemens.variables,
            scope: &scope,
            in_subprogram: true,
        };
        let line = rewrite(&text, names)?;
        let parsed = self.block.parse(&line.text, &scope);
        let origin = |mut fault: Box<BlockDiagnostic>| {
            fault.span = line.origin(fault.span);
            fault
        };
        parsed.map_err(origin)?;
        let whole = SourceSpan::new(0, text.len());
        if !self.block.assignments.is_empty() || !line.texts.is_empty() {
            return Err(refused(whole, "an assignment"));
        }
        if let Some(word) = self.block.named.untaken(|_| false) {
            return Err(origin(refused(
                word.span,
                "a word other than CR, RND and CHR",
            )));
        }
        // To other languages they are fillets, chamfers and increments.
        if let Some(letter) = b"ACUW"
            .iter()
            .find(|letter| self.block.get(**letter).is_some())
        {
            return Err(origin(refused(self.block.span(*letter), "another axis")));
        }
        if let Some(corner) = self.block.corner
            && !matches!(corner.kind, CornerKind::Round | CornerKind::Chamfer)
        {
            return Err(origin(
                refused(corner.span, "CHF or RNDM").help("write CHR or RND"),
            ));
        }
        if self.block.get(b'F').is_some() {
            let message = "F in the contour of a cycle";
            let span = self.block.span(b'F');
            return Err(origin(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("whether it counts beside the feeds of the cycle is not known here")
                    .help("give the feed to the cycle"),
            ));
        }
        profile
            .add(&self.block, &self.interpreter)
            .map_err(origin)?;
        Ok(line.ends_subprogram)
    }
}

#[cold]
fn refused(span: SourceSpan, what: &str) -> Box<BlockDiagnostic> {
    let message = format!("{what} in the contour of a cycle");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("a contour is drawn by G0, G1, G2 and G3, with CR, I, K, RND and CHR")
        .help("write its blocks out")
}
