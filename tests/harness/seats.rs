//! The seats of tests at the processors: two for each core, because tests that run at the speed of the clock leave a core
//! idle for two thirds of their time. Each is a locked file.

use std::fs::File;

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

fn count() -> usize {
    2 * std::thread::available_parallelism().map_or(1, usize::from)
}

fn open(nth: usize) -> File {
    // Of this user: that of another could not be opened.
    let user = rustix::process::geteuid().as_raw();
    let path = std::env::temp_dir().join(format!("glidepath-e2e-{user}.{nth}.lock"));
    File::options()
        .create(true)
        .append(true)
        .open(path)
        .unwrap()
}
