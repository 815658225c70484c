//! The bus in OP: one frame a cycle.
//!
//! ```text
//! FRMW 0x0910 │ LRW: outputs and inputs of all │ FPRD 0x0130 of each │ FPRD of one mailbox
//! ```
//!
//! A drive that does not know LRW gets LWR and LRD in its place, and then all do.
//!
//! The time of the reference goes to all clocks, process data is exchanged, and every drive says in
//! what state it is and why. The last datagram looks whether a mailbox is full, of one drive after the
//! other, and if one is, takes the message out: emergencies come that way.

use super::bus_time::BusTime;
use super::state::{ERROR, INIT};
use crate::bus_clock::{BusClock, FrameTimes};
use crate::coe::emergency;
use crate::error::BusError;
use crate::exchange::{Exchange, station};
use crate::frame::{Address, Command, Frame, Slot};
use crate::image::{Inputs, Outputs};
use crate::layout::Led;
use crate::registers::{AL_CONTROL, AL_STATUS, MAILBOX_IN_STATUS, SYSTEM_TIME};
use crate::wire::{MAX_FRAME, Wire};
use std::io;

/// The state of a device, as it says itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DeviceState {
    /// 8 for OP.
    pub state: u8,
    /// It did not get or keep what it was asked for.
    pub has_error: bool,
    /// AL status code.
    pub code: u16,
}

/// The state that a device has to have for its outputs to count.
pub(crate) struct StateCode;

impl StateCode {
    pub(crate) const OP: u8 = super::state::OP;
}

/// The outcome of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reception {
    /// It came back, and every drive took part.
    Good(FrameTimes),
    /// It came back, and not every drive took part: the working counter is too low.
    Short {
        /// What was counted.
        counted: u16,
        /// What should have been.
        expected: u16,
    },
    /// It did not come back in time.
    Lost,
}

/// What the last datagram of a frame is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Aside {
    /// Whether the mailbox of this drive is full.
    Look(usize),
    /// The message in it.
    Take(usize),
}

/// A bus in operation.
#[derive(Debug)]
pub struct Op<'w, W> {
    wire: &'w mut W,
    frame: Frame,
    received: Vec<u8>,
    index: u8,
    time: Option<Slot>,
    /// Outputs and inputs, or outputs alone.
    image: Option<Slot>,
    /// Inputs, where they have a datagram of their own.
    inputs: Option<Slot>,
    lacks_lrw: bool,
    status: Vec<Slot>,
    aside: Option<(Slot, Aside)>,
    next_aside: Aside,
    reference: u16,
    bus_time: BusTime,
    stations: Vec<u16>,
    /// Mailboxes from the drives: where, and how long.
    mailboxes: Vec<(u16, u16)>,
    states: Vec<DeviceState>,
    drives: Vec<Led>,
    /// Bytes of the outputs and of the inputs of all.
    sizes: (usize, usize),
    sent_ns: u64,
    /// Frames that came back when they were not waited for any more.
    stale: u64,
    emergency: Option<(usize, u16)>,
    clock: Option<BusClock>,
}

impl<'w, W: Wire> Op<'w, W> {
    pub(super) fn new(
        wire: &'w mut W,
        drives: Vec<Led>,
        (reference, bus_time): (usize, BusTime),
    ) -> Self {
        let mailbox = |led: &Led| {
            led.device
                .mailbox
                .map_or((0, 0), |(_, m)| (m.start, m.length))
        };
        Self {
            wire,
            frame: Frame::default(),
            received: vec![0; MAX_FRAME],
            index: 0,
            time: None,
            image: None,
            inputs: None,
            lacks_lrw: drives.iter().any(|led| led.device.lacks_lrw),
            status: Vec::with_capacity(drives.len()),
            aside: None,
            next_aside: Aside::Look(0),
            reference: station(reference),
            bus_time,
            stations: drives
                .iter()
                .map(|led| station(led.device.position))
                .collect(),
            mailboxes: drives.iter().map(mailbox).collect(),
            states: vec![DeviceState::default(); drives.len()],
            sizes: Led::sizes(&drives),
            drives,
            sent_ns: 0,
            stale: 0,
            emergency: None,
            clock: None,
        }
    }

    pub(super) fn take_over(&mut self, clock: BusClock) {
        self.clock = Some(clock);
    }

    /// The clock of the bus, as it was found on the way here; `None` the second time.
    pub const fn take_clock(&mut self) -> Option<BusClock> {
        self.clock.take()
    }

    /// The wire.
    pub const fn wire(&mut self) -> &mut W {
        self.wire
    }

    /// In what states the drives were when they answered last.
    #[must_use]
    pub fn states(&self) -> &[DeviceState] {
        &self.states
    }

    /// Frames that came back when they were not waited for any more.
    #[must_use]
    pub const fn stale(&self) -> u64 {
        self.stale
    }

    /// The emergency that came last, and from which drive; `None` if that was told.
    pub const fn take_emergency(&mut self) -> Option<(usize, u16)> {
        self.emergency.take()
    }

    /// The number of the datagrams of the frame that was sent last.
    #[must_use]
    pub const fn index(&self) -> u8 {
        self.index
    }

    /// Brings all devices to INIT, which stops SYNC0 and takes all power. Whoever does not hear it has
    /// a watchdog.
    ///
    /// # Errors
    ///
    /// The port is gone.
    pub fn leave(self) -> Result<(), BusError> {
        let mut bus = Exchange::new(self.wire);
        let mut init = [INIT | ERROR, 0];
        bus.ask(Command::Bwr, Address::all(AL_CONTROL), &mut init, 3)?;
        Ok(())
    }

