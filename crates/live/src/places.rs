//! The places of a server: who is being answered at a time. Any user of the host, and of the network where devices
//! are served, can open connections, and leave them open: so whoever has not shown a token gives way to whoever comes
//! later, and takes no place from those who have. Each server has places of its own, so that nobody on the network
//! takes one from the host's pages; and a paired device has no more than its share of them, so that no device takes
//! those of the others.

use std::collections::VecDeque;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::sha256::Sha256;

/// Connections that have not shown the token.
const STRANGERS: usize = 64;
/// How long each of them may stay at least: long enough to have its request read on a busy host. While all are
/// newer, nobody else is let in, and whoever opens connections without end waits as all do.
const STAY: Duration = Duration::from_millis(50);
/// The same on the network, where a handshake goes to and fro in front of the request.
const STAY_ON_NETWORK: Duration = Duration::from_millis(300);
/// Open pages that have shown it, and those of one device: a browser opens six connections to a server at most, and
/// needs some for commands.
const PAGES: Room = Room { all: 24, device: 4 };
/// Other requests that have shown it.
const REQUESTS: Room = Room { all: 32, device: 8 };

/// How many places there are.
#[derive(Debug, Clone, Copy)]
struct Room {
    all: usize,
    /// Of these, the most that one paired device may have.
    device: usize,
}

/// Who has a place now: the device, `None` for pages of this host.
type Taken = Mutex<Vec<Option<Sha256>>>;

/// The places of a server.
#[derive(Debug)]
pub(crate) struct Places {
    stay: Duration,
    /// The one that came first is in front.
    strangers: Mutex<VecDeque<Stranger>>,
    pages: Taken,
    requests: Taken,
}

/// One who has not shown the token, and since when.
#[derive(Debug)]
struct Stranger {
    stream: Arc<TcpStream>,
    since: Instant,
}

/// The place of one who has shown the token, until it is dropped.
#[derive(Debug)]
pub(crate) struct Permit<'a> {
    taken: &'a Taken,
    device: Option<Sha256>,
}

impl Drop for Permit<'_> {
    fn drop(&mut self) {
        let mut taken = lock(self.taken);
        if let Some(index) = taken.iter().position(|other| *other == self.device) {
            taken.swap_remove(index);
        }
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
            pages: Taken::default(),
            requests: Taken::default(),
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

    /// A place for a page that stays, of a device or of this host; `None` if all are taken, or all that the device may
    /// have.
    pub(crate) fn page(&self, device: Option<Sha256>) -> Option<Permit<'_>> {
        take(&self.pages, PAGES, device)
    }

    /// The same for any other request.
    pub(crate) fn request(&self, device: Option<Sha256>) -> Option<Permit<'_>> {
        take(&self.requests, REQUESTS, device)
    }

    fn strangers(&self) -> MutexGuard<'_, VecDeque<Stranger>> {
        lock(&self.strangers)
    }
}

fn lock<T>(list: &Mutex<T>) -> MutexGuard<'_, T> {
    // The list is whole, whoever panicked.
    list.lock().unwrap_or_else(PoisonError::into_inner)
}

fn take(taken: &Taken, room: Room, device: Option<Sha256>) -> Option<Permit<'_>> {
    let mut list = lock(taken);
    let of_device = list.iter().filter(|other| **other == device).count();
    let is_full = list.len() >= room.all || (device.is_some() && of_device >= room.device);
    if is_full {
        return None;
    }
    list.push(device);
    Some(Permit { taken, device })
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
        let pages: Vec<_> = (0..PAGES.all).map(|_| places.page(None).unwrap()).collect();
        assert!(places.page(None).is_none() && places.page(None).is_none());
        assert!(places.request(None).is_some());
        drop(pages);
        assert!(places.page(None).is_some());
    }

    #[test]
    fn a_device_leaves_places_for_others() {
        let places = Places::on_network();
        let [one, other] = [b"one", b"two"].map(|token| Some(Sha256::of(token)));
        let mut of_one: Vec<_> = (0..PAGES.device)
            .map(|_| places.page(one).unwrap())
            .collect();
        assert!(places.page(one).is_none());
        let _of_other = places.page(other).unwrap();
        of_one.pop();
        assert!(places.page(one).is_some());
        let _requests: Vec<_> = (0..REQUESTS.device)
            .map(|_| places.request(one).unwrap())
            .collect();
        assert!(places.request(one).is_none());
        assert!(places.request(other).is_some());
    }
}
