//! A network between a page and its server that stops to carry anything, and keeps every connection.

use std::io::{Read as _, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{sleep, spawn};
use std::time::Duration;

/// Between two looks whether it carries anything again.
const POLL: Duration = Duration::from_millis(2);

/// The way to a port of this host, by another port.
pub(crate) struct Proxy {
    pub(crate) port: u16,
    is_stopped: Arc<AtomicBool>,
}

impl Proxy {
    pub(crate) fn to(server: u16) -> Self {
        let listener = TcpListener::bind(("127.0.0.1", 0)).unwrap();
        let port = listener.local_addr().unwrap().port();
        let is_stopped = Arc::<AtomicBool>::default();
        let stops = Arc::clone(&is_stopped);
        // It ends with the process of the tests: nobody knows of its port any more by then.
        let _carrying = spawn(move || {
            for page in listener.incoming().flatten() {
                let Ok(server) = TcpStream::connect(("127.0.0.1", server)) else {
                    return;
                };
                let back = (server.try_clone().unwrap(), page.try_clone().unwrap());
                for (from, to) in [(page, server), back] {
                    let stops = Arc::clone(&stops);
                    let _way = spawn(move || carry(from, to, &stops));
                }
            }
        });
        Self { port, is_stopped }
    }

    /// From now on nothing arrives, on either side, and nothing is closed. What is sent meanwhile arrives once it carries again.
    pub(crate) fn stop(&self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }

    pub(crate) fn go_on(&self) {
        self.is_stopped.store(false, Ordering::Relaxed);
    }
}

fn carry(mut from: TcpStream, mut to: TcpStream, is_stopped: &AtomicBool) {
    let mut bytes = vec![0; 65_536];
    loop {
        let length = from.read(&mut bytes).unwrap_or(0);
        while is_stopped.load(Ordering::Relaxed) {
            sleep(POLL);
        }
        if length == 0 || to.write_all(&bytes[..length]).is_err() {
            break;
        }
    }
    let _over = to.shutdown(Shutdown::Both);
}
