//! The flood: another user of the host, or of the network, who has no token and all the time in the world.

use crate::page::Page;
use crate::tls;
use glidepath_live::Sha256;

use std::collections::VecDeque;
use std::io::Write as _;
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// Connections that give a byte now and then, and never the end of a request or of a handshake; others that come and
/// go; and where TLS is spoken, handshakes without end. They last as long as this.
pub(crate) struct Flood {
    over: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
}

impl Flood {
    pub(crate) fn begin(page: &Page, slow: usize) -> Self {
        let over = Arc::<AtomicBool>::default();
        let (port, fingerprint) = (page.port, page.fingerprint);
        let of = || Arc::clone(&over);
        let (slowly, quickly) = (of(), of());
        let mut threads = vec![
            std::thread::spawn(move || trickle(port, slow, fingerprint.is_some(), &slowly)),
            std::thread::spawn(move || come_and_go(port, &quickly)),
        ];
        if let Some(fingerprint) = fingerprint {
            let shaking = of();
            threads.push(std::thread::spawn(move || {
                shake_hands(port, fingerprint, &shaking);
            }));
        }
        Self { over, threads }
    }
}

impl Drop for Flood {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        for thread in self.threads.drain(..) {
            thread.join().unwrap();
        }
    }
}

fn trickle(port: u16, slow: usize, is_tls: bool, over: &AtomicBool) {
    // The first of a handshake is its kind, its version, and a length that is not reached.
    let begin = if is_tls {
        &b"\x16\x03\x01\x40\x00"[..]
    } else {
        b"G"
    };
    let mut streams = Vec::new();
    while !over.load(Ordering::Relaxed) {
        while streams.len() < slow {
            let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
            // One that was shown out comes again.
            if stream.write_all(begin).is_ok() {
                streams.push(stream);
            }
        }
        streams.retain_mut(|stream| stream.write_all(b"G").is_ok());
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn come_and_go(port: u16, over: &AtomicBool) {
    let mut streams = VecDeque::new();
    while !over.load(Ordering::Relaxed) {
        streams.push_back(TcpStream::connect(("127.0.0.1", port)).unwrap());
        if streams.len() > 8 {
            streams.pop_front();
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// One behind the other, as fast as they are answered, each with a request that nobody answers with anything.
fn shake_hands(port: u16, fingerprint: Sha256, over: &AtomicBool) {
    while !over.load(Ordering::Relaxed) {
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        let _refused = tls::with(fingerprint, stream).write_all(b"GET /api/may HTTP/1.1\r\n\r\n");
    }
}
