//! A program on the command line: its name, and where it can be read as often as needed.
//!
//! A program is read more than once: its beginning tells its dialect, then it is checked as a
//! whole, then it is planned, by `run` in another process. A pipe can be read once. What comes
//! through one is therefore kept in a file without a name, which is gone with this process, and
//! read from there: `-`, `/dev/stdin`, a FIFO and `<(…)` are the same program as a file with their
//! text.

use crate::file_error::FileError;
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

/// A program as it is named on the command line; [`ProgramFile::open`] comes before
/// [`ProgramFile::path`].
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
        let is_device = there.as_ref().is_some_and(|there| {
            let kind = there.file_type();
            kind.is_block_device() || (kind.is_char_device() && there.rdev() != NOTHING)
        });
        let is_terminal = is_device && File::open(&self.name).is_ok_and(|file| file.is_terminal());
        if is_device && !is_terminal {
            let error = io::Error::new(io::ErrorKind::InvalidInput, "it is a device, no program");
            return Err(FileError::open(&self.name)(error));
        }
        let is_pipe = || {
            let kind = there.map(|there| there.file_type());
            is_terminal || kind.is_some_and(|kind| kind.is_fifo() || kind.is_socket())
        };
        if self.kept.get().is_some() || !(self.is_standard_input() || is_pipe()) {
            return Ok(());
        }
        let kept = self.keep().map_err(FileError::file("read", &self.name))?;
        // Nobody else opens it meanwhile: commands open programs before anything else.
        self.kept.set(Arc::new(kept)).ok();
        Ok(())
    }

    fn keep(&self) -> io::Result<Kept> {
        let mut file = tempfile::tempfile()?;
        if self.is_standard_input() {
            copy(io::stdin().lock(), &mut file)?;
        } else {
            copy(File::open(&self.name)?, &mut file)?;
        }
        let path = format!("/proc/{}/fd/{}", std::process::id(), file.as_raw_fd());
        Ok(Kept {
            _file: file,
            path: path.into(),
        })
    }
}

/// Copies all of a pipe.
fn copy(pipe: impl Read, file: &mut File) -> io::Result<()> {
    if io::copy(&mut pipe.take(MOST_BYTES + 1), file)? > MOST_BYTES {
        let message = "a program from a pipe has at most 4 GiB; put a longer one into a file";
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    Ok(())
}
