//! The pipe of setpoints from the servo process to this one: as they are in memory, one after the
//! other. Both ends are the same program.
//!
//! Who judges setpoints reads the program too, which may take it minutes between two moves. The servo
//! must not be held up by that, or it loses setpoints. So a thread of its own takes what comes through
//! the pipe, and keeps it until it is asked for.

use glidepath_link::{LinkError, Setpoint, Subscriber};
use serde::{Deserialize, Serialize};
use std::io::{self, Cursor, ErrorKind, Read};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};

/// Bytes that are read at a time.
const PIECE: usize = 1 << 15;
/// Bytes that are kept before whoever writes is held up after all: a quarter of an hour of setpoints every
/// 4 ms, a minute of those every 250 µs. The memory is taken as it is needed.
const MOST: usize = 1 << 28;

/// Whether the servo has ended what it gives.
#[derive(Debug, Clone)]
pub(super) struct GivenAll(Arc<Shared>);

impl GivenAll {
    /// Whether it has, however much of it was asked for by now.
    pub(super) fn is_so(&self) -> bool {
        self.0.kept().end.is_some()
    }
}

/// Reads ahead of whoever reads it.
#[derive(Debug)]
pub(super) struct ReadAhead {
    shared: Arc<Shared>,
    taken: Cursor<Vec<u8>>,
}

#[derive(Debug, Default)]
struct Shared {
    kept: Mutex<Kept>,
    came: Condvar,
    went: Condvar,
}

/// What was read and not yet asked for.
#[derive(Debug, Default)]
struct Kept {
    bytes: Vec<u8>,
    /// How it ended, behind the bytes.
    end: Option<io::Result<()>>,
    /// Nobody will ask any more.
    is_dropped: bool,
}

impl Shared {
    fn kept(&self) -> MutexGuard<'_, Kept> {
        // Bytes are there or not, whoever panicked.
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl ReadAhead {
    /// Begins to read, until the end, an error, or until nobody reads this any more.
    pub(super) fn of(from: impl Read + Send + 'static) -> Self {
        Self::keeping(from, MOST)
    }

    /// Tells when there is nothing more to be read from the pipe.
    pub(super) fn given_all(&self) -> GivenAll {
        GivenAll(Arc::clone(&self.shared))
    }

    fn keeping(from: impl Read + Send + 'static, most: usize) -> Self {
        let shared = Arc::<Shared>::default();
        let keeping = Arc::clone(&shared);
        std::thread::spawn(move || keep(from, &keeping, most));
        Self {
            shared,
            taken: Cursor::default(),
        }
    }
}

impl Drop for ReadAhead {
    fn drop(&mut self) {
        self.shared.kept().is_dropped = true;
        self.shared.went.notify_one();
    }
}

fn keep(mut from: impl Read, shared: &Shared, most: usize) {
    let mut piece = vec![0; PIECE];
    loop {
        let read = match from.read(&mut piece) {
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            read => read,
        };
        let is_full = |kept: &mut Kept| kept.bytes.len() >= most && !kept.is_dropped;
        let kept = shared.went.wait_while(shared.kept(), is_full);
        let mut kept = kept.unwrap_or_else(PoisonError::into_inner);
        match read {
            Ok(0) => kept.end = Some(Ok(())),
            Ok(length) => kept.bytes.extend_from_slice(&piece[..length]),
            Err(error) => kept.end = Some(Err(error)),
        }
        shared.came.notify_one();
        if kept.is_dropped || kept.end.is_some() {
            return;
        }
    }
}

impl Read for ReadAhead {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let length = self.taken.read(into)?;
        if length > 0 || into.is_empty() {
            return Ok(length);
        }
        let is_awaited = |kept: &mut Kept| kept.bytes.is_empty() && kept.end.is_none();
        let kept = self.shared.came.wait_while(self.shared.kept(), is_awaited);
        let mut kept = kept.unwrap_or_else(PoisonError::into_inner);
        if kept.bytes.is_empty() {
            // An error is told once; behind it there is the end.
            let end = kept.end.replace(Ok(()));
            return end.unwrap_or(Ok(())).map(|()| 0);
        }
        self.taken = Cursor::new(std::mem::take(&mut kept.bytes));
        self.shared.went.notify_one();
        drop(kept);
        self.taken.read(into)
    }
}

/// Bytes that are told of why the servo stopped, at most: with all of them escaped they are fewer than
/// those of a setpoint.
const MOST_SAID: usize = 160;
const _: () = assert!(6 * MOST_SAID + 64 < size_of::<Setpoint>());

/// What the servo says behind its last setpoint.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::command) struct Farewell {
    /// How often it stopped the joints by itself.
    pub(in crate::command) own_stops: u64,
    /// Why it did so first.
    pub(in crate::command) first_stop: Option<String>,
}

impl Farewell {
    /// As it goes through the pipe: a text that is shorter than a setpoint, or it would be taken for one.
    /// Of a reason that is too long the beginning is told.
    pub(in crate::command) fn to_bytes(&self) -> Vec<u8> {
        let mut told = self.clone();
        if let Some(why) = &mut told.first_stop {
            let end = (0..=MOST_SAID).rev().find(|end| why.is_char_boundary(*end));
            why.truncate(end.unwrap_or(0));
        }
        serde_json::to_vec(&told).unwrap_or_default()
    }

    /// What is left at the end of the pipe; `None` for part of a setpoint.
    fn from_bytes(bytes: &[u8]) -> Option<Self> {
        serde_json::from_slice(bytes).ok()
    }
}

