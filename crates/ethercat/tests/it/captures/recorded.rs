//! A device as a capture has it: what it answered to other masters is what it answers to ours.
//!
//! Its registers are what was read of them, its EEPROM the words that were read, its objects the answers of its
//! mailbox; what was not answered is not there. States are those that it reached. What our master asks and the
//! capture does not have is noted: nothing of it is made up but zeros, and the divider of watchdogs as it is at
//! every device.

use super::pcap::{datagrams, frames, word};
use std::collections::{BTreeMap, BTreeSet};

const AL_CONTROL: u16 = 0x120;
const AL_STATUS: u16 = 0x130;
const DIVIDER: u16 = 0x400;
const EEPROM: u16 = 0x502;
const EEPROM_DATA: u16 = 0x508;
const MAILBOX_STATUS: u16 = 0x80d;
const CLOCK: core::ops::Range<u16> = 0x910..0x9d0;
const MEMORY: u16 = 0x1000;
const FULL: u8 = 8;
/// The code of an object that there is not.
const NO_OBJECT: [u8; 4] = [0, 0, 2, 6];

/// Index and subindex.
type Asked = (u16, u8);

/// What another master did with a device.
#[derive(Debug, Default, Clone)]
pub(super) struct Known {
    /// By register.
    bytes: BTreeMap<u16, u8>,
    /// Registers that were asked or written in vain.
    absent: BTreeSet<u16>,
    words: BTreeMap<u16, u16>,
    /// The messages of its mailbox, by what was asked: the first one, and segments behind it.
    answers: BTreeMap<Asked, Vec<Vec<u8>>>,
    /// The state of a device, with its error, in order; and its code.
    pub(super) states: Vec<(u8, u16)>,
    /// What was written last, by register.
    pub(super) written: BTreeMap<u16, Vec<u8>>,
}

impl Known {
    /// The highest state that it reached, with an error or without.
    pub(super) fn reached(&self) -> u8 {
        let states = self.states.iter().map(|(state, _)| state & 15);
        states.max().unwrap_or(0)
    }

    /// Whether it was asked what every start has to know: functions, ports, and who it is.
    pub(super) fn is_known(&self) -> bool {
        let registers = [0x08, 0x110, 0x111];
        registers.iter().all(|at| self.bytes.contains_key(at))
            && (8..12).all(|at| self.words.contains_key(&at))
            && self.reached() > 0
    }

    fn read(&mut self, offset: u16, data: &[u8]) {
        for (at, byte) in (offset..).zip(data) {
            self.bytes.entry(at).or_insert(*byte);
        }
    }
}

/// A question that is under way, and what was asked of the EEPROM.
#[derive(Debug, Default)]
struct UnderWay {
    object: Option<Asked>,
    word: u16,
}

/// The devices of a capture, in the order of the cable; none where nobody gave them addresses.
pub(super) fn devices(capture: &[u8]) -> Vec<Known> {
    let (mut stations, mut known) = (BTreeMap::new(), BTreeMap::<u16, Known>::new());
    let mut under_way = BTreeMap::<u16, UnderWay>::new();
    for frame in frames(capture) {
        let is_answer = frame[6] & 2 != 0;
        for datagram in datagrams(frame) {
            let (station, offset, data) = (datagram.station, datagram.offset, datagram.data);
            if (datagram.command, offset, is_answer) == (2, 0x10, false) {
                stations.insert(word(data, 0), 0_u16.wrapping_sub(station));
                continue;
            }
            if !matches!(datagram.command, 4 | 5) {
                continue;
            }
            let way = under_way.entry(station).or_default();
            let device = known.entry(station).or_default();
            match (datagram.command, is_answer) {
                (5, false) => note_question(way, offset, data),
                // A mailbox that is empty does not answer either.
                (_, true) if datagram.counter == 0 && offset < MEMORY => {
                    device.absent.insert(offset);
                }
                (4, true) => note_answer(device, way, offset, data),
                (5, true) => {
                    device.written.insert(offset, data.to_vec());
                }
                _ => {}
            }
        }
    }
    let mut line: Vec<_> = stations.into_iter().map(|(at, nth)| (nth, at)).collect();
    line.sort_unstable();
    let known = line.into_iter().filter_map(|(_, at)| known.remove(&at));
    known.collect()
}

