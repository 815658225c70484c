//! The places of a server: who is being answered at a time. Any user of the host, and of the network where devices
//! are served, can open connections, and leave them open: so whoever has not shown a token gives way to whoever comes
//! later, and takes no place from those who have. Each server has places of its own, so that nobody on the network
//! takes one from the host's pages.

use std::collections::VecDeque;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Connections that have not shown the token.
const STRANGERS: usize = 64;
/// How long each of them may stay at least: long enough to have its request read on a busy host. While all are
/// newer, nobody else is let in, and whoever opens connections without end waits as all do.
const STAY: Duration = Duration::from_millis(50);
/// The same on the network, where a handshake goes to and fro in front of the request.
const STAY_ON_NETWORK: Duration = Duration::from_millis(300);
/// Open pages that have shown it.
const PAGES: usize = 24;
/// Other requests that have shown it.
const REQUESTS: usize = 32;

/// The places of a server.
#[derive(Debug)]
pub(crate) struct Places {
    stay: Duration,
    /// The one that came first is in front.
    strangers: Mutex<VecDeque<Stranger>>,
    pages: AtomicUsize,
    requests: AtomicUsize,
}

/// One who has not shown the token, and since when.
#[derive(Debug)]
struct Stranger {
    stream: Arc<TcpStream>,
    since: Instant,
}

/// The place of one who has shown the token, until it is dropped.
#[derive(Debug)]
pub(crate) struct Permit<'a>(&'a AtomicUsize);

impl Drop for Permit<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Places {
    /// Those of a server that this host alone reaches.
    pub(crate) fn on_host() -> Self {
        Self::new(STAY)
    }

    /// Those of a server of the network.
    pub(crate) fn on_network() -> Self {
        Self::new(STAY_ON_NETWORK)
    }

    fn new(stay: Duration) -> Self {
        Self {
            stay,
            strangers: Mutex::default(),
            pages: AtomicUsize::default(),
            requests: AtomicUsize::default(),
        }
    }

    /// Lets in one who has shown nothing yet. Where there is no room, the one that came first has to go,
    /// as soon as it has had its time: until then this waits.
    pub(crate) fn enter(&self, stream: &Arc<TcpStream>) {
        loop {
            let mut strangers = self.strangers();
            let first = strangers.front().filter(|_| strangers.len() >= STRANGERS);
            let left = first.map_or(Duration::ZERO, |first| {
                self.stay.saturating_sub(first.since.elapsed())
            });
            if left.is_zero() {
                if strangers.len() >= STRANGERS {
                    show_out(strangers.pop_front());
                }
                strangers.push_back(Stranger {
                    stream: Arc::clone(stream),
                    since: Instant::now(),
                });
                return;
            }
            drop(strangers);
            std::thread::sleep(left);
        }
    }

    /// It is no stranger any more, or has gone.
    pub(crate) fn leave(&self, stream: &Arc<TcpStream>) {
        self.strangers()
            .retain(|other| !Arc::ptr_eq(&other.stream, stream));
    }

    /// A place for a page that stays; `None` if all are taken.
    pub(crate) fn page(&self) -> Option<Permit<'_>> {
        take(&self.pages, PAGES)
    }

    /// A place for any other request; `None` if all are taken.
    pub(crate) fn request(&self) -> Option<Permit<'_>> {
        take(&self.requests, REQUESTS)
    }

    fn strangers(&self) -> MutexGuard<'_, VecDeque<Stranger>> {
        // The list is whole, whoever panicked.
        self.strangers
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

fn take(taken: &AtomicUsize, most: usize) -> Option<Permit<'_>> {
    // Given back where there was none.
    let place = Permit(taken);
    (taken.fetch_add(1, Ordering::Relaxed) < most).then_some(place)
}

/// Its thread, which waits for it, is told that it has ended.
fn show_out(stranger: Option<Stranger>) {
    // One that has gone by itself need not be shown out.
    let _gone = stranger.map(|stranger| stranger.stream.shutdown(Shutdown::Both));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read as _;
    use std::net::TcpListener;

    #[test]
    fn the_stranger_that_came_first_gives_way_and_nobody_else() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let places = Places::on_host();
        let come = || {
            let guest = TcpStream::connect(address).unwrap();
            let stream = Arc::new(listener.accept().unwrap().0);
            places.enter(&stream);
            (guest, stream)
        };
        let mut guests: Vec<_> = (0..STRANGERS).map(|_| come()).collect();
        // The second has shown the token.
        places.leave(&guests[1].1);
        guests.extend((0..3).map(|_| come()));
        let is_out = |nth: usize| {
            let (guest, _) = &guests[nth];
            guest.set_nonblocking(true).unwrap();
            let mut guest = guest;
            guest.read(&mut [0]).is_ok_and(|length| length == 0)
        };
        let out: Vec<usize> = (0..guests.len()).filter(|nth| is_out(*nth)).collect();
        assert_eq!(out, [0, 2]);
    }

    #[test]
    fn places_are_given_back() {
        let places = Places::on_host();
        let pages: Vec<_> = (0..PAGES).map(|_| places.page().unwrap()).collect();
        assert!(places.page().is_none() && places.page().is_none());
        assert!(places.request().is_some());
        drop(pages);
        assert!(places.page().is_some());
    }
}
