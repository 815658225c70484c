//! The failure of a function: a code for the program, and a text for whoever reads its log.

use core::cell::RefCell;
use core::fmt::{self, Write as _};
use glidepath_link::{LinkError, RecordError};

/// The codes that functions return where they fail. The header lists the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(i32)]
pub(crate) enum Code {
    Argument = -1,
    Abi = -2,
    Thread = -3,
    NoServer = -4,
    Version = -5,
    Taken = -6,
    Record = -7,
    Transport = -8,
    Panic = -9,
    Refused = -10,
}

/// A failure on its way to the caller. It allocates nothing that a transport has not.
#[derive(Debug)]
pub(crate) enum Failure {
    /// What is wrong with an argument.
    Argument(&'static str),
    /// The caller was compiled for another version.
    Abi {
        asked: u32,
        here: u32,
    },
    /// The caller's structures are other ones.
    Layout,
    /// The caller's structure has another size.
    Size {
        structure: &'static str,
        caller: usize,
        here: usize,
    },
    /// A handle was used by a thread that it does not belong to.
    Thread(&'static str),
    /// A handle that a panic has left in an unknown state.
    Broken(&'static str),
    Link(LinkError),
    Record(RecordError),
}

impl Failure {
    pub(crate) const fn code(&self) -> Code {
        match self {
            Self::Argument(_) | Self::Link(LinkError::Name { .. }) => Code::Argument,
            Self::Abi { .. } | Self::Layout | Self::Size { .. } => Code::Abi,
            Self::Thread(_) => Code::Thread,
            Self::Broken(_) => Code::Panic,
            Self::Record(_) | Self::Link(LinkError::Record(_)) => Code::Record,
            Self::Link(LinkError::NoServer { .. }) => Code::NoServer,
            Self::Link(LinkError::VersionMismatch { .. }) => Code::Version,
            Self::Link(LinkError::Taken { .. } | LinkError::TooManyRequests { .. }) => Code::Taken,
            Self::Link(_) => Code::Transport,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Argument(what) => f.write_str(what),
            Self::Abi { asked, here } => write!(
                f,
                "the program was compiled for version {asked} of the ABI, this library has {here}: \
                 compile it with the header of this library"
            ),
            Self::Layout => f.write_str(
                "the program's structures are not those of this library: compile it with the \
                 header of this library",
            ),
            Self::Size {
                structure,
                caller,
                here,
            } => write!(
                f,
                "{structure} has {caller} bytes in the program and {here} in the library: pass its \
                 sizeof, and compile with the header of this library"
            ),
            Self::Thread(what) => write!(
                f,
                "{what} belongs to another thread: use and close it in the thread that opened it \
                 (a servo may be handed over with gp_servo_release)"
            ),
            Self::Broken(what) => {
                write!(f, "{what} was left unfinished by an error inside: close it")
            }
            Self::Link(error) => error.fmt(f),
            Self::Record(error) => error.fmt(f),
        }
    }
}

impl From<LinkError> for Failure {
    fn from(error: LinkError) -> Self {
        Self::Link(error)
    }
}

impl From<RecordError> for Failure {
    fn from(error: RecordError) -> Self {
        Self::Record(error)
    }
}

/// Bytes of the longest text kept.
const TEXT: usize = 512;

/// The last text of a thread. Of fixed size: to note a failure needs no memory.
struct LastError {
    bytes: [u8; TEXT],
    len: usize,
}

impl fmt::Write for LastError {
    /// Leaves out what has no room, from the first character that has none.
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = TEXT - self.len;
        let mut end = text.len().min(room);
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        let bytes = text.as_bytes().iter().take(end);
        for (to, from) in self.bytes.iter_mut().skip(self.len).zip(bytes) {
            *to = *from;
        }
        self.len += end;
        if end < text.len() {
            return Err(fmt::Error);
        }
        Ok(())
    }
}

std::thread_local! {
    static LAST_ERROR: RefCell<LastError> = const {
        RefCell::new(LastError { bytes: [0; TEXT], len: 0 })
    };
}

/// Keeps a text for the thread that asks for it.
pub(crate) fn remember(text: fmt::Arguments<'_>) {
    LAST_ERROR.with_borrow_mut(|last| {
        last.len = 0;
        // A text that is too long is cut.
        let _ = last.write_fmt(text);
    });
}

/// Gives the text that was kept last.
pub(crate) fn with_last_error<T>(read: impl FnOnce(&[u8]) -> T) -> T {
    LAST_ERROR.with_borrow(|last| read(last.bytes.get(..last.len).unwrap_or_default()))
}
