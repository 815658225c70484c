//! The input arbiter, where a program that is read ahead asks what the machine's inputs and its probe
//! say.
//!
//! ```text
//!  source of items ── request ──► arbiter ◄── result ── publisher, once the machine rests there
//!        │   ▲ ◄────── result ─────┘  │
//!        │   └─── as before ── journal ◄── kept before the program is told
//! ```
//!
//! What a program does depends on what it is told. So the answers are kept in a journal, and a
//! program that is read again up to where it was left is told the same again.

use std::fmt::Debug;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glidepath_gcode::{InputWait, Probed};

/// The result of an input request of a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InputResult {
    /// What the input of an M66 is: `#5399`.
    Input(f64),
    /// How a probing move ended.
    Probe(Probed),
}

/// An answer, and the line of the program that asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnsweredInput {
    /// The line.
    pub line: u32,
    /// What it was told.
    pub answer: InputResult,
}

/// The journal, in which answers outlast the run of a program.
pub trait InputJournal: Debug + Send {
    /// The next of the answers that the same program was told before, in the order in which it
    /// asked.
    fn recall(&mut self) -> Option<AnsweredInput>;

    /// From here on it asks anew: what was not recalled does not hold any more.
    ///
    /// # Errors
    /// That cannot be written.
    fn end_recall(&mut self) -> io::Result<()>;

    /// Keeps an answer. When this returns, it outlasts the process, and a loss of power.
    ///
    /// # Errors
    /// It cannot be written.
    fn keep(&mut self, answered: &AnsweredInput) -> io::Result<()>;
}

/// An input request of a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum InputRequest {
    Input(InputWait),
    /// How the probing move ended that was handed over last.
    Probe,
}

/// The arbiter, of which a source of items asks and to which a publisher answers. Clones are the same one.
#[derive(Debug, Clone, Default)]
pub struct InputArbiter {
    arbiter: Arc<Mutex<ArbiterState>>,
}

#[derive(Debug, Default)]
struct ArbiterState {
    asked: Option<(u32, InputRequest)>,
    answer: Option<InputResult>,
    journal: Option<Box<dyn InputJournal>>,
    recalls: bool,
}

impl InputArbiter {
    /// Keeps answers in a journal from now on. A program that is read again is told at first what it
    /// was told before.
    pub fn keep_in(&self, journal: Box<dyn InputJournal>, recalls: bool) {
        let mut arbiter = self.arbiter();
        (arbiter.journal, arbiter.recalls) = (Some(journal), recalls);
    }

    /// Whether answers are kept.
    #[must_use]
    pub fn keeps(&self) -> bool {
        self.arbiter().journal.is_some()
    }

    /// The program was read up to where it is to begin: what it asks from here on is asked anew.
    ///
    /// # Errors
    /// The journal cannot be written.
    pub fn begin_here(&self) -> io::Result<()> {
        let mut arbiter = self.arbiter();
        if !std::mem::take(&mut arbiter.recalls) {
            return Ok(());
        }
        arbiter
            .journal
            .as_mut()
            .map_or(Ok(()), |journal| journal.end_recall())
    }

    /// What the program was told when it came here before.
    pub(crate) fn recall(&self) -> Option<AnsweredInput> {
        let mut arbiter = self.arbiter();
        let recalls = arbiter.recalls;
        arbiter.journal.as_mut().filter(|_| recalls)?.recall()
    }

    /// Asks.
    pub(crate) fn ask(&self, line: u32, request: InputRequest) {
        let mut arbiter = self.arbiter();
        (arbiter.asked, arbiter.answer) = (Some((line, request)), None);
    }

    /// The answer, once.
    pub(crate) fn take_answer(&self) -> Option<InputResult> {
        self.arbiter().answer.take()
    }

    /// What is asked of inputs and was not answered.
    pub(crate) fn asked(&self) -> Option<InputWait> {
        match self.arbiter().asked {
            Some((_, InputRequest::Input(wait))) => Some(wait),
            _ => None,
        }
    }

    /// Answers what is asked, and keeps the answer.
    ///
    /// # Errors
    /// It cannot be kept: the program is not told.
    pub(crate) fn answer(&self, answer: InputResult) -> io::Result<()> {
        let mut arbiter = self.arbiter();
        let line = arbiter.asked.map_or(0, |(line, _)| line);
        // What is answered now comes behind all that was recalled.
        let ends_recall = std::mem::take(&mut arbiter.recalls);
        if let Some(journal) = &mut arbiter.journal {
            if ends_recall {
                journal.end_recall()?;
            }
            journal.keep(&AnsweredInput { line, answer })?;
        }
        (arbiter.asked, arbiter.answer) = (None, Some(answer));
        Ok(())
    }

    fn arbiter(&self) -> MutexGuard<'_, ArbiterState> {
        self.arbiter.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