fn note_question(way: &mut UnderWay, offset: u16, data: &[u8]) {
    if offset == EEPROM && data.len() == 6 && data[1] & 1 != 0 {
        way.word = word(data, 2);
    }
    if offset >= MEMORY && data.len() >= 16 && data[5] & 15 == 3 && data[7] >> 4 == 2 {
        match data[8] >> 5 {
            // Of a single object, not of all its subindices.
            2 if data[8] == 0x40 => way.object = Some((word(data, 9), data[11])),
            3 => {}
            _ => way.object = None,
        }
    }
}

fn note_answer(device: &mut Known, way: &UnderWay, offset: u16, data: &[u8]) {
    match offset {
        AL_STATUS => {
            let code = if data.len() >= 6 { word(data, 4) } else { 0 };
            let state = (data[0], code);
            if device.states.last() != Some(&state) {
                device.states.push(state);
            }
        }
        EEPROM_DATA => {
            for (at, pair) in (way.word..).zip(data.chunks_exact(2)) {
                device.words.insert(at, word(pair, 0));
            }
        }
        0x500..0x900 => {}
        MEMORY.. => {
            let is_answer = data.len() >= 16 && data[5] & 15 == 3 && data[7] >> 4 >= 2;
            if let Some(object) = way.object.filter(|_| is_answer) {
                let messages = device.answers.entry(object).or_default();
                let begins = data[8] >> 5 != 0;
                if begins {
                    messages.clear();
                }
                messages.push(data.to_vec());
            }
        }
        _ => device.read(offset, data),
    }
}

/// A device that answers as it did.
#[derive(Debug)]
pub(super) struct Recorded {
    pub(super) known: Known,
    station: u16,
    state: u8,
    bytes: BTreeMap<u16, u8>,
    word: u16,
    /// What waits in its mailbox, and segments still to come.
    mailbox: Option<Vec<u8>>,
    segments: Vec<Vec<u8>>,
    /// What our master asked and no capture knows: registers, words of the EEPROM, objects.
    pub(super) unknown: BTreeSet<u16>,
    pub(super) unknown_words: BTreeSet<u16>,
    pub(super) unknown_objects: BTreeSet<Asked>,
    /// Whether it went to a state that it never reached.
    pub(super) beyond: bool,
}

impl Recorded {
    pub(super) fn new(known: Known) -> Self {
        Self {
            state: known.states.first().map_or(1, |(state, _)| *state),
            bytes: known.bytes.clone(),
            known,
            station: 0,
            word: 0,
            mailbox: None,
            segments: Vec::new(),
            unknown: BTreeSet::new(),
            unknown_words: BTreeSet::new(),
            unknown_objects: BTreeSet::new(),
            beyond: false,
        }
    }

    /// A register that our master wrote, bytes.
    pub(super) fn at<const N: usize>(&self, register: u16) -> [u8; N] {
        let byte = |nth: usize| self.bytes.get(&(register + nth as u16)).copied();
        core::array::from_fn(|nth| byte(nth).unwrap_or(0))
    }

    pub(super) fn is_at(&self, station: u16) -> bool {
        self.station == station
    }

    pub(super) const fn state(&self) -> u8 {
        self.state
    }

    /// Whether it has no system time: another master asked or wrote it in vain.
    fn lacks_clock(&self) -> bool {
        [0x910, 0x918, 0x920]
            .iter()
            .any(|at| self.known.absent.contains(at))
    }

    fn has(&self, register: u16) -> bool {
        !(CLOCK.contains(&register) && self.lacks_clock())
    }

    fn start(&self, manager: u16) -> u16 {
        u16::from_le_bytes(self.at(0x800 + 8 * manager))
    }

