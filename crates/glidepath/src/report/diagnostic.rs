//! The diagnostics of a program, for people and as JSON.

use core::fmt;
use glidepath_gcode::Diagnostic;
use miette::{LabeledSpan, MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use serde_json::{Value, json};

/// A diagnostic as miette prints it: file:line:column, the source line with a mark under the word,
/// the reason and the remedy.
#[derive(Debug)]
pub struct ProgramDiagnostic<'a> {
    name: &'a str,
    diagnostic: &'a Diagnostic,
    /// Bytes of the excerpt to mark.
    mark: SourceSpan,
}

impl<'a> ProgramDiagnostic<'a> {
    /// A diagnostic in the program called `name`, or in a file of a subroutine it calls.
    #[must_use]
    pub fn new(name: &'a str, diagnostic: &'a Diagnostic) -> Self {
        Self {
            name: diagnostic.file.as_deref().unwrap_or(name),
            diagnostic,
            mark: mark(diagnostic),
        }
    }
}

/// Characters of the excerpt to bytes of it.
fn mark(diagnostic: &Diagnostic) -> SourceSpan {
    let excerpt = &diagnostic.excerpt;
    let bytes = |characters: usize| {
        excerpt
            .text
            .char_indices()
            .nth(characters)
            .map_or(excerpt.text.len(), |(at, _)| at)
    };
    let start = bytes(excerpt.caret);
    let end = bytes(excerpt.caret.saturating_add(excerpt.length));
    (start, end.saturating_sub(start)).into()
}

impl fmt::Display for ProgramDiagnostic<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diagnostic.message)
    }
}

impl std::error::Error for ProgramDiagnostic<'_> {}

impl miette::Diagnostic for ProgramDiagnostic<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        Some(Box::new(self.diagnostic.code))
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        let help = &self.diagnostic.help;
        if help.is_empty() {
            None
        } else {
            Some(Box::new(help))
        }
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let reason = Some(self.diagnostic.reason.clone()).filter(|reason| !reason.is_empty());
        let label = LabeledSpan::new_with_span(reason, self.mark);
        Some(Box::new(core::iter::once(label)))
    }
}

/// The one line of the program that is at hand, at its place in the program.
impl SourceCode for ProgramDiagnostic<'_> {
    fn read_span<'b>(
        &'b self,
        _span: &SourceSpan,
        _lines_before: usize,
        _lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'b> + 'b>, MietteError> {
        let text = &self.diagnostic.excerpt.text;
        let from_zero = |number: u32| {
            usize::try_from(number)
                .unwrap_or(usize::MAX)
                .saturating_sub(1)
        };
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.to_owned(),
            text.as_bytes(),
            (0, text.len()).into(),
            from_zero(self.diagnostic.line),
            from_zero(self.diagnostic.column),
            1,
        )))
    }
}

/// A diagnostic as a JSON object.
#[must_use]
pub fn diagnostic_object(program: &str, diagnostic: &Diagnostic) -> Value {
    json!({
        "program": program,
        "file": diagnostic.file.as_deref().unwrap_or(program),
        "line": diagnostic.line,
        "column": diagnostic.column,
        "length": diagnostic.length,
        "code": diagnostic.code.as_str(),
        "message": diagnostic.message,
        "reason": diagnostic.reason,
        "help": diagnostic.help,
        "source": diagnostic.excerpt.text,
    })
}
