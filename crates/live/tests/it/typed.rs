//! Lines that are being typed: too long ones, ones that no key types, and a thousand of them at once.

use crate::page::{HOST, Page, TOKEN};
use glidepath_live::{MOST_TYPED, Request, TypedLine, TypedLineError};
use std::sync::atomic::Ordering;

fn ask(page: &Page, line: &str, token: &str) -> (u16, String) {
    let head = format!("GET /api/judge?line={line} HTTP/1.1");
    let (status, _, body) = page.ask(&[&head, HOST, token], "");
    (status, body)
}

#[test]
fn a_line_is_one_that_a_person_types() {
    Page::both().iter().for_each(takes_lines);
}

fn takes_lines(page: &Page) {
    for (written, said) in [
        ("G1%20X1", "G1 X1"),
        ("G1%09X1%20%28%C3%A4%29", "G1\tX1 (ä)"),
        ("", ""),
        ("%2B%26%3D%23%25", "+&=#%"),
    ] {
        assert_eq!(ask(page, written, TOKEN), (200, said.to_owned()));
    }
    let none = TypedLineError::None.to_string();
    let control = TypedLineError::Control.to_string();
    for (written, said) in [
        ("G1%0AX1", &control),
        ("G1%0DX1", &control),
        ("G1%00", &control),
        ("%1B%5B2J", &control),
        ("G1%C2%9B", &control),
        ("%7F", &control),
        ("%FF", &none),
        ("%2", &none),
        ("%zz", &none),
    ] {
        assert_eq!(
            &ask(page, written, TOKEN),
            &(409, said.clone()),
            "{written}"
        );
    }
    // What is no address does not come so far.
    for raw in ["G1\u{1}X1", "G1\u{7f}X1"] {
        assert_eq!(ask(page, raw, TOKEN).0, 400, "{raw:?}");
    }
}

#[test]
fn a_line_that_is_too_long_is_not_read() {
    Page::both().iter().for_each(refuses_long_lines);
}

fn refuses_long_lines(page: &Page) {
    let of = |bytes: usize| ask(page, &"%20".repeat(bytes), TOKEN);
    assert_eq!(of(MOST_TYPED).0, 200);
    let (status, said) = of(MOST_TYPED + 1);
    assert_eq!(
        (status, said.as_str()),
        (409, "the line is longer than 1000 bytes")
    );
    // A head is bounded before anybody looks at it.
    let line = "x".repeat(20_000);
    let head = format!("GET /api/judge?line={line} HTTP/1.1\r\nHost: a\r\n\r\n");
    assert!(Request::read(&mut head.as_bytes()).is_err());
    let query = format!("line={}", "x".repeat(MOST_TYPED + 1));
    assert_eq!(TypedLine::of(&query), Err(TypedLineError::TooLong));
}

#[test]
fn a_thousand_lines_are_answered_and_of_strangers_none() {
    let page = Page::serve();
    let threads = 8;
    std::thread::scope(|scope| {
        for thread in 0..threads {
            let page = &page;
            scope.spawn(move || {
                for number in 0..1000 / threads {
                    let line = format!("G{thread}X{number}");
                    // A page that asks again before it was answered is told so.
                    let (status, said) = ask(page, &line, TOKEN);
                    assert!(status == 503 || (status, &said) == (200, &line), "{said}");
                    if number % 25 == 0 {
                        assert_eq!(ask(page, &line, "X-Other: none").0, 403);
                    }
                }
            });
        }
    });
    assert_eq!(page.reached.documents.load(Ordering::Relaxed), 1000);
    assert_eq!(page.reached.commands.load(Ordering::Relaxed), 0);
    assert_eq!(ask(&page, "G1", TOKEN), (200, "G1".to_owned()));
}
