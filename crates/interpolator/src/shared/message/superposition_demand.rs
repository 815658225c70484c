//! What the input of a superposition asks for.

/// What the input asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SuperpositionDemand {
    /// Nobody sends it.
    Silent,
    /// The digital input that has to be on is off.
    Barred,
    /// The value of the input.
    Value(f64),
}
