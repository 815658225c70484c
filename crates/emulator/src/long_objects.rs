//! Objects of more than four bytes, which go by the mailbox as a whole or in segments (ETG.1000.6), and what a
//! device can do wrong with segments.

use crate::dictionary::Object;
use crate::eeprom::MAILBOX;
use crate::segment_fault::SegmentFault;
use std::collections::BTreeMap;

/// Bytes of a message in front of the data of its first part, and of a segment.
const BEFORE_FIRST: usize = 16;
const BEFORE_SEGMENT: usize = 9;
/// Data that a segment has at least; what is less is filled up, and told.
const LEAST: usize = 7;

/// The codes of aborts.
const WRONG_TOGGLE: u32 = 0x0503_0000;
const NO_COMMAND: u32 = 0x0504_0001;
const WRONG_LENGTH: u32 = 0x0607_0010;

/// A transfer under way.
#[derive(Debug, Clone)]
struct Transfer {
    object: Object,
    is_upload: bool,
    /// What is still to be told, or what was told so far.
    data: Vec<u8>,
    /// What the master says that it writes.
    told: usize,
    toggle: u8,
    nth: u32,
}

/// An answer: service, and its bytes from the command on.
pub(crate) type Answer = (u16, Vec<u8>);

/// What becomes of a message of the master.
pub(crate) enum Taken {
    /// It is not about a long object.
    No,
    /// It is answered.
    Answer(Answer),
    /// It is not.
    Silence,
}

/// The long objects of a device.
#[derive(Debug, Clone, Default)]
pub(crate) struct LongObjects {
    objects: BTreeMap<Object, Vec<u8>>,
    transfer: Option<Transfer>,
    fault: SegmentFault,
}

fn abort((index, sub): Object, code: u32) -> Taken {
    let [low, high] = index.to_le_bytes();
    let head = [0x80, low, high, sub];
    Taken::Answer((2, [head, code.to_le_bytes()].concat()))
}

/// A segment of this data: what it tells of that, and the data.
#[allow(clippy::cast_possible_truncation, reason = "7 at most")]
fn segment(command: u8, data: &[u8], is_last: bool) -> Vec<u8> {
    let unused = LEAST.saturating_sub(data.len());
    let mut body = vec![command | (unused as u8) << 1 | u8::from(is_last)];
    body.extend_from_slice(data);
    body.resize(1 + data.len() + unused, 0);
    body
}

impl LongObjects {
    pub(crate) fn new(objects: &[(Object, Vec<u8>)], fault: SegmentFault) -> Self {
        Self {
            objects: objects.iter().cloned().collect(),
            transfer: None,
            fault,
        }
    }

    /// The bytes of an object.
    pub(crate) fn get(&self, object: Object) -> Option<&[u8]> {
        self.objects.get(&object).map(Vec::as_slice)
    }

    /// Puts others in their place.
    pub(crate) fn put(&mut self, object: Object, bytes: Vec<u8>) {
        self.objects.insert(object, bytes);
    }

    /// A request of the master, from its command on, as long as the message says.
    pub(crate) fn take(&mut self, request: &[u8]) -> Taken {
        let Some(&[command, low, high, sub]) = request.first_chunk() else {
            return Taken::No;
        };
        let object = (u16::from_le_bytes([low, high]), sub);
        match command >> 5 {
            2 if self.objects.contains_key(&object) => self.begin_upload(object),
            1 if self.objects.contains_key(&object) => self.begin_download(object, request),
            3 if self.transfer.is_some() => self.upload_segment(command),
            0 if self.transfer.is_some() => self.download_segment(request),
            4 => {
                // The master aborts.
                self.transfer = None;
                Taken::Silence
            }
            _ => Taken::No,
        }
    }

    fn begin_upload(&mut self, object: Object) -> Taken {
        let mut data = self.objects.get(&object).cloned().unwrap_or_default();
        let (index, sub) = object;
        let [low, high] = index.to_le_bytes();
        let more = if let SegmentFault::Length(more) = self.fault {
            more
        } else {
            0
        };
        let told = u32::try_from(data.len()).unwrap_or(0);
        let told = told.saturating_add_signed(more);
        let first = data.len().min(usize::from(MAILBOX) - BEFORE_FIRST);
        let rest = data.split_off(first);
        let head = [[0x41, low, high, sub], told.to_le_bytes()].concat();
        self.transfer = (told as usize > first).then_some(Transfer {
            object,
            is_upload: true,
            data: rest,
            told: 0,
            toggle: 0,
            nth: 0,
        });
        Taken::Answer((3, [head, data].concat()))
    }

