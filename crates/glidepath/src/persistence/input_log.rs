//! The journal of what inputs and the probe answered the program under way, among what the machine
//! keeps.

use crate::persistence::error::StateError;
use glidepath_gcode::Probed;
use glidepath_geometry::AxisVector;
use glidepath_persistence::{AXES, Directory, InputLog, LoggedInput, LoggedValue};
use glidepath_planner::{AnsweredInput, InputJournal, InputResult};
use std::io;
use std::path::Path;
use std::vec::IntoIter;

/// The journal of one run. Whoever keeps what the machine keeps may write it.
#[derive(Debug)]
pub(crate) struct Journal {
    answers: InputLog<Directory>,
    /// What was answered before and was not recalled yet, and how much was.
    before: IntoIter<LoggedInput>,
    recalled: usize,
}

impl Journal {
    /// For a program that begins anew.
    ///
    /// # Errors
    /// What an earlier run of it was told cannot be dropped.
    pub(crate) fn begin(folder: &Path, program: u64) -> Result<Self, StateError> {
        Ok(Self {
            answers: InputLog::begin(Directory::open(folder)?, program)?,
            before: Vec::new().into_iter(),
            recalled: 0,
        })
    }

    /// For a program that goes on, or is to begin in its middle.
    ///
    /// # Errors
    /// What it was told cannot be read.
    pub(crate) fn go_on(folder: &Path, program: u64) -> Result<Self, StateError> {
        let opened = InputLog::go_on(Directory::open(folder)?, program);
        let (answers, before) = opened.map_err(StateError::Answers)?;
        Ok(Self {
            answers,
            before: before.into_iter(),
            recalled: 0,
        })
    }
}

impl InputJournal for Journal {
    fn recall(&mut self) -> Option<AnsweredInput> {
        let kept = self.before.next()?;
        self.recalled += 1;
        Some(answered(&kept))
    }

    fn end_recall(&mut self) -> io::Result<()> {
        let kept = self.answers.keep_first(self.recalled);
        kept.map_err(io::Error::other)
    }

    fn keep(&mut self, answered: &AnsweredInput) -> io::Result<()> {
        let kept = self.answers.keep(&kept(answered));
        kept.map_err(io::Error::other)
    }
}

fn kept(answered: &AnsweredInput) -> LoggedInput {
    let said = match answered.answer {
        InputResult::Input(value) => LoggedValue::Input(value),
        InputResult::Probe(probed) => LoggedValue::Probe {
            contact: probed.contact.map(|contact| places(&contact)),
            was_so: probed.was_so,
            stands: places(&probed.stands),
        },
    };
    LoggedInput {
        line: answered.line,
        said,
    }
}

fn answered(kept: &LoggedInput) -> AnsweredInput {
    let answer = match kept.said {
        LoggedValue::Input(value) => InputResult::Input(value),
        LoggedValue::Probe {
            contact,
            was_so,
            stands,
        } => InputResult::Probe(Probed {
            contact: contact.map(AxisVector::from),
            was_so,
            stands: AxisVector::from(stands),
        }),
    };
    AnsweredInput {
        line: kept.line,
        answer,
    }
}

fn places(position: &AxisVector) -> [f64; AXES] {
    (*position).into()
}
