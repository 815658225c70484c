//! A connection of the server, plain or over TLS, and how long each part of it may take.

use core::time::Duration;
use rustls::{ServerConfig, ServerConnection, Stream};
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Instant;

/// How long a request may take to come, from its first byte to its last, with the handshake in front of it, and how
/// long an answer to one without the token may take to go.
const PATIENCE: Duration = Duration::from_secs(5);
/// How long whoever has shown the token may take to receive a part of an answer.
const PATIENCE_WITH_PAGE: Duration = Duration::from_secs(5);
/// What a connection begins with that speaks TLS: a handshake.
const HANDSHAKE: u8 = 22;

/// How long what is read and written may take.
#[derive(Debug, Clone, Copy)]
enum Pace {
    /// Everything together, until then.
    Until(Instant),
    /// Each part.
    Each(Duration),
}

/// A socket with a pace.
#[derive(Debug)]
struct Socket {
    stream: Arc<TcpStream>,
    pace: Pace,
}

impl Socket {
    fn left(&self) -> io::Result<Option<Duration>> {
        let left = match self.pace {
            Pace::Until(until) => until.checked_duration_since(Instant::now()),
            Pace::Each(patience) => Some(patience),
        };
        match left.filter(|left| !left.is_zero()) {
            Some(left) => Ok(Some(left)),
            None => Err(io::ErrorKind::TimedOut.into()),
        }
    }
}

impl Read for Socket {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.stream.set_read_timeout(self.left()?)?;
        (&*self.stream).read(into)
    }
}

impl Write for Socket {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.set_write_timeout(self.left()?)?;
        (&*self.stream).write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        (&*self.stream).flush()
    }
}

/// A connection. Nothing of TLS is done before something is read or written.
#[derive(Debug)]
pub(crate) struct Connection {
    socket: Socket,
    tls: Option<Box<ServerConnection>>,
}

impl Connection {
    /// A connection that has a stranger's time for its request.
    pub(crate) fn new(
        stream: &Arc<TcpStream>,
        tls: Option<&Arc<ServerConfig>>,
    ) -> io::Result<Self> {
        stream.set_nodelay(true)?;
        let tls = tls.map(|config| ServerConnection::new(Arc::clone(config)));
        let tls = tls.transpose().map_err(io::Error::other)?.map(Box::new);
        let socket = Socket {
            stream: Arc::clone(stream),
            pace: Pace::Until(Instant::now() + PATIENCE),
        };
        Ok(Self { socket, tls })
    }

    /// Whether it begins as something else than TLS where TLS is spoken. It is plain from then on.
    pub(crate) fn turns_out_plain(&mut self) -> io::Result<bool> {
        if self.tls.is_none() {
            return Ok(false);
        }
        let mut first = [0];
        self.socket.stream.set_read_timeout(self.socket.left()?)?;
        let is_plain = self.socket.stream.peek(&mut first)? == 1 && first != [HANDSHAKE];
        if is_plain {
            self.tls = None;
        }
        Ok(is_plain)
    }

    /// Gives a stranger's time for the answer.
    pub(crate) fn hurry(&mut self) -> &mut Self {
        self.socket.pace = Pace::Until(Instant::now() + PATIENCE);
        self
    }

    /// Gives the time of who has shown a token.
    pub(crate) fn wait_for_page(&mut self) {
        self.socket.pace = Pace::Each(PATIENCE_WITH_PAGE);
    }

    /// Says that nothing follows, so that nobody takes what was cut off for the whole.
    pub(crate) fn close(&mut self) -> io::Result<()> {
        match &mut self.tls {
            Some(tls) => {
                tls.send_close_notify();
                tls.complete_io(&mut self.socket).map(drop)
            }
            None => Ok(()),
        }
    }
}

impl Read for Connection {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        match &mut self.tls {
            Some(tls) => Stream::new(&mut **tls, &mut self.socket).read(into),
            None => self.socket.read(into),
        }
    }
}

impl Write for Connection {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.tls {
            Some(tls) => Stream::new(&mut **tls, &mut self.socket).write(bytes),
            None => self.socket.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.tls {
            Some(tls) => Stream::new(&mut **tls, &mut self.socket).flush(),
            None => self.socket.flush(),
        }
    }
}
