//! Files mapped into memory whose room was taken before.
#![allow(
    unsafe_code,
    reason = "memory that processes share is mapped by hand: what maps it for iceoryx2 takes no room \
              for it, so that a process dies of SIGBUS when the file system is full"
)]

use super::directory;
use super::trouble;
use crate::LinkError;
use core::ptr::NonNull;
use rustix::fs::{FallocateFlags, fallocate};
use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};
use std::fs::File;
use std::io;
use std::path::Path;

/// A whole file in memory, shared with the processes that map it too. The file is closed: a process
/// has as many files mapped as it has peers, and only so many descriptors.
#[derive(Debug)]
pub(super) struct Mapping {
    start: NonNull<u8>,
    length: usize,
}

/// Why a file could not be made or opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MappingError {
    /// To be made, and there already.
    Exists,
    /// To be opened, and not there.
    Missing,
    /// Its maker has not given it its length yet.
    Empty,
    /// Anything else, of which [`trouble`] was told.
    Failed,
}

impl Mapping {
    /// Makes a file of a length, of zeros, all of its room taken. Leaves none if that fails.
    pub(super) fn make(path: &Path, length: usize) -> Result<Self, MappingError> {
        let bytes = u64::try_from(length).unwrap_or(u64::MAX);
        let failed = |error| {
            trouble::note(LinkError::no_file(path, bytes, error));
            MappingError::Failed
        };
        let file = match directory::options().create_new(true).open(path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                return Err(MappingError::Exists);
            }
            opened => opened.map_err(failed)?,
        };
        let mapped = fallocate(&file, FallocateFlags::empty(), 0, bytes)
            .map_err(io::Error::from)
            .and_then(|()| Self::of(&file, length, true));
        mapped.map_err(|error| {
            // It is of no use to anybody.
            let _ = std::fs::remove_file(path);
            failed(error)
        })
    }

    /// Maps a file that another process made, at least `least` long.
    pub(super) fn open(path: &Path, least: usize, to_write: bool) -> Result<Self, MappingError> {
        let failed = |error| {
            trouble::note(LinkError::no_file(path, 0, error));
            MappingError::Failed
        };
        let file = match directory::options().write(to_write).open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(MappingError::Missing);
            }
            opened => opened.map_err(failed)?,
        };
        let found = file.metadata().map_err(failed)?;
        let length = usize::try_from(found.len()).unwrap_or(usize::MAX);
        if length == 0 {
            return Err(MappingError::Empty);
        }
        if !found.is_file() || length < least {
            let why = "it was cut off or is not of this program";
            return Err(failed(io::Error::new(io::ErrorKind::InvalidData, why)));
        }
        Self::of(&file, length, to_write).map_err(failed)
    }

    fn of(file: &File, length: usize, to_write: bool) -> io::Result<Self> {
        let mut access = ProtFlags::READ;
        access.set(ProtFlags::WRITE, to_write);
        // SAFETY: the kernel chooses a place where nothing is; the mapping is undone with `self`.
        let start = unsafe {
            mmap(
                core::ptr::null_mut(),
                length,
                access,
                MapFlags::SHARED,
                file,
                0,
            )
        }?;
        let start = NonNull::new(start.cast()).ok_or(io::ErrorKind::OutOfMemory)?;
        Ok(Self { start, length })
    }

    /// Where it begins: at the beginning of a page.
    pub(super) const fn start(&self) -> NonNull<u8> {
        self.start
    }

    pub(super) const fn length(&self) -> usize {
        self.length
    }
}

impl Drop for Mapping {
    fn drop(&mut self) {
        // SAFETY: it was mapped there with that length, and who has a pointer into it borrows `self`
        // or is iceoryx2, which keeps the storage for as long.
        let _ = unsafe { munmap(self.start.as_ptr().cast(), self.length) };
    }
}
