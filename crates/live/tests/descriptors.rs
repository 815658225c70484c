//! A server whose process has no descriptor left for a connection: it answers again as soon as it has one. A
//! program of its own, because the limit is that of the whole process.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use glidepath_live::{Caller, Feed, Response, Role, Server, Site};
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use std::fs::File;
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

struct Nothing;

impl Site for Nothing {
    fn document(&self, _caller: Caller, _path: &str, _query: &str) -> Option<Response> {
        None
    }

    fn command(&self, _caller: Caller, _body: &[u8]) -> Response {
        unreachable!()
    }

    fn upload(&self, _caller: Caller, _query: &str, _piece: &[u8]) -> Response {
        unreachable!()
    }
}

#[test]
fn a_server_without_descriptors_answers_when_it_has_some() {
    let server = Server::bind(0, Role::Look).unwrap();
    let port = server.port();
    let running = server.start(Arc::new(Nothing), &Feed::default()).unwrap();
    let before = getrlimit(Resource::Nofile);
    let few = Rlimit {
        current: Some(40),
        ..before
    };
    setrlimit(Resource::Nofile, few).unwrap();
    let mut files: Vec<File> = std::iter::from_fn(|| File::open("/dev/null").ok()).collect();
    // A descriptor is freed only for the client's end of a connection. The thread that accepts may take the freed
    // one first, because a thread that waits for a connection holds a descriptor for it already: then another is
    // freed. So the second connection is the one that the server has none for.
    let mut connect = || loop {
        match TcpStream::connect(("127.0.0.1", port)) {
            Ok(connection) => return connection,
            Err(error) => assert!(files.pop().is_some(), "{error}"),
        }
    };
    let (_first, mut asked) = (connect(), connect());
    std::thread::sleep(Duration::from_millis(200));
    files.clear();
    asked
        .set_read_timeout(Some(Duration::from_secs(60)))
        .unwrap();
    let request = format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n");
    asked.write_all(request.as_bytes()).unwrap();
    let mut answer = String::new();
    asked.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    setrlimit(Resource::Nofile, before).unwrap();
    drop(running);
}
