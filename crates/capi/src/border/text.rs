//! The functions for versions, the clock, and the text of the last failure.

use super::pointer::Room;
use crate::failure::with_last_error;
use crate::layout;
use core::ffi::{CStr, c_char};
use std::ffi::CString;
use std::sync::OnceLock;

#[unsafe(no_mangle)]
extern "C" fn gp_abi_version() -> u32 {
    layout::ABI
}

#[unsafe(no_mangle)]
extern "C" fn gp_layout() -> u64 {
    layout::LAYOUT
}

#[unsafe(no_mangle)]
extern "C" fn gp_version() -> *const c_char {
    static VERSION: OnceLock<CString> = OnceLock::new();
    let version =
        VERSION.get_or_init(|| CString::new(env!("CARGO_PKG_VERSION")).unwrap_or_default());
    CStr::as_ptr(version)
}

#[unsafe(no_mangle)]
pub(super) extern "C" fn gp_now_ns() -> u64 {
    let mut now = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: the place for the time is this function's own. That clock is always there, so there is
    // nothing to fail.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC, &raw mut now) };
    // The clock began when the host did: it is not negative, and fits for five centuries.
    let (seconds, nanoseconds) = (now.tv_sec.unsigned_abs(), now.tv_nsec.unsigned_abs());
    seconds * 1_000_000_000 + nanoseconds
}

#[unsafe(no_mangle)]
extern "C" fn gp_last_error(text: Room<c_char>, size: usize) -> usize {
    with_last_error(|last| {
        text.put_text(last, size);
        last.len()
    })
}
