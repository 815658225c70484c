//! A wire in memory: time passes by waiting alone.

use glidepath_emulator::Segment;
use glidepath_ethercat::Wire;
use glidepath_realtime::CountingAllocator;
use std::collections::VecDeque;
use std::io;

/// From the port to the first drive, and back, ns.
pub(crate) const WAY_NS: u64 = 30_000;

/// What becomes of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fate {
    /// It comes back.
    Whole,
    /// It does not reach the drives.
    LostOnTheWay,
    /// It reaches the drives, and does not come back.
    LostOnTheWayBack,
    /// It comes back so much later, ns, maybe after others.
    Late(u64),
    /// The working counter of its process data is one too low.
    Short,
}

/// What happens beside the wire while time passes.
pub(crate) trait World {
    /// Called with every time that something is due; returns when the next thing is.
    fn pass(&mut self, now_ns: u64, segment: &mut Segment) -> u64;

    /// What becomes of a frame that is sent now.
    fn fate(&mut self, now_ns: u64) -> Fate;

    /// Whether allocations of the master are counted now.
    fn counts(&self) -> bool {
        false
    }
}

/// Nothing happens, and no frame is lost.
#[derive(Debug)]
pub(crate) struct Quiet;

impl World for Quiet {
    fn pass(&mut self, _: u64, _: &mut Segment) -> u64 {
        u64::MAX
    }

    fn fate(&mut self, _: u64) -> Fate {
        Fate::Whole
    }
}

#[derive(Debug)]
pub(crate) struct MemoryWire<W> {
    pub(crate) segment: Segment,
    pub(crate) world: W,
    now_ns: u64,
    due_ns: u64,
    /// Frames on their way back, by when they arrive.
    back: VecDeque<(u64, Vec<u8>)>,
    /// Allocations of this thread when the master was given back control last.
    allocations: u64,
    /// Those of the master between two calls, while they were counted.
    pub(crate) counted: u64,
    counts: bool,
}

impl<W: World> MemoryWire<W> {
    pub(crate) fn new(segment: Segment, world: W, now_ns: u64) -> Self {
        Self {
            segment,
            world,
            now_ns,
            due_ns: now_ns,
            back: VecDeque::new(),
            allocations: 0,
            counted: 0,
            counts: false,
        }
    }

    fn enter(&mut self) {
        let calls = CountingAllocator::calls_of_this_thread() - self.allocations;
        if self.counts {
            self.counted += calls;
        }
    }

    fn leave(&mut self) {
        self.counts = self.world.counts();
        self.allocations = CountingAllocator::calls_of_this_thread();
    }

    fn advance(&mut self, until_ns: u64) {
        while self.due_ns <= until_ns {
            self.now_ns = self.now_ns.max(self.due_ns);
            self.segment.advance(self.now_ns);
            self.due_ns = self.world.pass(self.now_ns, &mut self.segment);
        }
        self.now_ns = self.now_ns.max(until_ns);
    }
}

impl<W: World> Wire for MemoryWire<W> {
    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        self.enter();
        self.advance(deadline_ns);
        self.leave();
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        self.enter();
        let mut frame = frame.to_vec();
        let fate = self.world.fate(self.now_ns);
        if fate != Fate::LostOnTheWay {
            self.segment.pass(&mut frame, self.now_ns + WAY_NS);
            if fate == Fate::Short {
                spoil(&mut frame);
            }
            let late_ns = if let Fate::Late(late_ns) = fate {
                late_ns
            } else {
                0
            };
            if fate != Fate::LostOnTheWayBack {
                self.back
                    .push_back((self.now_ns + 2 * WAY_NS + late_ns, frame));
            }
        }
        self.leave();
        Ok(())
    }

    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>> {
        self.enter();
        let first = self.back.iter().enumerate().min_by_key(|(_, (at, _))| *at);
        let first = first.map(|(nth, (at, _))| (nth, *at));
        let received = match first.filter(|(_, at)| *at <= until_ns) {
            Some((nth, at_ns)) => {
                self.advance(at_ns);
                let (_, frame) = self.back.remove(nth).unwrap();
                into[..frame.len()].copy_from_slice(&frame);
                Some(frame.len())
            }
            None => {
                self.advance(until_ns);
                None
            }
        };
        self.leave();
        Ok(received)
    }
}

/// Takes one from the working counter of the first LRW.
fn spoil(frame: &mut [u8]) {
    let mut at = 16;
    while at + 10 < frame.len() {
        let length = usize::from(u16::from_le_bytes([frame[at + 6], frame[at + 7]]));
        let counter = at + 10 + (length & 0x7ff);
        if frame[at] == 12 {
            frame[counter] = frame[counter].wrapping_sub(1);
            return;
        }
        if length & 0x8000 == 0 {
            return;
        }
        at = counter + 2;
    }
}
