//! The mailbox: SDO requests, and emergencies.

use crate::dictionary::{Dictionary, Object};
use crate::eeprom::MAILBOX;
use crate::long_objects::{LongObjects, Taken};
use crate::memory::{Memory, SYNC_MANAGER};
use std::collections::VecDeque;

/// Status of the sync manager that the master reads.
const INPUT_STATUS: u16 = SYNC_MANAGER + 8 + 5;
/// Bit of that: a message waits.
const FULL: u8 = 8;

const NO_OBJECT: u32 = 0x0602_0000;
const NO_SUBINDEX: u32 = 0x0609_0011;
pub(crate) const NOT_MAPPABLE: u32 = 0x0604_0041;
pub(crate) const OUT_OF_RANGE: u32 = 0x0609_0030;
pub(crate) const TOO_LONG: u32 = 0x0604_0042;
pub(crate) const READ_ONLY: u32 = 0x0601_0002;
pub(crate) const NO_ACCESS: u32 = 0x0601_0000;
const NO_COMMAND: u32 = 0x0504_0001;

/// Messages on their way to the master.
#[derive(Debug, Clone, Default)]
pub(crate) struct Mailbox {
    waiting: VecDeque<Vec<u8>>,
    /// Messages with the number of the one before are dropped.
    drops_repeats: bool,
    /// That number; 0 is none.
    number: u8,
    /// Objects of more than four bytes.
    pub(crate) long: LongObjects,
}

fn message(kind: u8, service: u16, data: &[u8]) -> Vec<u8> {
    let length = u16::try_from(2 + data.len()).unwrap_or(0);
    let mut message = length.to_le_bytes().to_vec();
    message.extend_from_slice(&[0, 0, 0, 3 | kind & 0x70]);
    message.extend_from_slice(&(service << 12).to_le_bytes());
    message.extend_from_slice(data);
    message
}

impl Mailbox {
    pub(crate) fn new(drops_repeats: bool, long: LongObjects) -> Self {
        Self {
            drops_repeats,
            long,
            ..Self::default()
        }
    }

    /// Puts the next message where the master reads, if the last one was read.
    pub(crate) fn offer(&mut self, memory: &mut Memory) {
        let status = memory.byte(INPUT_STATUS);
        if status & FULL != 0 {
            return;
        }
        if let Some(mut message) = self.waiting.pop_front() {
            let start = memory.sync_manager(1).start;
            message.resize(MAILBOX.into(), 0);
            memory.put(start, &message);
            memory.put(INPUT_STATUS, &[status | FULL]);
        }
    }

    /// The master has read the message.
    pub(crate) fn taken(&mut self, memory: &mut Memory) {
        let status = memory.byte(INPUT_STATUS);
        memory.put(INPUT_STATUS, &[status & !FULL]);
        self.offer(memory);
    }

    /// Whether there is a message to be read.
    pub(crate) fn is_full(memory: &Memory) -> bool {
        memory.byte(INPUT_STATUS) & FULL != 0
    }

    /// Sends an emergency.
    pub(crate) fn emergency(&mut self, memory: &mut Memory, code: u16) {
        let [low, high] = code.to_le_bytes();
        self.waiting
            .push_back(message(0, 1, &[low, high, 0x20, 0, 0, 0, 0, 0]));
        self.offer(memory);
    }

    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        self.waiting.clear();
        self.long.clear();
        self.number = 0;
    }

    /// Takes a message of the master. `refusal` says which objects cannot be written now, by the code
    /// of an abort.
    pub(crate) fn receive(
        &mut self,
        memory: &mut Memory,
        objects: &mut Dictionary,
        sent: &[u8],
        refusal: impl Fn(&Dictionary, Object, u32) -> Option<u32>,
    ) {
        let &[
            _,
            _,
            _,
            _,
            _,
            kind,
            _,
            service,
            command,
            low,
            high,
            sub,
            ref value @ ..,
        ] = sent
        else {
            return;
        };
        if kind & 15 != 3 || service >> 4 != 2 {
            return;
        }
        let (number, before) = (kind >> 4 & 7, self.number);
        self.number = number;
        if self.drops_repeats && number != 0 && number == before {
            return;
        }
        let end = 6 + usize::from(u16::from_le_bytes([sent[0], sent[1]]));
        match self.long.take(sent.get(8..end).unwrap_or_default()) {
            Taken::Answer((service, body)) => {
                self.waiting.push_back(message(kind, service, &body));
                self.offer(memory);
                return;
            }
            Taken::Silence => return,
            Taken::No => {}
        }
        let index = u16::from_le_bytes([low, high]);
        let object = (index, sub);
        let head = |command: u8| [command, low, high, sub];
        let found = objects.get(object);
        let abort = |code: u32| (2, [head(0x80), code.to_le_bytes()].concat());
        let told = value.first_chunk().copied().map_or(0, u32::from_le_bytes);
        let refused = refusal(objects, object, told).unwrap_or(0);
        let (service, answer) = match (found, command >> 5) {
            (None, _) if objects.has_index(index) => abort(NO_SUBINDEX),
            (None, _) => abort(NO_OBJECT),
            (Some(_), _) if command & 0x10 != 0 => abort(NO_ACCESS),
            (Some(_), 1) if refused != 0 => abort(refused),
            (Some((size, value)), 2) => {
                let command = 0x43 | (4 - size) << 2;
                (3, [head(command), value.to_le_bytes()].concat())
            }
            (Some((size, _)), 1) if command & 2 != 0 => {
                let bytes = value.iter().take(size.into()).rev();
                let value = bytes.fold(0, |n, byte| n << 8 | u32::from(*byte));
                objects.set(object, value);
                (3, [head(0x60), [0; 4]].concat())
            }
            _ => abort(NO_COMMAND),
        };
        self.waiting.push_back(message(kind, service, &answer));
        self.offer(memory);
    }
}