/// The receiving end.
#[derive(Debug)]
pub(super) struct Pipe<R> {
    from: R,
    farewell: Arc<OnceLock<Farewell>>,
}

impl<R: Read> Pipe<R> {
    /// The end of a pipe, and where its farewell will be.
    pub(super) fn new(from: R) -> (Self, Arc<OnceLock<Farewell>>) {
        let farewell = Arc::default();
        let pipe = Self {
            from,
            farewell: Arc::clone(&farewell),
        };
        (pipe, farewell)
    }

    /// Reads until a piece is full or the pipe has ended; how much there was.
    fn fill(&mut self, piece: &mut [u8]) -> io::Result<usize> {
        let mut filled = 0;
        while filled < piece.len() {
            match self.from.read(&mut piece[filled..]) {
                Ok(0) => break,
                Ok(length) => filled += length,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(filled)
    }
}

impl<R: Read> Subscriber<Setpoint> for Pipe<R> {
    /// The next setpoint; `None` at the end, also where a writer that died left part of one.
    fn take(&mut self) -> Result<Option<Setpoint>, LinkError> {
        let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
        let bytes = bytemuck::bytes_of_mut(&mut setpoint);
        let filled = self.fill(bytes).map_err(|error| LinkError::Transport {
            service: "servo",
            action: "reading what it received",
            detail: error.into(),
        })?;
        if filled == bytes.len() {
            return Ok(Some(setpoint));
        }
        if let Some(farewell) = Farewell::from_bytes(&bytes[..filled]) {
            let _ = self.farewell.set(farewell);
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write as _;
    use std::sync::mpsc;
    use std::time::Duration;

    #[test]
    fn setpoints_come_through_to_the_bit_and_parts_of_one_do_not() {
        let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
        (setpoint.number, setpoint.position[2]) = (7, -0.1);
        let mut bytes = bytemuck::bytes_of(&setpoint).to_vec();
        bytes.extend_from_within(..100);
        let (mut pipe, farewell) = Pipe::new(bytes.as_slice());
        assert_eq!(pipe.take().unwrap(), Some(setpoint));
        assert!(pipe.take().unwrap().is_none());
        assert_eq!(farewell.get(), None);
    }

    #[test]
    fn what_is_said_behind_the_last_setpoint_comes_through() {
        let jump = glidepath_link::servo::Jump {
            joint: 8,
            from: -1.234_567_890_123_456_7e-300,
            to: f64::MIN,
            span_t: 0.008,
            of: glidepath_link::servo::JumpOf::Acceleration,
            asked: f64::MAX,
            limit: 320.0,
        };
        let said = Farewell {
            own_stops: 2,
            first_stop: Some(jump.to_string()),
        };
        let mut bytes = bytemuck::bytes_of(&<Setpoint as bytemuck::Zeroable>::zeroed()).to_vec();
        bytes.extend(said.to_bytes());
        let (mut pipe, farewell) = Pipe::new(bytes.as_slice());
        assert!(pipe.take().unwrap().is_some());
        assert!(pipe.take().unwrap().is_none());
        let told = farewell.get().unwrap();
        assert_eq!(told.own_stops, 2);
        // The numbers are longer than any that a machine has.
        let (all, some) = (said.first_stop.unwrap(), told.first_stop.clone().unwrap());
        assert!(all.len() > MOST_SAID && all.starts_with(&some));
        assert_eq!(some.len(), MOST_SAID);
        let short = Farewell {
            own_stops: 1,
            first_stop: Some("setpoints stayed away".to_owned()),
        };
        assert_eq!(Farewell::from_bytes(&short.to_bytes()), Some(short));
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

    /// Setpoints come through the pipe one by one, so that what is kept must not be counted in reads.
    #[test]
    fn minutes_of_setpoints_that_come_one_by_one_are_kept() {
        const COUNT: usize = 60_000;
        struct Drips(mpsc::Sender<()>, usize);
        impl Read for Drips {
            fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
                if self.1 == COUNT {
                    self.0.send(()).unwrap();
                    return Ok(0);
                }
                self.1 += 1;
                into[..size_of::<Setpoint>()].fill(7);
                Ok(size_of::<Setpoint>())
            }
        }
        let (sender, all_read) = mpsc::channel();
        let mut ahead = ReadAhead::of(Drips(sender, 0));
        all_read.recv_timeout(Duration::from_secs(120)).unwrap();
        let mut got = Vec::new();
        ahead.read_to_end(&mut got).unwrap();
        assert_eq!(got.len(), COUNT * size_of::<Setpoint>());
        assert!(got.iter().all(|byte| *byte == 7));
    }

    #[test]
    fn whoever_writes_is_held_up_when_too_much_is_kept_until_it_is_asked_for() {
        struct Flood;
        impl Read for Flood {
            fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
                Ok(into.len())
            }
        }
        const FEW: usize = 3 * PIECE;
        let mut ahead = ReadAhead::keeping(Flood, FEW);
        while ahead.shared.kept().bytes.len() < FEW {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(Duration::from_millis(20));
        assert_eq!(ahead.shared.kept().bytes.len(), FEW);
        let mut byte = [1];
        ahead.read_exact(&mut byte).unwrap();
        assert_eq!(byte, [0]);
        while ahead.shared.kept().bytes.len() < FEW {
            std::thread::sleep(Duration::from_millis(1));
        }
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
