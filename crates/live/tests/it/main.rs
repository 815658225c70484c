//! The server as a browser, a foreign page and another user of the host meet it: plain bytes over a
//! socket.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    missing_docs,
    reason = "a test that fails may panic"
)]

mod devices;
mod flood;
mod page;
mod patience;
mod refusals;
mod requests;
mod tls;
mod typed;