    /// Sends the frame of a cycle.
    ///
    /// # Errors
    ///
    /// The port does not take it.
    pub fn send(&mut self, outputs: &[Outputs]) -> io::Result<()> {
        self.index = self.index.wrapping_add(1);
        let (frame, index) = (&mut self.frame, self.index);
        frame.clear();
        let reference = Address::station(self.reference, SYSTEM_TIME);
        self.time = frame.push(Command::Frmw, index, reference, 8);
        let (out, back) = self.sizes;
        if self.lacks_lrw {
            // What is read lies behind what is written.
            let from = Address::logical(u32::try_from(out).unwrap_or(u32::MAX));
            self.image = frame.push(Command::Lwr, index, Address::logical(0), out);
            self.inputs = frame.push(Command::Lrd, index, from, back);
        } else {
            self.image = frame.push(Command::Lrw, index, Address::logical(0), out + back);
        }
        if let Some(image) = &self.image {
            let data = frame.data(image);
            for (led, output) in self.drives.iter().zip(outputs) {
                let length = led.layout.rest.len();
                if let Some(place) = data.get_mut(led.outputs_at..led.outputs_at + length) {
                    output.put(&led.layout, place);
                }
            }
        }
        self.status.clear();
        for station in &self.stations {
            let address = Address::station(*station, AL_STATUS);
            self.status
                .extend(frame.push(Command::Fprd, index, address, 6));
        }
        let (nth, register, length) = match self.next_aside {
            Aside::Look(nth) => (nth, MAILBOX_IN_STATUS, 1),
            Aside::Take(nth) => {
                let (start, length) = self.mailboxes.get(nth).copied().unwrap_or_default();
                (nth, start, length.into())
            }
        };
        let station = self.stations.get(nth).copied().unwrap_or_default();
        let slot = frame.push(
            Command::Fprd,
            index,
            Address::station(station, register),
            length,
        );
        self.aside = slot.map(|slot| (slot, self.next_aside));
        self.sent_ns = self.wire.now_ns();
        self.wire.send(self.frame.bytes())
    }

    /// Waits for the frame that was sent last. Others are counted and passed over.
    ///
    /// # Errors
    ///
    /// The port is gone.
    pub fn receive(&mut self, until_ns: u64, inputs: &mut [Inputs]) -> io::Result<Reception> {
        while let Some(length) = self.wire.receive(&mut self.received, until_ns)? {
            let received_ns = self.wire.now_ns();
            let Some(reception) = self.read(length, received_ns, inputs) else {
                self.stale += 1;
                continue;
            };
            return Ok(reception);
        }
        Ok(Reception::Lost)
    }

    fn read(
        &mut self,
        length: usize,
        received_ns: u64,
        inputs: &mut [Inputs],
    ) -> Option<Reception> {
        let received = self.received.get(..length)?;
        let time = self.frame.answer(self.time.as_ref()?, received)?;
        let image = self.frame.answer(self.image.as_ref()?, received)?;
        let count = self.stations.len();
        // Reading counts 1, writing 1, and 2 where both are one datagram.
        let (counted, each, back) = if let Some(slot) = &self.inputs {
            let inputs = self.frame.answer(slot, received)?;
            (image.counter + inputs.counter, 2, inputs.data)
        } else {
            let (_, back) = image.data.split_at(self.sizes.0);
            (image.counter, 3, back)
        };
        self.bus_time.hear(*time.data.first_chunk()?);
        for (slot, state) in self.status.iter().zip(&mut self.states) {
            let answer = self.frame.answer(slot, received);
            *state = match answer.map(|answer| (answer.counter, answer.data)) {
                Some((1.., &[status, _, _, _, low, high])) => DeviceState {
                    state: status & 15,
                    has_error: status & ERROR != 0,
                    code: u16::from_le_bytes([low, high]),
                },
                // It does not answer.
                _ => DeviceState::default(),
            };
        }
        self.next_aside = next_aside(self.aside.as_ref(), self.stations.len(), |slot, aside| {
            let answer = self.frame.answer(slot, received)?;
            let full = answer.counter == 1 && answer.data.first().is_some_and(|s| s & 8 != 0);
            if let (Aside::Take(nth), 1) = (aside, answer.counter) {
                self.emergency = emergency(answer.data)
                    .map(|code| (nth, code))
                    .or(self.emergency);
            }
            Some(full)
        });
        #[allow(clippy::cast_possible_truncation, reason = "nine drives")]
        let expected = each * count as u16;
        if counted != expected {
            return Some(Reception::Short { counted, expected });
        }
        for (led, input) in self.drives.iter().zip(inputs) {
            *input = Inputs::take(&led.layout, back.get(led.inputs_at..)?)?;
        }
        Some(Reception::Good(FrameTimes {
            sent_ns: self.sent_ns,
            received_ns,
            bus_ns: self.bus_time.now_ns(),
        }))
    }
}

/// What the last datagram of the next frame is about: the message, if a mailbox is full, else the
/// next drive's mailbox.
fn next_aside(
    last: Option<&(Slot, Aside)>,
    drives: usize,
    mut is_full: impl FnMut(&Slot, Aside) -> Option<bool>,
) -> Aside {
    let Some((slot, aside)) = last else {
        return Aside::Look(0);
    };
    let full = is_full(slot, *aside).unwrap_or(false);
    match aside {
        Aside::Look(nth) if full => Aside::Take(*nth),
        Aside::Look(nth) | Aside::Take(nth) => Aside::Look((nth + 1) % drives.max(1)),
    }
}
