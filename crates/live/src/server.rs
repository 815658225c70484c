//! The server of the page: one thread for each request, on loopback alone.

use crate::asset;
use crate::feed::{Feed, Message};
use crate::guard::{Guard, UPLOAD};
use crate::places::Places;
use crate::request::{Head, MOST_BODY, MOST_PIECE, Request};
use crate::response::{ContentType, Response, Status, begin_stream};
use crate::role::{Caller, Role};
use crate::token::Token;
use core::time::Duration;
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Instant;

/// How long a request may take to come, from its first byte to its last, and how long an answer to one
/// without the token may take to go.
const PATIENCE: Duration = Duration::from_secs(5);
/// How long whoever has shown the token may take to receive a part of an answer.
const PATIENCE_WITH_PAGE: Duration = Duration::from_secs(5);
/// How long to wait where the system has nothing left for a connection.
const BREATH: Duration = Duration::from_millis(20);
/// How long a page hears nothing at most, when nothing happens.
const SILENCE: Duration = Duration::from_secs(1);
/// Where a page hears what happens.
const STREAM: &str = "/api/stream";
/// Where commands go.
const COMMAND: &str = "/api/command";
/// What a page may.
const MAY: &str = "/api/may";

/// The site: what there is to show and to command. Requests come from several threads, all of them
/// judged.
pub trait Site: Send + Sync {
    /// What is at a path below `/api/` for the caller, with its query; `None` if there is nothing.
    fn document(&self, caller: Caller, path: &str, query: &str) -> Option<Response>;
    /// Does what the body asks for, if the caller may.
    fn command(&self, caller: Caller, body: &[u8]) -> Response;
    /// Takes a piece of a program, which the query tells more about, if the caller may.
    fn upload(&self, caller: Caller, query: &str, piece: &[u8]) -> Response;
}

/// The reason why there is no server.
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
    tokens: Vec<(Role, Token)>,
}

impl Server {
    /// Takes a port of 127.0.0.1, any free one for 0, and makes a token for each role up to `most`.
    ///
    /// # Errors
    ///
    /// The port cannot be had, or the system has no random numbers.
    pub fn bind(port: u16, most: Role) -> Result<Self, ServerError> {
        let failed = |cause| ServerError::Port { port, cause };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        let roles = Role::ALL.into_iter().filter(|role| *role <= most);
        let tokens = roles.map(|role| Token::new().map(|token| (role, token)));
        let tokens: io::Result<_> = tokens.collect();
        Ok(Self {
            listener,
            address,
            tokens: tokens.map_err(ServerError::Token)?,
        })
    }

    /// The address to open for each role, the least first, with the token behind `#`, which browsers do
    /// not send.
    pub fn urls(&self) -> impl Iterator<Item = (Role, String)> {
        let address = self.address;
        let tokens = self.tokens.iter();
        tokens.map(move |(role, token)| {
            (*role, format!("http://{address}/#token={}", token.as_str()))
        })
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
            guard: Guard::new(self.address.port(), self.tokens),
            site,
            feed: feed.clone(),
            over: Arc::clone(&over),
            places: Places::default(),
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
        let Some(accepting) = self.accepting.take() else {
            return;
        };
        // The thread waits for a connection, and the system may have none to give just now.
        while !accepting.is_finished() {
            let _woken = TcpStream::connect_timeout(&self.address, PATIENCE);
            std::thread::sleep(Duration::from_millis(1));
        }
        let _ended = accepting.join();
    }
}

/// What the threads of the requests share.
struct Work {
    guard: Guard,
    site: Arc<dyn Site>,
    feed: Feed,
    over: Arc<AtomicBool>,
    places: Places,
}

fn accept(listener: &TcpListener, work: &Arc<Work>) {
    while !work.over.load(Ordering::Relaxed) {
        let Ok((stream, _)) = listener.accept() else {
            // The connection has gone, or there is no descriptor for it yet.
            std::thread::sleep(BREATH);
            continue;
        };
        let stream = Arc::new(stream);
        work.places.enter(&stream);
        let (shared, own) = (Arc::clone(work), Arc::clone(&stream));
        let thread = std::thread::Builder::new().name("live-request".to_owned());
        let started = thread.spawn(move || {
            // A browser that goes away is its own business.
            let _answered = answer(&own, &shared);
            shared.places.leave(&own);
        });
        if started.is_err() {
            work.places.leave(&stream);
        }
    }
}

