//! An allocator that counts, for tests that prove a thread does not allocate.

use core::cell::Cell;
use std::alloc::{GlobalAlloc, Layout, System};

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // The cell has no destructor, so it is there for the whole life of the thread.
    ALLOCATIONS.with(|n| n.set(n.get() + 1));
}

/// The system's allocator, with a count of the calls each thread makes.
///
/// In a test binary:
///
/// ```
/// #[global_allocator]
/// static ALLOCATOR: glidepath_realtime::CountingAllocator = glidepath_realtime::CountingAllocator;
///
/// let before = glidepath_realtime::CountingAllocator::calls_of_this_thread();
/// let boxed = std::hint::black_box(Box::new(1));
/// assert!(glidepath_realtime::CountingAllocator::calls_of_this_thread() > before);
/// # drop(boxed);
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct CountingAllocator;

impl CountingAllocator {
    /// Allocations, reallocations and releases by the calling thread so far; always 0 unless this
    /// is the program's global allocator.
    #[must_use]
    pub fn calls_of_this_thread() -> u64 {
        ALLOCATIONS.with(Cell::get)
    }
}

// SAFETY: every method passes its arguments on to the system's allocator unchanged.
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps `GlobalAlloc`'s contract, which is the same here.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, ptr: *mut u8, layout: Layout) {
        count();
        // SAFETY: as above; `ptr` came from `System`.
        unsafe { System.dealloc(ptr, layout) }
    }

    unsafe fn realloc(&self, ptr: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        count();
        // SAFETY: as above; `ptr` came from `System`.
        unsafe { System.realloc(ptr, layout, new_size) }
    }
}
