//! The answers to requests: the guard's verdict first, then what the page asks for.

use crate::asset;
use crate::connection::Connection;
use crate::devices::Devices;
use crate::feed::{Feed, Message};
use crate::guard::{Guard, PAIR, UPLOAD};
use crate::places::Places;
use crate::request::{Head, MOST_BODY, MOST_PIECE, Request};
use crate::response::{ContentType, Response, Status, begin_stream};
use crate::role::Caller;
use core::time::Duration;
use rustls::ServerConfig;
use std::io::{self, Write as _};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// How long a page hears nothing at most, when nothing happens.
const SILENCE: Duration = Duration::from_secs(1);
/// How long a device that is not paired any more is told what happens at most.
const LOOK_EVERY: Duration = Duration::from_millis(300);
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

/// What the threads of the requests share.
pub(crate) struct Work {
    pub(crate) guard: Guard,
    pub(crate) site: Arc<dyn Site>,
    pub(crate) feed: Feed,
    pub(crate) over: Arc<AtomicBool>,
    pub(crate) places: Places,
    /// How TLS is spoken, and with whom; `None` where nothing is encrypted.
    pub(crate) devices: Option<(Arc<ServerConfig>, Arc<dyn Devices>)>,
}

/// Answers the request of a connection.
pub(crate) fn answer(stream: &Arc<TcpStream>, work: &Work) -> io::Result<()> {
    let tls = work.devices.as_ref().map(|(tls, _)| tls);
    let mut connection = Connection::new(stream, tls)?;
    if connection.turns_out_plain()? {
        let words = "only https is spoken here: put https:// in front of the address";
        return text(Status::BadRequest, words).write(&mut connection);
    }
    let answered = judge_and_answer(&mut connection, stream, work);
    let closed = connection.close();
    answered.and(closed)
}

fn judge_and_answer(
    connection: &mut Connection,
    stream: &Arc<TcpStream>,
    work: &Work,
) -> io::Result<()> {
    let head = match Head::read(connection) {
        Ok(head) => head,
        Err(error) => return refuse(connection, error),
    };
    let judged = work.guard.judge(&head.request);
    let is_piece = judged.is_ok() && head.request.path().0 == UPLOAD;
    let most = if is_piece { MOST_PIECE } else { MOST_BODY };
    let request = match head.body(connection, most) {
        Ok(request) => request,
        Err(error) => return refuse(connection, error),
    };
    let caller = match judged {
        Ok(caller) => caller,
        Err(refusal) => {
            let status = Status::Other(refusal.code());
            return text(status, &refusal.to_string()).write(connection.hurry());
        }
    };
    let (path, _) = request.path();
    if let Some(caller) = caller {
        // The guard has seen the token.
        work.places.leave(stream);
        connection.wait_for_page();
        return answer_page(connection, &request, caller, work);
    }
    let found = match (request.method.as_str(), path, &work.devices) {
        ("GET", path, _) => asset::find(path),
        ("POST", PAIR, Some((_, devices))) => Some(devices.pair(&request.body)),
        _ => None,
    };
    found.unwrap_or_else(not_found).write(connection.hurry())
}

/// Says what is wrong with a request that is none.
fn refuse(connection: &mut Connection, error: io::Error) -> io::Result<()> {
    if error.kind() != io::ErrorKind::InvalidData {
        return Err(error);
    }
    text(Status::BadRequest, &error.to_string()).write(connection.hurry())
}

/// Answers one who has shown a token.
fn answer_page(
    connection: &mut Connection,
    request: &Request,
    caller: Caller,
    work: &Work,
) -> io::Result<()> {
    let (path, query) = request.path();
    let is_stream = (request.method.as_str(), path) == ("GET", STREAM);
    let place = if is_stream {
        work.places.page(caller.device)
    } else {
        work.places.request(caller.device)
    };
    let Some(_place) = place else {
        let words = "too many pages are open: close one";
        return text(Status::Unavailable, words).write(connection);
    };
    if let (Some((_, devices)), Some(token)) = (&work.devices, &caller.device) {
        devices.seen(token);
    }
    let answer = match (request.method.as_str(), path) {
        ("GET", STREAM) => return tell(connection, caller, work),
        ("GET", MAY) => Response::new(ContentType::Text, caller.role.name().as_bytes()),
        ("POST", COMMAND) => work.site.command(caller, &request.body),
        ("POST", UPLOAD) => work.site.upload(caller, query, &request.body),
        ("GET", path) => {
            let found = work.site.document(caller, path, query);
            found.unwrap_or_else(not_found)
        }
        _ => not_found(),
    };
    answer.write(connection)
}

/// Tells a page what happens, until it goes away, or is the page of a device that is paired no more.
fn tell(connection: &mut Connection, caller: Caller, work: &Work) -> io::Result<()> {
    begin_stream(connection)?;
    let (mut heard, mut looked) = (0, Instant::now());
    while let Some((messages, next)) = work.feed.after(heard, SILENCE) {
        if looked.elapsed() > LOOK_EVERY {
            looked = Instant::now();
            if !is_let_in(caller, work) {
                return Ok(());
            }
        }
        heard = next;
        let mut bytes = Vec::new();
        for message in &messages {
            bytes.extend_from_slice(message.bytes());
        }
        if messages.is_empty() {
            bytes.extend_from_slice(Message::silence().bytes());
        }
        connection.write_all(&bytes)?;
    }
    Ok(())
}

/// Whether a caller is let in still.
fn is_let_in(caller: Caller, work: &Work) -> bool {
    let Some((_, devices)) = &work.devices else {
        return true;
    };
    let Some(token) = &caller.device else {
        return false;
    };
    devices.seen(token);
    devices.role(token).is_some()
}

fn not_found() -> Response {
    text(Status::NotFound, "there is nothing here")
}

fn text(status: Status, words: &str) -> Response {
    Response::new(ContentType::Text, words.as_bytes()).with(status)
}
