//! The wire: what a master needs of an Ethernet port, and of time.

mod line_lock;
mod packet;
mod sys;

pub use packet::{PacketWire, WireError};

use std::io;

/// Longest Ethernet frame without its checksum, bytes.
pub const MAX_FRAME: usize = 1514;

/// An Ethernet port, with the clock that its times are told by. One thread uses it.
///
/// Behind it is a raw socket, or in tests a segment in memory whose time is none but its own.
pub trait Wire {
    /// Now, ns of `CLOCK_MONOTONIC`.
    fn now_ns(&self) -> u64;

    /// Returns when it is that late.
    fn sleep_until(&mut self, deadline_ns: u64);

    /// Sends a frame.
    ///
    /// # Errors
    ///
    /// The port does not take it.
    fn send(&mut self, frame: &[u8]) -> io::Result<()>;

    /// The next frame that came back, and its length; `None` if there is none until `until_ns`.
    ///
    /// # Errors
    ///
    /// The port is gone.
    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>>;
}
