//! The storage: the few things that are done with files, so that a test can let the power go at
//! each of them.

use std::io;

/// A folder with files.
pub trait Storage {
    /// All of a file; `None` if there is none of that name.
    ///
    /// # Errors
    /// The file cannot be read.
    fn read(&self, name: &str) -> io::Result<Option<Vec<u8>>>;

    /// Makes an empty file, in the place of one that is there.
    ///
    /// # Errors
    /// The file cannot be made.
    fn create(&mut self, name: &str) -> io::Result<()>;

    /// Writes bytes at the end of a file that was created.
    ///
    /// # Errors
    /// The bytes cannot be written.
    fn append(&mut self, name: &str, bytes: &[u8]) -> io::Result<()>;

    /// Waits until the bytes of a file outlast a loss of power.
    ///
    /// # Errors
    /// They may not.
    fn sync(&mut self, name: &str) -> io::Result<()>;

    /// Gives a file another name, in the place of one that has it, in one step.
    ///
    /// # Errors
    /// The file keeps its name.
    fn rename(&mut self, from: &str, to: &str) -> io::Result<()>;

    /// Waits until the names of all files outlast a loss of power.
    ///
    /// # Errors
    /// They may not.
    fn sync_names(&mut self) -> io::Result<()>;

    /// What people call a file of it.
    fn describe(&self, name: &str) -> String;
}

impl<S: Storage> Storage for &mut S {
    fn read(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        (**self).read(name)
    }

    fn create(&mut self, name: &str) -> io::Result<()> {
        (**self).create(name)
    }

    fn append(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        (**self).append(name, bytes)
    }

    fn sync(&mut self, name: &str) -> io::Result<()> {
        (**self).sync(name)
    }

    fn rename(&mut self, from: &str, to: &str) -> io::Result<()> {
        (**self).rename(from, to)
    }

    fn sync_names(&mut self) -> io::Result<()> {
        (**self).sync_names()
    }

    fn describe(&self, name: &str) -> String {
        (**self).describe(name)
    }
}
