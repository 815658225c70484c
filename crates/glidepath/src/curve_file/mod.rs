//! Curve files of NURBS for the commands that look at curves themselves: read, and written.

mod error;
mod write;

pub use error::CurveError;
pub use write::to_toml;

use crate::failure::Failure;
use glidepath_curve::NurbsFile;
use std::path::Path;

/// Reads a curve file.
///
/// # Errors
/// The file cannot be read, or something in it has to be mended.
pub fn read(path: &Path) -> Result<NurbsFile, Failure> {
    let text = std::fs::read_to_string(path).map_err(Failure::open(path))?;
    Ok(parse(&path.display().to_string(), &text)?)
}

/// Judges the text of a curve file; `name` is the file's, for reports and for a curve without a name.
///
/// # Errors
/// The first thing that has to be mended.
pub fn parse(name: &str, text: &str) -> Result<NurbsFile, Box<CurveError>> {
    let mut file = NurbsFile::parse(text).map_err(|finding| {
        CurveError::new(name, text, finding.at, finding.message, &finding.help)
    })?;
    file.name.get_or_insert_with(|| name.to_owned());
    Ok(file)
}

#[cfg(test)]
mod tests;
