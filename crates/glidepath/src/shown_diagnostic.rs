//! A diagnostic with the text of others made safe to show.

use core::fmt;
use glidepath_link::printable;
use miette::{
    Diagnostic, LabeledSpan, MietteError, MietteSpanContents, Severity, SourceCode, SourceSpan,
    SpanContents,
};

/// Lines that are shown before and behind the one that is meant, as miette does by itself.
const CONTEXT: usize = 1;

/// A diagnostic whose words and whose source no terminal obeys. The mark stays: a character is shown
/// as one of as many bytes.
pub(crate) struct ShownDiagnostic<'a> {
    diagnostic: &'a dyn Diagnostic,
    source: Option<ShownSource>,
}

impl<'a> ShownDiagnostic<'a> {
    pub(crate) fn new(diagnostic: &'a dyn Diagnostic) -> Self {
        let label = diagnostic.labels().and_then(|mut labels| labels.next());
        let source = diagnostic.source_code().zip(label);
        Self {
            diagnostic,
            source: source.and_then(|(source, label)| ShownSource::read(source, label.inner())),
        }
    }
}

fn shown(text: &dyn fmt::Display) -> String {
    printable(&text.to_string()).into_owned()
}

impl fmt::Debug for ShownDiagnostic<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.diagnostic, f)
    }
}

impl fmt::Display for ShownDiagnostic<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown(&self.diagnostic))
    }
}

impl std::error::Error for ShownDiagnostic<'_> {}

impl Diagnostic for ShownDiagnostic<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        Some(Box::new(shown(&self.diagnostic.code()?)))
    }

    fn severity(&self) -> Option<Severity> {
        self.diagnostic.severity()
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        Some(Box::new(shown(&self.diagnostic.help()?)))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labels = self.diagnostic.labels()?;
        Some(Box::new(labels.map(|label| {
            let text = label.label().map(|text| printable(text).into_owned());
            LabeledSpan::new_with_span(text, *label.inner())
        })))
    }
}

/// The lines around what is meant.
struct ShownSource {
    name: String,
    language: Option<String>,
    text: String,
    span: SourceSpan,
    line: usize,
    column: usize,
    lines: usize,
    /// Line and column of what is meant itself, for which miette asks without context.
    place: (usize, usize),
}

impl ShownSource {
    fn read(source: &dyn SourceCode, span: &SourceSpan) -> Option<Self> {
        let read = source.read_span(span, CONTEXT, CONTEXT).ok()?;
        let text = str::from_utf8(read.data()).ok()?;
        let meant = source.read_span(span, 0, 0).ok()?;
        Some(Self {
            name: printable(read.name().unwrap_or_default()).into_owned(),
            language: read.language().map(str::to_owned),
            text: printable(text).into_owned(),
            span: *read.span(),
            line: read.line(),
            column: read.column(),
            lines: read.line_count(),
            place: (meant.line(), meant.column()),
        })
    }
}

impl SourceCode for ShownSource {
    fn read_span<'b>(
        &'b self,
        _span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'b> + 'b>, MietteError> {
        let (line, column) = if lines_before == 0 && lines_after == 0 {
            self.place
        } else {
            (self.line, self.column)
        };
        let contents = MietteSpanContents::new_named(
            self.name.clone(),
            self.text.as_bytes(),
            self.span,
            line,
            column,
            self.lines,
        );
        Ok(Box::new(match &self.language {
            Some(language) => contents.with_language(language),
            None => contents,
        }))
    }
}
