//! What a sender is told: answers to its lines, reports, messages.

use super::Session;
use crate::error::ErrorNumber;
use crate::report::{BLOCKS, Beside};
use crate::state::State;

impl Session {
    pub(super) fn say_report(&mut self, is_full: bool) {
        let state = self.state();
        let ahead_r = self.ahead_t / self.settings.ahead_t;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and 15"
        )]
        let taken = (ahead_r.clamp(0.0, 1.0) * f64::from(BLOCKS)).ceil() as u32;
        let is_open = self.stream.is_open();
        let beside = Beside {
            state,
            axes: &self.settings.axes,
            units: self.units,
            mask: self.mask,
            free_blocks: BLOCKS - if is_open { taken } else { 0 },
            free_bytes: self.settings.rx_bytes.saturating_sub(self.kept_bytes()),
            line: match self.machine.line {
                line @ 1.. if is_open => self.stream.number(line.into()),
                _ => 0,
            },
            overrides: self.overrides.percents(),
            is_full,
        };
        let text = self.reporter.report(&self.machine, &beside);
        self.say(&text);
    }

    pub(super) fn welcome(&mut self) {
        self.reporter.begin_anew();
        self.say("");
        self.say("Grbl 1.1h ['$' for help]");
        if self.state() == State::Alarm {
            self.message("'$H'|'$X' to unlock");
        }
    }

    pub(super) fn say(&mut self, text: &str) {
        self.out.extend_from_slice(text.as_bytes());
        self.out.extend_from_slice(b"\r\n");
    }

    /// Something for people. Brackets would end it early.
    pub(super) fn message(&mut self, text: &str) {
        let is_plain = |c: char| c.is_ascii() && !c.is_ascii_control() && !matches!(c, '[' | ']');
        let plain: String = text
            .chars()
            .map(|c| if is_plain(c) { c } else { ' ' })
            .collect();
        self.say(&format!("[MSG:{}]", plain.trim()));
    }

    /// Answers the oldest line.
    pub(super) fn answer_ok(&mut self) {
        if self.lines.pop_front().is_some() {
            self.say("ok");
        }
    }

    /// Likewise, with why it is refused.
    pub(super) fn answer_error(&mut self, number: ErrorNumber, why: &str) {
        if self.lines.pop_front().is_some() {
            self.message(why);
            self.say(&format!("error:{}", number.0));
        }
    }
}
