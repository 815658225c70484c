//! Lines that are executed, and what comes of them.

use std::time::Duration;

use super::awaited::Waiting;
use super::{Latch, Session};
use crate::error::ErrorNumber;
use crate::line::{Wanted, is_idle_g53, not_of_senders, wanted};
use crate::state::State;
use crate::stream::{Outcome, Refused};
use crate::words::{without_comments, words};
use crate::{Act, Alarm, Doing};

impl Session {
    /// Does what lines want, as far as that is possible now.
    pub(super) fn process(&mut self, now: Duration) {
        while self.process_next(now) {}
        self.tell_questions();
    }

    /// Does what the next line wants. Returns whether there may be more to do.
    fn process_next(&mut self, now: Duration) -> bool {
        if self.reset.is_some() || self.waiting != Waiting::Nothing {
            return false;
        }
        let Some(line) = self.lines.get(self.given) else {
            return false;
        };
        let is_first = self.given == 0;
        if line.is_too_long {
            if is_first {
                self.answer_error(ErrorNumber::TOO_LONG, "a line has at most 256 characters");
            }
            return is_first;
        }
        let (text, asked_ns, is_late) = (line.text.clone(), line.asked_ns, line.is_late);
        let line_is_told = line.is_told;
        match wanted(&text) {
            Wanted::Nothing if is_first => {
                self.answer_ok();
                true
            }
            Wanted::Nothing => self.give("", asked_ns),
            Wanted::Code => self.process_code(&text, asked_ns),
            Wanted::Jog(_) | Wanted::Home(_) if is_first && is_late => {
                let why = "the endpoint stood still: nobody knows when this was sent";
                self.answer_error(ErrorNumber::NOT_IDLE, why);
                true
            }
            // The answer was told while lines before it waited.
            _ if is_first && line_is_told => {
                self.answer_ok();
                true
            }
            statement if is_first => self.process_statement(statement, now),
            // Answers come in order.
            _ => false,
        }
    }

    fn process_code(&mut self, text: &str, asked_ns: u64) -> bool {
        let is_first = self.given == 0;
        let words = words(text);
        let without_g53;
        let text = if is_idle_g53(&words) {
            without_g53 = without_comments(text).replace("G53", "");
            &without_g53
        } else {
            text
        };
        if let Some((number, why)) = not_of_senders(&words) {
            if is_first {
                self.answer_error(number, why);
            }
            return is_first;
        }
        match self.state() {
            State::Alarm | State::Sleep | State::Jog | State::Home if !is_first => false,
            State::Alarm | State::Sleep => {
                self.answer_error(ErrorNumber::LOCKED, "the machine is locked: $X unlocks it");
                true
            }
            State::Jog | State::Home => {
                self.answer_error(ErrorNumber::LOCKED, "the machine is moved by hand");
                true
            }
            State::Check => {
                self.waiting = Waiting::Judgement;
                self.acts.push(Act::Judge(text.to_owned()));
                false
            }
            State::Idle | State::Run | State::Hold { .. } | State::Door { .. } => {
                self.latch == Latch::Free && self.give(text, asked_ns)
            }
        }
    }

    /// Gives a line to the stream, if there is room.
    fn give(&mut self, text: &str, asked_ns: u64) -> bool {
        if !self.stream.has_room() {
            return false;
        }
        self.stream.push(text, asked_ns);
        self.given += 1;
        true
    }

    /// The line that waits for it was judged.
    pub fn judged(&mut self, refused: Option<&Refused>) {
        if self.waiting != Waiting::Judgement {
            return;
        }
        self.waiting = Waiting::Nothing;
        match refused {
            None => self.answer_ok(),
            Some(refused) => {
                let number = self.number_of(refused);
                self.answer_error(number, &refused.text);
            }
        }
    }

    /// What came of lines that were given.
    pub(super) fn take_outcome(&mut self, outcome: Outcome, now: Duration) {
        match outcome {
            Outcome::Read => self.answer_given(None, ""),
            Outcome::ProgramEnd => {
                self.message("Pgm End");
                self.overrides.reset(now, &mut self.acts);
            }
            Outcome::Refused(refused) => self.take_refusal(&refused),
            Outcome::NotBegun(why) => {
                self.stream.drop_oldest();
                let is_ready = matches!(self.machine.doing, Doing::NotHomed | Doing::Off);
                let number = if is_ready {
                    ErrorNumber::LOCKED
                } else {
                    ErrorNumber::NOT_IDLE
                };
                self.answer_given(Some(number), &why);
            }
            Outcome::Failed(why) => {
                // What was given waits again, and is refused as long as the machine is locked.
                self.stream.forget_unread();
                self.given = 0;
                if self.machine.doing != Doing::Faulted {
                    self.alarm = Some(Alarm::Stopped);
                    self.say(&format!("ALARM:{}", Alarm::Stopped.number()));
                    self.message(&why);
                }
            }
        }
    }

    fn take_refusal(&mut self, refused: &Refused) {
        if refused.name == "probe" {
            let alarm = if self.facts.probe_made {
                Alarm::ProbeAtFirst
            } else {
                Alarm::ProbeNothing
            };
            self.alarm = Some(alarm);
            self.say(&format!("ALARM:{}", alarm.number()));
            self.message(&refused.text);
            self.answer_given(None, "");
            return;
        }
        let text = match refused.column {
            0 => refused.text.clone(),
            column => format!("column {column}: {}", refused.text),
        };
        let number = self.number_of(refused);
        self.answer_given(Some(number), &text);
        // What is behind it in the sender's stream is not executed without somebody who says so.
        if refused.is_in_motion && self.latch == Latch::Free {
            self.latch = Latch::Hold;
            self.message("The machine comes to rest before the line that was refused");
        }
    }

    /// The number for the oldest line, which was refused.
    fn number_of(&self, refused: &Refused) -> ErrorNumber {
        let line = self.lines.front().map_or("", |line| line.text.as_str());
        ErrorNumber::of_refusal(&refused.name, &words(line))
    }

    /// Answers the oldest line, which was given. Where it was dropped meanwhile, nobody waits for an answer.
    fn answer_given(&mut self, error: Option<ErrorNumber>, why: &str) {
        if self.given == 0 {
            return;
        }
        self.given -= 1;
        match error {
            None => self.answer_ok(),
            Some(number) => self.answer_error(number, why),
        }
    }
}
