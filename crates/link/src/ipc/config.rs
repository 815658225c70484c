//! The settings by which a process joins an instance, and the directory where the instance keeps
//! its files.

use super::directory;
use crate::{Capacity, LinkError};
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

/// Longest name of an instance.
const NAME_MAX: usize = 32;

/// The instance to take part in. Processes with the same instance and root path meet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LinkConfig {
    /// Name of the instance: letters, digits, `-` and `_`, at most 32.
    pub instance: String,
    /// Directory for the files of all instances of this user, private to the user (mode 0700). It
    /// is made if it does not exist.
    pub root: PathBuf,
    /// How much the services hold; the same for all processes of an instance.
    pub capacity: Capacity,
}

impl LinkConfig {
    /// An instance under [`LinkConfig::default_root`].
    #[must_use]
    pub fn new(instance: &str) -> Self {
        let root = Self::default_root();
        Self {
            instance: instance.to_owned(),
            root,
            capacity: Capacity::default(),
        }
    }

    /// `$XDG_RUNTIME_DIR/glidepath` where that is a directory of this user in memory, else
    /// `/dev/shm/glidepath-<uid>`.
    #[must_use]
    pub fn default_root() -> PathBuf {
        let user = rustix::process::geteuid().as_raw();
        std::env::var_os("XDG_RUNTIME_DIR")
            .map(PathBuf::from)
            .filter(|path| path.is_absolute())
            .filter(|path| path.metadata().is_ok_and(|m| m.is_dir() && m.uid() == user))
            .filter(|path| directory::is_in_memory(path))
            .map_or_else(
                || PathBuf::from(format!("/dev/shm/glidepath-{user}")),
                |path| path.join("glidepath"),
            )
    }

    /// The instance's own directory.
    #[must_use]
    pub fn directory(&self) -> PathBuf {
        self.root.join(&self.instance)
    }

    /// Checks the name and makes the directories.
    pub(super) fn prepare(&self) -> Result<(), LinkError> {
        self.check_name()?;
        for path in [&self.root, &self.directory()] {
            directory::make(path).map_err(failed(path))?;
        }
        Ok(())
    }

    fn check_name(&self) -> Result<(), LinkError> {
        let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        let name = &self.instance;
        if name.is_empty() || name.len() > NAME_MAX || !name.chars().all(allowed) {
            let (what, longest) = ("the instance", NAME_MAX);
            return Err(LinkError::Name {
                what,
                name: name.clone(),
                longest,
            });
        }
        Ok(())
    }

    /// Checks that the directories are this user's alone, without making them. None where there is
    /// no instance is no failure.
    pub(super) fn check(&self) -> Result<(), LinkError> {
        self.check_name()?;
        for path in [&self.root, &self.directory()] {
            match directory::check(path) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
                checked => checked.map_err(failed(path))?,
            }
        }
        Ok(())
    }
}

fn failed(path: &Path) -> impl Fn(io::Error) -> LinkError {
    let path = path.display().to_string();
    move |source| LinkError::Root {
        path: path.clone(),
        source,
    }
}
