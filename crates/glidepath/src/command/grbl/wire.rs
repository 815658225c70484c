//! The wire, where senders connect: one at a time, by TCP of this host or by a pseudo-terminal.

use super::error::EndpointError;
use super::owner::owner;
use super::peer::{Looked, Peer};
use super::pty::Pty;
use crate::output;
use glidepath_grbl::Session;
use rustix::event::{PollFd, PollFlags, poll};
use rustix::time::Timespec;
use std::io::{ErrorKind, Write as _};
use std::net::{Ipv4Addr, TcpListener};
use std::path::Path;
use std::time::{Duration, Instant};

/// How long behind its opening a pseudo-terminal is greeted: senders set it up first.
const GREETING: Duration = Duration::from_millis(100);
/// Reads of a turn at most.
const READS: u32 = 16;
/// The user who may do anything.
const ROOT: u32 = 0;
/// What the sender of another user is told.
const OF_ANOTHER: &[u8] = b"[MSG:Refused: this endpoint serves other users: --user names one]\r\n";
/// What a second sender is told.
const BUSY: &[u8] = b"[MSG:Busy: another sender is connected]\r\n";

/// Who is connected.
#[derive(Debug)]
enum Connected {
    Nobody,
    Tcp(Peer),
    /// With when it was opened, until it is greeted.
    Pty(Option<Instant>),
}

/// The port and the pseudo-terminal where senders connect.
#[derive(Debug)]
pub(super) struct Wire {
    listener: Option<TcpListener>,
    pty: Option<Pty>,
    connected: Connected,
    /// Whose programs may connect, besides this user's and root's.
    user: Option<u32>,
    /// For a pseudo-terminal whose reader is slow.
    unsent: Vec<u8>,
}

impl Wire {
    /// Opens the port and the pseudo-terminal that are asked for.
    ///
    /// # Errors
    /// One of them cannot be had.
    pub(super) fn open(
        port: Option<u16>,
        link: Option<&Path>,
        user: Option<u32>,
    ) -> Result<Self, EndpointError> {
        let listener = port
            .map(|port| {
                let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
                listener.set_nonblocking(true)?;
                Ok(listener)
            })
            .transpose()
            .map_err(|cause| EndpointError::Port {
                port: port.unwrap_or_default(),
                cause,
            })?;
        let pty = link
            .map(|link| {
                Pty::open(link).map_err(|cause| EndpointError::Terminal {
                    link: link.display().to_string(),
                    cause,
                })
            })
            .transpose()?;
        Ok(Self {
            listener,
            pty,
            connected: Connected::Nobody,
            user,
            unsent: Vec::new(),
        })
    }

    /// The TCP port, if there is one.
    pub(super) fn port(&self) -> Option<u16> {
        let address = self.listener.as_ref()?.local_addr().ok()?;
        Some(address.port())
    }

    /// Whether a sender is to be greeted.
    pub(super) const fn is_new(&self) -> bool {
        matches!(self.connected, Connected::Pty(Some(_)))
    }

    /// Waits for bytes, or a sender, for so long at most.
    pub(super) fn wait(&self, most: Duration) {
        let flags = PollFlags::IN;
        let mut watched = Vec::with_capacity(3);
        watched.extend(self.listener.as_ref().map(|it| PollFd::new(it, flags)));
        match &self.connected {
            Connected::Tcp(peer) => watched.push(PollFd::new(peer.stream(), flags)),
            Connected::Pty(_) => {
                watched.extend(
                    self.pty
                        .as_ref()
                        .map(|pty| PollFd::from_borrowed_fd(pty.fd(), flags)),
                );
            }
            // One that nobody has open is told as such at once.
            Connected::Nobody => {}
        }
        let most = Timespec {
            tv_sec: 0,
            tv_nsec: most.subsec_nanos().into(),
        };
        // A wait that is cut short is one that was shorter.
        let _polled = poll(&mut watched, Some(&most));
    }

    /// Takes senders in, and what the one that is connected has sent.
    pub(super) fn turn(&mut self, session: &mut Session, now: Duration) {
        self.accept(session, now);
        self.look_at_pty(session, now);
        let mut bytes = Vec::new();
        for _ in 0..READS {
            if !session.wants_bytes() {
                return;
            }
            bytes.clear();
            let looked = match &mut self.connected {
                Connected::Nobody => return,
                Connected::Tcp(peer) => peer.read(&mut bytes),
                Connected::Pty(_) => match &self.pty {
                    Some(pty) if pty.read(&mut bytes) => Looked::Here,
                    _ => Looked::Gone,
                },
            };
            match looked {
                Looked::Here if bytes.is_empty() => return,
                Looked::Here => session.hear(&bytes, now),
                Looked::Browser => {
                    output::note("grbl: a browser's request was dropped");
                    self.lose(session);
                }
                Looked::Gone => self.lose(session),
            }
        }
    }

    /// Sends what the session says.
    pub(super) fn send(&mut self, session: &mut Session) {
        let said = session.take_output();
        let is_here = match &mut self.connected {
            Connected::Nobody => true,
            Connected::Tcp(peer) => peer.write(&said),
            Connected::Pty(_) => {
                self.unsent.extend_from_slice(&said);
                if let Some(pty) = &self.pty {
                    pty.write(&mut self.unsent);
                }
                // A terminal that nobody reads keeps nobody from anything.
                let excess = self.unsent.len().saturating_sub(MOST_UNSENT);
                self.unsent.drain(..excess);
                true
            }
        };
        if !is_here {
            self.lose(session);
        }
    }

    fn accept(&mut self, session: &mut Session, now: Duration) {
        let Some(listener) = &self.listener else {
            return;
        };
        loop {
            let mut stream = match listener.accept() {
                Ok((stream, _)) => stream,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(_) => return,
            };
            let own = rustix::process::getuid().as_raw();
            let may = |user| user == own || user == ROOT || Some(user) == self.user;
            if !owner(&stream).is_some_and(may) {
                output::note("grbl: a connection of another user was refused");
                // Whoever does not take it is closed all the same.
                let _told = stream.write_all(OF_ANOTHER);
                continue;
            }
            if !matches!(self.connected, Connected::Nobody) {
                // Whoever does not take it is closed all the same.
                let _told = stream.write_all(BUSY);
                continue;
            }
            if let Ok(peer) = Peer::new(stream) {
                output::note("grbl: a sender has connected");
                self.connected = Connected::Tcp(peer);
                session.connected(now);
            }
        }
    }

    fn look_at_pty(&mut self, session: &mut Session, now: Duration) {
        let Some(pty) = &self.pty else {
            return;
        };
        match &mut self.connected {
            Connected::Tcp(_) => {}
            Connected::Nobody if pty.is_open() => {
                if pty.begin().is_ok() {
                    output::note("grbl: a sender has opened the terminal");
                    self.unsent.clear();
                    self.connected = Connected::Pty(Some(Instant::now()));
                }
            }
            Connected::Nobody => {}
            Connected::Pty(_) if !pty.is_open() => self.lose(session),
            Connected::Pty(opened) => {
                if opened.is_some_and(|opened| opened.elapsed() >= GREETING) {
                    *opened = None;
                    session.connected(now);
                }
            }
        }
    }

    fn lose(&mut self, session: &mut Session) {
        output::note("grbl: the sender has gone");
        if let (Connected::Pty(_), Some(pty)) = (&self.connected, &self.pty) {
            pty.end();
        }
        self.connected = Connected::Nobody;
        self.unsent.clear();
        session.lost();
    }
}

/// Bytes that wait for the reader of a pseudo-terminal.
const MOST_UNSENT: usize = 64 * 1024;
