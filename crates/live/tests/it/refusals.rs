//! Refusals: requests that are not those of the page.

use crate::page::{HOST, JSON, Page, TOKEN};
use std::sync::atomic::Ordering;

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
        &[HOST, "Origin: SCHEME://evil.example", TOKEN],
        403,
    ),
    ("no origin at all", &[HOST, "Origin: null", TOKEN], 403),
    (
        "another scheme",
        &[HOST, "Origin: OTHER://127.0.0.1:PORT", TOKEN],
        403,
    ),
    (
        "another port's page",
        &[HOST, "Origin: SCHEME://127.0.0.1:1", TOKEN],
        403,
    ),
    (
        "a second origin",
        &[
            HOST,
            "Origin: SCHEME://127.0.0.1:PORT",
            "Origin: SCHEME://evil.example",
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
    Page::both().iter().for_each(refuses_all);
}

fn refuses_all(page: &Page) {
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
    Page::both().iter().for_each(refuses_hosts);
}

fn refuses_hosts(page: &Page) {
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
