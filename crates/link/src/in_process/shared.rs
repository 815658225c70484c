//! The queue that the ports of a service share, behind a lock.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What the ports of a service share.
#[derive(Debug)]
pub(super) struct Shared<T>(Arc<Mutex<T>>);

impl<T> Shared<T> {
    pub(super) fn new(inner: T) -> Self {
        Self(Arc::new(Mutex::new(inner)))
    }

    /// The queues hold plain data and every change is complete before anything can panic, so a
    /// thread that panicked elsewhere has not broken them.
    pub(super) fn lock(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}
