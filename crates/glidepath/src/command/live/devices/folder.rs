//! The folder of what nobody else may read: the key of the certificate, and the list of devices.
//!
//! Folder and files are the user's own and closed to all others, or they are not used. A file is replaced as a whole, so
//! that whoever reads it meanwhile has the one or the other.

use crate::file_error::FileError;
use glidepath_persistence::Directory;
use rustix::fs::{FlockOperation, OFlags, flock};
use rustix::process::geteuid;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _, fchown};
use std::path::{Path, PathBuf};

/// The folder, in that of what the machine keeps.
const NAME: &str = "devices";
/// Who has it locked writes.
const LOCK: &str = "lock";
/// Largest file that is read, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// The folder.
#[derive(Debug, Clone)]
pub(super) struct SecretFolder {
    path: PathBuf,
}

/// The right to write in the folder, until it is dropped.
#[derive(Debug)]
pub(super) struct Lock {
    _file: File,
}

/// What tells one version of a file from another.
pub(super) type Stamp = Option<(u64, i64, i64, u64)>;

impl SecretFolder {
    /// The folder of a machine, which is made if it is not there.
    pub(super) fn open(state: &Path) -> Result<Self, FileError> {
        let folder = Self::at(state);
        let made = Directory::open(state).map_err(io::Error::other);
        made.map_err(FileError::file("write in", state))?;
        match fs::DirBuilder::new().mode(0o700).create(&folder.path) {
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists => {
                return Err(FileError::file("make", &folder.path)(error));
            }
            _ => {}
        }
        let _checked = folder.check()?;
        Ok(folder)
    }

    /// The folder of a machine, which need not be there.
    pub(super) fn at(state: &Path) -> Self {
        Self {
            path: state.join(NAME),
        }
    }

    /// Where a file is.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// What the folder is, if nobody else gets in; `None` if it is not there.
    fn check(&self) -> Result<Option<Metadata>, FileError> {
        let found = match fs::symlink_metadata(&self.path) {
            Ok(found) => found,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(FileError::file("use", &self.path)(error)),
        };
        let checked = if found.is_dir() {
            check_closed(&found, "chmod 700")
        } else {
            Err(refused("it is no folder"))
        };
        checked.map_err(FileError::file("use", &self.path))?;
        Ok(Some(found))
    }

    /// What a file has in it; `None` if it is not there.
    pub(super) fn read(&self, name: &str) -> Result<Option<Vec<u8>>, FileError> {
        let path = self.file(name);
        let failed = |error| FileError::file("read", &path)(error);
        if self.check()?.is_none() {
            return Ok(None);
        }
        let mut file = match options().read(true).open(&path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(failed(error)),
        };
        let read = file.metadata().and_then(|found| {
            if !found.is_file() {
                return Err(refused("it is no file"));
            }
            check_closed(&found, "chmod 600")?;
            let mut bytes = Vec::new();
            let _length = Read::by_ref(&mut file)
                .take(MOST_BYTES)
                .read_to_end(&mut bytes)?;
            Ok(bytes)
        });
        read.map(Some).map_err(failed)
    }

