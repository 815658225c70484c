//! The numbers of threads.

use core::sync::atomic::{AtomicU64, Ordering};

/// Belongs to no thread.
pub(super) const NOBODY: u64 = 0;

/// The number of the calling thread. No two threads of a process ever have the same.
pub(super) fn this_thread() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(NOBODY + 1);
    std::thread_local! {
        static THIS: u64 = NEXT.fetch_add(1, Ordering::Relaxed);
    }
    THIS.with(|number| *number)
}
