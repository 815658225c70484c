//! The note of the program in execution, which its planner leaves for whoever shows the machine.
//!
//! A status has the fingerprint of the program, and no room for its name. So a planner writes down what
//! has that fingerprint, in a file of the instance's directory, before it publishes the first frame. The
//! note outlasts its planner: it is of the program that the machine executes as long as the status has
//! the same fingerprint, and of none after that. Lines, pipes and streams have no fingerprint, and so no
//! note: what they are called stands in the job of the status.

use super::config::LinkConfig;
use super::directory;
use crate::LinkError;
use crate::record::TOLERANCE_RATIOS;
use crate::wording::in_one_line;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::os::unix::ffi::OsStrExt as _;
use std::path::{Path, PathBuf};

/// How a note begins: what has another form is not read.
const MARK: &str = "glidepath.ActiveProgram.v2";
/// Longest note, bytes.
const MOST: u64 = 16 << 10;

/// The program in a file that a planner has begun last.
#[derive(Debug, Clone, PartialEq)]
pub struct ActiveProgram {
    /// Which text it is, not 0: see [`crate::SetpointFrame::program`].
    pub fingerprint: u64,
    /// Its length, bytes.
    pub bytes: u64,
    /// How many times its tolerance its motion may use: see [`crate::JobRequest::tolerance_ratio`].
    pub tolerance_ratio: f64,
    /// Its file, with its full path.
    pub file: PathBuf,
}

impl ActiveProgram {
    /// Leaves the note, in the place of the one before.
    ///
    /// # Errors
    ///
    /// [`LinkError::File`] if it cannot be written.
    pub fn leave(&self, config: &LinkConfig) -> Result<(), LinkError> {
        let path = path(config);
        // Whoever reads sees the note before or this one, and no part of one.
        let new = path.with_extension("new");
        write(&new, &self.note())
            .and_then(|()| std::fs::rename(&new, &path))
            .map_err(|error| LinkError::no_file(&path, 0, error))
    }

    /// The note that was left last; `None` if there is none, or none that this version can read.
    ///
    /// # Errors
    ///
    /// [`LinkError::File`] if it cannot be read.
    pub fn read(config: &LinkConfig) -> Result<Option<Self>, LinkError> {
        let path = path(config);
        let mut note = Vec::new();
        let read = directory::options()
            .open(&path)
            .and_then(|file| file.take(MOST).read_to_end(&mut note));
        match read {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(LinkError::no_file(&path, 0, error)),
            Ok(_) => Ok(Self::of_note(&note)),
        }
    }

    /// The name of the program, for people: the last part of its path, in one line.
    #[must_use]
    pub fn name(&self) -> String {
        let name = self.file.file_name().unwrap_or(self.file.as_os_str());
        in_one_line(&name.to_string_lossy()).into_owned()
    }

    fn note(&self) -> Vec<u8> {
        let (fingerprint, bytes, ratio) = (self.fingerprint, self.bytes, self.tolerance_ratio);
        let mut note = format!("{MARK}\n{fingerprint:016x}\n{bytes}\n{ratio}\n").into_bytes();
        note.extend_from_slice(self.file.as_os_str().as_bytes());
        note
    }

    fn of_note(note: &[u8]) -> Option<Self> {
        let mut parts = note.splitn(5, |byte| *byte == b'\n');
        let mut line = || str::from_utf8(parts.next()?).ok();
        if line()? != MARK {
            return None;
        }
        let fingerprint = u64::from_str_radix(line()?, 16).ok()?;
        let bytes = line()?.parse().ok()?;
        let tolerance_ratio = line()?
            .parse()
            .ok()
            .filter(|it| TOLERANCE_RATIOS.contains(it))?;
        let file = Path::new(OsStr::from_bytes(parts.next()?));
        file.is_absolute().then(|| Self {
            fingerprint,
            bytes,
            tolerance_ratio,
            file: file.to_owned(),
        })
    }
}

fn path(config: &LinkConfig) -> PathBuf {
    config.directory().join("active-program")
}

fn write(path: &Path, note: &[u8]) -> io::Result<()> {
    let mut file: File = directory::options()
        .create(true)
        .truncate(true)
        .open(path)?;
    file.write_all(note)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(file: &[u8]) -> ActiveProgram {
        ActiveProgram {
            fingerprint: 0x00ab_cdef_0123_4567,
            bytes: 1234,
            tolerance_ratio: 2.5,
            file: PathBuf::from(OsStr::from_bytes(file)),
        }
    }

    #[test]
    fn a_note_reads_back_whatever_its_file_is_called() {
        for file in [&b"/srv/part.ngc"[..], b"/srv/a\nb\xff .ngc", b"/"] {
            let told = program(file);
            assert_eq!(ActiveProgram::of_note(&told.note()), Some(told));
        }
        assert_eq!(program(b"/srv/two\nlines\x1b").name(), "two lines?");
    }

    #[test]
    fn what_is_cut_off_or_of_another_form_is_no_note() {
        let note = program(b"/srv/part.ngc").note();
        for length in 0..=note.len() - b"/srv/part.ngc".len() {
            assert_eq!(ActiveProgram::of_note(&note[..length]), None, "{length}");
        }
        let other = b"glidepath.ActiveProgram.v1\n1\n2\n1\n/srv/part.ngc";
        assert_eq!(ActiveProgram::of_note(other), None);
        // A path from nowhere names nothing.
        assert_eq!(ActiveProgram::of_note(&program(b"part.ngc").note()), None);
    }
}
