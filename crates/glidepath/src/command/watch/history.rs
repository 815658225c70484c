//! The history of what happened lately, in plain words.

use crate::report::counted;
use glidepath_link::{MachineState, Status};
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Events that are shown.
const KEPT: usize = 4;

/// The events since the watch began.
#[derive(Debug, Default)]
pub(super) struct History {
    events: VecDeque<(Instant, String)>,
    state: Option<MachineState>,
    missed: u64,
    error: String,
    message: String,
}

impl History {
    /// Looks what is new.
    pub(super) fn take(&mut self, status: &Status) {
        let is_first = self.state.is_none();
        if let Ok(state) = status.state()
            && self.state.replace(state) != Some(state)
        {
            let line = if status.line > 0 {
                format!(", line {}", status.line)
            } else {
                String::new()
            };
            self.add(format!(
                "{}{line}",
                state.text().split("; ").next().unwrap_or_default()
            ));
        }
        let missed = status.missed_ticks.saturating_sub(self.missed);
        self.missed = status.missed_ticks;
        if missed > 0 && !is_first {
            self.add(format!("the host let {} pass", counted(missed, "tick")));
        }
        let message = status.message.as_str();
        if message != self.message {
            message.clone_into(&mut self.message);
            if !message.is_empty() {
                self.add(format!("the program says: {message}"));
            }
        }
        let error = status.last_error.as_str();
        if error != self.error {
            error.clone_into(&mut self.error);
            if !error.is_empty() {
                self.add(error.to_owned());
            }
        }
    }

    fn add(&mut self, text: String) {
        self.events.push_front((Instant::now(), text));
        self.events.truncate(KEPT);
    }

    /// The last events, the newest first, with how long ago they were.
    pub(super) fn events(&self) -> Vec<(Duration, String)> {
        let events = self.events.iter();
        events
            .map(|(at, text)| (at.elapsed(), text.clone()))
            .collect()
    }
}
