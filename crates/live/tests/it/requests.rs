//! What the page is given, and what it may: requests as its own browser makes them.

use crate::page::{HOST, JSON, Page, TOKEN};
use glidepath_live::{Message, Role, Server};
use std::sync::atomic::Ordering;

#[test]
fn the_page_is_given_out_and_its_data_with_the_token() {
    Page::both().iter().for_each(gives_out);
}

fn gives_out(page: &Page) {
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
    let own = "Origin: SCHEME://localhost:PORT";
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

#[test]
fn a_link_leads_to_the_page_and_to_nothing_else() {
    Page::both().iter().for_each(takes_links);
}

fn takes_links(page: &Page) {
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
    Page::both().into_iter().for_each(tells);
}

fn tells(page: Page) {
    page.feed.push(Message::new(1, b"before"));
    let mut stream = page.connect();
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
    Page::both().iter().for_each(takes_pieces);
}

fn takes_pieces(page: &Page) {
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
    assert_eq!(scripts, 14);
    assert!(
        !text.contains("/api/command"),
        "nothing of a file operates a machine"
    );
}
