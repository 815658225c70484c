//! Variables of texts, which DEF STRING declares, and arrays of them.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// Longest text, bytes.
pub(crate) const MAX_TEXT: usize = 200;

/// A text that a line assigns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct TextAssignment {
    /// In capitals.
    pub(crate) name: Vec<u8>,
    pub(crate) element: usize,
    pub(crate) value: Vec<u8>,
}

/// A variable of texts, or an array of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct TextVariable {
    /// Bytes that each text may have.
    most: usize,
    /// How many elements along each dimension; none: it is no array.
    sizes: Vec<usize>,
    values: Vec<Vec<u8>>,
}

impl TextVariable {
    /// Empty texts of at most so many bytes.
    pub(super) fn new(most: usize, sizes: Vec<usize>) -> Self {
        let count = sizes.iter().product();
        Self {
            most,
            sizes,
            values: vec![Vec::new(); count],
        }
    }

    pub(super) fn count(&self) -> usize {
        self.values.len()
    }

    pub(super) fn sizes(&self) -> &[usize] {
        &self.sizes
    }

    pub(super) fn value(&self, element: usize) -> &[u8] {
        self.values.get(element).map_or(&[], Vec::as_slice)
    }

    pub(super) fn set(&mut self, element: usize, value: Vec<u8>) {
        if let Some(slot) = self.values.get_mut(element) {
            *slot = value;
        }
    }

    /// Refuses a text that is longer than the variable.
    pub(super) fn check(&self, value: &[u8], span: SourceSpan) -> Outcome<()> {
        if value.len() <= self.most {
            return Ok(());
        }
        let (length, most) = (value.len(), self.most);
        let message = format!("a text of {length} bytes in a variable of {most}");
        Err(
            BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                .because("DEF STRING says in brackets how long its texts may be")
                .help("declare it longer, or write a shorter text"),
        )
    }
}
