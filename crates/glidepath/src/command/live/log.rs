//! The log of events since the page is served, in plain words.

use super::day::now_ms;
use crate::report::counted;
use glidepath_link::{MachineState, StateChange, Status};
use serde_json::{Value, json};
use std::collections::VecDeque;

/// Events that are remembered.
const KEPT: usize = 100;

#[derive(Debug)]
struct Entry {
    at_ms: u64,
    kind: &'static str,
    text: String,
    /// What is counted, how often, and since when: events of the same kind one after the other are one entry.
    counted: Option<(&'static str, u64, u64)>,
}

/// The events, the newest first.
#[derive(Debug, Default)]
pub(super) struct Log {
    entries: VecDeque<Entry>,
    state: Option<MachineState>,
    /// Nobody serves the machine.
    is_gone: bool,
    counts: [u64; 3],
    overrides: [f64; 2],
    error: String,
    event: String,
}

impl Log {
    /// Looks what is new.
    pub(super) fn take(&mut self, status: &Status) {
        let is_first = self.state.is_none();
        self.is_gone = false;
        let line = match status.line {
            0 => String::new(),
            line => format!(", line {line}"),
        };
        if let Ok(state) = status.state()
            && self.state.replace(state) != Some(state)
        {
            let kind = match state {
                MachineState::Faulted => "bad",
                MachineState::Starving | MachineState::Starved => "warn",
                MachineState::Idle
                | MachineState::Running
                | MachineState::Holding
                | MachineState::Held
                | MachineState::ProgramStop
                | MachineState::Stopping
                | MachineState::Waiting
                | MachineState::Awaiting
                | MachineState::Jogging
                | MachineState::Homing
                | MachineState::Off
                | MachineState::NotHomed
                | MachineState::Preparing => "state",
            };
            // How one goes on is said where the machine is shown, not where its past is.
            let words = state.text().split("; ").next().unwrap_or_default();
            self.add(kind, format!("{words}{line}"));
        }
        self.count(status, is_first);
        let overrides = [status.feed_override, status.rapid_override];
        for ((name, now), was) in ["feed", "rapid"]
            .into_iter()
            .zip(overrides)
            .zip(self.overrides)
        {
            if !is_first && (now - was).abs() > 1e-9 {
                self.add("info", format!("{name} override {:.0} %", now * 100.0));
            }
        }
        self.overrides = overrides;
        let said = [
            (status.last_error.as_str(), "warn"),
            (status.last_event.as_str(), "info"),
        ];
        for (text, kind) in said {
            let known = if kind == "warn" {
                &mut self.error
            } else {
                &mut self.event
            };
            if text != known {
                text.clone_into(known);
                // Changes of the state are told in plain words, and missed ticks are counted.
                let is_told = StateChange::is_told_in(text) || text.ends_with("missed");
                if !text.is_empty() && !is_told {
                    self.add(kind, text.to_owned());
                }
            }
        }
    }

    fn count(&mut self, status: &Status, is_first: bool) {
        let now = [
            status.missed_ticks,
            status.setpoints_lost,
            status.commands_refused,
        ];
        let words = [
            ("tick", "missed"),
            ("setpoint", "lost"),
            ("command", "refused"),
        ];
        let before = core::mem::replace(&mut self.counts, now);
        for ((now, before), (one, fate)) in now.into_iter().zip(before).zip(words) {
            let more = now.saturating_sub(before);
            if more > 0 && !is_first {
                self.add_counted((one, fate), more);
            }
        }
    }

    /// The interpolator is gone.
    pub(super) fn ended(&mut self) {
        if !core::mem::replace(&mut self.is_gone, true) && self.state.take().is_some() {
            self.add("warn", "the interpolator ended".to_owned());
        }
    }

    /// Something that is told of elsewhere than in a status.
    pub(super) fn add(&mut self, kind: &'static str, text: String) {
        self.entries.push_front(Entry {
            at_ms: now_ms(),
            kind,
            text,
            counted: None,
        });
        self.entries.truncate(KEPT);
    }

    /// Adds what is counted to the entry before, if that is of the same.
    fn add_counted(&mut self, (one, fate): (&'static str, &'static str), more: u64) {
        let before = self.entries.front().and_then(|last| last.counted);
        let before = before.filter(|(of, ..)| *of == one);
        let at_ms = now_ms();
        let (count, since_ms) = before.map_or((more, at_ms), |(_, count, since_ms)| {
            (count + more, since_ms)
        });
        if before.is_some() {
            self.entries.pop_front();
        }
        self.add("warn", format!("{} {fate}", counted(count, one)));
        if let Some(added) = self.entries.front_mut() {
            added.counted = Some((one, count, since_ms));
        }
    }

    pub(super) fn object(&self) -> Value {
        self.entries
            .iter()
            .map(|entry| {
                let since = entry.counted.map(|(.., since_ms)| since_ms);
                let since_ms = since.filter(|since_ms| *since_ms != entry.at_ms);
                json!({
                    "at_ms": entry.at_ms,
                    "since_ms": since_ms,
                    "kind": entry.kind,
                    "text": entry.text,
                })
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_counted_is_one_entry_until_something_else_happens() {
        let mut log = Log::default();
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::Running.code();
        log.take(&status);
        for missed in [1, 3, 6] {
            status.missed_ticks = missed;
            log.take(&status);
        }
        let texts = |log: &Log| {
            let entries = log.object();
            let entries = entries.as_array().unwrap().iter();
            entries
                .map(|entry| entry["text"].as_str().unwrap().to_owned())
                .collect::<Vec<_>>()
        };
        assert_eq!(texts(&log)[0], "6 ticks missed");
        assert_eq!(texts(&log).len(), 2);
        status.state = MachineState::Held.code();
        log.take(&status);
        status.missed_ticks = 7;
        log.take(&status);
        assert_eq!(texts(&log)[0], "1 tick missed");
        assert_eq!(
            (texts(&log).len(), texts(&log)[2].as_str()),
            (4, "6 ticks missed")
        );
    }
}
