//! The exchange of datagrams before the cycles begin: one a frame, asked again when it is lost.

use crate::error::BusError;
use crate::frame::{Address, Command, Frame};
use crate::wire::{MAX_FRAME, Wire};

/// How long an answer is waited for.
const PATIENCE_NS: u64 = 20_000_000;
/// How often it is asked for.
const TRIES: u32 = 5;

/// The wire, and a frame of its own.
#[derive(Debug)]
pub(crate) struct Exchange<'w, W> {
    pub(crate) wire: &'w mut W,
    frame: Frame,
    received: Vec<u8>,
    index: u8,
    /// The numbers of the last messages to the mailboxes of the devices.
    numbers: Vec<u8>,
}

/// The station address of the nth device.
#[allow(
    clippy::cast_possible_truncation,
    reason = "a segment has 65535 devices at most"
)]
pub(crate) const fn station(nth: usize) -> u16 {
    0x1001 + nth as u16
}

impl<'w, W: Wire> Exchange<'w, W> {
    pub(crate) fn new(wire: &'w mut W) -> Self {
        Self {
            wire,
            frame: Frame::default(),
            received: vec![0; MAX_FRAME],
            index: 0,
            numbers: Vec::new(),
        }
    }

    /// The number of the next message to a device's mailbox: 1 to 7, and never that of the one before,
    /// because a device may take that for the same message (ETG.1000.4).
    pub(crate) fn next_number(&mut self, nth: usize) -> u8 {
        if self.numbers.len() <= nth {
            self.numbers.resize(nth + 1, 0);
        }
        let number = &mut self.numbers[nth];
        *number = *number % 7 + 1;
        *number
    }

    /// The number of the last message to the mailbox of the device with a station address; 0 before the first.
    pub(crate) fn last_number(&self, address: u16) -> u8 {
        let nth = usize::from(address.wrapping_sub(station(0)));
        self.numbers.get(nth).copied().unwrap_or(0)
    }

    /// Asks once more and once more; returns the working counter, and when the question was sent
    /// and answered. `data` becomes the answer's. `None` if nothing came back.
    pub(crate) fn ask(
        &mut self,
        command: Command,
        address: Address,
        data: &mut [u8],
        tries: u32,
    ) -> Result<Option<(u16, u64)>, BusError> {
        let failed = |action| move |source| BusError::Wire { action, source };
        for _ in 0..tries {
            self.index = self.index.wrapping_add(1);
            self.frame.clear();
            let Some(slot) = self.frame.push(command, self.index, address, data.len()) else {
                return Ok(None);
            };
            self.frame.data(&slot).copy_from_slice(data);
            let sent_ns = self.wire.now_ns();
            self.wire
                .send(self.frame.bytes())
                .map_err(failed("sending"))?;
            let until_ns = sent_ns + PATIENCE_NS;
            while let Some(length) = self
                .wire
                .receive(&mut self.received, until_ns)
                .map_err(failed("receiving"))?
            {
                let received = &self.received[..length];
                if let Some(answer) = self.frame.answer(&slot, received) {
                    data.copy_from_slice(answer.data);
                    return Ok(Some((answer.counter, sent_ns.midpoint(self.wire.now_ns()))));
                }
            }
        }
        Ok(None)
    }

    /// Writes to all devices; returns how many took it.
    pub(crate) fn write_all(&mut self, register: u16, bytes: &[u8]) -> Result<u16, BusError> {
        let address = Address::all(register);
        let asked = self.ask(Command::Bwr, address, &mut bytes.to_vec(), TRIES)?;
        asked.map_or(Err(BusError::Nobody), |(counter, _)| Ok(counter))
    }

    /// Writes to one device.
    pub(crate) fn write(
        &mut self,
        nth: usize,
        register: u16,
        bytes: &[u8],
        action: &'static str,
    ) -> Result<(), BusError> {
        let address = Address::station(station(nth), register);
        self.one(Command::Fpwr, address, &mut bytes.to_vec(), nth, action)
    }

    /// Reads from one device.
    pub(crate) fn read<const N: usize>(
        &mut self,
        nth: usize,
        register: u16,
        action: &'static str,
    ) -> Result<[u8; N], BusError> {
        let mut bytes = [0; N];
        let address = Address::station(station(nth), register);
        self.one(Command::Fprd, address, &mut bytes, nth, action)?;
        Ok(bytes)
    }

    /// Whether a device has a register: a frame that comes back without its answer says that it has
    /// not. Asked again and again, because a device can miss a datagram.
    pub(crate) fn has(
        &mut self,
        nth: usize,
        register: u16,
        length: usize,
        action: &'static str,
    ) -> Result<bool, BusError> {
        let address = Address::station(station(nth), register);
        let mut is_heard = false;
        for _ in 0..TRIES {
            match self.ask(Command::Fprd, address, &mut vec![0; length], 1)? {
                Some((1.., _)) => return Ok(true),
                Some(_) => is_heard = true,
                None => {}
            }
        }
        if is_heard {
            return Ok(false);
        }
        Err(BusError::NoAnswer {
            device: nth,
            action,
            tries: TRIES,
        })
    }

    /// A question that one device has to answer.
    pub(crate) fn one(
        &mut self,
        command: Command,
        address: Address,
        data: &mut [u8],
        device: usize,
        action: &'static str,
    ) -> Result<(), BusError> {
        let sent = data.to_vec();
        for _ in 0..TRIES {
            data.copy_from_slice(&sent);
            if let Some((1.., _)) = self.ask(command, address, data, 1)? {
                return Ok(());
            }
        }
        Err(BusError::NoAnswer {
            device,
            action,
            tries: TRIES,
        })
    }
}
