//! Setpoints through a pipe, from the servo process to this one: as they are in memory, one after
//! the other. Both ends are the same program.
//!
//! Who judges setpoints reads the program too, which may take it seconds between two moves. The servo
//! must not be held up by that, or it loses setpoints. So a thread of its own takes what comes through
//! the pipe, and keeps minutes of it.

use glidepath_link::{LinkError, Setpoint, Subscriber};
use std::io::{self, Cursor, ErrorKind, Read};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

/// Bytes that are handed over together, at most, and how many such pieces are kept.
const PIECE: usize = 1 << 15;
const PIECES: usize = 1 << 11;

/// Reads ahead of whoever reads it.
#[derive(Debug)]
pub(super) struct ReadAhead {
    pieces: Receiver<io::Result<Vec<u8>>>,
    piece: Cursor<Vec<u8>>,
}

impl ReadAhead {
    /// Begins to read, until the end, an error, or until nobody reads this any more.
    pub(super) fn of(from: impl Read + Send + 'static) -> Self {
        let (sender, pieces) = sync_channel(PIECES);
        std::thread::spawn(move || hand_over(from, &sender));
        Self {
            pieces,
            piece: Cursor::default(),
        }
    }
}

fn hand_over(mut from: impl Read, pieces: &SyncSender<io::Result<Vec<u8>>>) {
    let mut piece = vec![0; PIECE];
    loop {
        let read = match from.read(&mut piece) {
            Ok(0) => return,
            Ok(length) => Ok(piece[..length].to_vec()),
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(error) => Err(error),
        };
        let is_over = read.is_err();
        if pieces.send(read).is_err() || is_over {
            return;
        }
    }
}

impl Read for ReadAhead {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        loop {
            let length = self.piece.read(into)?;
            if length > 0 || into.is_empty() {
                return Ok(length);
            }
            let Ok(piece) = self.pieces.recv() else {
                return Ok(0);
            };
            self.piece = Cursor::new(piece?);
        }
    }
}

/// The receiving end.
#[derive(Debug)]
pub(super) struct Pipe<R>(pub(super) R);

impl<R: Read> Subscriber<Setpoint> for Pipe<R> {
    /// The next setpoint; `None` at the end, also where a writer that died left part of one.
    fn take(&mut self) -> Result<Option<Setpoint>, LinkError> {
        let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
        match self.0.read_exact(bytemuck::bytes_of_mut(&mut setpoint)) {
            Ok(()) => Ok(Some(setpoint)),
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => Ok(None),
            Err(error) => Err(LinkError::Transport {
                service: "servo",
                action: "reading what it received",
                detail: error.into(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write as _;

    #[test]
    fn setpoints_come_through_to_the_bit_and_parts_of_one_do_not() {
        let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
        (setpoint.number, setpoint.position[2]) = (7, -0.1);
        let mut bytes = bytemuck::bytes_of(&setpoint).to_vec();
        bytes.extend_from_within(..100);
        let mut pipe = Pipe(bytes.as_slice());
        assert_eq!(pipe.take().unwrap(), Some(setpoint));
        assert!(pipe.take().unwrap().is_none());
    }

    #[test]
    fn whoever_writes_is_not_held_up_by_whoever_reads() {
        // Twenty times what a pipe of the kernel takes.
        let bytes: Vec<u8> = (0..20 << 16).map(|k: u32| (k % 251) as u8).collect();
        let (reader, mut writer) = io::pipe().unwrap();
        let mut ahead = ReadAhead::of(reader);
        writer.write_all(&bytes).unwrap();
        drop(writer);
        let mut got = Vec::new();
        ahead.read_to_end(&mut got).unwrap();
        assert!(got == bytes);
    }

    #[test]
    fn an_error_comes_behind_what_was_read() {
        struct Broken(bool);
        impl Read for Broken {
            fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
                if std::mem::replace(&mut self.0, true) {
                    return Err(ErrorKind::ConnectionReset.into());
                }
                into[0] = 5;
                Ok(1)
            }
        }
        let mut ahead = ReadAhead::of(Broken(false));
        let mut got = Vec::new();
        let error = ahead.read_to_end(&mut got).unwrap_err();
        assert_eq!((got, error.kind()), (vec![5], ErrorKind::ConnectionReset));
    }
}
