//! A line that somebody types, as a page asks whether it could be executed.

use crate::query::{decoded, parameter};

/// The longest line that is asked about, bytes.
pub const MOST_TYPED: usize = 1000;

/// A line that is being typed: one line, of bounded length, with nothing in it that cannot be seen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TypedLine(String);

/// The reason why nothing is said of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TypedLineError {
    /// The question has no line in it, or one that is no text.
    #[error("the question has no line in it")]
    None,
    /// It is too long to be asked about.
    #[error("the line is longer than {MOST_TYPED} bytes")]
    TooLong,
    /// There is something in it that no key types.
    #[error("the line has a control character in it")]
    Control,
}

impl TypedLine {
    /// The line of a query.
    ///
    /// # Errors
    ///
    /// It is none that a person types.
    pub fn of(query: &str) -> Result<Self, TypedLineError> {
        let written = parameter(query, "line").ok_or(TypedLineError::None)?;
        // Each byte is written as three characters at most.
        if written.len() > 3 * MOST_TYPED {
            return Err(TypedLineError::TooLong);
        }
        let line = decoded(written).ok_or(TypedLineError::None)?;
        if line.len() > MOST_TYPED {
            return Err(TypedLineError::TooLong);
        }
        if line.chars().any(|c| c.is_control() && c != '\t') {
            return Err(TypedLineError::Control);
        }
        Ok(Self(line))
    }

    /// Its text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.0
    }
}
