//! The handles that a caller holds between calls.
//!
//! Ports count references without locks, so a handle belongs to one thread at a time; every call
//! makes sure of it before anything else is touched. A handle of another kind, or one that was
//! closed and whose memory still is as it was left, is noticed by its mark; memory that was given
//! back for other use cannot be told.

use super::call::{NONE, call};
use super::thread::{NOBODY, this_thread};
use crate::failure::Failure;
use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};

/// What a handle holds.
pub(super) trait Held {
    /// Tells the kinds apart. No two are the same, and none is zero.
    const MARK: u32;
    /// What to call it in a text.
    const NAME: &'static str;
    /// For an argument that is no such handle.
    const NO_HANDLE: &'static str;
    /// Whether another thread may take it once its own has released it.
    const MAY_MOVE: bool = false;
}

/// What is at the address that a caller has. All kinds begin with their mark.
#[repr(C)]
struct Cell<T> {
    mark: AtomicU32,
    /// Whether a call did not come to its end.
    is_broken: AtomicBool,
    /// The thread that it belongs to.
    owner: AtomicU64,
    held: UnsafeCell<T>,
}

/// A handle: null, or one that this library gave out and that was not closed. Only a caller in C
/// has one, and answers for that.
#[repr(transparent)]
pub(super) struct Handle<T>(*mut Cell<T>);

impl<T: Held> Cell<T> {
    /// Makes sure that it belongs to the calling thread, or takes it if it belongs to none.
    fn claim(&self) -> Result<(), Failure> {
        let this = this_thread();
        let owner = self.owner.load(Ordering::Acquire);
        let is_taken = || {
            let order = (Ordering::Acquire, Ordering::Relaxed);
            self.owner
                .compare_exchange(NOBODY, this, order.0, order.1)
                .is_ok()
        };
        if owner == this || (owner == NOBODY && T::MAY_MOVE && is_taken()) {
            return Ok(());
        }
        Err(Failure::Thread(T::NAME))
    }
}

impl<T: Held> Handle<T> {
    /// A handle of the calling thread. It lives until [`Handle::close`].
    pub(super) fn open(held: T) -> Self {
        Self(Box::into_raw(Box::new(Cell {
            mark: AtomicU32::new(T::MARK),
            is_broken: AtomicBool::new(false),
            owner: AtomicU64::new(this_thread()),
            held: UnsafeCell::new(held),
        })))
    }

    /// What is at the address, for its thread.
    fn find(&self) -> Result<&Cell<T>, Failure> {
        if self.0.is_null() || !self.0.is_aligned() {
            return Err(Failure::Argument(T::NO_HANDLE));
        }
        // SAFETY: a handle that is not null is at some `Cell`, as the type says, and each begins
        // with its mark: an atomic number, which any thread may read.
        let mark = unsafe { &*self.0.cast::<AtomicU32>() };
        if mark.load(Ordering::Acquire) != T::MARK {
            return Err(Failure::Argument(T::NO_HANDLE));
        }
        // SAFETY: the mark says that it is a cell of this kind. All of it but what is in the
        // `UnsafeCell` may be shared with other threads.
        let found = unsafe { &*self.0 };
        found.claim()?;
        Ok(found)
    }

    /// Does something with what the handle holds.
    pub(super) fn with(&self, body: impl FnOnce(&mut T) -> Result<i32, Failure>) -> i32 {
        call(|| {
            let found = self.find()?;
            if found.is_broken.swap(true, Ordering::Relaxed) {
                return Err(Failure::Broken(T::NAME));
            }
            // SAFETY: it belongs to this thread, so no other one is here; and this one is not here
            // twice: nothing that a body does calls back, and `is_broken` would say so.
            let held = unsafe { &mut *found.held.get() };
            let result = body(held);
            found.is_broken.store(false, Ordering::Relaxed);
            result
        })
    }

