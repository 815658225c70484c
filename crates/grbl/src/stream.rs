//! The stream of a sender: its lines as jobs of the planner's service.
//!
//! ```text
//!   line ──► unread ──given──► service ──read──► answered
//!                 │                │
//!                 │                └ a job ends: nothing more has come, M2, a line that was refused, an abort
//!                 └ what is left is given to the next job
//! ```

use std::collections::VecDeque;

use crate::Facts;

/// Lines that are not read, at most.
const MOST_UNREAD: usize = 64;
/// Text of one request at most, bytes.
const MOST_TEXT: usize = 1000;

/// A wish about a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JobIntent {
    /// The lines are to be executed; the first of them begins the job.
    Execute,
    /// How it stands.
    Ask,
    /// What was read is executed, and nothing more.
    Close,
    /// It is to end: the motion comes to rest on the path.
    Cancel,
    /// There is none: modes and offsets are to be those of a machine that was switched on. It is asked for until it is
    /// told to be over.
    Reset,
}

/// A request to the planner's service.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Counts the jobs of this endpoint; 0 to ask how the machine is set up.
    pub job: u64,
    /// What is wanted of it.
    pub wish: JobIntent,
    /// The number of the first of the lines, from 1.
    pub first: u64,
    /// Lines of the job.
    pub lines: Vec<String>,
    /// When the line that began the job was sent at the earliest, ns of the clock of
    /// [`Session::ask_at`](crate::Session::ask_at).
    pub asked_ns: u64,
}

/// A line that was refused. It has no effect, and ends its job behind the line before.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    /// Byte of the line, from 1; 0 if it is about no place.
    pub column: u32,
    /// The stable name of the diagnostic.
    pub name: String,
    /// What, why, and how to mend it.
    pub text: String,
    /// Lines before it are still executed.
    pub is_in_motion: bool,
}

/// The end of a job.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// All that was read was executed.
    Done,
    /// Likewise, and the last line ended a program.
    ProgramEnd,
    /// It has not begun: somebody else has the machine, or it is not ready.
    NotBegun(String),
    /// The motion ended before it did.
    Failed(String),
}

/// The stage of a job.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stage {
    /// Nothing is known of it.
    Unknown,
    /// Lines are taken, read and executed.
    Open,
    /// It has ended.
    Over(End),
}

/// The answer of the planner's service.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// The job that was asked about.
    pub job: u64,
    /// How it stands.
    pub stage: Stage,
    /// Lines of it that have come.
    pub taken: u64,
    /// Lines of it that were read, and, where they end at rest, executed.
    pub read: u64,
    /// The line behind those was refused.
    pub refused: Option<Refused>,
    /// Motion that is planned ahead of what is executed, s; above 0 as long as anything that was read is not
    /// executed.
    pub ahead_t: f64,
    /// How the machine is set up.
    pub facts: Facts,
}

/// What came of lines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The oldest line was read.
    Read,
    /// The oldest line was refused.
    Refused(Refused),
    /// A program ended with the line that is read next.
    ProgramEnd,
    /// The job has not begun.
    NotBegun(String),
    /// The motion of the job ended before it did.
    Failed(String),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Phase {
    /// No job.
    #[default]
    None,
    Open,
    /// Nothing more is given.
    Closing,
    /// It is to end.
    Cancelling,
}

/// A line that is not read.
#[derive(Debug)]
struct Unread {
    text: String,
    asked_ns: u64,
}

/// The lines of a sender, and the job they belong to.
#[derive(Debug, Default)]
pub(crate) struct Stream {
    job: u64,
    phase: Phase,
    /// When the line that began the job was sent.
    asked_ns: u64,
    unread: VecDeque<Unread>,
    taken: u64,
    read: u64,
    /// Lines of jobs before.
    before: u64,
    /// A reset of modes and offsets that is not done: its number, once there is no job.
    reset: Option<u64>,
}

impl Stream {
    pub(crate) fn has_room(&self) -> bool {
        self.unread.len() < MOST_UNREAD && matches!(self.phase, Phase::None | Phase::Open)
    }

    /// Whether a job is under way.
    pub(crate) const fn is_open(&self) -> bool {
        !matches!(self.phase, Phase::None)
    }

    pub(crate) fn has_unread(&self) -> bool {
        !self.unread.is_empty()
    }

    /// Modes and offsets are to be reset. There is no job.
    pub(crate) const fn reset(&mut self) {
        self.job += 1;
        self.reset = Some(self.job);
    }

    /// Whether a reset of modes and offsets is not done.
    pub(crate) const fn is_resetting(&self) -> bool {
        self.reset.is_some()
    }

    /// The number of a line of the present job among all lines.
    pub(crate) const fn number(&self, line: u64) -> u64 {
        self.before + line
    }

    /// Takes a line that was sent at `asked_ns` at the earliest.
    pub(crate) fn push(&mut self, text: &str, asked_ns: u64) {
        let text = text.to_owned();
        self.unread.push_back(Unread { text, asked_ns });
    }

