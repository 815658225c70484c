//! Curve files of NURBS for the commands that look at curves themselves: read, and written.

mod diagnostic;
mod read;
mod write;

pub use diagnostic::CurveDiagnostic;
pub use read::{CurveFileError, MOST_BYTES, parse, read};
pub use write::to_toml;

#[cfg(test)]
mod tests;
