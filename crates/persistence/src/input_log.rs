//! The journal of answers: what the machine answered a program that asked its inputs and its probe,
//! in the order in which it asked. With it the program can be read again up to where it was left,
//! as it was then.
//!
//! ```text
//!   # glidepath answers version 1 program 00c0ffee00c0ffee
//!   1 17 input 1 9f86d081884c7d65
//!   2 23 contact 5 2 -7.25 0 0 0 0 0 0 stands 5 2 -7.26 0 0 0 0 0 0 60303ae22b998861
//! ```
//!
//! Each line has its number, the line of the program that asked, what was said, and a checksum. It
//! is waited for before the program is told. So a line that is torn when the power goes is the last
//! one, and nobody was ever told what it says: it is left out. What is damaged anywhere else is told.

use crate::error::StoreError;
use crate::state::AXES;
use crate::storage::Storage;
use core::fmt::Write as _;
use core::hash::Hasher as _;
use twox_hash::XxHash64;

const NAME: &str = "answers";
const NEW: &str = "answers.new";
const HEAD: &str = "# glidepath answers version 1 program";

/// Most bytes that are kept: a hundred thousand inputs, or some thirty thousand contacts. What
/// comes later is not kept, and a program cannot be taken up again behind it.
const MOST_BYTES: usize = 8 << 20;

/// The content of an answer: the value of an input, or the end of a probing move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoggedValue {
    /// What an input was, as the program reads it.
    Input(f64),
    /// How a probing move ended, mm and degrees in machine coordinates.
    Probe {
        /// Where the axes were at the contact, if there was one.
        contact: Option<[f64; AXES]>,
        /// It was so before anything moved.
        was_so: bool,
        /// Where the machine came to rest.
        stands: [f64; AXES],
    },
}

/// An answer, and the line of the program that asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoggedInput {
    /// The line.
    pub line: u32,
    /// What was said.
    pub said: LoggedValue,
}

/// The answers to one run of a program.
#[derive(Debug)]
pub struct InputLog<S> {
    storage: S,
    program: u64,
    /// How many of the lines in the file are of this run.
    count: usize,
    /// The file has these lines and no others: `None` if that is not made sure of yet.
    bytes: Option<usize>,
}

impl<S: Storage> InputLog<S> {
    /// For a run of a program from its beginning: what an earlier run of it was told does not hold.
    ///
    /// # Errors
    /// The file of that run cannot be replaced.
    pub fn begin(storage: S, program: u64) -> Result<Self, StoreError> {
        let mut answers = Self::new(storage, program);
        if program_of(&answers.text()?) == Some(program) {
            answers.keep_first(0)?;
        }
        Ok(answers)
    }

    /// For a run of a program that goes on: with what it was told so far. There is nothing if the
    /// answers that are kept are those of another program.
    ///
    /// # Errors
    /// [`StoreError::Damaged`], or the file cannot be read.
    pub fn go_on(storage: S, program: u64) -> Result<(Self, Vec<LoggedInput>), StoreError> {
        let mut answers = Self::new(storage, program);
        let text = answers.text()?;
        let mut found = Vec::new();
        if program_of(&text) == Some(program) {
            found = answers.answers_in(&text)?;
            answers.count = found.len();
        }
        Ok((answers, found))
    }

    const fn new(storage: S, program: u64) -> Self {
        Self {
            storage,
            program,
            count: 0,
            bytes: None,
        }
    }

    /// Drops all but the first answers: what is asked behind them is asked anew. Nothing is lost
    /// before this returns, and the others are gone when it does.
    ///
    /// # Errors
    /// The file cannot be replaced.
    pub fn keep_first(&mut self, count: usize) -> Result<(), StoreError> {
        let text = self.text()?;
        let mut kept = format!("{HEAD} {:016x}\n", self.program);
        if program_of(&text) == Some(self.program) {
            let lines = text.split_inclusive('\n').skip(1);
            kept.extend(lines.take(count.min(self.count)));
        }
        let name = self.storage.describe(NEW);
        let storage = &mut self.storage;
        storage
            .create(NEW)
            .and_then(|()| storage.append(NEW, kept.as_bytes()))
            .and_then(|()| storage.sync(NEW))
            .map_err(StoreError::io("write", &name))?;
        storage
            .rename(NEW, NAME)
            .and_then(|()| storage.sync_names())
            .map_err(StoreError::io("rename", &name))?;
        self.count = count.min(self.count);
        self.bytes = Some(kept.len());
        Ok(())
    }

