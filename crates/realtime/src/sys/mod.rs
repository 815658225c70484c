//! All `unsafe` code of the crate: calls the safe wrappers of rustix do not cover.
#![allow(
    unsafe_code,
    reason = "raw Linux calls; every block says why it is sound"
)]

pub(crate) mod alloc;
pub(crate) mod sched;
pub(crate) mod seccomp;
pub(crate) mod stack;
