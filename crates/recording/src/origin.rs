//! The origin of a recording: the facts, the configuration and the program that it belongs to.

use std::collections::BTreeMap;

/// The origin of a recording: everything that is needed to judge it later, elsewhere.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origin {
    /// By name: versions, the instance, the period, the clocks, what the command line said.
    pub facts: BTreeMap<String, String>,
    /// The text of the configuration.
    pub configuration: String,
    /// The program, if it was told.
    pub program: Option<Vec<u8>>,
}

/// The name of the metadata record.
pub(crate) const FACTS: &str = "glidepath";
/// The names of the attachments.
pub(crate) const CONFIGURATION: &str = "configuration.toml";
pub(crate) const PROGRAM: &str = "program.ngc";
/// The fact that tells how far the host's clock is ahead of the monotonic one, ns.
pub(crate) const AHEAD: &str = "realtime_minus_monotonic_ns";

impl Origin {
    /// A fact, if it was told.
    #[must_use]
    pub fn fact(&self, name: &str) -> Option<&str> {
        self.facts.get(name).map(String::as_str)
    }

    /// Tells a fact.
    pub fn tell(&mut self, name: &str, value: impl ToString) {
        self.facts.insert(name.to_owned(), value.to_string());
    }

    /// How far the host's clock is ahead of the monotonic one, ns.
    pub(crate) fn ahead_ns(&self) -> u64 {
        self.fact(AHEAD)
            .and_then(|text| text.parse().ok())
            .unwrap_or(0)
    }

    /// Tells how far the host's clock is ahead of the monotonic one, ns.
    pub fn tell_clocks(&mut self, realtime_ns: u64, monotonic_ns: u64) {
        self.tell(AHEAD, realtime_ns.saturating_sub(monotonic_ns));
    }
}
