//! The reader and the writer of NURBS curve files, for the commands that look at curves themselves.

mod read;
mod write;

pub use read::{CurveFileError, MOST_BYTES, parse, read};
pub use write::to_toml;

#[cfg(test)]
mod tests;
