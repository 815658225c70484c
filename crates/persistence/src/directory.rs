//! A folder of the file system as storage.
//!
//! What is kept decides where a machine goes, so nobody but the folder's owner and those it was
//! opened to by its group may write there: a folder or a file that everybody may write to is
//! refused, and so is a folder to write in that is another user's. Neither files nor the folder itself
//! are reached through symbolic links, and what is no file (a FIFO waits for ever) is not read.

use crate::error::StoreError;
use crate::storage::Storage;
use rustix::fs::{FlockOperation, OFlags, flock};
use rustix::process::geteuid;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, MetadataExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

/// The file whose lock says who writes.
const LOCK: &str = "lock";

/// Largest file that is read, bytes: what is kept is a thousandth of it, ten thousand tools apart.
const MOST_BYTES: u64 = 16 << 20;

/// A folder.
#[derive(Debug)]
pub struct Directory {
    path: PathBuf,
}

/// The right to write in a folder, until it is dropped or the process ends.
#[derive(Debug)]
pub struct DirectoryLock {
    _file: File,
}

impl Directory {
    /// A folder, which is made if it is not there; its parent has to be.
    ///
    /// # Errors
    /// It cannot be made, or is no folder.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let name = path.display().to_string();
        let made = fs::DirBuilder::new().mode(0o750).create(path);
        match made {
            Ok(()) => {
                // The folder itself is a name in another one.
                let parent = path.parent().filter(|parent| *parent != Path::new(""));
                let parent = parent.unwrap_or(Path::new("."));
                let synced = File::open(parent).and_then(|parent| parent.sync_all());
                synced.map_err(StoreError::io("write", &name))?;
            }
            // A link to one, too: the check says what is wrong with it.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && path.is_dir() => {}
            Err(source) => return Err(StoreError::io("make the folder", &name)(source)),
        }
        let folder = Self::at(path);
        let checked = folder.check().and_then(|found| {
            let user = geteuid();
            let is_own = user.is_root() || [user.as_raw(), 0].contains(&found.uid());
            let why = format!("it belongs to user {}", found.uid());
            is_own.then_some(()).ok_or_else(|| refused(&why))
        });
        checked.map_err(StoreError::io("write in the folder", &name))?;
        Ok(folder)
    }

    /// What the folder is, of which nothing is read or written if everybody may write there.
    fn check(&self) -> io::Result<Metadata> {
        let found = fs::symlink_metadata(&self.path)?;
        if found.is_symlink() {
            return Err(refused(
                "it is a symbolic link, which could lead elsewhere tomorrow; name the folder itself",
            ));
        }
        check_closed(&found)?;
        Ok(found)
    }

    /// A folder to read in, which need not be there: nothing is kept then.
    #[must_use]
    pub fn at(path: &Path) -> Self {
        // Without a slash at its end, behind which a link is followed.
        Self {
            path: path.components().collect(),
        }
    }

    /// How a file in it is opened: the file itself, at once.
    fn options() -> OpenOptions {
        let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK;
        let mut options = OpenOptions::new();
        options.custom_flags(flags.bits().cast_signed());
        options
    }

    /// Takes the right to write here, which one process has at a time.
    ///
    /// # Errors
    /// [`StoreError::Taken`]: another process has it; or the lock's file cannot be made.
    pub fn lock(&self) -> Result<DirectoryLock, StoreError> {
        let path = self.path.join(LOCK);
        let file = Self::options()
            .create(true)
            .truncate(false)
            .read(true)
            .write(true)
            .mode(0o640)
            .open(&path)
            .map_err(StoreError::io("open", &path.display().to_string()))?;
        match flock(&file, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => {
                // Where it cannot be written, others are told of a process without its number.
                let _noted = note_process(&file);
                Ok(DirectoryLock { _file: file })
            }
            Err(rustix::io::Errno::WOULDBLOCK) => Err(StoreError::Taken {
                folder: self.path.display().to_string(),
                process: noted_process(&file),
            }),
            Err(error) => {
                let name = path.display().to_string();
                Err(StoreError::io("lock", &name)(error.into()))
            }
        }
    }
}

/// Writes the number of this process, which has the lock, into the lock's file.
fn note_process(mut file: &File) -> io::Result<()> {
    file.set_len(0)?;
    file.write_all(std::process::id().to_string().as_bytes())
}

/// The process that has noted itself in the lock's file.
fn noted_process(file: &File) -> Option<u32> {
    let mut text = String::new();
    file.take(16).read_to_string(&mut text).ok()?;
    text.trim().parse().ok()
}

impl Storage for Directory {
    fn read(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        let file = match Self::options().read(true).open(self.path.join(name)) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error),
        };
        self.check()?;
        let found = file.metadata()?;
        check_closed(&found)?;
        if !found.is_file() {
            return Err(io::Error::new(io::ErrorKind::InvalidData, "it is no file"));
        }
        let mut bytes = Vec::new();
        file.take(MOST_BYTES).read_to_end(&mut bytes)?;
        Ok(Some(bytes))
    }

    fn create(&mut self, name: &str) -> io::Result<()> {
        let path = self.path.join(name);
        // What is there may be a link to something else.
        match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        let mut options = Self::options();
        let options = options.create_new(true).write(true).mode(0o640);
        options.open(path).map(drop)
    }

    fn append(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let mut file = Self::options().append(true).open(self.path.join(name))?;
        file.write_all(bytes)
    }

    fn sync(&mut self, name: &str) -> io::Result<()> {
        Self::options()
            .write(true)
            .open(self.path.join(name))?
            .sync_all()
    }

    fn rename(&mut self, from: &str, to: &str) -> io::Result<()> {
        fs::rename(self.path.join(from), self.path.join(to))
    }

    fn sync_names(&mut self) -> io::Result<()> {
        File::open(&self.path)?.sync_all()
    }

    fn describe(&self, name: &str) -> String {
        self.path.join(name).display().to_string()
    }
}

/// Refuses what everybody may write to.
fn check_closed(found: &Metadata) -> io::Result<()> {
    const EVERYBODY: u32 = 0o002;
    if found.mode() & EVERYBODY == 0 {
        return Ok(());
    }
    Err(refused(
        "everybody may write to it, and could send the machine elsewhere; look at what is kept, \
         then `chmod o-w` it",
    ))
}

fn refused(why: &str) -> io::Error {
    io::Error::new(io::ErrorKind::PermissionDenied, why)
}
