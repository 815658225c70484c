//! Directories that nobody but their user can enter, and files in them.
//!
//! What is in a directory of mode 0700 needs no other protection: whatever its own mode, no other
//! user can open, make, replace or link it. So the directory is checked instead of the files: it is
//! no symbolic link, belongs to this user, is closed to all others, and nobody else can put another
//! in its place.

use std::fs::{DirBuilder, File, Metadata, OpenOptions};
use std::io;
use std::os::unix::fs::{DirBuilderExt, MetadataExt, OpenOptionsExt};
use std::path::Path;

/// Only other people's business is barred: root could do anything anyway.
const ROOT: u32 = 0;
/// Others may write.
const OPEN: u32 = 0o022;
/// Only an entry's owner may rename or remove it.
const STICKY: u32 = 0o1000;

/// Makes a directory that only this user can enter, or checks that it is one.
pub(super) fn make(path: &Path) -> io::Result<()> {
    check_way_to(path)?;
    match DirBuilder::new().mode(0o700).recursive(false).create(path) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(error),
        _ => check_itself(path),
    }
}

/// Checks that a directory is this user's alone. `NotFound` if it does not exist.
pub(super) fn check(path: &Path) -> io::Result<()> {
    check_way_to(path)?;
    check_itself(path)
}

fn check_itself(path: &Path) -> io::Result<()> {
    let found = path.symlink_metadata()?;
    if found.is_dir() && found.uid() == own_user() && found.mode() & 0o077 == 0 {
        return Ok(());
    }
    let what = if found.is_symlink() {
        "a symbolic link".to_owned()
    } else if found.is_dir() {
        format!(
            "of mode {:04o} and user {}",
            found.mode() & 0o7777,
            found.uid()
        )
    } else {
        "no directory".to_owned()
    };
    Err(refused(format!(
        "it exists, but is not a directory of mode 0700 of this user: it is {what}"
    )))
}

/// Checks that nobody but this user and root can put something else in the place of what a path
/// stands for.
fn check_way_to(path: &Path) -> io::Result<()> {
    if !path.is_absolute() {
        let kind = io::ErrorKind::InvalidInput;
        return Err(io::Error::new(kind, "the path is not absolute"));
    }
    let parent = path.parent().unwrap_or(path);
    // As it is written, with the symbolic links on the way, and where they lead.
    for way in [parent.to_owned(), parent.canonicalize()?] {
        for place in way.ancestors() {
            let found = place.symlink_metadata()?;
            if !is_trusted(&found) {
                let place = place.display();
                return Err(refused(format!(
                    "others can replace {place}, which is on the way"
                )));
            }
        }
    }
    Ok(())
}

fn is_trusted(found: &Metadata) -> bool {
    let is_own = [ROOT, own_user()].contains(&found.uid());
    let is_open = !found.is_symlink() && found.mode() & OPEN != 0 && found.mode() & STICKY == 0;
    is_own && !is_open
}

fn own_user() -> u32 {
    rustix::process::geteuid().as_raw()
}

fn refused(why: String) -> io::Error {
    io::Error::new(io::ErrorKind::PermissionDenied, why)
}

/// How files in such a directory are opened: for reading and writing, never through a symbolic
/// link.
pub(super) fn options() -> OpenOptions {
    let mut options = OpenOptions::new();
    let flags = rustix::fs::OFlags::NOFOLLOW.bits();
    options
        .read(true)
        .write(true)
        .mode(0o600)
        .custom_flags(flags.cast_signed());
    options
}

/// Opens a file, and makes it if it does not exist.
pub(super) fn open(path: &Path) -> io::Result<File> {
    options().create(true).truncate(false).open(path)
}

/// Which file it is, whatever its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Identity {
    device: u64,
    number: u64,
}

impl Identity {
    /// That of an open file.
    pub(super) fn of(file: &File) -> io::Result<Self> {
        Ok(Self::in_metadata(&file.metadata()?))
    }

    fn in_metadata(found: &Metadata) -> Self {
        Self {
            device: found.dev(),
            number: found.ino(),
        }
    }

    /// Whether a name stands for it, as far as the system tells.
    pub(super) fn is_at(self, path: &Path) -> bool {
        self.is_named(path).unwrap_or(true)
    }

    fn is_named(self, path: &Path) -> io::Result<bool> {
        match path.symlink_metadata() {
            Ok(named) => Ok(Self::in_metadata(&named) == self),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
            Err(error) => Err(error),
        }
    }
}

/// Whether a name still stands for an open file.
pub(super) fn is_still(file: &File, path: &Path) -> io::Result<bool> {
    Identity::of(file)?.is_named(path)
}

/// Whether a path is on a file system that is memory: what is mapped from another is written to a
/// disk, and waits for it.
pub(super) fn is_in_memory(path: &Path) -> bool {
    const TMPFS: i64 = 0x0102_1994;
    rustix::fs::statfs(path).is_ok_and(|found| found.f_type == TMPFS)
}
