//! The last datagrams of a frame, beside its process data: whether a mailbox is full, of one device after
//! the other; the message in one that is; and a question: to a drive whose touch probe is asked that way, or for
//! the diagnosis history of a device that has failed.
//!
//! ```text
//!        ┌── full ──► Take ──┐
//!  Look ─┴── empty ──────────┴─► Look at the next one, or Post, or Look for the answer to that
//! ```

use super::history_mail::HistoryMail;
use super::mailbox::Mailbox;
use super::probe_mail::{MESSAGE, ProbeMail};
use crate::coe::{emergency, message};
use crate::diagnosis::Diagnosis;
use crate::frame::{Address, Command, Frame, Slot};
use crate::probe::{ProbeInputs, ProbeUse};
use crate::registers::MAILBOX_IN_STATUS;

/// Bit of a mailbox' status.
const FULL: u8 = 8;

/// What the datagrams are about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Matter {
    /// Whether the mailbox of this device is full.
    Look(usize),
    /// The message in it.
    Take(usize),
    /// A question.
    Post(Question),
}

/// What a question is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Question {
    Probe,
    History,
}

/// The datagrams of one frame after the other.
#[derive(Debug)]
pub(super) struct Asides {
    mailboxes: Vec<Mailbox>,
    next: Matter,
    sent: Option<(Matter, Slot, Option<Slot>)>,
    /// The mailbox that is looked at next, if nobody is asked.
    turn: usize,
    /// It was the turn of a question.
    was_mail: bool,
    mail: ProbeMail,
    history: HistoryMail,
    emergency: Option<(usize, u16)>,
}

impl Asides {
    pub(super) fn new(mailboxes: Vec<Mailbox>, mail: ProbeMail) -> Self {
        Self {
            history: HistoryMail::new(&mailboxes),
            mailboxes,
            next: Matter::Look(0),
            sent: None,
            turn: 0,
            was_mail: false,
            mail,
            emergency: None,
        }
    }

    /// The emergency that came last, and from which device; `None` if that was told.
    pub(super) const fn take_emergency(&mut self) -> Option<(usize, u16)> {
        self.emergency.take()
    }

    /// A device, by its number, has failed: its diagnosis history is to be asked.
    pub(super) fn want_history(&mut self, nth: usize) {
        let mailbox = self.mailboxes.iter().position(|mailbox| mailbox.nth == nth);
        if let Some(mailbox) = mailbox {
            self.history.want(mailbox);
        }
    }

    /// The message of a history that came last, and of which device; `None` if that was told.
    pub(super) fn take_diagnosis(&mut self) -> Option<(usize, Diagnosis)> {
        let (mailbox, diagnosis) = self.history.take()?;
        Some((self.mailbox(mailbox).nth, diagnosis))
    }

    /// What the touch probe of a drive is to do, and whether it is to be asked what it keeps.
    pub(super) fn want(&mut self, axis: usize, wanted: ProbeUse, asks: bool) {
        self.mail.want(axis, wanted, asks);
    }

    /// What the touch probe of a drive has answered; `None` if it is not asked by its mailbox.
    pub(super) fn told(&self, axis: usize) -> Option<ProbeInputs> {
        self.mail.told(axis)
    }

    /// Adds the datagrams to a frame.
    pub(super) fn push(&mut self, frame: &mut Frame, index: u8) {
        self.sent = match self.next {
            Matter::Look(nth) => {
                let mailbox = self.mailbox(nth);
                let at = Address::station(mailbox.station, MAILBOX_IN_STATUS);
                let slot = frame.push(Command::Fprd, index, at, 1);
                slot.map(|slot| (self.next, slot, None))
            }
            Matter::Take(nth) => {
                let mailbox = self.mailbox(nth);
                let (start, length) = mailbox.back;
                let at = Address::station(mailbox.station, start);
                let slot = frame.push(Command::Fprd, index, at, length.into());
                slot.map(|slot| (self.next, slot, None))
            }
            Matter::Post(question) => self.post(frame, index, question),
        };
    }

    fn mailbox(&self, nth: usize) -> Mailbox {
        self.mailboxes.get(nth).copied().unwrap_or_default()
    }

    /// A question: its bytes, and the last byte of the mailbox, by which it is handed over.
    fn post(
        &mut self,
        frame: &mut Frame,
        index: u8,
        question: Question,
    ) -> Option<(Matter, Slot, Option<Slot>)> {
        let (nth, message) = match question {
            Question::Probe => self.mail.question()?,
            Question::History => {
                let (nth, object) = self.history.question()?;
                (nth, message(object, None, self.mail.next_number(nth)))
            }
        };
        let mailbox = self.mailbox(nth);
        let (start, length) = mailbox.out;
        let at = Address::station(mailbox.station, start);
        let slot = frame.push(Command::Fpwr, index, at, MESSAGE)?;
        frame.data(&slot).copy_from_slice(&message);
        let end = start + length.saturating_sub(1);
        let at = Address::station(mailbox.station, end);
        let last = frame.push(Command::Fpwr, index, at, 1)?;
        Some((Matter::Post(question), slot, Some(last)))
    }

    /// What came back of them; what the next ones are about follows from that.
    pub(super) fn hear(&mut self, frame: &Frame, received: &[u8]) {
        let Some((matter, slot, last)) = self.sent.take() else {
            self.next = Matter::Look(self.turn);
            return;
        };
        let Some(answer) = frame.answer(&slot, received) else {
            return;
        };
        let is_there = answer.counter == 1;
        self.mail.pass();
        self.history.pass();
        match matter {
            Matter::Look(nth) if is_there && answer.data.first().is_some_and(|s| s & FULL != 0) => {
                self.next = Matter::Take(nth);
                return;
            }
            Matter::Take(nth)
                if is_there
                    && !self.mail.hear(nth, answer.data)
                    && !self.history.hear(nth, answer.data) =>
            {
                let code = emergency(answer.data).zip(self.mailboxes.get(nth));
                let told = code.map(|(code, mailbox)| (mailbox.nth, code));
                self.emergency = told.or(self.emergency);
            }
            Matter::Post(question) => {
                let last = last.and_then(|last| frame.answer(&last, received));
                let is_taken = is_there && last.is_some_and(|last| last.counter == 1);
                match question {
                    Question::Probe => self.mail.posted(is_taken),
                    Question::History => self.history.posted(is_taken),
                }
            }
            _ => {}
        }
        self.next = self.after();
    }

    /// What the next datagrams are about: mailboxes in turn, and every other time a question, if there is
    /// one.
    fn after(&mut self) -> Matter {
        self.was_mail = !self.was_mail;
        if self.was_mail {
            if self.mail.question().is_some() {
                return Matter::Post(Question::Probe);
            }
            if let Some(nth) = self.mail.waits_for() {
                return Matter::Look(nth);
            }
            // A touch probe is asked first: something waits for that.
            if self.history.question().is_some() {
                return Matter::Post(Question::History);
            }
            if let Some(nth) = self.history.waits_for() {
                return Matter::Look(nth);
            }
        }
        self.turn = (self.turn + 1) % self.mailboxes.len().max(1);
        Matter::Look(self.turn)
    }
}
