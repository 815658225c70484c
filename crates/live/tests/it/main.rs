//! The server as a browser, a foreign page and another user of the host meet it: plain bytes over a
//! socket.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    missing_docs,
    reason = "a test that fails may panic"
)]

mod flood;

use flood::Flood;
use glidepath_live::{Caller, ContentType, Feed, Message, Response, Role, Running, Server, Site};
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Counts what reached it.
#[derive(Default)]
struct Counted {
    commands: AtomicUsize,
    documents: AtomicUsize,
    callers: Mutex<Vec<Caller>>,
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

struct Page {
    port: u16,
    /// That of who may operate, and those of all roles.
    token: String,
    tokens: Vec<String>,
    reached: Arc<Counted>,
    feed: Feed,
    _running: Running,
}

impl Page {
    fn serve() -> Self {
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
    fn ask(&self, lines: &[&str], body: &str) -> (u16, String, String) {
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

    fn status(&self, lines: &[&str]) -> u16 {
        self.ask(lines, "").0
    }
}

const HOST: &str = "Host: 127.0.0.1:PORT";
const TOKEN: &str = "X-Glidepath-Token: TOKEN";
const JSON: &str = "Content-Type: application/json";

#[test]
fn the_page_is_given_out_and_its_data_with_the_token() {
    let page = Page::serve();
    for host in ["127.0.0.1", "localhost", "LocalHost", "[::1]"] {
        let host = format!("Host: {host}:PORT");
        let (status, head, body) = page.ask(&["GET / HTTP/1.1", &host], "");
        assert_eq!(status, 200, "{host}");
        assert!(body.starts_with("<!doctype html>"));
        for field in [
            "Content-Security-Policy: default-src 'none'; script-src 'self'",
            "frame-ancestors 'none'",
            "X-Content-Type-Options: nosniff",
            "Cache-Control: no-store",
        ] {
            assert!(head.contains(field), "{field}: {head}");
        }
        assert!(!head.to_lowercase().contains("access-control"), "{head}");
    }
    let own = "Origin: http://localhost:PORT";
    let (status, _, body) = page.ask(&["GET /api/plan?x=1 HTTP/1.1", HOST, own, TOKEN], "");
    assert_eq!((status, body.as_str()), (200, "/api/plan x=1"));
    let post = [
        "POST /api/command HTTP/1.1",
        HOST,
        own,
        TOKEN,
        JSON,
        "Content-Length: 2",
    ];
    assert_eq!(page.ask(&post, "{}").0, 200);
    assert_eq!(
        page.status(&["GET /api/nothing HTTP/1.1", HOST, TOKEN]),
        404
    );
    assert_eq!(page.status(&["GET /../Cargo.toml HTTP/1.1", HOST]), 404);
    assert_eq!(page.reached.commands.load(Ordering::Relaxed), 1);
}

/// What is wrong, the request, and the status of the answer.
const REFUSED: [(&str, &[&str], u16); 24] = [
    ("a foreign host", &["Host: evil.example:PORT", TOKEN], 421),
    ("a rebound name", &["Host: evil.example", TOKEN], 421),
    ("another port", &["Host: 127.0.0.1:1", TOKEN], 421),
    (
        "a longer name",
        &["Host: 127.0.0.1:PORT.evil.example", TOKEN],
        421,
    ),
    ("no host", &[TOKEN], 421),
    ("a second host", &[HOST, "Host: evil.example", TOKEN], 421),
    (
        "a second host in front",
        &["Host: evil.example", HOST, TOKEN],
        421,
    ),
    ("the same host twice", &[HOST, HOST, TOKEN], 421),
    (
        "a foreign origin",
        &[HOST, "Origin: http://evil.example", TOKEN],
        403,
    ),
    ("no origin at all", &[HOST, "Origin: null", TOKEN], 403),
    (
        "another scheme",
        &[HOST, "Origin: https://127.0.0.1:PORT", TOKEN],
        403,
    ),
    (
        "another port's page",
        &[HOST, "Origin: http://127.0.0.1:1", TOKEN],
        403,
    ),
    (
        "a second origin",
        &[
            HOST,
            "Origin: http://127.0.0.1:PORT",
            "Origin: http://evil.example",
            TOKEN,
        ],
        403,
    ),
    (
        "a foreign page, says the browser",
        &[HOST, "Sec-Fetch-Site: cross-site", TOKEN],
        403,
    ),
    (
        "a page of another port, says the browser",
        &[HOST, "Sec-Fetch-Site: same-site", TOKEN],
        403,
    ),
    (
        "a link to what only pages ask for",
        &[
            HOST,
            "Sec-Fetch-Site: cross-site",
            "Sec-Fetch-Mode: navigate",
            TOKEN,
        ],
        403,
    ),
    ("no token", &[HOST], 403),
    (
        "a wrong token",
        &[HOST, "X-Glidepath-Token: 00000000000000000000000000000000"],
        403,
    ),
    ("an empty token", &[HOST, "X-Glidepath-Token:"], 403),
    ("two tokens", &[HOST, TOKEN, TOKEN], 403),
    (
        "a token and more",
        &[HOST, "X-Glidepath-Token: TOKENx"],
        403,
    ),
    (
        "a token as a cookie",
        &[HOST, "Cookie: X-Glidepath-Token=TOKEN"],
        403,
    ),
    (
        "a body without length",
        &[HOST, TOKEN, JSON, "Transfer-Encoding: chunked"],
        400,
    ),
    (
        "two lengths",
        &[HOST, TOKEN, JSON, "Content-Length: 0", "Content-Length: 1"],
        400,
    ),
];

#[test]
fn whoever_is_not_the_page_is_refused_everywhere() {
    let page = Page::serve();
    for (wrong, fields, status) in REFUSED {
        for line in [
            "GET /api/plan HTTP/1.1",
            "GET /api/stream HTTP/1.1",
            "POST /api/command HTTP/1.1",
        ] {
            let mut lines = vec![line];
            lines.extend_from_slice(fields);
            if line.starts_with("POST") && !fields.contains(&JSON) {
                lines.push(JSON);
            }
            assert_eq!(page.status(&lines), status, "{wrong}: {line}");
        }
    }
    // The page itself, too, where the token does not matter.
    for (wrong, fields, status) in &REFUSED[..15] {
        let mut lines = vec!["GET / HTTP/1.1"];
        lines.extend_from_slice(fields);
        assert_eq!(page.status(&lines), *status, "{wrong}");
    }
    assert_eq!(page.reached.documents.load(Ordering::Relaxed), 0);
    assert_eq!(page.reached.commands.load(Ordering::Relaxed), 0);
}

#[test]
fn a_target_that_names_a_host_is_refused() {
    let page = Page::serve();
    for line in [
        "GET http://evil.example/api/plan HTTP/1.1",
        "GET http://127.0.0.1:PORT/api/plan HTTP/1.1",
        "POST http://evil.example/api/command HTTP/1.1",
        "GET //evil.example/api/plan HTTP/1.1",
        "CONNECT evil.example:443 HTTP/1.1",
        "OPTIONS * HTTP/1.1",
    ] {
        assert_eq!(page.status(&[line, HOST, TOKEN, JSON]), 421, "{line}");
    }
    // No leave is given to foreign pages, and nothing is done by other methods.
    for method in ["OPTIONS", "PUT", "DELETE", "HEAD"] {
        let line = format!("{method} /api/command HTTP/1.1");
        assert_eq!(page.status(&[&line, HOST, TOKEN, JSON]), 405, "{method}");
    }
    let plain = "Content-Type: text/plain";
    let line = "POST /api/command HTTP/1.1";
    assert_eq!(page.status(&[line, HOST, TOKEN, plain]), 415);
    assert_eq!(page.status(&[line, HOST, TOKEN]), 415);
    assert_eq!(page.status(&["POST / HTTP/1.1", HOST, TOKEN, JSON]), 405);
    assert_eq!(page.reached.documents.load(Ordering::Relaxed), 0);
    assert_eq!(page.reached.commands.load(Ordering::Relaxed), 0);
}

#[test]
fn a_link_leads_to_the_page_and_to_nothing_else() {
    let page = Page::serve();
    let link = [
        HOST,
        "Sec-Fetch-Site: cross-site",
        "Sec-Fetch-Mode: navigate",
    ];
    let ask = |line| page.status(&[&[line], &link[..]].concat());
    assert_eq!(ask("GET / HTTP/1.1"), 200);
    assert_eq!(ask("GET /app.js HTTP/1.1"), 403);
}

#[test]
fn pages_hear_what_happens_and_the_end_of_it() {
    let page = Page::serve();
    page.feed.push(Message::new(1, b"before"));
    let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
    stream
        .set_read_timeout(Some(Duration::from_secs(20)))
        .unwrap();
    let (port, token) = (page.port, &page.token);
    let head = format!(
        "GET /api/stream HTTP/1.1\r\nHost: localhost:{port}\r\nX-Glidepath-Token: {token}\r\n\r\n"
    );
    stream.write_all(head.as_bytes()).unwrap();
    let mut heard = Vec::new();
    while !heard.ends_with(b"before") {
        let mut byte = [0];
        stream.read_exact(&mut byte).unwrap();
        heard.push(byte[0]);
    }
    page.feed.push(Message::new(2, b"after"));
    let mut message = [0; 10];
    stream.read_exact(&mut message).unwrap();
    assert_eq!(message, *b"\x06\x00\x00\x00\x02after");
    // A server that ends lets nobody wait.
    drop(page);
    let mut rest = Vec::new();
    stream.read_to_end(&mut rest).unwrap();
}

#[test]
fn a_browser_that_says_nothing_keeps_nobody_away() {
    let page = Page::serve();
    let idle: Vec<TcpStream> = (0..8)
        .map(|_| TcpStream::connect(("127.0.0.1", page.port)).unwrap())
        .collect();
    assert_eq!(page.status(&["GET / HTTP/1.1", HOST]), 200);
    drop(idle);
}

#[test]
fn strangers_take_no_place_from_who_has_the_token() {
    let page = Page::serve();
    let _flood = Flood::begin(page.port, 200);
    std::thread::sleep(Duration::from_millis(300));
    let post = ["POST /api/command HTTP/1.1", HOST, TOKEN, JSON];
    for asked in 1..=50 {
        let lines = [&post[..], &["Content-Length: 2"]].concat();
        assert_eq!(page.ask(&lines, "{}").0, 200);
        assert_eq!(page.reached.commands.load(Ordering::Relaxed), asked);
        assert_eq!(page.status(&["GET /api/plan HTTP/1.1", HOST, TOKEN]), 200);
    }
}

#[test]
fn open_pages_take_no_place_from_commands() {
    let page = Page::serve();
    let (port, token) = (page.port, &page.token);
    let stream = format!(
        "GET /api/stream HTTP/1.1\r\nHost: localhost:{port}\r\nX-Glidepath-Token: {token}\r\n\r\n"
    );
    let open = || {
        let mut opened = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
        opened.write_all(stream.as_bytes()).unwrap();
        let mut head = [0; 12];
        opened.read_exact(&mut head).unwrap();
        let status = String::from_utf8_lossy(&head[9..]).into_owned();
        (opened, status)
    };
    let pages: Vec<_> = std::iter::repeat_with(open)
        .take_while(|(_, status)| status == "200")
        .collect();
    assert!(pages.len() >= 16, "{} pages", pages.len());
    let post = ["POST /api/command HTTP/1.1", HOST, TOKEN, JSON];
    assert_eq!(page.ask(&post, "").0, 200);
    drop(pages);
    // Their places are free again when they are told the next time.
    while open().1 != "200" {
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_token_says_what_its_page_may() {
    let page = Page::serve();
    let ask = |token: &str, line: &str, number: &str| {
        let token = format!("X-Glidepath-Token: {token}");
        let number = format!("X-Glidepath-Page: {number}");
        page.ask(&[line, HOST, &token, JSON, &number], "")
    };
    for (token, role) in page.tokens.iter().zip(Role::ALL) {
        assert_eq!(ask(token, "GET /api/may HTTP/1.1", "").2, role.name());
        for (number, known) in [
            ("00000000000000ff", 255),
            ("ff", 0),
            ("zzzzzzzzzzzzzzzz", 0),
        ] {
            assert_eq!(ask(token, "POST /api/command HTTP/1.1", number).0, 200);
            let caller = page.reached.callers.lock().unwrap().pop().unwrap();
            assert_eq!((caller.role, caller.page), (role, known));
        }
    }
    // What was not asked for there is no token for.
    let server = Server::bind(0, Role::Hold).unwrap();
    let roles: Vec<Role> = server.urls().map(|(role, _)| role).collect();
    assert_eq!(roles, [Role::Look, Role::Hold]);
}

#[test]
fn pieces_of_programs_are_long_for_who_has_a_token_and_for_nobody_else() {
    let page = Page::serve();
    let bytes = "Content-Type: application/octet-stream";
    let line = "POST /api/upload?name=a.ngc HTTP/1.1";
    let body = "x".repeat(1 << 20);
    let length = format!("Content-Length: {}", body.len());
    let (status, _, said) = page.ask(&[line, HOST, TOKEN, bytes, &length], &body);
    assert_eq!((status, said.as_str()), (200, "name=a.ngc 1048576"));
    let longer = format!("Content-Length: {}", body.len() + 1);
    assert_eq!(page.ask(&[line, HOST, TOKEN, bytes, &longer], "").0, 400);
    assert_eq!(page.ask(&[line, HOST, bytes, &length], "").0, 400);
    let short = "Content-Length: 1";
    assert_eq!(page.ask(&[line, HOST, bytes, short], "x").0, 403);
    assert_eq!(page.ask(&[line, HOST, TOKEN, JSON, short], "x").0, 415);
    let command = "POST /api/command HTTP/1.1";
    assert_eq!(page.ask(&[command, HOST, TOKEN, JSON, &length], "").0, 400);
    assert_eq!(page.ask(&[command, HOST, TOKEN, bytes, short], "x").0, 415);
    assert_eq!(page.reached.commands.load(Ordering::Relaxed), 1);
}

/// However often a byte of it comes.
#[test]
fn a_request_that_does_not_come_to_its_end_is_given_up() {
    let page = Page::serve();
    let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
    let (ended, is_over) = std::sync::mpsc::channel();
    let mut heard = stream.try_clone().unwrap();
    std::thread::spawn(move || {
        // Reset or closed: both are an end.
        let _ended = heard.read(&mut [0]);
        ended.send(()).unwrap();
    });
    let begun = Instant::now();
    while is_over.try_recv().is_err() {
        // The server may have closed it just now.
        let _sent = stream.write_all(b"G");
        assert!(begun.elapsed() < Duration::from_secs(60), "it is kept");
        std::thread::sleep(Duration::from_millis(200));
    }
    assert!(begun.elapsed() > Duration::from_secs(4), "hurried too much");
}

/// A file with a motion in it: the page with nothing to load.
#[test]
fn a_page_as_a_file_has_everything_in_it() {
    let scale = glidepath_live::AxisScale {
        index: 0,
        limits: [1.0; 3],
    };
    let mut motion = glidepath_live::Motion::new(&[scale], 0.004);
    motion.push(&glidepath_live::MotionSample::default());
    let text = glidepath_live::file::page("{\"a\":\"</script>\"}", "G0 X1\n</script>", &motion);
    assert!(text.starts_with("<!doctype html>"));
    assert!(text.contains(glidepath_live::file::GENERATOR));
    assert!(text.contains("SIL OPEN FONT LICENSE"));
    // Neither a name of a file nor an address is left that a browser would load.
    for loads in ["<link rel=\"stylesheet\"", "src=\"", "url(fonts", "@import"] {
        assert!(!text.contains(loads), "{loads}");
    }
    let scripts = text.matches("<script>").count();
    assert_eq!(text.matches("</script>").count(), scripts);
    assert_eq!(scripts, 13);
    assert!(
        !text.contains("/api/command"),
        "nothing of a file operates a machine"
    );
}
