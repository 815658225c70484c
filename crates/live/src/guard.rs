//! The guard of the server: every request is judged here before anybody else sees it.
//!
//! The page is given out on loopback, but that alone keeps nobody away. Any page in the same browser
//! can send requests to loopback; a page of a foreign name can have that name lead to loopback
//! (DNS rebinding); and other users of the host reach it, too. So:
//!
//! * the target is a path, and nothing else: one that names a host could differ from `Host`;
//! * there is one `Host`, and it is one of the names of loopback with this port. Comparing it with
//!   `Origin` would be no defence, since a page of a foreign name sends both alike;
//! * an `Origin`, if there is one, is one of the same names, and so it is with
//!   `Sec-Fetch-Site`, by which browsers say where a request comes from;
//! * whatever is told or done takes a token, in a header field that no foreign page can set, and
//!   that is compared in constant time; which of the tokens it is says what its page may;
//! * commands are `POST` with `application/json`, and pieces of programs `application/octet-stream`,
//!   which a foreign page cannot send without being asked for leave, and leave is never given.

use crate::request::Request;
use crate::role::{Caller, Role};
use crate::token::Token;

/// The header field that has the token, in lower case.
pub const TOKEN_FIELD: &str = "x-glidepath-token";
/// The header field that has the number of the page, sixteen hexadecimal digits, in lower case.
pub const PAGE_FIELD: &str = "x-glidepath-page";
/// Where pieces of programs go.
pub const UPLOAD: &str = "/api/upload";
/// What is told or done is below this path.
pub const API: &str = "/api/";

/// The reason why a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// The target is no path of this server.
    #[error("the target of the request is no path")]
    Target,
    /// There is no `Host`, a second one, or one that is not loopback with this port.
    #[error("this server has another name: open the address that `glidepath live` printed")]
    Host,
    /// The request comes from a page of another origin.
    #[error("the request comes from another page")]
    Origin,
    /// The token is missing or wrong.
    #[error("the token is missing or wrong: open the address that `glidepath live` printed")]
    Token,
    /// The method does not go with the path.
    #[error("this path does not take that method")]
    Method,
    /// A command that is no JSON, or a piece of a program that is no bytes.
    #[error("a command is `application/json`, a piece of a program `application/octet-stream`")]
    ContentType,
}

impl Refusal {
    /// The status of the answer.
    #[must_use]
    pub const fn code(self) -> u16 {
        match self {
            Self::Target | Self::Host => 421,
            Self::Origin | Self::Token => 403,
            Self::Method => 405,
            Self::ContentType => 415,
        }
    }
}

/// The judge of requests.
#[derive(Debug, Clone)]
pub struct Guard {
    hosts: Vec<String>,
    tokens: Vec<(Role, Token)>,
}

impl Guard {
    /// The judge of a server on this port, with a token for each role that there is.
    #[must_use]
    pub fn new(port: u16, tokens: Vec<(Role, Token)>) -> Self {
        let names = ["127.0.0.1", "localhost", "[::1]"];
        let mut hosts: Vec<String> = names.iter().map(|name| format!("{name}:{port}")).collect();
        if port == 80 {
            hosts.extend(names.map(str::to_owned));
        }
        Self { hosts, tokens }
    }

    /// Judges a request. Returns who asks; nobody where no token is wanted.
    ///
    /// # Errors
    ///
    /// It is refused.
    pub fn judge(&self, request: &Request) -> Result<Option<Caller>, Refusal> {
        let (path, _) = request.path();
        if !path.starts_with('/') || path.starts_with("//") || !path.is_ascii() {
            return Err(Refusal::Target);
        }
        let host = request.only("host").ok_or(Refusal::Host)?;
        if !self.is_own(host) {
            return Err(Refusal::Host);
        }
        self.judge_origin(request)?;
        let is_api = path.starts_with(API);
        let caller = if is_api {
            Some(self.caller(request)?)
        } else {
            None
        };
        match request.method.as_str() {
            "GET" => Ok(caller),
            "POST" if is_api => {
                let kind = request.only("content-type").ok_or(Refusal::ContentType)?;
                let kind = kind.split(|byte| *byte == b';').next().unwrap_or_default();
                let wanted: &[u8] = match path {
                    UPLOAD => b"application/octet-stream",
                    _ => b"application/json",
                };
                if kind.trim_ascii().eq_ignore_ascii_case(wanted) {
                    Ok(caller)
                } else {
                    Err(Refusal::ContentType)
                }
            }
            _ => Err(Refusal::Method),
        }
    }

    /// Who asks, by its token.
    fn caller(&self, request: &Request) -> Result<Caller, Refusal> {
        let shown = request.only(TOKEN_FIELD).ok_or(Refusal::Token)?;
        // All are compared, whichever it is.
        let roles = self.tokens.iter().filter(|(_, token)| token.is(shown));
        let role = roles.map(|(role, _)| *role).max().ok_or(Refusal::Token)?;
        let page = request.only(PAGE_FIELD).filter(|page| page.len() == 16);
        let page = page.and_then(|page| str::from_utf8(page).ok());
        let page = page.and_then(|page| u64::from_str_radix(page, 16).ok());
        let page = page.unwrap_or(0);
        Ok(Caller { role, page })
    }

    fn judge_origin(&self, request: &Request) -> Result<(), Refusal> {
        for origin in request.values("origin") {
            let host = origin.strip_prefix(b"http://").ok_or(Refusal::Origin)?;
            if !self.is_own(host) {
                return Err(Refusal::Origin);
            }
        }
        let is_own = |site: &[u8]| matches!(site, b"same-origin" | b"none");
        if request.values("sec-fetch-site").all(is_own) {
            return Ok(());
        }
        // A link or a bookmark to the page itself shows nothing without the token.
        let is_navigation = request.only("sec-fetch-mode") == Some(b"navigate");
        if is_navigation && request.path().0 == "/" {
            Ok(())
        } else {
            Err(Refusal::Origin)
        }
    }

    fn is_own(&self, host: &[u8]) -> bool {
        let mut own = self.hosts.iter();
        own.any(|own| own.as_bytes().eq_ignore_ascii_case(host))
    }
}
