//! Records in a file: what went over a port, to look at later or to run again.
//!
//! A file is a header of 64 bytes and then the records, as they are in memory; all numbers are
//! little-endian.
//!
//! | offset | bytes | |
//! |---|---|---|
//! | 0 | 8 | `GLIDEREC` |
//! | 8 | 4 | version of this format, 1 |
//! | 12 | 4 | size of a record |
//! | 16 | 48 | name of the record with its version, padded with zeros |
//!
//! A file that was cut short, by a crash or a full disk, is good up to its last whole record.

#[cfg(target_endian = "big")]
compile_error!(
    "recordings are little-endian, as the records in memory must be to be written as they are"
);

mod error;
mod format;

pub use error::RecordingError;

use crate::{LinkError, Record, Subscriber};
use core::marker::PhantomData;
use format::{Header, MAGIC, NAME_BYTES, VERSION};
use std::io::{self, Read, Write};

/// Writes records to a file or any other writer, which had better be buffered.
#[derive(Debug)]
pub struct Recorder<R, W: Write> {
    writer: W,
    written: u64,
    record: PhantomData<R>,
}

impl<R: Record, W: Write> Recorder<R, W> {
    /// Begins a recording.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn new(mut writer: W) -> Result<Self, RecordingError> {
        writer.write_all(bytemuck::bytes_of(&Header::of::<R>()))?;
        Ok(Self {
            writer,
            written: 0,
            record: PhantomData,
        })
    }

    /// Adds a record, unchecked: a recording shows what was there.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn write(&mut self, record: &R) -> Result<(), RecordingError> {
        self.writer.write_all(bytemuck::bytes_of(record))?;
        self.written += 1;
        Ok(())
    }

    /// Hands over what is buffered.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn flush(&mut self) -> Result<(), RecordingError> {
        Ok(self.writer.flush()?)
    }

    /// Records written.
    #[must_use]
    pub const fn written(&self) -> u64 {
        self.written
    }

    /// Ends the recording; gives the writer back, flushed.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn finish(mut self) -> Result<W, RecordingError> {
        self.writer.flush()?;
        Ok(self.writer)
    }
}

/// A receiving end that records all that passes.
pub struct Recording<R, W: Write> {
    inner: Box<dyn Subscriber<R>>,
    recorder: Recorder<R, W>,
}

impl<R, W: Write> core::fmt::Debug for Recording<R, W> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Recording")
            .field("written", &self.recorder.written)
            .finish_non_exhaustive()
    }
}

impl<R: Record, W: Write> Recording<R, W> {
    /// Records what passes from `inner`.
    #[must_use]
    pub const fn new(inner: Box<dyn Subscriber<R>>, recorder: Recorder<R, W>) -> Self {
        Self { inner, recorder }
    }

    /// Ends the recording; gives its writer back, flushed.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn finish(self) -> Result<W, RecordingError> {
        self.recorder.finish()
    }
}

impl<R: Record, W: Write> Subscriber<R> for Recording<R, W> {
    fn take(&mut self) -> Result<Option<R>, LinkError> {
        let taken = self.inner.take()?;
        if let Some(record) = &taken {
            self.recorder.write(record)?;
        }
        Ok(taken)
    }
}

/// Reads a recording, as if its records arrived again; `None` at its end.
#[derive(Debug)]
pub struct Replay<R, I: Read> {
    reader: I,
    whole: u64,
    record: PhantomData<R>,
}

impl<R: Record, I: Read> Replay<R, I> {
    /// Opens a recording.
    ///
    /// # Errors
    ///
    /// If the file is no recording of these records in this version.
    pub fn new(mut reader: I) -> Result<Self, RecordingError> {
        let mut header = Header {
            magic: [0; 8],
            version: 0,
            record_size: 0,
            name: [0; NAME_BYTES],
        };
        let read = read_up_to(&mut reader, bytemuck::bytes_of_mut(&mut header))?;
        if read < size_of::<Header>() || header.magic != MAGIC {
            return Err(RecordingError::NotARecording);
        }
        if header.version != VERSION {
            return Err(RecordingError::Version {
                found: header.version,
            });
        }
        if header != Header::of::<R>() {
            return Err(RecordingError::OtherRecord {
                found: header.name(),
                expected: R::NAME,
            });
        }
        Ok(Self {
            reader,
            whole: 0,
            record: PhantomData,
        })
    }

    /// The next record, unchecked; `None` at the end.
    ///
    /// # Errors
    ///
    /// The reader's, or [`RecordingError::CutShort`].
    pub fn next_record(&mut self) -> Result<Option<R>, RecordingError> {
        let mut record = R::zeroed();
        let read = read_up_to(&mut self.reader, bytemuck::bytes_of_mut(&mut record))?;
        if read == 0 {
            return Ok(None);
        }
        if read < size_of::<R>() {
            return Err(RecordingError::CutShort { whole: self.whole });
        }
        self.whole += 1;
        Ok(Some(record))
    }
}

impl<R: Record, I: Read> Subscriber<R> for Replay<R, I> {
    fn take(&mut self) -> Result<Option<R>, LinkError> {
        Ok(self.next_record()?)
    }
}

/// Fills the buffer as far as there is something to read.
fn read_up_to(reader: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while let Some(rest) = buffer.get_mut(filled..).filter(|rest| !rest.is_empty()) {
        match reader.read(rest) {
            Ok(0) => break,
            Ok(read) => filled += read,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(filled)
}
