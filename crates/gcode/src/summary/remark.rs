//! A remark of a program to people.

/// The kinds of remarks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RemarkKind {
    /// `(MSG, …)`: for the operator.
    Message,
    /// `(DEBUG, …)` and `(PRINT, …)`: with the values of parameters in it.
    Debug,
    /// The comment beside M0, M1 or M60: why the machine stands.
    Stop,
}

/// A remark of a program to people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Source line.
    pub line: u32,
    /// What it is.
    pub kind: RemarkKind,
    /// The text.
    pub text: String,
}
