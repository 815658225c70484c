//! A page that is served, with a site behind it that counts what reaches it.

use glidepath_live::{Caller, ContentType, Feed, Response, Role, Running, Server, Site};
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Counts what reached it.
#[derive(Default)]
pub(crate) struct Counted {
    pub(crate) commands: AtomicUsize,
    pub(crate) documents: AtomicUsize,
    pub(crate) callers: Mutex<Vec<Caller>>,
}

struct Shared(Arc<Counted>);

impl Site for Shared {
    fn document(&self, _caller: Caller, path: &str, query: &str) -> Option<Response> {
        self.0.documents.fetch_add(1, Ordering::Relaxed);
        let text = format!("{path} {query}").into_bytes();
        (path == "/api/plan").then(|| Response::new(ContentType::Json, text))
    }

    fn command(&self, caller: Caller, body: &[u8]) -> Response {
        self.0.commands.fetch_add(1, Ordering::Relaxed);
        self.0.callers.lock().unwrap().push(caller);
        Response::new(ContentType::Json, body)
    }

    fn upload(&self, caller: Caller, query: &str, piece: &[u8]) -> Response {
        self.0.commands.fetch_add(1, Ordering::Relaxed);
        self.0.callers.lock().unwrap().push(caller);
        let text = format!("{query} {}", piece.len()).into_bytes();
        Response::new(ContentType::Text, text)
    }
}

pub(crate) struct Page {
    pub(crate) port: u16,
    /// That of who may operate, and those of all roles.
    pub(crate) token: String,
    pub(crate) tokens: Vec<String>,
    pub(crate) reached: Arc<Counted>,
    pub(crate) feed: Feed,
    _running: Running,
}

impl Page {
    pub(crate) fn serve() -> Self {
        let server = Server::bind(0, Role::Operate).unwrap();
        let feed = Feed::default();
        let tokens: Vec<String> = server
            .urls()
            .map(|(_, url)| url.split_once("#token=").unwrap().1.to_owned())
            .collect();
        let port = server.port();
        let reached = Arc::<Counted>::default();
        let running = server
            .start(Arc::new(Shared(Arc::clone(&reached))), &feed)
            .unwrap();
        Self {
            port,
            token: tokens[2].clone(),
            tokens,
            reached,
            feed,
            _running: running,
        }
    }

    /// Sends lines and a body; gives the status, the head and the body of the answer.
    pub(crate) fn ask(&self, lines: &[&str], body: &str) -> (u16, String, String) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .unwrap();
        let port = self.port.to_string();
        let head: String = lines
            .iter()
            .map(|line| line.replace("PORT", &port).replace("TOKEN", &self.token) + "\r\n")
            .collect();
        stream
            .write_all(format!("{head}\r\n{body}").as_bytes())
            .unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        (status, head.to_owned(), body.to_owned())
    }

    pub(crate) fn status(&self, lines: &[&str]) -> u16 {
        self.ask(lines, "").0
    }
}

pub(crate) const HOST: &str = "Host: 127.0.0.1:PORT";
pub(crate) const TOKEN: &str = "X-Glidepath-Token: TOKEN";
pub(crate) const JSON: &str = "Content-Type: application/json";