    /// Our master reads; `None` if nobody answers.
    pub(super) fn read(&mut self, register: u16, length: usize) -> Option<Vec<u8>> {
        if register >= MEMORY {
            let mut message = self.mailbox.take().filter(|_| register == self.start(1))?;
            message.resize(length, 0);
            return Some(message);
        }
        if !self.has(register) {
            return None;
        }
        let mut bytes = Vec::new();
        for at in (register..).take(length) {
            bytes.push(self.byte(at));
        }
        Some(bytes)
    }

    fn byte(&mut self, at: u16) -> u8 {
        match at {
            AL_STATUS => self.state,
            0x131..0x136 => 0,
            // Never busy, and no error.
            EEPROM..EEPROM_DATA => 0,
            EEPROM_DATA..0x510 => {
                let word = self.word + (at - EEPROM_DATA) / 2;
                let known = self.known.words.get(&word).copied();
                if known.is_none() {
                    self.unknown_words.insert(word);
                }
                known.unwrap_or(0xffff).to_le_bytes()[usize::from(at & 1)]
            }
            MAILBOX_STATUS if self.mailbox.is_some() => FULL,
            0x805 | MAILBOX_STATUS => 0,
            _ => {
                let known = self.bytes.get(&at).copied();
                if known.is_none() && !(DIVIDER..DIVIDER + 2).contains(&at) {
                    self.unknown.insert(at);
                }
                known.unwrap_or(match at {
                    DIVIDER => 0xc2,
                    0x401 => 0x09,
                    _ => 0,
                })
            }
        }
    }

    /// Our master writes; whether somebody takes it.
    pub(super) fn write(&mut self, register: u16, data: &[u8]) -> bool {
        if register >= MEMORY {
            if register == self.start(0) {
                self.hear(data);
            }
            return true;
        }
        if !self.has(register) {
            return false;
        }
        match register {
            0x10 => self.station = word(data, 0),
            AL_CONTROL => {
                let wanted = data[0] & 15;
                self.beyond |= wanted > self.known.reached();
                self.state = wanted;
            }
            EEPROM if data.len() == 6 => self.word = word(data, 2),
            0x500..0x510 | 0x900..0x910 => {}
            _ => self.bytes.extend((register..).zip(data.iter().copied())),
        }
        true
    }

    /// A message of our master.
    fn hear(&mut self, sent: &[u8]) {
        if sent.len() < 16 || sent[5] & 15 != 3 || sent[7] >> 4 != 2 {
            return;
        }
        let object = (word(sent, 9), sent[11]);
        self.mailbox = match sent[8] >> 5 {
            2 => Some(self.begin(object)),
            3 if !self.segments.is_empty() => Some(self.segments.remove(0)),
            // What it would say to being written is not known.
            _ => {
                self.unknown_objects.insert(object);
                Some(abort(object))
            }
        };
    }

    fn begin(&mut self, object: Asked) -> Vec<u8> {
        let Some(messages) = self.known.answers.get(&object) else {
            self.unknown_objects.insert(object);
            return abort(object);
        };
        let (first, rest) = messages.split_first().unwrap();
        self.segments = rest.to_vec();
        first.clone()
    }

    /// What it adds to the working counter of process data: once for what it gives, twice for what it takes.
    pub(super) fn counted(&self, logical: core::ops::Range<u32>) -> u16 {
        if self.state < 4 {
            return 0;
        }
        let (mut gives, mut takes) = (false, false);
        for nth in 0..8 {
            let window: [u8; 13] = self.at(0x600 + 16 * nth);
            let start = u32::from_le_bytes([window[0], window[1], window[2], window[3]]);
            let length = u32::from(word(&window, 4));
            let is_on = window[12] & 1 != 0;
            if is_on && start < logical.end && logical.start < start + length {
                gives |= window[11] & 1 != 0;
                takes |= window[11] & 2 != 0;
            }
        }
        u16::from(gives) + 2 * u16::from(takes)
    }
}

/// The refusal of an object that there is not.
fn abort((index, sub): Asked) -> Vec<u8> {
    let [low, high] = index.to_le_bytes();
    let head = [10, 0, 0, 0, 0, 3, 0, 0x20, 0x80, low, high, sub];
    [&head[..], &NO_OBJECT].concat()
}
