//! The reader of NURBS curve files.

use crate::file_error::FileError;
use crate::text_diagnostic::TextDiagnostic;
use crate::text_file;
use glidepath_curve::NurbsFile;
use std::path::Path;
use thiserror::Error;

/// Largest curve file, bytes: a hundred thousand control points.
pub const MOST_BYTES: u64 = 4 << 20;

/// The reason why a curve file cannot be used.
#[derive(Debug, Error)]
pub enum CurveFileError {
    /// It cannot be read.
    #[error(transparent)]
    Unreadable(#[from] FileError),
    /// Something in it has to be mended.
    #[error(transparent)]
    Rejected(#[from] Box<TextDiagnostic>),
}

/// Reads a curve file of a name, from where it can be read: what came through a pipe is elsewhere.
///
/// # Errors
/// The file cannot be read, or something in it has to be mended.
pub fn read(named: &Path, path: &Path) -> Result<NurbsFile, CurveFileError> {
    let text = text_file::read(path, MOST_BYTES).map_err(FileError::open(named))?;
    Ok(parse(&named.display().to_string(), &text)?)
}

/// Judges the text of a curve file; `name` is the file's, for reports and for a curve without a
/// name.
///
/// # Errors
/// The first thing that has to be mended.
pub fn parse(name: &str, text: &str) -> Result<NurbsFile, Box<TextDiagnostic>> {
    let mut file = NurbsFile::parse(text)
        .map_err(|fault| TextDiagnostic::new(name, text, fault.at, fault.message, &fault.help))?;
    file.name.get_or_insert_with(|| name.to_owned());
    Ok(file)
}