    /// The nth segment, as the fault has it; `None` where there is none.
    fn spoilt(&mut self, object: Object, nth: u32) -> Option<Taken> {
        match self.fault {
            SegmentFault::Abort(at, code) if at == nth => {
                self.transfer = None;
                Some(abort(object, code))
            }
            SegmentFault::Silent(at) if at == nth => {
                (self.fault, self.transfer) = (SegmentFault::None, None);
                Some(Taken::Silence)
            }
            _ => None,
        }
    }

    fn upload_segment(&mut self, command: u8) -> Taken {
        let (told, object, nth) = match self.next_segment(true, command) {
            Ok(step) => step,
            Err(refused) => return refused,
        };
        let Some(transfer) = &mut self.transfer else {
            return abort(object, NO_COMMAND);
        };
        let most = usize::from(MAILBOX) - BEFORE_SEGMENT;
        let count = if self.fault == SegmentFault::Empty {
            0
        } else {
            transfer.data.len().min(most)
        };
        let rest = transfer.data.split_off(count);
        let data = core::mem::replace(&mut transfer.data, rest);
        let is_last = transfer.data.is_empty() && self.fault != SegmentFault::Empty;
        if let Some(spoilt) = self.spoilt(object, nth) {
            return spoilt;
        }
        if is_last {
            self.transfer = None;
        }
        Taken::Answer((3, segment(told, &data, is_last)))
    }

    fn begin_download(&mut self, object: Object, request: &[u8]) -> Taken {
        let (index, sub) = object;
        let [low, high] = index.to_le_bytes();
        let value = request.get(4..).and_then(|told| told.first_chunk());
        let Some(value) = value.copied() else {
            return abort(object, WRONG_LENGTH);
        };
        let is_expedited = request[0] & 2 != 0;
        let (told, data) = if is_expedited {
            let count = 4 - usize::from(request[0] >> 2 & 3);
            (count, value[..count].to_vec())
        } else {
            let data = request.get(8..).unwrap_or_default();
            (u32::from_le_bytes(value) as usize, data.to_vec())
        };
        self.transfer = Some(Transfer {
            object,
            is_upload: false,
            data,
            told,
            toggle: 0,
            nth: 0,
        });
        if let Some(refused) = self.written(false) {
            return refused;
        }
        Taken::Answer((3, vec![0x60, low, high, sub, 0, 0, 0, 0]))
    }

    /// The object is written when all is there; what is refused of it.
    fn written(&mut self, is_last: bool) -> Option<Taken> {
        let transfer = self.transfer.as_ref()?;
        let (object, told, given) = (transfer.object, transfer.told, transfer.data.len());
        if given < told && !is_last {
            return None;
        }
        let transfer = self.transfer.take()?;
        if given != told {
            return Some(abort(object, WRONG_LENGTH));
        }
        self.objects.insert(object, transfer.data);
        None
    }

    /// The toggle to tell of the next segment, its object and its number; or why there is none.
    fn next_segment(&mut self, is_upload: bool, command: u8) -> Result<(u8, Object, u32), Taken> {
        let under_way = self.transfer.as_mut();
        let Some(transfer) = under_way.filter(|transfer| transfer.is_upload == is_upload) else {
            return Err(abort((0, 0), NO_COMMAND));
        };
        let (object, nth) = (transfer.object, transfer.nth);
        if command & 0x10 != transfer.toggle {
            self.transfer = None;
            return Err(abort(object, WRONG_TOGGLE));
        }
        let told = if self.fault == SegmentFault::SameToggle {
            0
        } else {
            transfer.toggle
        };
        transfer.toggle ^= 0x10;
        transfer.nth += 1;
        Ok((told, object, nth))
    }

    fn download_segment(&mut self, request: &[u8]) -> Taken {
        let command = request[0];
        let (told, object, nth) = match self.next_segment(false, command) {
            Ok(step) => step,
            Err(refused) => return refused,
        };
        let Some(transfer) = &mut self.transfer else {
            return abort(object, NO_COMMAND);
        };
        let unused = usize::from(command >> 1 & 7);
        let data = &request[1..];
        let data = &data[..data.len().saturating_sub(unused)];
        transfer.data.extend_from_slice(data);
        if let Some(spoilt) = self.spoilt(object, nth) {
            return spoilt;
        }
        if let Some(refused) = self.written(command & 1 != 0) {
            return refused;
        }
        Taken::Answer((3, vec![0x20 | told, 0, 0, 0, 0, 0, 0, 0]))
    }

    /// Forgets what is under way.
    pub(crate) fn clear(&mut self) {
        self.transfer = None;
    }
}
