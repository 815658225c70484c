//! A file that has no name before it is whole: whatever ends the command, nothing of it is left over.
//!
//! Where the file system has no files without a name it has one of its own, which a command that is killed
//! leaves behind.

use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat, open};
use std::fs::{File, Permissions};
use std::io::{self, Write};
use std::os::fd::AsRawFd as _;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A file that is being written, in the folder of its place.
#[derive(Debug)]
pub(crate) enum PartFile {
    /// Without a name.
    Nameless {
        /// The file.
        file: File,
        /// Its folder.
        folder: PathBuf,
    },
    /// With a name of its own.
    Named(NamedTempFile),
}

impl PartFile {
    /// Begins a file for a place, with a mode.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub(crate) fn create(folder: &Path, place: &Path, mode: u32) -> io::Result<Self> {
        let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
        if let Ok(file) = open(folder, flags, Mode::from_raw_mode(mode)) {
            let file = File::from(file);
            // It gets its name by this one.
            if Path::new(&open_name(&file)).exists() {
                let folder = folder.to_owned();
                return Ok(Self::Nameless { file, folder });
            }
        }
        let prefix = prefix(place);
        let mut builder = tempfile::Builder::new();
        let builder = builder.prefix(&prefix).suffix(SUFFIX);
        let permissions = Permissions::from_mode(mode);
        let named = builder.permissions(permissions).tempfile_in(folder);
        Ok(Self::Named(named?))
    }

    /// Gives the file a mode, whatever the mask of the process takes from it.
    ///
    /// # Errors
    /// The file system knows no modes.
    pub(crate) fn set_mode(&self, mode: u32) -> io::Result<()> {
        let file = match self {
            Self::Nameless { file, .. } => file,
            Self::Named(file) => file.as_file(),
        };
        file.set_permissions(Permissions::from_mode(mode))
    }

    /// Puts the file in its place, instead of what is there.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub(crate) fn persist(self, place: &Path) -> io::Result<()> {
        match self {
            Self::Named(file) => file.persist(place).map(drop).map_err(io::Error::from),
            Self::Nameless { file, folder } => {
                // A name that is taken cannot be given; another one is, and takes its place.
                let prefix = prefix(place);
                let mut builder = tempfile::Builder::new();
                let named = builder
                    .prefix(&prefix)
                    .suffix(SUFFIX)
                    .make_in(folder, |path| {
                        let given =
                            linkat(CWD, open_name(&file), CWD, path, AtFlags::SYMLINK_FOLLOW);
                        given.map_err(io::Error::from)
                    })?;
                named.persist(place).map_err(io::Error::from)
            }
        }
    }
}

const SUFFIX: &str = ".part";

fn prefix(place: &Path) -> String {
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    format!(".{name}.")
}

/// The name by which the system knows an open file.
fn open_name(file: &File) -> String {
    format!("/proc/self/fd/{}", file.as_raw_fd())
}

impl Write for PartFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Nameless { file, .. } => file.write(bytes),
            Self::Named(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Nameless { file, .. } => file.flush(),
            Self::Named(file) => file.flush(),
        }
    }
}