    /// Puts bytes into a file, in place of what is there.
    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), FileError> {
        let place = self.file(name);
        self.replace(&place, bytes)
            .map_err(FileError::file("write", &place))
    }

    fn replace(&self, place: &Path, bytes: &[u8]) -> io::Result<()> {
        let new = place.with_extension("new");
        match fs::remove_file(&new) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        let mut file = options()
            .create_new(true)
            .write(true)
            .mode(0o600)
            .open(&new)?;
        self.give_to_owner(&file)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(&new, place)?;
        File::open(&self.path)?.sync_all()
    }

    /// What root writes belongs to whoever has the folder, who is to read it.
    fn give_to_owner(&self, file: &File) -> io::Result<()> {
        if !geteuid().is_root() {
            return Ok(());
        }
        let found = fs::metadata(&self.path)?;
        fchown(file, Some(found.uid()), Some(found.gid()))
    }

    /// Takes the right to write, as soon as nobody else has it.
    pub(super) fn lock(&self) -> Result<Lock, FileError> {
        let path = self.file(LOCK);
        let locked = || {
            let mut options = options();
            let options = options.create(true).truncate(false).write(true).mode(0o600);
            let file = options.open(&path)?;
            self.give_to_owner(&file)?;
            flock(&file, FlockOperation::LockExclusive)?;
            Ok(Lock { _file: file })
        };
        locked().map_err(FileError::file("lock", &path))
    }

    /// Which version of a file is there.
    pub(super) fn stamp(&self, name: &str) -> Stamp {
        let found = fs::symlink_metadata(self.file(name)).ok()?;
        // This time changes with the mode, too.
        Some((found.ino(), found.ctime(), found.ctime_nsec(), found.len()))
    }
}

/// How a file is opened: itself, at once.
fn options() -> OpenOptions {
    let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK;
    let mut options = OpenOptions::new();
    options.custom_flags(flags.bits().cast_signed());
    options
}

/// Refuses what others can open, or have.
fn check_closed(found: &Metadata, remedy: &str) -> io::Result<()> {
    let user = geteuid();
    if !user.is_root() && user.as_raw() != found.uid() {
        return Err(refused(&format!("it belongs to user {}", found.uid())));
    }
    if found.mode() & 0o077 == 0 {
        return Ok(());
    }
    Err(refused(&format!(
        "other users can open it, and may have; `{remedy}` it, and pair the devices anew: they are in it"
    )))
}

fn refused(why: &str) -> io::Error {
    io::Error::new(io::ErrorKind::PermissionDenied, why)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::{PermissionsExt as _, symlink};

    fn made() -> (tempfile::TempDir, SecretFolder) {
        let state = tempfile::tempdir().unwrap();
        let folder = SecretFolder::open(state.path()).unwrap();
        folder.write("list", b"secret").unwrap();
        (state, folder)
    }

    #[test]
    fn what_is_written_is_closed_to_others() {
        let (_state, folder) = made();
        let mode = |path: &Path| fs::metadata(path).unwrap().mode() & 0o777;
        assert_eq!(mode(&folder.file("list")), 0o600);
        assert_eq!(mode(&folder.path), 0o700);
        let _lock = folder.lock().unwrap();
        assert_eq!(mode(&folder.file(LOCK)), 0o600);
        assert_eq!(folder.read("list").unwrap().unwrap(), b"secret");
        assert_eq!(folder.read("nothing").unwrap(), None);
        let before = folder.stamp("list");
        folder.write("list", b"shhh").unwrap();
        assert_ne!(folder.stamp("list"), before);
    }

    #[test]
    fn what_others_can_open_is_not_used() {
        for mode in [0o640, 0o604, 0o620, 0o601] {
            let (_state, folder) = made();
            let open = fs::Permissions::from_mode(mode);
            fs::set_permissions(folder.file("list"), open).unwrap();
            let error = folder.read("list").unwrap_err().to_string();
            assert!(error.contains("other users can open it"), "{error}");
        }
        for mode in [0o750, 0o705, 0o711] {
            let (state, folder) = made();
            fs::set_permissions(&folder.path, fs::Permissions::from_mode(mode)).unwrap();
            assert!(folder.read("list").is_err());
            assert!(SecretFolder::open(state.path()).is_err());
        }
    }

    #[test]
    fn nothing_is_reached_through_a_link() {
        let (state, folder) = made();
        symlink(folder.file("list"), folder.file("other")).unwrap();
        assert!(folder.read("other").is_err());
        let elsewhere = tempfile::tempdir().unwrap();
        symlink(state.path().join(NAME), elsewhere.path().join(NAME)).unwrap();
        assert!(SecretFolder::open(elsewhere.path()).is_err());
        assert!(SecretFolder::at(elsewhere.path()).read("list").is_err());
    }
}
