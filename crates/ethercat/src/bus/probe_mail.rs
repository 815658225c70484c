//! The questions to touch probes that are not in the process data: one at a time, in the cycles of OP.
//!
//! A unit is switched by 0x60B8, where that is not in the process data. While somebody wants to know, 0x60B9 is read over and over, and behind it
//! the places that it says are kept. What is told is that of one such reading.

use super::mailbox::Mailbox;
use crate::coe::{self, Object, Reply, object};
use crate::exchange::station;
use crate::layout::{Drives, ProbeAccess};
use crate::probe::{ProbeInputs, ProbeUse};
use crate::settings::DriveSettings;

/// Bytes of a question.
pub(super) const MESSAGE: usize = 16;
/// Frames that an answer may take until the question is asked again.
const PATIENCE: u32 = 1000;
/// The bits of a status that say that a place is kept, at a rising and at a falling edge.
const KEPT: [u8; 2] = [2, 4];

/// The touch probe of a drive.
#[derive(Debug, Clone, Copy)]
struct Mailed {
    /// The number of the drive, and of its mailbox.
    axis: usize,
    mailbox: usize,
    access: ProbeAccess,
    /// Its objects: 0x60B8, 0x60B9, and the places.
    function: Object,
    status: Object,
    places: [Object; 2],
    /// What is wanted of it, and what it has taken; `None` while that is not known.
    wanted: ProbeUse,
    asks: bool,
    was_told: Option<ProbeUse>,
    /// What is being read began before that was wanted.
    is_outdated: bool,
    /// What is being read, and what was read.
    reading: ProbeInputs,
    told: ProbeInputs,
}

/// A question under way.
#[derive(Debug, Clone, Copy)]
struct Question {
    nth: usize,
    what: What,
    number: u8,
    /// Frames since the device has taken it; `None` before.
    since: Option<u32>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum What {
    Switch(ProbeUse),
    Status,
    Place(usize),
}

/// All touch probes that are asked by their mailbox.
#[derive(Debug, Default)]
pub(super) struct ProbeMail {
    probes: Vec<Mailed>,
    question: Option<Question>,
    turn: usize,
    /// The numbers of the last messages, by mailbox.
    numbers: Vec<u8>,
}

impl ProbeMail {
    /// Those of the drives whose touch probes are not, or not all, in the process data. `number` is that of the
    /// last message to a device.
    pub(super) fn new(drives: &Drives, mailboxes: &[Mailbox], number: impl Fn(u16) -> u8) -> Self {
        let axes = drives.axes.iter().enumerate();
        let probes = axes.filter_map(|(axis, led)| {
            let is_mailed =
                |access: &ProbeAccess| access.places.is_none() || access.function.is_none();
            let access = led.layout.probe.filter(is_mailed)?;
            let device = &drives.devices.get(led.device)?.device;
            let at = station(device.position);
            let mailbox = mailboxes.iter().position(|mailbox| mailbox.station == at)?;
            Some(Mailed::new(axis, mailbox, access))
        });
        Self {
            probes: probes.collect(),
            question: None,
            turn: 0,
            numbers: mailboxes
                .iter()
                .map(|mailbox| number(mailbox.station))
                .collect(),
        }
    }

    /// What is wanted of the touch probe of a drive.
    pub(super) fn want(&mut self, axis: usize, wanted: ProbeUse, asks: bool) {
        if let Some(probe) = self.probes.iter_mut().find(|probe| probe.axis == axis) {
            if probe.wanted != wanted {
                probe.is_outdated = true;
                probe.told = ProbeInputs::unlike(wanted);
            }
            (probe.wanted, probe.asks) = (wanted, asks);
        }
        if self.question.is_none() {
            self.ask_next();
        }
    }

    /// The number of the next message to a mailbox, of whatever it is about.
    pub(super) fn next_number(&mut self, mailbox: usize) -> u8 {
        let number = self.numbers.get_mut(mailbox);
        number.map_or(1, |number| {
            *number = *number % 7 + 1;
            *number
        })
    }

