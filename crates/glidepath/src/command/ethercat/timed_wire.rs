//! The wire between the master and emulated drives, with the moment at which a frame was sent.

use core::sync::atomic::{AtomicU64, Ordering};
use glidepath_ethercat::{PacketWire, Wire};
use std::io;

/// The master's end. On a real line a frame passes the devices within microseconds. The thread that emulates them may be
/// woken milliseconds later, so they are told when the frame was sent, and are as they would have been then.
pub(super) struct TimedWire<'s> {
    wire: PacketWire,
    sent_ns: &'s AtomicU64,
}

impl<'s> TimedWire<'s> {
    /// The moment of the last frame comes to stand in `sent_ns`, before it is sent.
    pub(super) const fn new(wire: PacketWire, sent_ns: &'s AtomicU64) -> Self {
        Self { wire, sent_ns }
    }
}

impl Wire for TimedWire<'_> {
    fn now_ns(&self) -> u64 {
        self.wire.now_ns()
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        self.wire.sleep_until(deadline_ns);
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        self.sent_ns.store(self.now_ns(), Ordering::Release);
        self.wire.send(frame)
    }

    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>> {
        self.wire.receive(into, until_ns)
    }
}
