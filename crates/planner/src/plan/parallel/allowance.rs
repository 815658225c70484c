//! The allowance: a bound on what may wait between two threads that hand over the parts of a
//! program.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// The books of what waits.
#[derive(Debug)]
pub(super) struct Allowance {
    /// What may wait of all parts together, and what the part that is being taken may add to that.
    most: usize,
    most_of_first: usize,
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
}

impl Allowance {
    pub(super) fn new(most: usize, most_of_first: usize) -> Self {
        Self {
            most,
            most_of_first,
            state: Mutex::default(),
            change: Condvar::new(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        // Nothing is left half done where a thread can panic.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn is_full_for(&self, part: u64, state: &mut State) -> bool {
        let has_room =
            part == state.first && state.of(part).is_some_and(|own| *own < self.most_of_first);
        state.sum >= self.most && !has_room
    }

    /// Adds to what waits of a part, once there is room; false if nobody takes it any more.
    pub(super) fn add(&self, part: u64, weight: usize) -> bool {
        let state = self.lock();
        let waited = self.change.wait_while(state, |state| {
            !state.is_closed && self.is_full_for(part, state)
        });
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

    const MOST: usize = 1000;
    const MOST_OF_FIRST: usize = 10;

    #[test]
    fn parts_ahead_wait_for_room_and_the_first_never_for_theirs() {
        let allowance = Allowance::new(MOST, MOST_OF_FIRST);
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

    #[test]
    fn whoever_waits_for_room_is_woken_when_nobody_takes_any_more() {
        let allowance = Allowance::new(MOST, 0);
        assert!(allowance.add(0, MOST), "there is room for all of it");
        let (sender, added) = channel();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                for _ in 0..2 {
                    let _ = sender.send(allowance.add(0, MOST));
                }
            });
            assert!(added.try_recv().is_err(), "it waits");
            allowance.take(1);
            assert_eq!(added.recv(), Ok(true), "there was room for a batch");
            assert!(added.try_recv().is_err(), "it waits again");
            allowance.close();
            assert_eq!(added.recv(), Ok(false));
        });
    }
}
