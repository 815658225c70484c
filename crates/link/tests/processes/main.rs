//! The transport between processes, with real processes that are killed.
//!
//! The other processes are this test's own binary, started again to run [`peer::child`] alone.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that cannot go on fails"
)]
#![allow(clippy::print_stdout, reason = "a child tells its parent what it does")]

mod instance;
mod intruder;
mod isolation;
mod kill;
mod peer;
