//! The diagnostic of a file whose text has something to mend: what, and where.

use core::fmt;
use core::ops::Range;
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use serde_json::{Value, json};

/// A diagnostic of a text: one thing to mend.
#[derive(Debug)]
pub struct TextDiagnostic {
    file: String,
    message: String,
    pub(crate) help: String,
    span: Range<usize>,
    source: NamedSource<String>,
}

impl TextDiagnostic {
    /// What is wrong with some bytes of the text.
    pub(crate) fn new(
        file: &str,
        text: &str,
        span: Range<usize>,
        message: String,
        help: &str,
    ) -> Box<Self> {
        Box::new(Self {
            file: file.to_owned(),
            message,
            help: help.to_owned(),
            span,
            source: NamedSource::new(file, text.to_owned()),
        })
    }

    /// Line and column, both from 1; the column counts characters.
    #[must_use]
    pub fn line_and_column(&self) -> (usize, usize) {
        let text = self.source.inner();
        let before = text.get(..self.span.start).unwrap_or_default();
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let column = before.get(line_start..).unwrap_or_default().chars().count();
        (1 + before.matches('\n').count(), 1 + column)
    }

    /// As an object among the findings of a `--json` report.
    #[must_use]
    pub fn object(&self) -> Value {
        let (line, column) = self.line_and_column();
        json!({
            "program": self.file,
            "line": line,
            "column": column,
            "message": self.message,
            "help": self.help,
        })
    }
}

impl fmt::Display for TextDiagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for TextDiagnostic {}

impl Diagnostic for TextDiagnostic {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.help))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = LabeledSpan::underline(self.span.clone());
        Some(Box::new(core::iter::once(label)))
    }
}