    /// Closes the handle: nothing may be done with it any more, unless this fails because it is no
    /// such handle or belongs to another thread. Null is no handle, and closed.
    pub(super) fn close(self, end: impl FnOnce(T) -> Result<(), Failure>) -> i32 {
        if self.0.is_null() {
            return NONE;
        }
        call(|| {
            self.find()?.mark.store(0, Ordering::Release);
            // SAFETY: it came from a box, belongs to this thread, and nobody finds it any more.
            let cell = unsafe { Box::from_raw(self.0) };
            end(cell.held.into_inner())?;
            Ok(NONE)
        })
    }
}

impl<T: Held + Send> Handle<T> {
    /// Lets another thread take the handle.
    pub(super) fn release(&self) -> i32 {
        call(|| {
            self.find()?.owner.store(NOBODY, Ordering::Release);
            Ok(NONE)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::failure::Code;
    use core::ptr::null_mut;

    struct Counter(u32);

    impl Held for Counter {
        const MARK: u32 = 1;
        const NAME: &'static str = "a counter";
        const NO_HANDLE: &'static str = "no counter";
        const MAY_MOVE: bool = true;
    }

    struct Other;

    impl Held for Other {
        const MARK: u32 = 2;
        const NAME: &'static str = "another";
        const NO_HANDLE: &'static str = "no other";
    }

    // SAFETY: C hands addresses to any thread; what then may be done is what is tested here.
    unsafe impl<T> Send for Handle<T> {}

    impl Handle<Counter> {
        /// The same address once more, as C has it.
        fn again(&self) -> Self {
            Self(self.0)
        }

        fn count(&self) -> i32 {
            self.with(|counter| {
                counter.0 += 1;
                Ok(i32::try_from(counter.0).unwrap_or(i32::MAX))
            })
        }

        fn shut(self) -> i32 {
            self.close(|_| Ok(()))
        }

        fn elsewhere(&self, body: impl FnOnce(Self) -> i32 + Send + 'static) -> i32 {
            let handle = self.again();
            std::thread::spawn(move || body(handle)).join().unwrap_or(0)
        }
    }

    #[test]
    fn a_handle_is_used_by_its_thread_alone() {
        let handle = Handle::open(Counter(0));
        assert_eq!(handle.count(), 1);
        assert_eq!(
            handle.elsewhere(|handle| handle.count()),
            Code::Thread as i32
        );
        assert_eq!(handle.elsewhere(Handle::shut), Code::Thread as i32);
        assert_eq!(
            handle.elsewhere(|handle| handle.release()),
            Code::Thread as i32
        );
        assert_eq!(handle.count(), 2, "still open");
        assert_eq!(handle.shut(), NONE);
        assert_eq!(Handle::<Counter>(null_mut()).shut(), NONE);
    }

    #[test]
    fn a_handle_that_was_released_belongs_to_the_next_that_uses_it() {
        let handle = Handle::open(Counter(0));
        assert_eq!(handle.release(), NONE);
        let counted = handle.elsewhere(|handle| handle.count() + handle.release());
        assert_eq!(counted, 1);
        assert_eq!(handle.count(), 2);
        assert_eq!(
            handle.elsewhere(|handle| handle.count()),
            Code::Thread as i32
        );
        assert_eq!(handle.shut(), NONE);
    }

    #[test]
    fn what_is_no_handle_of_the_kind_is_refused() {
        let none = Handle::<Counter>(null_mut());
        assert_eq!(none.count(), Code::Argument as i32);
        let other = Handle::open(Other);
        let taken_for = Handle::<Counter>(other.0.cast());
        assert_eq!(taken_for.count(), Code::Argument as i32);
        assert_eq!(other.close(|_| Ok(())), NONE);
    }

    #[test]
    #[allow(clippy::panic, reason = "that is what is tested")]
    fn after_a_panic_a_handle_can_only_be_closed() {
        let handle = Handle::open(Counter(0));
        assert_eq!(handle.with(|_| panic!("on purpose")), Code::Panic as i32);
        assert_eq!(handle.count(), Code::Panic as i32);
        assert_eq!(handle.shut(), NONE);
    }
}
