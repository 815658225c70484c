//! A program on the command line, or another file that is read: its name, and where it can be read
//! as often as needed.
//!
//! A program is read more than once: its beginning tells its dialect, then it is checked as a
//! whole, then it is planned, by `run` in another process. So are configurations, tool tables and
//! recordings. A pipe can be read once. What comes through one is therefore kept in a file without
//! a name, which is gone with this process, and read from there: `-`, `/dev/stdin`, a FIFO and
//! `<(…)` are the same program as a file with their text.

use crate::file_error::FileError;
use crate::waiting_note::BlockedNote;
use std::fs::File;
use std::io::{self, IsTerminal as _, Read};
use std::os::fd::AsRawFd as _;
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// The most that is kept of a pipe, bytes: a program of some hundred million lines. An endless one
/// must not fill the disk.
const MOST_BYTES: u64 = 4 << 30;

/// The number of /dev/null, which is a program without blocks.
const NOTHING: u64 = (1 << 8) | 3;

/// A file as it is named on the command line; [`ProgramFile::open`] or [`ProgramFile::keep`] comes
/// before [`ProgramFile::path`].
#[derive(Debug, Clone)]
pub struct ProgramFile {
    name: PathBuf,
    kept: OnceLock<Arc<Kept>>,
}

/// The text of a pipe.
#[derive(Debug)]
struct Kept {
    /// Held so that the path stays good.
    _file: File,
    /// By which this process and those it starts can open the file.
    path: PathBuf,
}

impl ProgramFile {
    /// A program of a name, which is not looked at yet. `-` is standard input.
    pub fn named(name: impl Into<PathBuf>) -> Self {
        Self {
            name: name.into(),
            kept: OnceLock::new(),
        }
    }

    /// What the user calls it.
    #[must_use]
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// True for `-`.
    #[must_use]
    pub fn is_standard_input(&self) -> bool {
        self.name == Path::new("-")
    }

    /// True for standard input that is not kept: it is executed as it comes.
    #[must_use]
    pub fn is_stream(&self) -> bool {
        self.is_standard_input() && self.kept.get().is_none()
    }

    /// Where it can be read.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.kept.get().map_or(&self.name, |kept| &kept.path)
    }

    /// The file that has a folder, in which subroutines may stand; none for a pipe.
    #[must_use]
    pub fn in_folder(&self) -> Option<&Path> {
        (self.kept.get().is_none() && !self.is_standard_input()).then_some(&*self.name)
    }

    /// Keeps what comes through a pipe. Of files nothing is read.
    ///
    /// # Errors
    /// The pipe cannot be read, or its text not be kept. A file that does not exist is no error
    /// here, but where it is opened to be read.
    pub fn open(&self) -> Result<(), FileError> {
        // What cannot be looked at is told where it is opened to be read.
        let there = self.name.metadata().ok();
        if there.as_ref().is_some_and(std::fs::Metadata::is_dir) {
            let error = io::Error::new(io::ErrorKind::InvalidInput, "it is a folder, no program");
            return Err(FileError::open(&self.name)(error));
        }
        let is_device = there.as_ref().is_some_and(|there| {
            let kind = there.file_type();
            kind.is_block_device() || (kind.is_char_device() && there.rdev() != NOTHING)
        });
        let is_terminal = is_device && File::open(&self.name).is_ok_and(|file| file.is_terminal());
        if is_device && !is_terminal {
            let error = io::Error::new(io::ErrorKind::InvalidInput, "it is a device, no program");
            return Err(FileError::open(&self.name)(error));
        }
        if is_terminal {
            return self.keep_text(MOST_BYTES).map(drop);
        }
        self.keep_whole()
    }

    /// Keeps all that comes through a pipe. Of files nothing is read.
    ///
    /// # Errors
    /// As [`ProgramFile::open`].
    pub fn keep_whole(&self) -> Result<(), FileError> {
        if self.keep(MOST_BYTES)? > MOST_BYTES {
            let message = "what comes from a pipe has at most 4 GiB; put more into a file";
            let error = io::Error::new(io::ErrorKind::InvalidData, message);
            return Err(FileError::file("read", &self.name)(error));
        }
        Ok(())
    }

    /// Keeps what comes through a pipe, whatever it is, but hardly more than so many bytes: whoever
    /// reads the file refuses one that is longer. How many were kept; of files nothing is read.
    ///
    /// # Errors
    /// As [`ProgramFile::open`].
    pub fn keep(&self, most_bytes: u64) -> Result<u64, FileError> {
        let is_pipe = || {
            let kind = self.name.metadata().map(|there| there.file_type());
            kind.is_ok_and(|kind| kind.is_fifo() || kind.is_socket())
        };
        if self.kept.get().is_some() || !(self.is_standard_input() || is_pipe()) {
            return Ok(0);
        }
        self.keep_text(most_bytes)
    }

    fn keep_text(&self, most_bytes: u64) -> Result<u64, FileError> {
        if self.kept.get().is_some() {
            return Ok(0);
        }
        let name = if self.is_standard_input() {
            "standard input".to_owned()
        } else {
            self.name.display().to_string()
        };
        let note = BlockedNote::new(format!(
            "{name} is read to its end: until whoever writes it closes its pipe"
        ));
        let kept = self.copied(most_bytes);
        drop(note);
        let (kept, length) = kept.map_err(FileError::file("read", &self.name))?;
        // Nobody else opens it meanwhile: commands open programs before anything else.
        self.kept.set(Arc::new(kept)).ok();
        Ok(length)
    }

    fn copied(&self, most_bytes: u64) -> io::Result<(Kept, u64)> {
        let mut file = tempfile::tempfile()?;
        let length = if self.is_standard_input() {
            io::copy(&mut io::stdin().lock().take(most_bytes + 1), &mut file)?
        } else {
            io::copy(&mut File::open(&self.name)?.take(most_bytes + 1), &mut file)?
        };
        let path = format!("/proc/{}/fd/{}", std::process::id(), file.as_raw_fd());
        let kept = Kept {
            _file: file,
            path: path.into(),
        };
        Ok((kept, length))
    }
}
