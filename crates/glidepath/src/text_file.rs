//! Whole files: read, no more of them than they may have, and put in the place of others.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::path::Path;

/// The text of a file of at most so many bytes. Of a longer one, or a device that gives bytes
/// without end, nothing more is read.
///
/// # Errors
/// The file cannot be read, is too long, or is no UTF-8.
pub fn read(path: &Path, most_bytes: u64) -> io::Result<String> {
    String::from_utf8(bytes(path, most_bytes)?).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let message = format!("it is no UTF-8 text from byte {at} on");
        io::Error::new(io::ErrorKind::InvalidData, message)
    })
}

/// The bytes of such a file, whatever they are.
///
/// # Errors
/// The file cannot be read, or is too long.
pub fn bytes(path: &Path, most_bytes: u64) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    File::open(path)?
        .take(most_bytes + 1)
        .read_to_end(&mut text)?;
    if text.len() as u64 > most_bytes {
        let message = format!("it has more than {most_bytes} bytes, the most that are read");
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    Ok(text)
}

/// Puts a text as a file into a directory, in the place of the one of that name: all of it at once, since
/// somebody may be reading the one before.
///
/// # Errors
/// It cannot be written.
pub fn replace(directory: &Path, name: &str, text: &str) -> io::Result<()> {
    let mut file = tempfile::NamedTempFile::new_in(directory)?;
    file.write_all(text.as_bytes())?;
    file.persist(directory.join(name))?;
    Ok(())
}
