//! A file that must not change while it is read as a program.
//!
//! A program is read while the machine moves. One that somebody saves over or cuts off meanwhile
//! would be half of one program and half of another, or end in the middle as if that were its end.
//! Whoever reads it is told instead, and the motion ends as at any other error. A file that takes
//! the name of an open one changes nothing: the open one is read to its end.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::os::unix::fs::MetadataExt as _;
use std::path::Path;

/// What a change of a file's bytes changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Stamp {
    length: u64,
    modified: (i64, i64),
}

impl Stamp {
    fn of(file: &File) -> io::Result<Self> {
        let now = file.metadata()?;
        Ok(Self {
            length: now.len(),
            modified: (now.mtime(), now.mtime_nsec()),
        })
    }
}

/// A file that is refused from where it is found to have changed since it was opened.
#[derive(Debug)]
pub struct UnchangedFile {
    file: File,
    opened: Stamp,
}

impl UnchangedFile {
    /// Opens a file to be read.
    ///
    /// # Errors
    /// It cannot be opened.
    pub fn open(path: &Path) -> io::Result<Self> {
        let file = File::open(path)?;
        let opened = Stamp::of(&file)?;
        Ok(Self { file, opened })
    }
}

impl Read for UnchangedFile {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        // After the reading: what was read is then of the file that was opened.
        if Stamp::of(&self.file)? != self.opened {
            return Err(io::Error::other(
                "the file was changed while it was read; let it be written to its end first, or \
                 write it under another name and rename it",
            ));
        }
        Ok(count)
    }
}

impl Seek for UnchangedFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}
