//! How much may be planned and not be taken yet.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Frames, or what takes as much memory: 9 minutes of motion at 4 ms, about 40 MB.
const MOST: usize = 128 * 1024;

/// What the part that is being taken may add to that.
const MOST_OF_FIRST: usize = 4 * 1024;

/// The books of what waits.
#[derive(Debug)]
pub(super) struct Allowance {
    state: Mutex<State>,
    change: Condvar,
}

#[derive(Debug, Default)]
struct State {
    /// Number of the part that is being taken.
    first: u64,
    /// What waits of it and of those after it.
    waiting: VecDeque<usize>,
    sum: usize,
    is_closed: bool,
}

impl State {
    /// What waits of a part, if it was not taken.
    fn of(&mut self, part: u64) -> Option<&mut usize> {
        let index = usize::try_from(part.checked_sub(self.first)?).ok()?;
        if self.waiting.len() <= index {
            self.waiting.resize(index + 1, 0);
        }
        self.waiting.get_mut(index)
    }

    fn is_full_for(&mut self, part: u64) -> bool {
        let has_room = part == self.first && self.of(part).is_some_and(|own| *own < MOST_OF_FIRST);
        self.sum >= MOST && !has_room
    }
}

impl Allowance {
    pub(super) fn new() -> Self {
        Self {
            state: Mutex::default(),
            change: Condvar::new(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        // Nothing is left half done where a thread can panic.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds to what waits of a part, once there is room; false if nobody takes it any more.
    pub(super) fn add(&self, part: u64, weight: usize) -> bool {
        let state = self.lock();
        let waited = self
            .change
            .wait_while(state, |state| !state.is_closed && state.is_full_for(part));
        let mut state = waited.unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = state.of(part) {
            *own += weight;
            state.sum += weight;
        }
        !state.is_closed
    }

    /// So much was taken of the first part.
    pub(super) fn take(&self, weight: usize) {
        let mut state = self.lock();
        let first = state.first;
        if let Some(own) = state.of(first) {
            *own = own.saturating_sub(weight);
        }
        state.sum = state.sum.saturating_sub(weight);
        self.change.notify_all();
    }

    /// The first part was taken to its end.
    pub(super) fn go_on(&self) {
        let mut state = self.lock();
        state.waiting.pop_front();
        state.first += 1;
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
    fn parts_ahead_wait_for_room_and_the_first_never_for_theirs() {
        let allowance = Allowance::new();
        assert!(allowance.add(1, MOST), "there is room for all of it");
        assert!(allowance.add(0, MOST_OF_FIRST), "a room of its own");
        let (sender, added) = channel();
        std::thread::scope(|scope| {
            for part in [0, 1] {
                let (sender, allowance) = (sender.clone(), &allowance);
                scope.spawn(move || {
                    assert!(allowance.add(part, 1));
                    let _ = sender.send(part);
                });
            }
            assert!(added.try_recv().is_err(), "both wait");
            allowance.take(1);
            assert_eq!(added.recv(), Ok(0), "its own room is free again");
            assert!(added.try_recv().is_err(), "the other one still waits");
            allowance.take(MOST_OF_FIRST);
            allowance.go_on();
            assert!(added.try_recv().is_err(), "its own room is taken, too");
            allowance.take(1);
            assert_eq!(added.recv(), Ok(1), "now it is the first");
        });
        allowance.close();
        assert!(!allowance.add(9, 1));
    }
}
