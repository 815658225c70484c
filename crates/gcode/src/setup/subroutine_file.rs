//! Subroutines in files of their own.
//!
//! A call of a subroutine that the program does not define means the file of that name: `o<drill>
//! call` the subroutine `o<drill> sub` … `o<drill> endsub` in `drill.ngc`, `o100 call` the one in
//! `100.ngc`. Names are in lower case. As with LinuxCNC, what stands around that subroutine in its
//! file is not read.
//!
//! Where files are is the business of whoever reads programs: [`Subroutines`] asks for them by
//! name.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Most text of subroutines and loops kept at a time, bytes.
pub(crate) const MAX_KEPT_BYTES: usize = 32 * 1024 * 1024;
/// Largest file of a subroutine, bytes.
pub const MAX_SUBROUTINE_BYTES: usize = 16 * 1024 * 1024;
/// Most bytes of all files one program calls.
const MAX_FILES_BYTES: usize = MAX_KEPT_BYTES;

/// A file with a subroutine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SubroutineFile {
    /// What diagnostics call it: its path.
    pub name: Arc<str>,
    /// All of it, or more than [`MAX_SUBROUTINE_BYTES`] of it.
    pub text: Arc<[u8]>,
}

/// The reason why there is no file for a subroutine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoSubroutineFile {
    /// There is none of that name.
    Missing {
        /// The folders that were looked through, in order.
        looked_in: Vec<String>,
    },
    /// There is one, and it cannot be read.
    Unreadable {
        /// Its path.
        path: String,
        /// What the system says.
        reason: String,
    },
}

/// Why a file was not taken.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum NotTaken {
    None(NoSubroutineFile),
    TooLong(Arc<str>),
}

type Find = dyn Fn(&str) -> Result<SubroutineFile, NoSubroutineFile> + Send + Sync;

/// The source of a program's subroutines in other files.
///
/// Each file is read once: clones share what was read, so that a program that was checked runs with
/// the subroutines it was checked with. It belongs to one program.
#[derive(Clone)]
pub struct Subroutines {
    cache: Arc<FileCache>,
}

struct FileCache {
    find: Box<Find>,
    /// The files that were found, by name.
    found: Mutex<BTreeMap<String, SubroutineFile>>,
}

impl Subroutines {
    /// Subroutines that `find` gives: it is asked with the name of a file, as `drill.ngc`, which
    /// has no part that could lead to another folder.
    #[must_use]
    pub fn new(
        find: impl Fn(&str) -> Result<SubroutineFile, NoSubroutineFile> + Send + Sync + 'static,
    ) -> Self {
        let cache = FileCache {
            find: Box::new(find),
            found: Mutex::default(),
        };
        Self {
            cache: Arc::new(cache),
        }
    }

    /// The files read so far: by what name each was asked for, in the order of the names.
    #[must_use]
    pub fn read(&self) -> Vec<(String, SubroutineFile)> {
        let found = self.cache.found.lock();
        let found = found.unwrap_or_else(PoisonError::into_inner);
        found
            .iter()
            .map(|(name, file)| (name.clone(), file.clone()))
            .collect()
    }

    /// The file of that name.
    pub(crate) fn get(&self, name: &str) -> Result<SubroutineFile, NotTaken> {
        let found = self.cache.found.lock();
        let mut found = found.unwrap_or_else(PoisonError::into_inner);
        if let Some(file) = found.get(name) {
            return Ok(file.clone());
        }
        let file = (self.cache.find)(name).map_err(NotTaken::None)?;
        let others: usize = found.values().map(|file| file.text.len()).sum();
        if file.text.len() > MAX_SUBROUTINE_BYTES || others + file.text.len() > MAX_FILES_BYTES {
            return Err(NotTaken::TooLong(file.name));
        }
        found.insert(name.to_owned(), file.clone());
        Ok(file)
    }

    /// The first file that there is of some names; where there is none, where the last was looked for.
    pub(crate) fn first_of(
        &self,
        names: impl IntoIterator<Item = String>,
    ) -> Result<SubroutineFile, NotTaken> {
        let mut missing = NotTaken::None(NoSubroutineFile::Missing {
            looked_in: Vec::new(),
        });
        for name in names {
            match self.get(&name) {
                Err(none @ NotTaken::None(NoSubroutineFile::Missing { .. })) => missing = none,
                found => return found,
            }
        }
        Err(missing)
    }
}

impl fmt::Debug for Subroutines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Subroutines").finish_non_exhaustive()
    }
}

/// Two are the same if one is a clone of the other.
impl PartialEq for Subroutines {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.cache, &other.cache)
    }
}
