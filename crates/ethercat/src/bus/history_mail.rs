//! The questions for the diagnosis history of a device (0x10F3), beside the cycles of OP.
//!
//! Once at the beginning every device is asked which of its messages is the newest: what is older is not about what
//! happens later. When it reports a fault, or leaves OP by itself, it is asked that again, and then for the message.
//! Nobody waits for it: one datagram a frame, and never while a touch probe is asked. A device that has nothing new
//! yet is asked again and again for a while, and one without a history once.

use super::mailbox::Mailbox;
use crate::coe::{self, Object, Reply, object};
use crate::diagnosis::Diagnosis;

/// The number of the newest message.
const NEWEST: Object = object(0x10f3, 2, 1);
const HISTORY: u16 = 0x10f3;
/// Messages are behind this subindex.
const FIRST: u8 = 6;
/// Frames between two questions for something new, and how often they are asked.
const PAUSE: u32 = 50;
const MOST_QUESTIONS: u32 = 20;
/// Frames that an answer may take until it is given up.
const PATIENCE: u32 = 1000;
/// Where in a message the data of an object is that comes as a whole.
const DATA: usize = 16;

/// What is known of a device's history.
#[derive(Debug, Clone, Copy, Default)]
struct History {
    /// It has told that it has none.
    is_absent: bool,
    /// The newest message that is known; `None` before it was asked.
    newest: Option<u8>,
    /// It is to be asked.
    is_wanted: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum What {
    Newest,
    Message(u8),
}

/// A question under way.
#[derive(Debug, Clone, Copy)]
struct Question {
    mailbox: usize,
    what: What,
    /// Frames since the device has taken it; `None` before.
    since: Option<u32>,
    asked: u32,
    /// Frames until it is asked.
    pause: u32,
}

/// The histories of all devices with a mailbox.
#[derive(Debug, Default)]
pub(super) struct HistoryMail {
    histories: Vec<History>,
    question: Option<Question>,
    told: Option<(usize, Diagnosis)>,
}

impl HistoryMail {
    pub(super) fn new(mailboxes: &[Mailbox]) -> Self {
        let at_first = History {
            is_wanted: true,
            ..History::default()
        };
        Self {
            histories: vec![at_first; mailboxes.len()],
            question: None,
            told: None,
        }
    }

    /// A device is to be asked, by the number of its mailbox.
    pub(super) fn want(&mut self, mailbox: usize) {
        if let Some(history) = self.histories.get_mut(mailbox)
            && !history.is_absent
        {
            history.is_wanted = true;
        }
        self.ask_next();
    }

    /// The message that came last, and from which mailbox; `None` if that was told.
    pub(super) const fn take(&mut self) -> Option<(usize, Diagnosis)> {
        self.told.take()
    }

    fn ask_next(&mut self) {
        if self.question.is_some() {
            return;
        }
        let wanted = self.histories.iter().position(|history| history.is_wanted);
        self.question = wanted.map(|mailbox| {
            self.histories[mailbox].is_wanted = false;
            Question {
                mailbox,
                what: What::Newest,
                since: None,
                asked: 0,
                pause: 0,
            }
        });
    }

    const fn asks(question: Question) -> Object {
        match question.what {
            What::Newest => NEWEST,
            What::Message(sub) => object(HISTORY, sub, 4),
        }
    }

    /// The message that is to be sent, without its number, and to which mailbox.
    pub(super) fn question(&self) -> Option<(usize, Object)> {
        let question = self.question?;
        let is_due = question.since.is_none() && question.pause == 0;
        is_due.then(|| (question.mailbox, Self::asks(question)))
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
        Some(question.mailbox)
    }

    /// A frame has passed.
    pub(super) fn pass(&mut self) {
        let Some(question) = &mut self.question else {
            self.ask_next();
            return;
        };
        question.pause = question.pause.saturating_sub(1);
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
        let Some(question) = self.question else {
            return false;
        };
        let reply = coe::reply(message, Self::asks(question));
        let next = match (question.what, reply) {
            (_, Reply::Other) => return false,
            (What::Newest, Reply::Value(newest)) => self.see(question, newest),
            (What::Message(sub), Reply::Longer(told)) => {
                let end = DATA + told as usize;
                // What is longer than the mailbox has its head in the first part.
                let data = message.get(DATA..end.min(message.len()));
                if let Some(diagnosis) = data.and_then(Diagnosis::read) {
                    self.histories[mailbox].newest = Some(sub);
                    self.told = Some((mailbox, diagnosis));
                }
                None
            }
            (What::Newest, _) => {
                self.histories[mailbox].is_absent = true;
                None
            }
            (What::Message(_), _) => None,
        };
        self.question = next;
        self.ask_next();
        true
    }

    /// The number of the newest message has come. Returns what is asked next.
    fn see(&mut self, question: Question, newest: u32) -> Option<Question> {
        let newest = u8::try_from(newest).unwrap_or(0);
        let history = self.histories.get_mut(question.mailbox)?;
        let Some(known) = history.newest else {
            history.newest = Some(newest);
            return None;
        };
        if newest >= FIRST && known != newest {
            return Some(Question {
                what: What::Message(newest),
                since: None,
                ..question
            });
        }
        let asked = question.asked + 1;
        (asked < MOST_QUESTIONS).then_some(Question {
            since: None,
            asked,
            pause: PAUSE,
            ..question
        })
    }
}
