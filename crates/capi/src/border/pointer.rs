//! Arguments that are pointers, as types that have no other origin: only a caller in C makes one,
//! and answers for what its type says. So nothing but this file needs `unsafe` for them.

use crate::failure::Failure;
use bytemuck::AnyBitPattern;
use core::ffi::{CStr, c_char};
use core::mem::MaybeUninit;
use core::slice;

/// Where a value is to go: null, or room for a `T` that nobody else uses while the function runs.
#[repr(transparent)]
pub(super) struct Room<T>(*mut T);

impl<T> Room<T> {
    pub(super) const fn is_null(&self) -> bool {
        self.0.is_null()
    }

    /// Makes sure that a value can be given, before anything is done for it.
    ///
    /// # Errors
    ///
    /// `what`, if the pointer is null or not aligned.
    pub(super) fn check(&self, what: &'static str) -> Result<(), Failure> {
        if self.0.is_null() || !self.0.is_aligned() {
            return Err(Failure::Argument(what));
        }
        Ok(())
    }

    /// Gives the caller a value.
    ///
    /// # Errors
    ///
    /// As [`Room::check`].
    pub(super) fn put(&self, value: T, what: &'static str) -> Result<(), Failure> {
        self.check(what)?;
        // SAFETY: it is neither null nor unaligned, so it is room for a `T`, as the type says. What
        // is there is not dropped: it is the caller's memory, and may be no `T`.
        unsafe { self.0.write(value) };
        Ok(())
    }
}

impl Room<c_char> {
    /// Puts down a text and a zero, cut to the bytes that there are.
    ///
    /// `size` is what the caller says of the room: it is that of so many bytes. Who knows that there is room enough
    /// may say more than an object can have, and no more of it is looked at than the text takes.
    pub(super) fn put_text(&self, text: &[u8], size: usize) {
        let taken = size.min(text.len().saturating_add(1));
        let Some(longest) = taken.checked_sub(1).filter(|_| !self.is_null()) else {
            return;
        };
        // SAFETY: it is not null, and room for `size` bytes, which are at least `taken`, and need not have been
        // written to. `taken` is no more than a text that is there is long, and one.
        let room = unsafe { slice::from_raw_parts_mut(self.0.cast::<MaybeUninit<u8>>(), taken) };
        for (to, byte) in room.iter_mut().zip(text.iter().take(longest).chain(&[0])) {
            to.write(*byte);
        }
    }
}

/// A value that the caller has written: null, or a `T` that nobody writes to while the function
/// runs.
#[repr(transparent)]
pub(super) struct Given<T>(*const T);

impl<T: AnyBitPattern> Given<T> {
    /// The value.
    ///
    /// # Errors
    ///
    /// `what`, if the pointer is null or not aligned.
    pub(super) fn get(&self, what: &'static str) -> Result<T, Failure> {
        if self.0.is_null() || !self.0.is_aligned() {
            return Err(Failure::Argument(what));
        }
        // SAFETY: it is neither null nor unaligned, so it is at as many bytes as a `T` has, as the
        // type says; any bytes are a `T`.
        Ok(unsafe { self.0.read() })
    }
}

/// A text that the caller has written: null, or ended with a zero; nobody writes to it while the
/// function runs.
#[repr(transparent)]
pub(super) struct GivenText(*const c_char);

impl GivenText {
    /// The text.
    ///
    /// # Errors
    ///
    /// `what`, if the pointer is null, or the text is not UTF-8.
    pub(super) fn get(&self, what: &'static str) -> Result<&str, Failure> {
        if self.0.is_null() {
            return Err(Failure::Argument(what));
        }
        // SAFETY: it is not null, so it is at a text, as the type says; that stays as it is for as
        // long as this argument is there.
        let text = unsafe { CStr::from_ptr(self.0) };
        text.to_str().map_err(|_| Failure::Argument(what))
    }
}

/// Makes sure that the caller's structure has the size of ours.
pub(super) const fn check_size<T>(structure: &'static str, caller: usize) -> Result<(), Failure> {
    let here = size_of::<T>();
    if caller == here {
        return Ok(());
    }
    Err(Failure::Size {
        structure,
        caller,
        here,
    })
}

#[cfg(test)]
impl Room<c_char> {
    /// NULL.
    pub(super) const fn nowhere() -> Self {
        Self(core::ptr::null_mut())
    }

    /// Room for as many bytes as there are.
    pub(super) const fn at(bytes: &mut [u8]) -> Self {
        Self(bytes.as_mut_ptr().cast())
    }
}

#[cfg(test)]
impl<T> Given<T> {
    /// Where a value is.
    pub(super) const fn of(value: &T) -> Self {
        Self(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is in eight bytes after a text was put there, with what is said of their size.
    fn put(text: &[u8], size: usize) -> [u8; 8] {
        let mut room = [b'-'; 8];
        Room(room.as_mut_ptr().cast::<c_char>()).put_text(text, size);
        room
    }

    #[test]
    fn a_text_is_cut_to_the_room_and_ended() {
        assert_eq!(&put(b"text", 8), b"text\0---");
        assert_eq!(&put(b"text", 5), b"text\0---");
        assert_eq!(&put(b"text", 3), b"te\0-----");
        assert_eq!(&put(b"text", 1), b"\0-------");
        assert_eq!(&put(b"text", 0), b"--------");
        assert_eq!(&put(b"", 8), b"\0-------");
        Room(core::ptr::null_mut::<c_char>()).put_text(b"text", 8);
    }

    #[test]
    fn more_room_than_there_can_be_is_no_more_than_the_text_takes() {
        for size in [isize::MAX as usize, isize::MAX as usize + 1, usize::MAX] {
            assert_eq!(&put(b"text", size), b"text\0---");
        }
    }
}
