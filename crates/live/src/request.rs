//! A request of a browser, as it is on the wire.

use std::io::{self, Read};

/// Longest head of a request, bytes.
const MOST_HEAD: usize = 16 << 10;
/// Longest body, bytes: a command.
pub(crate) const MOST_BODY: usize = 4 << 10;
/// Longest body of a piece of a program, bytes.
pub const MOST_PIECE: usize = 1 << 20;
/// Most header fields.
const MOST_FIELDS: usize = 64;

/// A request. Nothing in it has been judged.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Its method, as GET.
    pub method: String,
    /// Its target, as it was sent: a path with a query, or anything else.
    pub target: String,
    /// Its header fields in the order in which they came, names in lower case.
    pub fields: Vec<(String, Vec<u8>)>,
    /// What follows the head.
    pub body: Vec<u8>,
}

impl Request {
    /// Reads a request with the body of a command.
    ///
    /// # Errors
    ///
    /// [`io::ErrorKind::InvalidData`] if it is none, or longer than any that is meant; the reader's
    /// errors.
    pub fn read(from: &mut impl Read) -> io::Result<Self> {
        Head::read(from)?.body(from, MOST_BODY)
    }

    /// The values of a header field, whose name is in lower case.
    pub fn values<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a [u8]> {
        let of_name = self.fields.iter().filter(move |(of, _)| of == name);
        of_name.map(|(_, value)| value.as_slice())
    }

    /// The value of a header field; `None` if there is none, or more than one.
    #[must_use]
    pub fn only(&self, name: &str) -> Option<&[u8]> {
        let mut of_name = self.fields.iter().filter(|(of, _)| of == name);
        let (_, first) = of_name.next()?;
        of_name.next().is_none().then_some(first)
    }

    /// Path and query of the target.
    #[must_use]
    pub fn path(&self) -> (&str, &str) {
        self.target.split_once('?').unwrap_or((&self.target, ""))
    }

    /// How long the body is.
    fn length(&self) -> io::Result<usize> {
        if self.values("transfer-encoding").next().is_some() {
            return Err(invalid("its body has no length"));
        }
        if self.values("content-length").next().is_none() {
            return Ok(0);
        }
        let length = self
            .only("content-length")
            .and_then(|value| str::from_utf8(value).ok())
            .filter(|text| text.bytes().all(|byte| byte.is_ascii_digit()))
            .and_then(|text| text.parse().ok());
        length.ok_or_else(|| invalid("the length of its body"))
    }
}

/// The head of a request, before its body is read: whoever may send nothing long is not listened to.
#[derive(Debug)]
pub struct Head {
    /// The request, with what of its body has come along.
    pub request: Request,
    length: usize,
}

impl Head {
    /// Reads a head.
    ///
    /// # Errors
    ///
    /// As [`Request::read`].
    pub fn read(from: &mut impl Read) -> io::Result<Self> {
        let mut bytes = Vec::new();
        loop {
            if let Some((mut request, head)) = parse(&bytes)? {
                let length = request.length()?;
                request.body = bytes.split_off(head);
                return Ok(Self { request, length });
            }
            if bytes.len() >= MOST_HEAD {
                return Err(invalid("its head is too long"));
            }
            let mut more = [0; 2048];
            let got = from.read(&mut more)?;
            if got == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            bytes.extend_from_slice(more.get(..got).unwrap_or_default());
        }
    }

    /// Reads the body, of at most so many bytes.
    ///
    /// # Errors
    ///
    /// As [`Request::read`].
    pub fn body(self, from: &mut impl Read, most: usize) -> io::Result<Request> {
        let (mut request, length) = (self.request, self.length);
        if length > most {
            return Err(invalid("the length of its body"));
        }
        let missing = length
            .checked_sub(request.body.len())
            .ok_or_else(|| invalid("more than one request"))?;
        let at = request.body.len();
        request.body.resize(at + missing, 0);
        from.read_exact(request.body.get_mut(at..).unwrap_or_default())?;
        Ok(request)
    }
}

/// The head of a request and its length, if it is whole.
fn parse(bytes: &[u8]) -> io::Result<Option<(Request, usize)>> {
    let mut fields = [httparse::EMPTY_HEADER; MOST_FIELDS];
    let mut parsed = httparse::Request::new(&mut fields);
    match parsed.parse(bytes) {
        Ok(httparse::Status::Complete(length)) => {
            let fields = parsed.headers.iter();
            let request = Request {
                method: parsed.method.unwrap_or_default().to_owned(),
                target: parsed.path.unwrap_or_default().to_owned(),
                fields: fields
                    .map(|field| (field.name.to_ascii_lowercase(), field.value.to_vec()))
                    .collect(),
                body: Vec::new(),
            };
            Ok(Some((request, length)))
        }
        Ok(httparse::Status::Partial) => Ok(None),
        Err(error) => Err(io::Error::new(io::ErrorKind::InvalidData, error)),
    }
}

fn invalid(what: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> io::Result<Request> {
        Request::read(&mut text.as_bytes())
    }

    #[test]
    fn a_request_is_read_with_its_body() {
        let text =
            "POST /api/command?x=1 HTTP/1.1\r\nHost: a\r\nHOST: b\r\nContent-Length: 2\r\n\r\n{}";
        let request = read(text).unwrap();
        assert_eq!(
            (request.method.as_str(), request.body.as_slice()),
            ("POST", &b"{}"[..])
        );
        assert_eq!(request.path(), ("/api/command", "x=1"));
        assert_eq!(request.values("host").count(), 2);
        assert_eq!(request.only("host"), None);
        assert_eq!(request.only("content-length"), Some(&b"2"[..]));
    }

    #[test]
    fn what_is_no_request_or_too_long_is_refused() {
        let long = format!("GET / HTTP/1.1\r\nX: {}\r\n\r\n", "x".repeat(20_000));
        for text in [
            "GET / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\nab",
            "GET / HTTP/1.1\r\nContent-Length: +1\r\n\r\na",
            "GET / HTTP/1.1\r\nContent-Length: 99999\r\n\r\na",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
            "GET / HTTP/1.1\r\nContent-Length: 1\r\n\r\nGET / HTTP/1.1\r\n\r\n",
            "hello\r\n\r\n",
            "GET / HTTP/1.1\r\n",
            long.as_str(),
        ] {
            assert!(read(text).is_err(), "{}", &text[..text.len().min(80)]);
        }
    }
}
