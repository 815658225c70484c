//! A sender that is connected by TCP.

use std::io::{ErrorKind, Read as _, Write as _};
use std::net::TcpStream;

/// What the requests of a browser begin with: a page from anywhere may have its browser open a port of this host.
const OF_BROWSERS: [&[u8]; 7] = [
    b"GET ",
    b"POST ",
    b"HEAD ",
    b"PUT ",
    b"OPTIONS ",
    b"DELETE ",
    b"PATCH ",
];
/// Bytes that wait for a sender which does not read.
const MOST_UNSENT: usize = 64 * 1024;

/// What came of a look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Looked {
    Here,
    Gone,
    Browser,
}

/// A sender that is connected by TCP.
#[derive(Debug)]
pub(super) struct Peer {
    stream: TcpStream,
    /// The first bytes, as long as they may be those of a browser; `None` when it is known that they are not.
    first: Option<Vec<u8>>,
    unsent: Vec<u8>,
}

impl Peer {
    pub(super) fn new(stream: TcpStream) -> std::io::Result<Self> {
        stream.set_nonblocking(true)?;
        stream.set_nodelay(true)?;
        rustix::net::sockopt::set_socket_keepalive(&stream, true)?;
        Ok(Self {
            stream,
            first: Some(Vec::new()),
            unsent: Vec::new(),
        })
    }

    pub(super) const fn stream(&self) -> &TcpStream {
        &self.stream
    }

    /// Takes bytes that have come.
    pub(super) fn read(&mut self, into: &mut Vec<u8>) -> Looked {
        let mut bytes = [0; 1024];
        let length = match self.stream.read(&mut bytes) {
            Ok(0) => return Looked::Gone,
            Ok(length) => length,
            Err(error) if error.kind() == ErrorKind::WouldBlock => return Looked::Here,
            Err(error) if error.kind() == ErrorKind::Interrupted => return Looked::Here,
            Err(_) => return Looked::Gone,
        };
        let come = bytes.get(..length).unwrap_or_default();
        let Some(first) = &mut self.first else {
            into.extend_from_slice(come);
            return Looked::Here;
        };
        first.extend_from_slice(come);
        if OF_BROWSERS.iter().any(|method| first.starts_with(method)) {
            return Looked::Browser;
        }
        if !OF_BROWSERS.iter().any(|method| method.starts_with(first)) {
            into.append(first);
            self.first = None;
        }
        Looked::Here
    }

    /// Sends, as far as the sender takes it. Returns whether it is still there.
    pub(super) fn write(&mut self, bytes: &[u8]) -> bool {
        self.unsent.extend_from_slice(bytes);
        while !self.unsent.is_empty() {
            match self.stream.write(&self.unsent) {
                Ok(0) => return false,
                Ok(length) => {
                    self.unsent.drain(..length);
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(_) => return false,
            }
        }
        self.unsent.len() < MOST_UNSENT
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, TcpListener};

    fn looked(sent: &[&[u8]]) -> (Looked, Vec<u8>) {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let mut client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        client.set_nodelay(true).unwrap();
        let mut peer = Peer::new(listener.accept().unwrap().0).unwrap();
        let (mut looked, mut bytes) = (Looked::Here, Vec::new());
        for part in sent {
            client.write_all(part).unwrap();
            let length = bytes.len();
            for _ in 0..50 {
                looked = peer.read(&mut bytes);
                if looked != Looked::Here || bytes.len() > length {
                    break;
                }
                std::thread::sleep(std::time::Duration::from_millis(2));
            }
        }
        (looked, bytes)
    }

    #[test]
    fn a_browser_is_told_from_a_sender_by_its_first_bytes() {
        assert_eq!(looked(&[b"POST / HTTP/1.1\r\n\r\n$X\n"]).0, Looked::Browser);
        assert_eq!(looked(&[b"GE", b"T / HTTP/1.1\r\n"]).0, Looked::Browser);
        let (here, bytes) = looked(&[b"G", b"0 X1\nPOST "]);
        assert_eq!((here, &bytes[..]), (Looked::Here, &b"G0 X1\nPOST "[..]));
        assert_eq!(looked(&[b"?"]).1, b"?");
    }
}