    /// What it has answered, or is taken to do until it has heard what is wanted; `None` if that is in the process data.
    pub(super) fn told(&self, axis: usize) -> Option<ProbeInputs> {
        let probe = self.probes.iter().find(|probe| probe.axis == axis)?;
        if probe.is_to_be_switched() {
            return Some(ProbeInputs::unlike(probe.wanted));
        }
        probe.access.places.is_none().then_some(probe.told)
    }

    /// The next probe of which something is wanted.
    fn ask_next(&mut self) {
        let count = self.probes.len();
        for step in 1..=count {
            let nth = (self.turn + step) % count;
            let probe = &self.probes[nth];
            let what = if probe.is_to_be_switched() {
                What::Switch(probe.wanted)
            } else if probe.asks && probe.access.places.is_none() {
                What::Status
            } else {
                continue;
            };
            self.turn = nth;
            self.ask(nth, what);
            return;
        }
    }

    fn ask(&mut self, nth: usize, what: What) {
        if let Some(probe) = self.probes.get_mut(nth) {
            match what {
                What::Status => probe.is_outdated = false,
                // From here on it may have taken that or not, until it answers.
                What::Switch(_) => probe.was_told = None,
                What::Place(_) => {}
            }
        }
        if let Some(mailbox) = self.probes.get(nth).map(|probe| probe.mailbox) {
            let number = self.next_number(mailbox);
            self.question = Some(Question {
                nth,
                what,
                number,
                since: None,
            });
        }
    }

    /// The message that is to be sent, and to which mailbox.
    pub(super) fn question(&self) -> Option<(usize, [u8; MESSAGE])> {
        let question = self.question.filter(|question| question.since.is_none())?;
        let probe = self.probes.get(question.nth)?;
        let value = match question.what {
            What::Switch(wanted) => {
                let access = probe.access;
                Some(access.probe.function(access.before, wanted).into())
            }
            What::Status | What::Place(_) => None,
        };
        let message = coe::message(probe.object(question.what), value, question.number);
        Some((probe.mailbox, message))
    }

    /// Whether the message that was sent last was taken.
    pub(super) const fn posted(&mut self, is_taken: bool) {
        if let Some(question) = &mut self.question
            && is_taken
        {
            question.since = Some(0);
        }
    }

    /// The mailbox that an answer is to come from.
    pub(super) fn waits_for(&self) -> Option<usize> {
        let question = self.question.filter(|question| question.since.is_some())?;
        self.probes.get(question.nth).map(|probe| probe.mailbox)
    }

    /// A frame has passed.
    pub(super) fn pass(&mut self) {
        let Some(question) = &mut self.question else {
            return;
        };
        if let Some(since) = &mut question.since {
            *since += 1;
            if *since > PATIENCE {
                self.question = None;
                self.ask_next();
            }
        }
    }

    /// A message has come from a mailbox; whether it was the answer.
    pub(super) fn hear(&mut self, mailbox: usize, message: &[u8]) -> bool {
        if self.waits_for() != Some(mailbox) {
            return false;
        }
        let Some(Question { nth, what, .. }) = self.question else {
            return false;
        };
        let Some(probe) = self.probes.get_mut(nth) else {
            return false;
        };
        let next = match coe::reply(message, probe.object(what)) {
            Reply::Value(value) => probe.take(what, value),
            // What it refuses now it took before the cycles began (see `probes`): asked again in its turn.
            Reply::Abort(_) | Reply::Longer(_) => None,
            Reply::Other => return false,
        };
        self.question = None;
        match next {
            Some(what) => self.ask(nth, what),
            None => self.ask_next(),
        }
        true
    }
}

impl Mailed {
    /// One of which nothing is wanted yet.
    fn new(axis: usize, mailbox: usize, access: ProbeAccess) -> Self {
        let own = |index, size| object(DriveSettings::of_axis(index, access.axis), 0, size);
        Self {
            axis,
            mailbox,
            access,
            function: own(0x60b8, 2),
            status: own(0x60b9, 2),
            places: access.probe.places().map(|index| own(index, 4)),
            wanted: ProbeUse::Off,
            asks: false,
            was_told: None,
            is_outdated: false,
            reading: ProbeInputs::default(),
            told: ProbeInputs::default(),
        }
    }

