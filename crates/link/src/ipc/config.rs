//! Where an instance keeps its files.

use crate::{Capacity, LinkError};
use std::io;
use std::os::unix::fs::{DirBuilderExt, MetadataExt};
use std::path::{Path, PathBuf};

/// Longest name of an instance.
const NAME_MAX: usize = 32;

/// Which instance to take part in. Processes with the same instance and root path meet.
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

    /// `$XDG_RUNTIME_DIR/glidepath` where that is a directory of this user, else
    /// `/tmp/glidepath-<uid>`.
    #[must_use]
    pub fn default_root() -> PathBuf {
        let user = rustix::process::geteuid().as_raw();
        std::env::var_os("XDG_RUNTIME_DIR")
            .map(PathBuf::from)
            .filter(|path| path.is_absolute())
            .filter(|path| path.metadata().is_ok_and(|m| m.is_dir() && m.uid() == user))
            .map_or_else(
                || PathBuf::from(format!("/tmp/glidepath-{user}")),
                |path| path.join("glidepath"),
            )
    }

    /// The instance's own directory.
    #[must_use]
    pub fn directory(&self) -> PathBuf {
        self.root.join(&self.instance)
    }

    /// What the names of the instance's files in `/dev/shm` begin with: the same for all processes
    /// of the instance, and no other instance's. A subscriber that does not use this crate needs it
    /// and [`LinkConfig::directory`] for its own configuration of iceoryx2.
    #[must_use]
    pub fn prefix(&self) -> String {
        // Two users, or two root paths, may each have an instance of the same name.
        let hash = fnv1a(self.root.as_os_str().as_encoded_bytes());
        format!("gp_{}_{hash:08x}_", self.instance)
    }

    /// Checks the name and makes the directories.
    pub(super) fn prepare(&self) -> Result<(), LinkError> {
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
        private_directory(&self.root)?;
        private_directory(&self.directory())
    }
}

/// Makes a directory that only this user can enter, or checks that it is one.
fn private_directory(path: &Path) -> Result<(), LinkError> {
    let failed = |source| LinkError::Root {
        path: path.display().to_string(),
        source,
    };
    if !path.is_absolute() {
        return Err(failed(io::Error::new(
            io::ErrorKind::InvalidInput,
            "the path is not absolute",
        )));
    }
    match std::fs::DirBuilder::new()
        .mode(0o700)
        .recursive(false)
        .create(path)
    {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
            let found = path.symlink_metadata().map_err(failed)?;
            let own = found.uid() == rustix::process::geteuid().as_raw();
            if found.is_dir() && own && found.mode() & 0o077 == 0 {
                Ok(())
            } else {
                let why = "it exists, but is not a directory of mode 0700 of this user";
                Err(failed(io::Error::new(io::ErrorKind::PermissionDenied, why)))
            }
        }
        Err(error) => Err(failed(error)),
    }
}

/// FNV-1a, 32 bits: short, and the same in every process and version.
fn fnv1a(bytes: &[u8]) -> u32 {
    let mix = |hash: u32, byte: &u8| (hash ^ u32::from(*byte)).wrapping_mul(0x0100_0193);
    bytes.iter().fold(0x811c_9dc5, mix)
}