    /// Lines that are not read are asked for anew.
    pub(crate) fn ask_anew(&mut self, asked_ns: u64) {
        for line in &mut self.unread {
            line.asked_ns = asked_ns;
        }
    }

    /// What was read is executed, and nothing more.
    pub(crate) const fn close(&mut self) {
        if matches!(self.phase, Phase::Open) {
            self.phase = Phase::Closing;
        }
    }

    /// The job is to end, and lines that are not read are forgotten.
    pub(crate) fn cancel(&mut self) {
        self.unread.clear();
        if self.is_open() {
            self.phase = Phase::Cancelling;
        }
    }

    /// Lines that are not read are forgotten, and what was read is executed.
    pub(crate) fn abandon(&mut self) {
        self.unread.clear();
        self.close();
    }

    /// Lines that are not read are to be given once more.
    pub(crate) fn forget_unread(&mut self) {
        self.unread.clear();
    }

    /// What to ask. `may_begin`: lines may begin a job.
    pub(crate) fn request(&mut self, may_begin: bool) -> Request {
        if let Some(first) = self.unread.front()
            && self.phase == Phase::None
            && may_begin
        {
            // It may have come while the job before was under way.
            self.asked_ns = first.asked_ns;
            self.before += self.read;
            (self.job, self.phase) = (self.job + 1, Phase::Open);
            (self.taken, self.read) = (0, 0);
        }
        let wish = match self.phase {
            Phase::None => {
                return Request {
                    job: self.reset.unwrap_or(0),
                    wish: match self.reset {
                        Some(_) => JobIntent::Reset,
                        None => JobIntent::Ask,
                    },
                    first: 1,
                    lines: Vec::new(),
                    asked_ns: 0,
                };
            }
            Phase::Open => JobIntent::Execute,
            Phase::Closing => JobIntent::Close,
            Phase::Cancelling => JobIntent::Cancel,
        };
        let given = usize::try_from(self.taken - self.read).unwrap_or(usize::MAX);
        let mut lines = Vec::new();
        let mut bytes = 0;
        for line in self.unread.iter().skip(given) {
            bytes += line.text.len() + 1;
            if wish != JobIntent::Execute || bytes > MOST_TEXT {
                break;
            }
            lines.push(line.text.clone());
        }
        Request {
            job: self.job,
            wish: if lines.is_empty() && wish == JobIntent::Execute && self.taken > 0 {
                JobIntent::Ask
            } else {
                wish
            },
            first: self.taken + 1,
            lines,
            asked_ns: self.asked_ns,
        }
    }

    /// What came of lines.
    pub(crate) fn hear(&mut self, told: &Told) -> Vec<Outcome> {
        let mut outcomes = Vec::new();
        if self.reset == Some(told.job) && told.stage == Stage::Over(End::Done) {
            self.reset = None;
        }
        if self.phase == Phase::None || told.job != self.job {
            return outcomes;
        }
        self.taken = self.taken.max(told.taken);
        let is_program_end = told.stage == Stage::Over(End::ProgramEnd);
        while self.read < told.read {
            self.read += 1;
            if is_program_end && self.read == told.read {
                outcomes.push(Outcome::ProgramEnd);
            }
            if self.unread.pop_front().is_some() {
                outcomes.push(Outcome::Read);
            }
        }
        if let (Some(refused), Phase::Open) = (&told.refused, self.phase) {
            self.phase = Phase::Closing;
            if self.unread.pop_front().is_some() {
                outcomes.push(Outcome::Refused(refused.clone()));
            }
        }
        let was_cancelled = self.phase == Phase::Cancelling;
        let end = match &told.stage {
            Stage::Open => return outcomes,
            Stage::Unknown => Outcome::Failed("the planner's service was started anew".to_owned()),
            Stage::Over(End::Done | End::ProgramEnd) => {
                self.phase = Phase::None;
                return outcomes;
            }
            Stage::Over(End::NotBegun(why)) => Outcome::NotBegun(why.clone()),
            Stage::Over(End::Failed(why)) => Outcome::Failed(why.clone()),
        };
        self.phase = Phase::None;
        if !was_cancelled {
            outcomes.push(end);
        }
        outcomes
    }

    /// Nobody executes lines.
    pub(crate) fn lose_service(&mut self, why: &str) -> Option<Outcome> {
        let phase = core::mem::take(&mut self.phase);
        // Another one begins as if it were reset.
        self.reset = None;
        match phase {
            Phase::None | Phase::Cancelling => None,
            Phase::Open if self.taken == 0 => Some(Outcome::NotBegun(why.to_owned())),
            Phase::Open | Phase::Closing => Some(Outcome::Failed(why.to_owned())),
        }
    }

    /// The oldest line, which is not executed.
    pub(crate) fn drop_oldest(&mut self) {
        self.unread.pop_front();
    }
}

#[cfg(test)]
mod tests;
