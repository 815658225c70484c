//! A group of devices in the image of a cycle: the drives, or all others. Each has datagrams of its own,
//! so that their working counters tell who does not take part.

use crate::frame::{Address, Command, Frame, Slot};

/// What came back of a group.
#[derive(Debug, Clone, Copy)]
pub(super) struct Exchanged<'a> {
    /// The working counter.
    pub(super) counted: u16,
    /// What it is if every device takes part.
    pub(super) expected: u16,
    pub(super) inputs: &'a [u8],
}

/// A group of devices.
#[derive(Debug)]
pub(super) struct Group {
    /// Where its outputs are in the logical address space; its inputs are behind them.
    at: u32,
    /// Bytes of its outputs and of its inputs.
    sizes: (usize, usize),
    /// Devices with outputs, and devices with inputs.
    counts: (u16, u16),
    lacks_lrw: bool,
    /// Outputs and inputs, or outputs alone.
    image: Option<Slot>,
    /// Inputs, where they have a datagram of their own.
    inputs: Option<Slot>,
}

impl Group {
    pub(super) const fn new(
        at: u32,
        sizes: (usize, usize),
        counts: (u16, u16),
        lacks_lrw: bool,
    ) -> Self {
        Self {
            at,
            sizes,
            counts,
            lacks_lrw,
            image: None,
            inputs: None,
        }
    }

    /// Adds its datagrams to a frame. Returns the place of the outputs.
    pub(super) fn push<'f>(&mut self, frame: &'f mut Frame, index: u8) -> Option<&'f mut [u8]> {
        let (out, back) = self.sizes;
        let at = Address::logical(self.at);
        if self.lacks_lrw {
            // What is read lies behind what is written.
            let behind = u32::try_from(out).unwrap_or(u32::MAX);
            let from = Address::logical(self.at.saturating_add(behind));
            let mut push = |command, address, length| {
                (length > 0)
                    .then(|| frame.push(command, index, address, length))
                    .flatten()
            };
            self.image = push(Command::Lwr, at, out);
            self.inputs = push(Command::Lrd, from, back);
        } else {
            self.image = frame.push(Command::Lrw, index, at, out + back);
        }
        let image = self.image.as_ref()?;
        frame.data(image).get_mut(..out)
    }

    /// What came back; `None` if it is the answer to something else.
    pub(super) fn answer<'r>(&self, frame: &Frame, received: &'r [u8]) -> Option<Exchanged<'r>> {
        let (takers, givers) = self.counts;
        let of = |slot: &Option<Slot>| match slot {
            Some(slot) => {
                let answer = frame.answer(slot, received)?;
                Some((answer.counter, answer.data))
            }
            None => Some((0, &[][..])),
        };
        let (counted, image) = of(&self.image)?;
        // Reading counts 1, writing 1, and 2 where both are one datagram.
        if self.lacks_lrw {
            let (read, inputs) = of(&self.inputs)?;
            return Some(Exchanged {
                counted: counted.saturating_add(read),
                expected: takers + givers,
                inputs,
            });
        }
        Some(Exchanged {
            counted,
            expected: 2 * takers + givers,
            inputs: image.get(self.sizes.0..)?,
        })
    }
}
