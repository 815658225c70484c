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
//!
//! Paired devices come over TLS to another port, where the same holds with other names and other tokens: `Host` is a
//! name of the certificate with that port, `Origin` the same by `https`, and the tokens are those of devices. None of
//! the one side is taken on the other, and whatever a device was given, it may not operate. One thing more is
//! taken there without a token: a code to be paired by.

use crate::devices::{Devices, MOST};
use crate::request::Request;
use crate::role::{Caller, Role};
use crate::sha256::Sha256;
use crate::token::Token;
use std::net::Ipv6Addr;
use std::sync::Arc;

/// The header field that has the token, in lower case.
pub const TOKEN_FIELD: &str = "x-glidepath-token";
/// The header field that has the number of the page, sixteen hexadecimal digits, in lower case.
pub const PAGE_FIELD: &str = "x-glidepath-page";
/// Where pieces of programs go.
pub const UPLOAD: &str = "/api/upload";
/// Where a device sends the code that it is paired by.
pub const PAIR: &str = "/api/pair";
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
    /// The same of a server of paired devices.
    #[error(
        "this server has another name: open the address that is shown where devices are paired"
    )]
    DeviceHost,
    /// The request comes from a page of another origin.
    #[error("the request comes from another page")]
    Origin,
    /// The token is missing or wrong.
    #[error("the token is missing or wrong: open the address that `glidepath live` printed")]
    Token,
    /// The device is not paired, or not any more.
    #[error("this device is not paired, or not any more")]
    Device,
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
            Self::Target | Self::Host | Self::DeviceHost => 421,
            Self::Origin | Self::Token | Self::Device => 403,
            Self::Method => 405,
            Self::ContentType => 415,
        }
    }
}

/// Who is let in.
#[derive(Debug, Clone)]
enum Admitted {
    /// Pages of this host, by the tokens of this server.
    Pages(Vec<(Role, Token)>),
    /// Paired devices, which may no more than this.
    Devices(Arc<dyn Devices>, Role),
}

/// The judge of requests.
#[derive(Debug, Clone)]
pub struct Guard {
    hosts: Vec<String>,
    admitted: Admitted,
}

impl Guard {
    /// The judge of a server on this port of loopback, with a token for each role that there is.
    #[must_use]
    pub fn new(port: u16, tokens: Vec<(Role, Token)>) -> Self {
        let names = ["127.0.0.1", "localhost", "[::1]"].map(str::to_owned);
        Self {
            hosts: hosts(names.to_vec(), port, 80),
            admitted: Admitted::Pages(tokens),
        }
    }

    /// The judge of a server of paired devices, with the names of its certificate, on this port. They may no more
    /// than `most`, and never operate.
    #[must_use]
    pub fn of_devices(names: &[String], port: u16, devices: Arc<dyn Devices>, most: Role) -> Self {
        let in_url = |name: &String| match name.parse::<Ipv6Addr>() {
            Ok(address) => format!("[{address}]"),
            Err(_) => name.clone(),
        };
        Self {
            hosts: hosts(names.iter().map(in_url).collect(), port, 443),
            admitted: Admitted::Devices(devices, most.min(MOST)),
        }
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
        if !request.only("host").is_some_and(|host| self.is_own(host)) {
            return Err(match self.admitted {
                Admitted::Pages(_) => Refusal::Host,
                Admitted::Devices(..) => Refusal::DeviceHost,
            });
        }
        self.judge_origin(request)?;
        let is_api = path.starts_with(API);
        let is_pairing = path == PAIR && matches!(self.admitted, Admitted::Devices(..));
        let caller = if is_api && !is_pairing {
            Some(self.caller(request)?)
        } else {
            None
        };
        match request.method.as_str() {
            "GET" if !is_pairing => Ok(caller),
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
        let shown = request.only(TOKEN_FIELD);
        let (role, device) = match &self.admitted {
            Admitted::Pages(tokens) => {
                let shown = shown.ok_or(Refusal::Token)?;
                // All are compared, whichever it is.
                let roles = tokens.iter().filter(|(_, token)| token.is(shown));
                let role = roles.map(|(role, _)| *role).max();
                (role.ok_or(Refusal::Token)?, None)
            }
            Admitted::Devices(devices, most) => {
                let token = Sha256::of(shown.ok_or(Refusal::Device)?);
                let role = devices.role(&token).ok_or(Refusal::Device)?;
                (role.min(*most), Some(token))
            }
        };
        let page = request.only(PAGE_FIELD).filter(|page| page.len() == 16);
        let page = page.and_then(|page| str::from_utf8(page).ok());
        let page = page.and_then(|page| u64::from_str_radix(page, 16).ok());
        let page = page.unwrap_or(0);
        Ok(Caller { role, page, device })
    }

    fn judge_origin(&self, request: &Request) -> Result<(), Refusal> {
        let scheme = match self.admitted {
            Admitted::Pages(_) => "http://",
            Admitted::Devices(..) => "https://",
        };
        for origin in request.values("origin") {
            let host = origin.strip_prefix(scheme.as_bytes());
            let host = host.ok_or(Refusal::Origin)?;
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

/// The names with a port, and without it where browsers leave it out.
fn hosts(names: Vec<String>, port: u16, left_out: u16) -> Vec<String> {
    let with_port = names.iter().map(|name| format!("{name}:{port}"));
    let mut hosts: Vec<String> = with_port.collect();
    if port == left_out {
        hosts.extend(names);
    }
    hosts
}
