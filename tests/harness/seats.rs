//! The seats of tests at the processors: two for each core, because tests that run at the speed of the clock leave a core
//! idle for two thirds of their time. Each is a locked file. A browser takes a core, and has seats of its own.

use std::cell::RefCell;
use std::fs::File;
use std::rc::{Rc, Weak};
use std::time::Duration;

/// Between two looks for a free seat.
const POLL: Duration = Duration::from_millis(50);

/// A seat. Where none is free, that of this place in the row is waited for.
pub(crate) fn one(place: u32) -> File {
    let seats: Vec<File> = (0..count()).map(open).collect();
    let free = seats.iter().position(|seat| seat.try_lock().is_ok());
    let nth = free.unwrap_or_else(|| {
        let nth = place as usize % seats.len();
        seats[nth].lock().unwrap();
        nth
    });
    seats.into_iter().nth(nth).unwrap()
}

/// All of them, in the one order in which nobody waits for somebody who waits.
pub(crate) fn all() -> Vec<File> {
    let taken = |nth| {
        let seat = open(nth);
        seat.lock().unwrap();
        seat
    };
    (0..count()).map(taken).collect()
}

/// A seat of a browser. The browsers of a test, which is a thread, share it: two that wait for a second one would wait for
/// ever.
pub(crate) fn of_browser() -> Rc<File> {
    thread_local! {
        static OWN: RefCell<Weak<File>> = const { RefCell::new(Weak::new()) };
    }
    if let Some(own) = OWN.with_borrow(Weak::upgrade) {
        return own;
    }
    let seats: Vec<File> = (0..cores()).map(|nth| file("browser", nth)).collect();
    let seat = loop {
        if let Some(nth) = seats.iter().position(|seat| seat.try_lock().is_ok()) {
            break seats.into_iter().nth(nth).unwrap();
        }
        std::thread::sleep(POLL);
    };
    let seat = Rc::new(seat);
    OWN.set(Rc::downgrade(&seat));
    seat
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn count() -> usize {
    2 * cores()
}

fn open(nth: usize) -> File {
    file("e2e", nth)
}

fn file(kind: &str, nth: usize) -> File {
    // Of this user: that of another could not be opened.
    let user = rustix::process::geteuid().as_raw();
    let path = std::env::temp_dir().join(format!("glidepath-{kind}-{user}.{nth}.lock"));
    File::options()
        .create(true)
        .append(true)
        .open(path)
        .unwrap()
}
