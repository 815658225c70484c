//! A terminal whose keys arrive one by one.

use core::time::Duration;
use rustix::event::{PollFd, PollFlags, poll};
use rustix::io::{Errno, read};
use rustix::stdio::stdin;
use rustix::termios::{
    LocalModes, OptionalActions, QueueSelector, SpecialCodeIndex, Termios, tcflush, tcgetattr,
    tcsetattr,
};
use rustix::time::Timespec;
use std::io;

/// A key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Key {
    Left,
    Right,
    Up,
    Down,
    PageUp,
    PageDown,
    Character(char),
}

/// What became of the wait for keys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Heard {
    /// Keys, in their order; none within the time.
    Keys(Vec<Key>),
    /// The terminal is there no more.
    Gone,
}

/// The terminal of standard input, without echo and without lines. As it was before when dropped.
#[derive(Debug)]
pub(super) struct Terminal {
    before: Termios,
}

impl Terminal {
    /// Takes the terminal over. Ctrl-C and its relatives stay signals.
    ///
    /// # Errors
    /// Standard input is no terminal, or the system refuses.
    pub(super) fn open() -> io::Result<Self> {
        let before = tcgetattr(stdin())?;
        let mut by_key = before.clone();
        by_key.local_modes -= LocalModes::ICANON | LocalModes::ECHO;
        by_key.special_codes[SpecialCodeIndex::VMIN] = 0;
        by_key.special_codes[SpecialCodeIndex::VTIME] = 0;
        tcsetattr(stdin(), OptionalActions::Flush, &by_key)?;
        Ok(Self { before })
    }

    /// The keys that are pressed within a time, as soon as there are any.
    ///
    /// # Errors
    /// The terminal cannot be read.
    pub(super) fn keys(&self, within: Duration) -> io::Result<Heard> {
        let input = stdin();
        let mut waits = [PollFd::new(&input, PollFlags::IN)];
        let timeout = Timespec {
            tv_sec: 0,
            tv_nsec: within.subsec_nanos().into(),
        };
        match poll(&mut waits, Some(&timeout)) {
            Ok(0) | Err(Errno::INTR) => return Ok(Heard::Keys(Vec::new())),
            Ok(_) => {}
            Err(error) => return Err(error.into()),
        }
        let mut bytes = [0; 256];
        match read(input, &mut bytes) {
            // Ready, and nothing to read: it was hung up.
            Ok(0) => Ok(Heard::Gone),
            Ok(count) => Ok(Heard::Keys(keys_of(bytes.get(..count).unwrap_or(&[])))),
            Err(Errno::INTR | Errno::AGAIN) => Ok(Heard::Keys(Vec::new())),
            Err(Errno::IO) => Ok(Heard::Gone),
            Err(error) => Err(error.into()),
        }
    }

    /// Forgets the keys that were pressed and not yet read.
    pub(super) fn forget(&self) {
        // What cannot be forgotten is read, and moves for as long as a key does.
        tcflush(stdin(), QueueSelector::IFlush).ok();
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        tcsetattr(stdin(), OptionalActions::Flush, &self.before).ok();
    }
}

/// The keys of what a terminal sends: control sequences of ECMA-48 and characters. Other sequences
/// are nothing.
fn keys_of(bytes: &[u8]) -> Vec<Key> {
    let mut keys = Vec::new();
    let mut rest = bytes;
    while let Some((first, after)) = rest.split_first() {
        rest = after;
        if *first != 0x1b {
            if first.is_ascii_graphic() || *first == b' ' {
                keys.push(Key::Character(char::from(*first)));
            }
            continue;
        }
        // ESC [ or ESC O, parameters, and a last byte from @ to ~.
        let Some((b'[' | b'O', sequence)) = rest.split_first() else {
            continue;
        };
        let is_last = |byte: &u8| (0x40..=0x7e).contains(byte);
        let Some(end) = sequence.iter().position(is_last) else {
            break;
        };
        let key = match sequence.get(..=end) {
            Some(b"A") => Some(Key::Up),
            Some(b"B") => Some(Key::Down),
            Some(b"C") => Some(Key::Right),
            Some(b"D") => Some(Key::Left),
            Some(b"5~") => Some(Key::PageUp),
            Some(b"6~") => Some(Key::PageDown),
            _ => None,
        };
        keys.extend(key);
        rest = sequence.get(end + 1..).unwrap_or(&[]);
    }
    keys
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sequences_and_characters_are_keys() {
        use Key::{Character, Down, Left, PageDown, PageUp, Right, Up};
        let all = keys_of(b"\x1b[A\x1bOB\x1b[C\x1b[D\x1b[5~\x1b[6~q+");
        let expected = [
            Up,
            Down,
            Right,
            Left,
            PageUp,
            PageDown,
            Character('q'),
            Character('+'),
        ];
        assert_eq!(all, expected);
        // Sequences that mean nothing here, one that is cut off, and what is no text.
        assert_eq!(keys_of(b"\x1b[1;5C\x1b[15~x\x1b["), [Character('x')]);
        assert_eq!(keys_of(b"\x00\xff\x1b"), []);
    }
}
