//! Records in files that are read and written, not mapped.
//!
//! A file of this kind has all of its room from the beginning, so that to write it never fails for
//! want of memory; and what is cut off, torn or garbled is found by a checksum, and is no record.
//!
//! ```text
//! number (8 bytes) · record · checksum of both (8 bytes)
//! ```

use crate::{LinkError, Record};
use core::marker::PhantomData;
use rustix::fs::{FallocateFlags, fallocate};
use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt as _;
use std::path::Path;

/// A place for one record, at a fixed offset of a file.
pub(super) struct RecordPlace<R> {
    offset: u64,
    record: PhantomData<R>,
}

impl<R: Record> RecordPlace<R> {
    const NUMBER: usize = size_of::<u64>();
    /// Bytes of a place.
    pub(super) const SIZE: usize = Self::NUMBER + size_of::<R>() + size_of::<u64>();

    pub(super) const fn at(offset: u64) -> Self {
        let record = PhantomData;
        Self { offset, record }
    }

    /// Writes a record with its number.
    pub(super) fn write(&self, file: &File, number: u64, record: &R) -> io::Result<()> {
        let mut bytes = Vec::with_capacity(Self::SIZE);
        bytes.extend(number.to_ne_bytes());
        bytes.extend(bytemuck::bytes_of(record));
        bytes.extend(checksum(&bytes).to_ne_bytes());
        file.write_all_at(&bytes, self.offset)
    }

    /// The record that is there with its number, unchecked; `None` if there is none, or only a part
    /// of one yet.
    pub(super) fn read(&self, file: &File) -> io::Result<Option<(u64, R)>> {
        let mut number = [0; size_of::<u64>()];
        let mut record = R::zeroed();
        let mut bytes = vec![0; Self::SIZE];
        match file.read_exact_at(&mut bytes, self.offset) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
            read => read?,
        }
        let (content, sum) = bytes.split_at(Self::NUMBER + size_of::<R>());
        if sum != checksum(content).to_ne_bytes() {
            return Ok(None);
        }
        let (first, rest) = content.split_at(Self::NUMBER);
        number.copy_from_slice(first);
        bytemuck::bytes_of_mut(&mut record).copy_from_slice(rest);
        Ok(Some((u64::from_ne_bytes(number), record)))
    }

    /// The number that is there, of a record or of a part of one: whether it is worth reading.
    pub(super) fn number(&self, file: &File) -> io::Result<u64> {
        let mut number = [0; size_of::<u64>()];
        match file.read_exact_at(&mut number, self.offset) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(0),
            read => read.map(|()| u64::from_ne_bytes(number)),
        }
    }
}

/// Gives a file all of its room now.
///
/// # Errors
///
/// [`LinkError::NoRoom`] if there is not as much.
pub(super) fn reserve(file: &File, path: &Path, length: usize) -> Result<(), LinkError> {
    let bytes = u64::try_from(length).unwrap_or(u64::MAX);
    fallocate(file, FallocateFlags::empty(), 0, bytes)
        .map_err(|error| LinkError::no_file(path, bytes, error.into()))
}

/// FNV-1a, 64 bits. A file of zeros is no record.
fn checksum(bytes: &[u8]) -> u64 {
    let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, mix)
}
