//! The flood: another user of the host, who has no token and all the time in the world.

use std::collections::VecDeque;
use std::io::Write as _;
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// Connections that give a byte now and then, and never the end of a request; and others that come and go.
/// They last as long as this.
pub(crate) struct Flood {
    over: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
}

impl Flood {
    pub(crate) fn begin(port: u16, slow: usize) -> Self {
        let over = Arc::<AtomicBool>::default();
        let begin = |go: fn(u16, usize, &AtomicBool)| {
            let over = Arc::clone(&over);
            std::thread::spawn(move || go(port, slow, &over))
        };
        let threads = vec![begin(trickle), begin(come_and_go)];
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

fn trickle(port: u16, slow: usize, over: &AtomicBool) {
    let mut streams = Vec::new();
    while !over.load(Ordering::Relaxed) {
        while streams.len() < slow {
            streams.push(TcpStream::connect(("127.0.0.1", port)).unwrap());
        }
        // One that was shown out comes again.
        streams.retain_mut(|stream| stream.write_all(b"G").is_ok());
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn come_and_go(port: u16, _slow: usize, over: &AtomicBool) {
    let mut streams = VecDeque::new();
    while !over.load(Ordering::Relaxed) {
        streams.push_back(TcpStream::connect(("127.0.0.1", port)).unwrap());
        if streams.len() > 8 {
            streams.pop_front();
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}
