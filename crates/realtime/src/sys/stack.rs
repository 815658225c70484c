//! The prefault of the stack: it is touched before it is needed.

use core::mem::MaybeUninit;

/// Stack that is made resident. A real-time thread must not go deeper.
pub(crate) const PREFAULTED_BYTES: usize = 256 * 1024;
const PAGE_BYTES: usize = 4096;

/// Touches every page of the next [`PREFAULTED_BYTES`] of the stack, so that no later use of it is
/// a page fault.
#[inline(never)]
#[allow(
    clippy::large_stack_arrays,
    reason = "a large array on the stack is the purpose"
)]
pub(crate) fn prefault() {
    let mut stack = [MaybeUninit::<u8>::uninit(); PREFAULTED_BYTES];
    for byte in stack.iter_mut().step_by(PAGE_BYTES) {
        // SAFETY: `byte` is a valid place in a local array; the write is volatile so that it is
        // made although nobody reads it.
        unsafe { core::ptr::write_volatile(byte, MaybeUninit::new(0)) };
    }
}
