//! The server: one thread for each request, on loopback alone.

use crate::asset;
use crate::feed::{Feed, Message};
use crate::guard::{API, Guard};
use crate::request::Request;
use crate::response::{Answer, ContentType, Status, begin_stream};
use crate::token::Token;
use core::time::Duration;
use std::io::{self, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::JoinHandle;

/// Requests that are answered at a time, open pages among them.
const MOST_CONNECTIONS: usize = 32;
/// How long a browser may take to send a request, or to take a part of an answer.
const PATIENCE: Duration = Duration::from_secs(5);
/// How long a page hears nothing at most, when nothing happens.
const SILENCE: Duration = Duration::from_secs(1);
/// Where a page hears what happens.
const STREAM: &str = "/api/stream";
/// Where commands go.
const COMMAND: &str = "/api/command";

/// What there is to show and to command. Requests come from several threads, all of them judged.
pub trait Site: Send + Sync {
    /// What is at a path below `/api/`, with its query; `None` if there is nothing.
    fn document(&self, path: &str, query: &str) -> Option<Answer>;
    /// Does what the body asks for.
    fn command(&self, body: &[u8]) -> Answer;
}

/// Why there is no server.
#[derive(Debug, thiserror::Error)]
pub enum ServerError {
    /// The port cannot be had.
    #[error("port {port} of 127.0.0.1 cannot be had: {cause}; give another one with --port")]
    Port {
        /// Which.
        port: u16,
        /// Why.
        cause: io::Error,
    },
    /// The system has no random numbers.
    #[error("no token: {0}")]
    Token(io::Error),
    /// A thread cannot be started.
    #[error("no thread for the server: {0}")]
    Thread(io::Error),
}

/// A server that does not answer yet.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    token: Token,
}

impl Server {
    /// Takes a port of 127.0.0.1, any free one for 0, and makes a token.
    ///
    /// # Errors
    ///
    /// The port cannot be had, or the system has no random numbers.
    pub fn bind(port: u16) -> Result<Self, ServerError> {
        let failed = |cause| ServerError::Port { port, cause };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        let token = Token::new().map_err(ServerError::Token)?;
        Ok(Self {
            listener,
            address,
            token,
        })
    }

    /// The address to open, with the token behind `#`, which browsers do not send.
    #[must_use]
    pub fn url(&self) -> String {
        format!("http://{}/#token={}", self.address, self.token.as_str())
    }

    /// The port.
    #[must_use]
    pub const fn port(&self) -> u16 {
        self.address.port()
    }

    /// Answers from now on.
    ///
    /// # Errors
    ///
    /// There is no thread for it.
    pub fn start(self, site: Arc<dyn Site>, feed: &Feed) -> Result<Running, ServerError> {
        let over = Arc::new(AtomicBool::new(false));
        let work = Work {
            guard: Guard::new(self.address.port(), self.token),
            site,
            feed: feed.clone(),
            over: Arc::clone(&over),
            open: AtomicUsize::new(0),
        };
        let listener = self.listener;
        let accepting = std::thread::Builder::new()
            .name("live-accept".to_owned())
            .spawn(move || accept(&listener, &Arc::new(work)))
            .map_err(ServerError::Thread)?;
        Ok(Running {
            address: self.address,
            over,
            feed: feed.clone(),
            accepting: Some(accepting),
        })
    }
}

/// A server that answers, until it is dropped.
#[derive(Debug)]
pub struct Running {
    address: SocketAddr,
    over: Arc<AtomicBool>,
    feed: Feed,
    accepting: Option<JoinHandle<()>>,
}

impl Drop for Running {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        self.feed.end();
        // Wakes the thread that waits for requests.
        let _woken = TcpStream::connect_timeout(&self.address, PATIENCE);
        let _ended = self.accepting.take().map(JoinHandle::join);
    }
}

/// What the threads of the requests share.
struct Work {
    guard: Guard,
    site: Arc<dyn Site>,
    feed: Feed,
    over: Arc<AtomicBool>,
    open: AtomicUsize,
}

fn accept(listener: &TcpListener, work: &Arc<Work>) {
    while let Ok((stream, _)) = listener.accept() {
        if work.over.load(Ordering::Relaxed) {
            return;
        }
        if work.open.fetch_add(1, Ordering::Relaxed) >= MOST_CONNECTIONS {
            work.open.fetch_sub(1, Ordering::Relaxed);
            continue;
        }
        let shared = Arc::clone(work);
        let thread = std::thread::Builder::new().name("live-request".to_owned());
        let started = thread.spawn(move || {
            // A browser that goes away is its own business.
            let _answered = answer(stream, &shared);
            shared.open.fetch_sub(1, Ordering::Relaxed);
        });
        if started.is_err() {
            work.open.fetch_sub(1, Ordering::Relaxed);
        }
    }
}

fn answer(mut stream: TcpStream, work: &Work) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let request = match Request::read(&mut stream) {
        Ok(request) => request,
        Err(error) if error.kind() == io::ErrorKind::InvalidData => {
            return text(Status::BadRequest, &error.to_string()).write(&mut stream);
        }
        Err(error) => return Err(error),
    };
    if let Err(refusal) = work.guard.judge(&request) {
        let status = Status::Other(refusal.code());
        return text(status, &refusal.to_string()).write(&mut stream);
    }
    let (path, query) = request.path();
    let answer = match (request.method.as_str(), path) {
        ("GET", STREAM) => return tell(stream, work),
        ("POST", COMMAND) => work.site.command(&request.body),
        ("GET", path) if path.starts_with(API) => {
            let found = work.site.document(path, query);
            found.unwrap_or_else(not_found)
        }
        ("GET", path) => asset::find(path).unwrap_or_else(not_found),
        _ => not_found(),
    };
    answer.write(&mut stream)
}

/// Tells a page what happens, until it goes away.
fn tell(mut stream: TcpStream, work: &Work) -> io::Result<()> {
    begin_stream(&mut stream)?;
    let mut heard = 0;
    while let Some((messages, next)) = work.feed.after(heard, SILENCE) {
        heard = next;
        let mut bytes = Vec::new();
        for message in &messages {
            bytes.extend_from_slice(message.bytes());
        }
        if messages.is_empty() {
            bytes.extend_from_slice(Message::silence().bytes());
        }
        stream.write_all(&bytes)?;
    }
    Ok(())
}

fn not_found() -> Answer {
    text(Status::NotFound, "there is nothing here")
}

fn text(status: Status, words: &str) -> Answer {
    Answer::new(ContentType::Text, words.as_bytes()).with(status)
}