    /// Keeps an answer behind those that are kept. When this returns it outlasts a loss of power.
    ///
    /// # Errors
    /// It cannot be written: the program may not be told.
    pub fn keep(&mut self, answer: &LoggedInput) -> Result<(), StoreError> {
        if self.bytes.is_none() {
            self.keep_first(self.count)?;
        }
        let bytes = self.bytes.unwrap_or_default();
        let line = line_of(self.program, self.count + 1, answer);
        if bytes + line.len() > MOST_BYTES {
            // Nothing that comes later either: answers are told again in their order.
            self.bytes = Some(MOST_BYTES);
            return Ok(());
        }
        let name = self.storage.describe(NAME);
        // A line that is written in part is not to be in front of another.
        self.bytes = None;
        self.storage
            .append(NAME, line.as_bytes())
            .and_then(|()| self.storage.sync(NAME))
            .map_err(StoreError::io("write", &name))?;
        self.bytes = Some(bytes + line.len());
        self.count += 1;
        Ok(())
    }

    fn text(&self) -> Result<String, StoreError> {
        let name = self.storage.describe(NAME);
        let bytes = self.storage.read(NAME);
        let bytes = bytes.map_err(StoreError::io("read", &name))?;
        // What is no text is a damaged line, and found as that.
        Ok(String::from_utf8_lossy(&bytes.unwrap_or_default()).into_owned())
    }

    /// The answers in a text of this program, without a last line that is torn.
    fn answers_in(&self, text: &str) -> Result<Vec<LoggedInput>, StoreError> {
        let mut found = Vec::new();
        let mut is_torn = false;
        for (number, line) in (1..).zip(text.split_inclusive('\n').skip(1)) {
            match answer_of(self.program, line) {
                Some((of, answer)) if of == number && !is_torn => found.push(answer),
                // Bytes that were not written yet read as anything, but not as a right line.
                None => is_torn = true,
                Some(_) => {
                    return Err(StoreError::Damaged {
                        file: self.storage.describe(NAME),
                        reason: format!("its line {} is not what was written", found.len() + 2),
                    });
                }
            }
        }
        Ok(found)
    }
}

/// The program whose answers a text has.
fn program_of(text: &str) -> Option<u64> {
    let (head, _) = text.split_once('\n')?;
    u64::from_str_radix(head.strip_prefix(HEAD)?.trim(), 16).ok()
}

fn line_of(program: u64, number: usize, answer: &LoggedInput) -> String {
    let mut line = format!("{number} {}", answer.line);
    // Writing to a String does not fail.
    let mut say = |word: &str, values: &[f64]| {
        let _ = write!(line, " {word}");
        for value in values {
            let _ = write!(line, " {value}");
        }
    };
    match &answer.said {
        LoggedValue::Input(value) => say("input", &[*value]),
        LoggedValue::Probe {
            contact,
            was_so,
            stands,
        } => {
            match contact {
                Some(contact) if *was_so => say("already", contact),
                Some(contact) => say("contact", contact),
                None => say("none", &[]),
            }
            say("stands", stands);
        }
    }
    let sum = checksum(program, &line);
    let _ = writeln!(line, " {sum:016x}");
    line
}

/// The answer of a line, and its number.
fn answer_of(program: u64, line: &str) -> Option<(usize, LoggedInput)> {
    let (said, sum) = line.strip_suffix('\n')?.rsplit_once(' ')?;
    if sum != format!("{:016x}", checksum(program, said)) {
        return None;
    }
    let mut words = said.split(' ');
    let number = words.next()?.parse().ok()?;
    let line = words.next()?.parse().ok()?;
    let kind = words.next()?;
    let values: Option<Vec<f64>> = words
        .filter(|word| *word != "stands")
        .map(|word| word.parse().ok().filter(|value: &f64| value.is_finite()))
        .collect();
    let values = values?;
    let said = match (kind, values.as_slice()) {
        ("input", [value]) => LoggedValue::Input(*value),
        ("none", stands) => LoggedValue::Probe {
            contact: None,
            was_so: false,
            stands: stands.try_into().ok()?,
        },
        ("contact" | "already", values) => {
            let (contact, stands) = values.split_at_checked(AXES)?;
            LoggedValue::Probe {
                contact: Some(contact.try_into().ok()?),
                was_so: kind == "already",
                stands: stands.try_into().ok()?,
            }
        }
        _ => return None,
    };
    Some((number, LoggedInput { line, said }))
}

/// XXH64 (Collet), seeded with the program, of everything that is said.
fn checksum(program: u64, said: &str) -> u64 {
    let mut hash = XxHash64::with_seed(program);
    hash.write(said.as_bytes());
    hash.finish()
}
