//! A page that is served, with a site behind it that counts what reaches it.

use crate::tls;
use glidepath_live::{
    Caller, ContentType, DeviceServer, Devices, Feed, Identity, Response, Role, Running, Server,
    Sha256, Site, Status, Turns, TypedLine,
};
use std::io::{Read, Write};
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
    turns: Turns,
}

impl Counted {
    /// A line as it was typed, or why it is none.
    fn judge(&self, caller: Caller, query: &str) -> Response {
        let text = |text: &str| Response::new(ContentType::Text, text.as_bytes());
        let Some(_turn) = self.turns.take(caller.page) else {
            return text("").with(Status::Unavailable);
        };
        match TypedLine::of(query) {
            Ok(line) => text(line.text()),
            Err(error) => text(&error.to_string()).with(Status::Conflict),
        }
    }
}

struct Shared(Arc<Counted>);

impl Site for Shared {
    fn document(&self, caller: Caller, path: &str, query: &str) -> Option<Response> {
        self.0.documents.fetch_add(1, Ordering::Relaxed);
        if path == "/api/judge" {
            return Some(self.0.judge(caller, query));
        }
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

/// Devices that are paired, by the hashes of their tokens.
#[derive(Debug, Default)]
pub(crate) struct Paired {
    pub(crate) tokens: Mutex<Vec<(Sha256, Role)>>,
    pub(crate) codes: AtomicUsize,
}

impl Devices for Paired {
    fn role(&self, token: &Sha256) -> Option<Role> {
        let tokens = self.tokens.lock().unwrap();
        let mut paired = tokens.iter().filter(|(of, _)| of == token);
        paired.next().map(|(_, role)| *role)
    }

    fn seen(&self, _token: &Sha256) {}

    fn pair(&self, body: &[u8]) -> Response {
        self.codes.fetch_add(1, Ordering::Relaxed);
        Response::new(ContentType::Json, body)
    }
}

/// What is read and written, plain or over TLS.
pub(crate) trait Wire: Read + Write {}
impl<T: Read + Write> Wire for T {}

pub(crate) struct Page {
    pub(crate) port: u16,
    /// What the certificate is compared by, where there is one.
    pub(crate) fingerprint: Option<Sha256>,
    pub(crate) paired: Arc<Paired>,
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
            fingerprint: None,
            paired: Arc::default(),
            token: tokens[2].clone(),
            tokens,
            reached,
            feed,
            _running: running,
        }
    }

    /// The same over TLS for devices, which may look and hold; one of them says that it may operate.
    pub(crate) fn serve_devices() -> Self {
        let names = ["127.0.0.1", "localhost", "::1"].map(str::to_owned);
        let identity = Identity::new("Glidepath", &names, 1_800_000_000).unwrap();
        let address = "127.0.0.1:0".parse().unwrap();
        let server = DeviceServer::bind(address, &identity).unwrap();
        let paired = Arc::<Paired>::default();
        let tokens: Vec<String> = Role::ALL.map(|role| format!("of {}", role.name())).into();
        for (token, role) in tokens.iter().zip(Role::ALL) {
            let hash = Sha256::of(token.as_bytes());
            paired.tokens.lock().unwrap().push((hash, role));
        }
        let (feed, reached) = (Feed::default(), Arc::<Counted>::default());
        let (site, devices) = (Shared(Arc::clone(&reached)), Arc::clone(&paired));
        let port = server.port();
        let running = server
            .start(Arc::new(site), &feed, devices, Role::Operate)
            .unwrap();
        Self {
            port,
            fingerprint: Some(identity.fingerprint()),
            paired,
            token: tokens[2].clone(),
            tokens,
            reached,
            feed,
            _running: running,
        }
    }

    /// Both, for what holds whichever it is.
    pub(crate) fn both() -> [Self; 2] {
        [Self::serve(), Self::serve_devices()]
    }

    /// A connection, after the handshake where there is one.
    pub(crate) fn connect(&self) -> Box<dyn Wire> {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let patience = Some(Duration::from_secs(20));
        stream.set_read_timeout(patience).unwrap();
        match self.fingerprint {
            Some(fingerprint) => Box::new(tls::with(fingerprint, stream)),
            None => Box::new(stream),
        }
    }

    /// The scheme of its addresses, and the other one.
    const fn schemes(&self) -> (&'static str, &'static str) {
        if self.fingerprint.is_some() {
            ("https", "http")
        } else {
            ("http", "https")
        }
    }

    /// Sends lines and a body; gives the status, the head and the body of the answer.
    pub(crate) fn ask(&self, lines: &[&str], body: &str) -> (u16, String, String) {
        let mut stream = self.connect();
        let port = self.port.to_string();
        let head: String = lines
            .iter()
            .map(|line| {
                let line = line.replace("PORT", &port).replace("TOKEN", &self.token);
                let (scheme, other) = self.schemes();
                line.replace("SCHEME", scheme).replace("OTHER", other) + "\r\n"
            })
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
