//! How many items may be read and not be taken up by a worker yet.
//!
//! The reader must be far ahead: a part is known to end only where the next one begins, so no
//! second worker has anything to do before all of the first part was read.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Items, about 2.5 MB.
const MOST: usize = 8 * 1024;

/// The books of the items that wait.
#[derive(Debug, Default)]
pub(super) struct Room {
    state: Mutex<State>,
    change: Condvar,
}

#[derive(Debug, Default)]
struct State {
    items: usize,
    is_closed: bool,
}

impl Room {
    fn lock(&self) -> MutexGuard<'_, State> {
        // Nothing is left half done where a thread can panic.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds items, once there is room; false if nobody takes them any more.
    ///
    /// Whoever waits here is not waited for: items that wait are those of parts handed over, and
    /// the first of these is being planned.
    pub(super) fn add(&self, items: usize) -> bool {
        let is_full = |state: &mut State| !state.is_closed && state.items >= MOST;
        let waited = self.change.wait_while(self.lock(), is_full);
        let mut state = waited.unwrap_or_else(PoisonError::into_inner);
        state.items += items;
        !state.is_closed
    }

    /// Items were taken up.
    pub(super) fn take(&self, items: usize) {
        let mut state = self.lock();
        state.items = state.items.saturating_sub(items);
        self.change.notify_all();
    }

    /// Nothing more is taken.
    pub(super) fn close(&self) {
        self.lock().is_closed = true;
        self.change.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    #[test]
    fn the_reader_waits_for_room_and_not_for_ever() {
        let room = Room::default();
        assert!(room.add(MOST), "there is room for all of it");
        let (sender, added) = channel();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                for _ in 0..2 {
                    let _ = sender.send(room.add(MOST));
                }
            });
            assert!(added.try_recv().is_err(), "it waits");
            room.take(1);
            assert_eq!(added.recv(), Ok(true), "there was room for a batch");
            assert!(added.try_recv().is_err(), "it waits again");
            room.close();
            assert_eq!(added.recv(), Ok(false));
        });
    }
}
