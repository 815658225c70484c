//! The findings of an audit.

use serde_json::{Value, json};

/// Findings that are listed; all are counted.
const LISTED: usize = 100;

/// A finding: what is not as it has to be, and where.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Finding {
    /// limit, deviation, order, gap, timing, frozen, program or broken.
    pub(super) kind: &'static str,
    pub(super) tick: u64,
    pub(super) line: u32,
    /// What it is.
    pub(super) text: String,
}

impl Finding {
    pub(super) fn object(&self) -> Value {
        json!({ "kind": self.kind, "tick": self.tick, "line": self.line, "text": self.text })
    }

    pub(super) fn line(&self) -> String {
        let Self {
            kind,
            tick,
            line,
            text,
        } = self;
        format!("    {kind:<10}line {line}, tick {tick}: {text}\n")
    }
}

/// The first findings, and how many there are.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub(super) listed: Vec<Finding>,
    pub(super) count: u64,
}

impl Findings {
    pub(super) fn push(&mut self, finding: Finding) {
        self.count += 1;
        if self.listed.len() < LISTED {
            self.listed.push(finding);
        }
    }

    pub(super) fn join(&mut self, other: Self) {
        let unlisted = other.count - other.listed.len() as u64;
        other
            .listed
            .into_iter()
            .for_each(|finding| self.push(finding));
        self.count += unlisted;
    }
}