    /// Whether it has to hear by its mailbox what is wanted.
    fn is_to_be_switched(&self) -> bool {
        self.access.function.is_none() && self.was_told != Some(self.wanted)
    }

    const fn object(&self, what: What) -> Object {
        match what {
            What::Switch(_) => self.function,
            What::Status => self.status,
            What::Place(0) => self.places[0],
            What::Place(_) => self.places[1],
        }
    }

    /// Takes an answer. Returns what is to be asked next.
    #[allow(
        clippy::cast_possible_wrap,
        reason = "the bits of a number with a sign"
    )]
    fn take(&mut self, what: What, value: u32) -> Option<What> {
        let from = match what {
            What::Switch(told) => {
                self.was_told = Some(told);
                return None;
            }
            // What it was before: it is asked again.
            What::Status | What::Place(_) if self.is_outdated => return None,
            What::Status => {
                let status = u16::try_from(value).unwrap_or(0);
                self.reading.status = self.access.probe.status(status);
                0
            }
            What::Place(edge) => {
                self.reading.places[edge.min(1)] = (value as i32).into();
                edge + 1
            }
        };
        let next = (from..2).find(|edge| self.reading.status & KEPT[*edge] != 0);
        if next.is_none() {
            self.told = self.reading;
        }
        next.map(What::Place)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;
    use crate::layout::ProbePlaces;
    use crate::probe::TouchProbe;

    /// A drive that is told by its mailbox what it is to do.
    fn mail(places: Option<ProbePlaces>) -> ProbeMail {
        let access = ProbeAccess {
            probe: TouchProbe::of_index(1),
            axis: 0,
            before: 0,
            function: None,
            places,
        };
        ProbeMail {
            probes: vec![Mailed::new(0, 0, access)],
            question: None,
            turn: 0,
            numbers: vec![0],
        }
    }

    /// The device takes the message that is to be sent.
    fn post(mail: &mut ProbeMail) {
        assert!(mail.question().is_some());
        mail.posted(true);
    }

    /// It answers: written.
    fn answer(mail: &mut ProbeMail) {
        let written = [10, 0, 0, 0, 0, 3, 0, 0x30, 0x60, 0xb8, 0x60, 0, 0, 0, 0, 0];
        assert!(mail.hear(0, &written));
    }

    #[test]
    fn a_unit_that_has_not_heard_yet_is_not_believed_to_do_what_is_wanted() {
        let mapped = ProbePlaces {
            status: 6,
            kept: [8, 12],
        };
        let mut mail = mail(Some(mapped));
        let unlike = |wanted| Some(ProbeInputs::unlike(wanted));
        mail.want(0, ProbeUse::Off, false);
        assert_eq!(mail.told(0), unlike(ProbeUse::Off));
        post(&mut mail);
        answer(&mut mail);
        // From here on what the process data says counts.
        assert_eq!(mail.told(0), None);
        mail.want(0, ProbeUse::Index, true);
        assert_eq!(mail.told(0), unlike(ProbeUse::Index));
        post(&mut mail);
        // It is on its way, and not wanted any more: it may be on at any time.
        mail.want(0, ProbeUse::Off, true);
        assert_eq!(mail.told(0), unlike(ProbeUse::Off));
        answer(&mut mail);
        assert_eq!(mail.told(0), unlike(ProbeUse::Off));
        post(&mut mail);
        answer(&mut mail);
        assert_eq!(mail.told(0), None);
    }

    #[test]
    fn one_that_is_switched_in_the_process_data_is_only_asked() {
        let mut mail = mail(None);
        mail.probes[0].access.function = Some(6);
        mail.want(0, ProbeUse::Index, true);
        assert_eq!(mail.question.unwrap().what, What::Status);
        assert_eq!(mail.told(0), Some(ProbeInputs::unlike(ProbeUse::Index)));
    }
}
