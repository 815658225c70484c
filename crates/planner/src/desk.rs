//! The input desk, where a program that is read ahead asks what the machine's inputs and its probe
//! say.
//!
//! ```text
//!  source of items ── question ──► desk ◄── answer ── publisher, once the machine rests there
//!        │   ▲ ◄────── answer ─────┘  │
//!        │   └─── as before ── journal ◄── kept before the program is told
//! ```
//!
//! What a program does depends on what it is told. So the answers are kept in a journal, and a
//! program that is read again up to where it was left is told the same again.

use std::fmt::Debug;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glidepath_gcode::{InputWait, Probed};

/// An answer to a question of a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Answer {
    /// What the input of an M66 is: `#5399`.
    Input(f64),
    /// How a probing move ended.
    Probe(Probed),
}

/// An answer, and the line of the program that asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answered {
    /// The line.
    pub line: u32,
    /// What it was told.
    pub answer: Answer,
}

/// The journal, in which answers outlast the run of a program.
pub trait AnswerJournal: Debug + Send {
    /// The next of the answers that the same program was told before, in the order in which it
    /// asked.
    fn recall(&mut self) -> Option<Answered>;

    /// From here on it asks anew: what was not recalled does not hold any more.
    ///
    /// # Errors
    /// That cannot be written.
    fn end_recall(&mut self) -> io::Result<()>;

    /// Keeps an answer. When this returns, it outlasts the process, and a loss of power.
    ///
    /// # Errors
    /// It cannot be written.
    fn keep(&mut self, answered: &Answered) -> io::Result<()>;
}

/// A question of a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Question {
    Input(InputWait),
    /// How the probing move ended that was handed over last.
    Probe,
}

/// The desk at which a source of items asks and a publisher answers. Clones are the same desk.
#[derive(Debug, Clone, Default)]
pub struct InputDesk {
    desk: Arc<Mutex<Desk>>,
}

#[derive(Debug, Default)]
struct Desk {
    asked: Option<(u32, Question)>,
    answer: Option<Answer>,
    journal: Option<Box<dyn AnswerJournal>>,
    recalls: bool,
}

impl InputDesk {
    /// Keeps answers in a journal from now on. A program that is read again is told at first what it
    /// was told before.
    pub fn keep_in(&self, journal: Box<dyn AnswerJournal>, recalls: bool) {
        let mut desk = self.desk();
        (desk.journal, desk.recalls) = (Some(journal), recalls);
    }

    /// Whether answers are kept.
    #[must_use]
    pub fn keeps(&self) -> bool {
        self.desk().journal.is_some()
    }

    /// The program was read up to where it is to begin: what it asks from here on is asked anew.
    ///
    /// # Errors
    /// The journal cannot be written.
    pub fn begin_here(&self) -> io::Result<()> {
        let mut desk = self.desk();
        if !std::mem::take(&mut desk.recalls) {
            return Ok(());
        }
        desk.journal
            .as_mut()
            .map_or(Ok(()), |journal| journal.end_recall())
    }

    /// What the program was told when it came here before.
    pub(crate) fn recall(&self) -> Option<Answered> {
        let mut desk = self.desk();
        let recalls = desk.recalls;
        desk.journal.as_mut().filter(|_| recalls)?.recall()
    }

    /// Asks.
    pub(crate) fn ask(&self, line: u32, question: Question) {
        let mut desk = self.desk();
        (desk.asked, desk.answer) = (Some((line, question)), None);
    }

    /// The answer, once.
    pub(crate) fn take_answer(&self) -> Option<Answer> {
        self.desk().answer.take()
    }

    /// What is asked of inputs and was not answered.
    pub(crate) fn asked(&self) -> Option<InputWait> {
        match self.desk().asked {
            Some((_, Question::Input(wait))) => Some(wait),
            _ => None,
        }
    }

    /// Answers what is asked, and keeps the answer.
    ///
    /// # Errors
    /// It cannot be kept: the program is not told.
    pub(crate) fn answer(&self, answer: Answer) -> io::Result<()> {
        let mut desk = self.desk();
        let line = desk.asked.map_or(0, |(line, _)| line);
        // What is answered now comes behind all that was recalled.
        let ends_recall = std::mem::take(&mut desk.recalls);
        if let Some(journal) = &mut desk.journal {
            if ends_recall {
                journal.end_recall()?;
            }
            journal.keep(&Answered { line, answer })?;
        }
        (desk.asked, desk.answer) = (None, Some(answer));
        Ok(())
    }

    fn desk(&self) -> MutexGuard<'_, Desk> {
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
