//! EXTCALL, CALL and PCALL: subprograms that a text or a path names.
//!
//! ```text
//! EXTCALL("ROUGH")   EXTCALL "/_N_WKS_DIR/_N_PART_WPD/_N_ROUGH_SPF"   EXTCALL("ROUGH.MPF")
//! CALL "FINISH"      CALL NAME<<R1                                    PCALL /_N_SPF_DIR/_N_HOLES_SPF(5, 2)
//! CALL BLOCK A TO B
//! ```
//!
//! On the control a path leads to a folder of its own, or to a drive beside it. Here subprograms are looked
//! for where all of them are, and of a path the name of the file counts alone.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::dialect::siemens::subprogram::arguments_ahead;
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::callee::Callee;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::statement::TextCall;
use crate::syntax::dialect::words::refused;
use crate::syntax::word_check::missing;

/// What a byte of a path without quotes may be.
const fn is_of_path(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'/' | b'\\' | b'_' | b'.' | b'-')
}

/// The path behind PCALL.
fn path_ahead(input: &mut Evaluator<'_>) -> Vec<u8> {
    input.next_visible();
    let rest = input.text.get(input.at..).unwrap_or_default();
    let length = rest.iter().take_while(|byte| is_of_path(**byte)).count();
    input.at += length;
    rest.get(..length).unwrap_or_default().to_vec()
}

/// The text behind EXTCALL or CALL, with or without parentheses.
fn text_ahead(input: &mut Evaluator<'_>, name: &str, span: SourceSpan) -> Outcome<Vec<u8>> {
    let has_parentheses = input.eat(b'(');
    if !input.is_text_next() {
        return Err(missing(
            span,
            name,
            "a text",
            "the name of the subprogram, in quotes or in a variable of DEF STRING",
        ));
    }
    let text = input.text_value()?;
    if has_parentheses && !input.eat(b')') {
        let span = SourceSpan::new(span.start, input.at);
        return Err(missing(span, name, ")", "the end of its parentheses"));
    }
    if input.eat_name(b"BLOCK") {
        let span = SourceSpan::new(input.at - b"BLOCK".len(), input.at);
        let help = "write CALL BLOCK, with a part of this program";
        return Err(refused("BLOCK", "a part of another program", help, span));
    }
    Ok(text)
}

impl<R: BufRead> Program<R> {
    /// A call by a text or a path, in that line; `at` is behind its word.
    pub(super) fn siemens_named_call(
        &mut self,
        call: TextCall,
        index: usize,
        text: &[u8],
        at: usize,
    ) -> Outcome<()> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        if call == TextCall::ByName && input.eat_name(b"BLOCK") {
            let behind = input.at;
            return self.siemens_call_block(index, text, behind);
        }
        input.next_visible();
        let start = input.at;
        let word = SourceSpan::new(at.saturating_sub(call.word().len()), at);
        let path = match call {
            TextCall::ByPath => path_ahead(&mut input),
            TextCall::External | TextCall::ByName => text_ahead(&mut input, call.word(), word)?,
        };
        let end = input.at.max(start + 1);
        let arguments = match call {
            TextCall::ByPath => arguments_ahead(&mut input)?,
            TextCall::External | TextCall::ByName => Vec::new(),
        };
        check_end(&mut input)?;
        let span = SourceSpan::new(start, end);
        let callee = Callee::of_path(&path, span).ok_or_else(|| no_name(&path, span))?;
        let Some(first) = self.siemens_subprogram(&callee)? else {
            return Ok(());
        };
        self.siemens_enter((first, 1), arguments, None, span)
    }
}

#[cold]
pub(super) fn no_name(path: &[u8], span: SourceSpan) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(path).into_owned();
    let message = format!("\"{shown}\" names no subprogram");
    BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
        .because("the last part of a path is the name of its file")
        .help("write the name of the subprogram")
}