/// A connection that has until a time.
struct Hurried<'a> {
    stream: &'a TcpStream,
    until: Instant,
}

impl Hurried<'_> {
    fn left(&self) -> io::Result<Option<Duration>> {
        let left = self.until.checked_duration_since(Instant::now());
        match left.filter(|left| !left.is_zero()) {
            Some(left) => Ok(Some(left)),
            None => Err(io::ErrorKind::TimedOut.into()),
        }
    }
}

impl Read for Hurried<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.stream.set_read_timeout(self.left()?)?;
        self.stream.read(into)
    }
}

impl Write for Hurried<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.set_write_timeout(self.left()?)?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

fn hurried(stream: &TcpStream) -> Hurried<'_> {
    let until = Instant::now() + PATIENCE;
    Hurried { stream, until }
}

fn answer(stream: &Arc<TcpStream>, work: &Work) -> io::Result<()> {
    stream.set_nodelay(true)?;
    let mut asking = hurried(stream);
    let head = match Head::read(&mut asking) {
        Ok(head) => head,
        Err(error) => return refuse(stream, error),
    };
    let judged = work.guard.judge(&head.request);
    let is_piece = judged.is_ok() && head.request.path().0 == UPLOAD;
    let most = if is_piece { MOST_PIECE } else { MOST_BODY };
    let request = match head.body(&mut asking, most) {
        Ok(request) => request,
        Err(error) => return refuse(stream, error),
    };
    let caller = match judged {
        Ok(caller) => caller,
        Err(refusal) => {
            let status = Status::Other(refusal.code());
            return text(status, &refusal.to_string()).write(&mut hurried(stream));
        }
    };
    let (path, _) = request.path();
    if let Some(caller) = caller {
        // The guard has seen the token.
        work.places.leave(stream);
        stream.set_write_timeout(Some(PATIENCE_WITH_PAGE))?;
        return answer_page(stream, &request, caller, work);
    }
    let found = match request.method.as_str() {
        "GET" => asset::find(path),
        _ => None,
    };
    found.unwrap_or_else(not_found).write(&mut hurried(stream))
}

/// Says what is wrong with a request that is none.
fn refuse(stream: &TcpStream, error: io::Error) -> io::Result<()> {
    if error.kind() != io::ErrorKind::InvalidData {
        return Err(error);
    }
    text(Status::BadRequest, &error.to_string()).write(&mut hurried(stream))
}

/// Answers one who has shown a token.
fn answer_page(
    mut stream: &TcpStream,
    request: &Request,
    caller: Caller,
    work: &Work,
) -> io::Result<()> {
    let (path, query) = request.path();
    let is_stream = (request.method.as_str(), path) == ("GET", STREAM);
    let place = if is_stream {
        work.places.page()
    } else {
        work.places.request()
    };
    let Some(_place) = place else {
        let words = "too many pages are open: close one";
        return text(Status::Unavailable, words).write(&mut stream);
    };
    let answer = match (request.method.as_str(), path) {
        ("GET", STREAM) => return tell(stream, work),
        ("GET", MAY) => Response::new(ContentType::Text, caller.role.name().as_bytes()),
        ("POST", COMMAND) => work.site.command(caller, &request.body),
        ("POST", UPLOAD) => work.site.upload(caller, query, &request.body),
        ("GET", path) => {
            let found = work.site.document(caller, path, query);
            found.unwrap_or_else(not_found)
        }
        _ => not_found(),
    };
    answer.write(&mut stream)
}

/// Tells a page what happens, until it goes away.
fn tell(mut stream: &TcpStream, work: &Work) -> io::Result<()> {
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

fn not_found() -> Response {
    text(Status::NotFound, "there is nothing here")
}

fn text(status: Status, words: &str) -> Response {
    Response::new(ContentType::Text, words.as_bytes()).with(status)
}
