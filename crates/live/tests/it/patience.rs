//! Who takes up the server's time and places: browsers that say nothing, strangers, open pages.

use crate::flood::Flood;
use crate::page::{HOST, JSON, Page, TOKEN};
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

#[test]
fn a_browser_that_says_nothing_keeps_nobody_away() {
    Page::both().iter().for_each(waits_for_nobody);
}

fn waits_for_nobody(page: &Page) {
    let idle: Vec<TcpStream> = (0..8)
        .map(|_| TcpStream::connect(("127.0.0.1", page.port)).unwrap())
        .collect();
    assert_eq!(page.status(&["GET / HTTP/1.1", HOST]), 200);
    drop(idle);
}

#[test]
fn strangers_take_no_place_from_who_has_the_token() {
    Page::both().iter().for_each(answers_in_a_flood);
}

fn answers_in_a_flood(page: &Page) {
    let _flood = Flood::begin(page, 200);
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
    // All places of this host are its pages', and of those of the network a device has its share.
    for (page, pages) in Page::both().iter().zip([24, 4]) {
        has_places_for_commands(page, pages);
    }
}

fn has_places_for_commands(page: &Page, most: usize) {
    let (port, token) = (page.port, &page.token);
    let stream = format!(
        "GET /api/stream HTTP/1.1\r\nHost: localhost:{port}\r\nX-Glidepath-Token: {token}\r\n\r\n"
    );
    let open = || {
        let mut opened = page.connect();
        opened.write_all(stream.as_bytes()).unwrap();
        let mut head = [0; 12];
        opened.read_exact(&mut head).unwrap();
        let status = String::from_utf8_lossy(&head[9..]).into_owned();
        (opened, status)
    };
    let pages: Vec<_> = std::iter::repeat_with(open)
        .take_while(|(_, status)| status == "200")
        .collect();
    assert_eq!(pages.len(), most);
    let post = ["POST /api/command HTTP/1.1", HOST, TOKEN, JSON];
    assert_eq!(page.ask(&post, "").0, 200);
    drop(pages);
    // Their places are free again when they are told the next time.
    while open().1 != "200" {
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// However often a byte of it comes: of a request, or of the handshake in front of it.
#[test]
fn a_request_that_does_not_come_to_its_end_is_given_up() {
    // The first of a handshake is its kind, its version, and a length that is not reached.
    for (page, begin) in Page::both()
        .iter()
        .zip([&b"G"[..], b"\x16\x03\x01\x40\x00"])
    {
        gives_up(page, begin);
    }
}

fn gives_up(page: &Page, begin: &[u8]) {
    let mut stream = TcpStream::connect(("127.0.0.1", page.port)).unwrap();
    let (ended, is_over) = std::sync::mpsc::channel();
    let mut heard = stream.try_clone().unwrap();
    std::thread::spawn(move || {
        // Reset or closed: both are an end.
        let _ended = heard.read(&mut [0]);
        ended.send(()).unwrap();
    });
    let begun = Instant::now();
    stream.write_all(begin).unwrap();
    while is_over.try_recv().is_err() {
        // The server may have closed it just now.
        let _sent = stream.write_all(b"G");
        assert!(begun.elapsed() < Duration::from_secs(60), "it is kept");
        std::thread::sleep(Duration::from_millis(200));
    }
    assert!(begun.elapsed() > Duration::from_secs(4), "hurried too much");
}
