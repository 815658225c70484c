//! The source of items of a job of lines, which tells what came of each line.

use std::io::{self, BufRead, Read};

use glidepath_gcode::{InForce, Options, Program};
use glidepath_geometry::AxisVector;
use glidepath_program::{Event, ItemKind};

use super::facts::{Found, LineFacts};
use super::inbox::{LineInbox, Refused};
use crate::run::refusal::Refusal;
use crate::source::item_source::{ItemSource, Supply};
use crate::source::program::ProgramSource;
use crate::source::run_channels::RunChannels;

/// The items of the lines of an inbox. What is read is told there.
#[derive(Debug)]
pub struct SentLines {
    source: ProgramSource<InboxReader>,
    inbox: LineInbox,
    /// Items handed over.
    given: u32,
    /// The line read last ends at rest.
    ends_at_rest: bool,
    words: String,
    zero: AxisVector,
    changes: u64,
    found: Found,
    /// Lines of which it is noted what they leave in force.
    noted_lines: u64,
}

impl SentLines {
    /// A source of what comes into an inbox, read with these options. It shares what it comes to
    /// with whoever attends to its run.
    #[must_use]
    pub fn new(inbox: LineInbox, options: Options, channels: RunChannels) -> Self {
        let reader = InboxReader {
            inbox: inbox.clone(),
            line: Vec::new(),
            passed: 0,
        };
        let source = ProgramSource::typed(reader, options).attended(channels);
        let (facts, found) = (LineFacts::of(source.program()), inbox.found());
        let (words, zero) = (facts.words.clone(), facts.zero);
        inbox.know(facts, found);
        Self {
            source,
            inbox,
            given: 0,
            ends_at_rest: false,
            words,
            zero,
            changes: 0,
            found,
            noted_lines: 0,
        }
    }

    /// The state in force behind the lines that were read.
    #[must_use]
    pub fn in_force(&self) -> InForce {
        self.source.in_force()
    }

    fn program(&self) -> &Program<InboxReader> {
        self.source.program()
    }

    /// Notes what the lines that were read leave in force, behind so many items.
    fn note(&mut self, behind: u32) {
        if let Some(probed) = self.source.take_probed() {
            self.found.look(&probed);
        }
        let facts = LineFacts::of(self.program());
        let changes = self.program().changes();
        let lines = self.source.lines_read();
        let is_new = facts.words != self.words || changes != self.changes;
        if facts.zero != self.zero {
            self.inbox.note_zero(behind, facts.zero);
        }
        // What lines assign to parameters shows in no word.
        if is_new || (lines != self.noted_lines && self.program().assigns()) {
            self.inbox.note_state(behind, self.source.in_force());
        }
        self.words.clone_from(&facts.words);
        (self.zero, self.changes, self.noted_lines) = (facts.zero, changes, lines);
        self.inbox.know(facts, self.found);
    }

    fn refuse(&mut self, refusal: &Refusal, behind: u32) -> Supply {
        let lines = self.source.lines_read();
        self.note(behind);
        self.inbox.has_read(lines.saturating_sub(1));
        let first = match refusal {
            Refusal::Program { diagnostics, .. } => diagnostics.first(),
            _ => None,
        };
        self.inbox.refuse(match first {
            Some(found) => Refused {
                column: found.column,
                diagnostic: found.code.as_str().to_owned(),
                text: joined(&[&found.message, &found.reason, &found.help]),
                in_motion: false,
            },
            None => Refused {
                diagnostic: "read-failed".to_owned(),
                text: refusal.to_string(),
                ..Refused::default()
            },
        });
        Supply::End
    }

    /// Whether lines wait for what was given out.
    fn waits(&mut self) -> bool {
        let is_asking = self.program().is_at_probe() || self.source.is_asking();
        if is_asking || !self.program().is_line_given() {
            return false;
        }
        if self.ends_at_rest {
            if !self.inbox.rests() {
                return true;
            }
            self.ends_at_rest = false;
            self.inbox.has_read(self.source.lines_read());
        }
        self.inbox.is_ahead()
    }
}

impl ItemSource for SentLines {
    fn next_item(&mut self) -> Supply {
        if self.inbox.is_over() {
            return Supply::End;
        }
        if self.waits() {
            return Supply::Pending;
        }
        let behind = self.given;
        match self.source.next_item() {
            Supply::Item(item) => {
                self.given = self.given.saturating_add(1);
                self.ends_at_rest |= ends_at_rest(&item.kind);
                self.inbox.give(matches!(item.kind, ItemKind::Move { .. }));
                self.note(behind);
                let lines = self.source.lines_read();
                let is_whole = !self.ends_at_rest && self.program().is_line_given();
                let is_probing = self.program().is_at_probe();
                let read = if is_whole && !is_probing {
                    lines
                } else {
                    lines - 1
                };
                self.inbox.has_read(read);
                Supply::Item(item)
            }
            Supply::Pending if self.source.is_asking() => Supply::Pending,
            Supply::Pending => {
                self.note(behind);
                let is_settled = self.program().is_settled();
                let lines = self.source.lines_read();
                if self.inbox.is_storing() {
                    self.inbox.has_read(lines.saturating_sub(1));
                    if self.inbox.end_if_storing(lines, is_settled) {
                        return Supply::End;
                    }
                }
                self.inbox.has_read(lines);
                if self.inbox.end_if_done(is_settled) {
                    return Supply::End;
                }
                Supply::Pending
            }
            Supply::Probe => Supply::Probe,
            Supply::End => {
                self.note(behind);
                // The end of a program leaves modes of its own.
                let facts = LineFacts {
                    words: self.source.in_force().words(),
                    ..LineFacts::of(self.program())
                };
                self.inbox.know(facts, self.found);
                self.inbox.end_program(self.source.lines_read());
                Supply::End
            }
            Supply::Refused(refusal) => self.refuse(&refusal, behind),
        }
    }

    fn is_silent(&mut self) -> bool {
        // While lines wait for the machine, more of them may be there.
        self.inbox.is_silent() && !self.inbox.is_ahead()
    }

    fn lines_read(&self) -> u64 {
        self.source.lines_read()
    }

    fn is_on_contour(&self) -> bool {
        self.source.is_on_contour()
    }
}

/// Whether a sender is answered only when it is executed. What a probe finds is answered anyhow.
const fn ends_at_rest(kind: &ItemKind) -> bool {
    match kind {
        ItemKind::Move { .. } => false,
        ItemKind::Dwell(_) => true,
        ItemKind::Event(Event::Probe { .. }) => false,
        ItemKind::Event(event) => event.is_at_rest(),
    }
}

/// Sentences in one.
fn joined(parts: &[&str]) -> String {
    let said: Vec<&str> = parts
        .iter()
        .copied()
        .filter(|part| !part.is_empty())
        .collect();
    said.join("; ")
}

/// Reads an inbox, a line at a time: what stands behind the end of a job is left there.
#[derive(Debug)]
struct InboxReader {
    inbox: LineInbox,
    line: Vec<u8>,
    passed: usize,
}

impl Read for InboxReader {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let length = {
            let mut from = self.fill_buf()?;
            from.read(into)?
        };
        self.consume(length);
        Ok(length)
    }
}

impl BufRead for InboxReader {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.passed >= self.line.len() {
            self.line.clear();
            self.passed = 0;
            self.inbox.next_line(&mut self.line);
        }
        Ok(self.line.get(self.passed..).unwrap_or_default())
    }

    fn consume(&mut self, amount: usize) {
        self.passed = self.passed.saturating_add(amount);
    }
}
