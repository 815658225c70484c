//! A folder of the file system as storage.

use crate::error::KeptError;
use crate::storage::Storage;
use rustix::fs::{FlockOperation, flock};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
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
    pub fn open(path: &Path) -> Result<Self, KeptError> {
        let name = path.display().to_string();
        let made = fs::DirBuilder::new().mode(0o750).create(path);
        match made {
            Ok(()) => {
                // The folder itself is a name in another one.
                let parent = path.parent().filter(|parent| *parent != Path::new(""));
                let parent = parent.unwrap_or(Path::new("."));
                let synced = File::open(parent).and_then(|parent| parent.sync_all());
                synced.map_err(KeptError::io("write", &name))?;
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && path.is_dir() => {}
            Err(source) => return Err(KeptError::io("make the folder", &name)(source)),
        }
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// A folder to read in, which need not be there: nothing is kept then.
    #[must_use]
    pub fn at(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
        }
    }

    /// Takes the right to write here, which one process has at a time.
    ///
    /// # Errors
    /// [`KeptError::Taken`]: another process has it; or the lock's file cannot be made.
    pub fn lock(&self) -> Result<DirectoryLock, KeptError> {
        let path = self.path.join(LOCK);
        let file = OpenOptions::new()
            .create(true)
            .truncate(false)
            .write(true)
            .mode(0o640)
            .open(&path)
            .map_err(KeptError::io("open", &path.display().to_string()))?;
        match flock(&file, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => Ok(DirectoryLock { _file: file }),
            Err(rustix::io::Errno::WOULDBLOCK) => Err(KeptError::Taken {
                folder: self.path.display().to_string(),
            }),
            Err(error) => {
                let name = path.display().to_string();
                Err(KeptError::io("lock", &name)(error.into()))
            }
        }
    }
}

impl Storage for Directory {
    fn read(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        let file = match File::open(self.path.join(name)) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error),
        };
        let mut bytes = Vec::new();
        file.take(MOST_BYTES).read_to_end(&mut bytes)?;
        Ok(Some(bytes))
    }

    fn create(&mut self, name: &str) -> io::Result<()> {
        let mut options = OpenOptions::new();
        let options = options.create(true).truncate(true).write(true).mode(0o640);
        options.open(self.path.join(name)).map(drop)
    }

    fn append(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let mut file = OpenOptions::new().append(true).open(self.path.join(name))?;
        file.write_all(bytes)
    }

    fn sync(&mut self, name: &str) -> io::Result<()> {
        OpenOptions::new()
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
