//! An answer of the server.

use std::io::{self, Write};
use std::sync::Arc;

/// The status of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// 200.
    Ok,
    /// 400: it cannot be understood.
    BadRequest,
    /// 403: it is not allowed.
    Forbidden,
    /// 404: there is no such thing.
    NotFound,
    /// 409: not now.
    Conflict,
    /// 503: the machine does not answer.
    Unavailable,
    /// Another one.
    Other(u16),
}

impl Status {
    const fn code(self) -> u16 {
        match self {
            Self::Ok => 200,
            Self::BadRequest => 400,
            Self::Forbidden => 403,
            Self::NotFound => 404,
            Self::Conflict => 409,
            Self::Unavailable => 503,
            Self::Other(code) => code,
        }
    }
}

/// The type of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContentType {
    /// A page.
    Html,
    /// A style sheet.
    Css,
    /// A program of the page.
    Script,
    /// A typeface.
    Font,
    /// A text.
    Text,
    /// An object.
    Json,
    /// Numbers as they are in memory.
    Binary,
}

impl ContentType {
    const fn name(self) -> &'static str {
        match self {
            Self::Html => "text/html; charset=utf-8",
            Self::Css => "text/css; charset=utf-8",
            Self::Script => "text/javascript; charset=utf-8",
            Self::Font => "font/woff2",
            Self::Text => "text/plain; charset=utf-8",
            Self::Json => "application/json",
            Self::Binary => "application/octet-stream",
        }
    }
}

/// An answer.
#[derive(Debug, Clone)]
pub struct Response {
    /// How it went.
    pub status: Status,
    /// What the body is.
    pub content: ContentType,
    /// The body.
    pub body: Arc<[u8]>,
}

impl Response {
    /// A body of this type.
    pub fn new(content: ContentType, body: impl Into<Arc<[u8]>>) -> Self {
        let body = body.into();
        Self {
            status: Status::Ok,
            content,
            body,
        }
    }

    /// The same with another status.
    #[must_use]
    pub fn with(self, status: Status) -> Self {
        Self { status, ..self }
    }

    /// Writes it.
    pub(crate) fn write(&self, to: &mut impl Write) -> io::Result<()> {
        let length = format!("Content-Length: {}\r\n", self.body.len());
        to.write_all(head(self.status, self.content, &length).as_bytes())?;
        to.write_all(&self.body)?;
        to.flush()
    }
}

/// Begins an answer that ends with the connection.
pub(crate) fn begin_stream(to: &mut impl Write) -> io::Result<()> {
    to.write_all(head(Status::Ok, ContentType::Binary, "").as_bytes())?;
    to.flush()
}

/// What the page may load: its own files, and nothing of anybody else.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; font-src 'self'; \
                      connect-src 'self'; img-src 'self' data:; base-uri 'none'; \
                      form-action 'none'; frame-ancestors 'none'";

fn head(status: Status, content: ContentType, length: &str) -> String {
    let (code, name) = (status.code(), content.name());
    format!(
        "HTTP/1.1 {code} \r\nContent-Type: {name}\r\n{length}Connection: close\r\nCache-Control: \
         no-store\r\nContent-Security-Policy: {POLICY}\r\nX-Content-Type-Options: \
         nosniff\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: \
         same-origin\r\nCross-Origin-Opener-Policy: same-origin\r\n\r\n"
    )
}
