//! Paired devices, and whoever is none: what is taken over TLS, and what is not.

use crate::page::{HOST, JSON, Page, TOKEN};
use glidepath_live::{Feed, Message, Role, Sha256};
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// Whatever was kept of it.
#[test]
fn a_device_never_operates() {
    let page = Page::serve_devices();
    for (token, role) in page.tokens.iter().zip(["look", "hold", "hold"]) {
        let field = format!("X-Glidepath-Token: {token}");
        let asked = ["GET /api/may HTTP/1.1", HOST, &field];
        assert_eq!(page.ask(&asked, "").2, role, "{token}");
        let post = ["POST /api/command HTTP/1.1", HOST, &field, JSON];
        assert_eq!(page.status(&post), 200);
        let caller = page.reached.callers.lock().unwrap().pop().unwrap();
        let of = Some(Sha256::of(token.as_bytes()));
        assert_eq!((caller.role.name(), caller.device), (role, of));
    }
}

#[test]
fn tokens_of_the_host_and_of_devices_are_not_taken_for_each_other() {
    let [host, devices] = Page::both();
    for (page, other) in [(&host, &devices), (&devices, &host)] {
        for token in &other.tokens {
            let field = format!("X-Glidepath-Token: {token}");
            for line in ["GET /api/plan HTTP/1.1", "GET /api/may HTTP/1.1"] {
                assert_eq!(page.status(&[line, HOST, &field]), 403);
            }
            let post = ["POST /api/command HTTP/1.1", HOST, &field, JSON];
            assert_eq!(page.status(&post), 403);
        }
    }
    let reached = |page: &Page| page.reached.commands.load(Ordering::Relaxed);
    assert_eq!(reached(&host) + reached(&devices), 0);
}

#[test]
fn a_code_is_taken_over_tls_alone_and_from_the_own_page() {
    let [host, devices] = Page::both();
    let pair = |page: &Page, more: &[&str]| {
        let lines = [&["POST /api/pair HTTP/1.1", HOST][..], more].concat();
        page.ask(&[&lines[..], &["Content-Length: 2"]].concat(), "{}")
            .0
    };
    assert_eq!(pair(&host, &[JSON]), 403);
    assert_eq!(pair(&host, &[JSON, TOKEN]), 404);
    assert_eq!(pair(&devices, &[]), 415);
    assert_eq!(pair(&devices, &[JSON, "Origin: https://evil.example"]), 403);
    assert_eq!(pair(&devices, &[JSON, "Sec-Fetch-Site: cross-site"]), 403);
    assert_eq!(devices.status(&["GET /api/pair HTTP/1.1", HOST]), 405);
    let codes = |page: &Page| page.paired.codes.load(Ordering::Relaxed);
    assert_eq!((codes(&host), codes(&devices)), (0, 0));
    assert_eq!(pair(&devices, &[JSON]), 200);
    assert_eq!(codes(&devices), 1);
}

#[test]
fn what_is_not_encrypted_is_told_so_and_nothing_else() {
    let page = Page::serve_devices();
    let plain = |head: &str| {
        let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
        let patience = Some(Duration::from_secs(20));
        stream.set_read_timeout(patience).unwrap();
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = Vec::new();
        // It may be reset, since nobody reads what was sent.
        let _ended = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    };
    let (port, token) = (page.port, &page.token);
    let head = format!("Host: 127.0.0.1:{port}\r\nX-Glidepath-Token: {token}\r\n\r\n");
    for line in [
        "GET / HTTP/1.1",
        "GET /api/plan HTTP/1.1",
        "POST /api/command HTTP/1.1",
    ] {
        let answer = plain(&format!("{line}\r\n{head}"));
        let is_refused = answer.is_empty() || answer.starts_with("HTTP/1.1 400");
        assert!(is_refused && !answer.contains("doctype"), "{answer}");
    }
    assert_eq!(page.reached.documents.load(Ordering::Relaxed), 0);
    assert_eq!(page.reached.commands.load(Ordering::Relaxed), 0);
}

/// TLS 1.2, as its first message says: no version beside it is offered.
#[test]
fn older_tls_is_not_spoken() {
    let page = Page::serve_devices();
    let mut hello = vec![3, 3];
    hello.extend([7; 32]);
    hello.extend([0, 0, 2, 0xc0, 0x2b, 1, 0, 0, 0]);
    let length = u8::try_from(hello.len()).unwrap();
    let mut record = vec![22, 3, 1, 0, length + 4, 1, 0, 0, length];
    record.extend(hello);
    let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
    stream.write_all(&record).unwrap();
    let mut answer = Vec::new();
    let _ended = stream.read_to_end(&mut answer);
    // An alert, or nothing; no handshake.
    assert!(answer.first().is_none_or(|kind| *kind == 21), "{answer:?}");
}

#[test]
fn the_stream_of_a_device_that_is_paired_no_more_ends() {
    let page = Page::serve_devices();
    let (port, token) = (page.port, &page.tokens[0]);
    let head = format!(
        "GET /api/stream HTTP/1.1\r\nHost: localhost:{port}\r\nX-Glidepath-Token: {token}\r\n\r\n"
    );
    let tells = |feed: &Feed| feed.push(Message::new(1, b"on"));
    for busy in [false, true] {
        let hash = Sha256::of(token.as_bytes());
        page.paired.tokens.lock().unwrap().push((hash, Role::Look));
        let mut stream = page.connect();
        stream.write_all(head.as_bytes()).unwrap();
        tells(&page.feed);
        let mut heard = Vec::new();
        while !heard.ends_with(b"on") {
            let mut byte = [0];
            stream.read_exact(&mut byte).unwrap();
            heard.push(byte[0]);
        }
        page.paired
            .tokens
            .lock()
            .unwrap()
            .retain(|(of, _)| *of != hash);
        let revoked = Instant::now();
        // Whether anything happens or not.
        while busy && revoked.elapsed() < Duration::from_millis(500) {
            tells(&page.feed);
            std::thread::sleep(Duration::from_millis(20));
        }
        // Something is told every second where it goes on.
        while stream.read(&mut [0; 1024]).unwrap() > 0 {
            assert!(revoked.elapsed() < Duration::from_secs(3), "{busy}");
        }
        let field = format!("X-Glidepath-Token: {token}");
        let again = ["GET /api/stream HTTP/1.1", HOST, &field];
        assert_eq!(page.status(&again), 403);
    }
}
