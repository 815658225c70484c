//! What the page can ask for, as far as it is known.

use serde_json::{Value, json};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Numbers as the page reads them.
pub(super) type Numbers = Arc<[u8]>;

#[derive(Debug, Default)]
struct Known {
    /// Counts what became known.
    version: u64,
    lines: u64,
    text: Vec<String>,
    program_path: Option<Numbers>,
    columns: Option<Numbers>,
    path: Option<Numbers>,
    report: Option<Value>,
    trouble: Option<String>,
}

/// What is known of machine and program, for all threads.
#[derive(Debug)]
pub(super) struct Shown {
    machine: Value,
    name: Option<String>,
    known: Mutex<Known>,
}

/// A whole plan.
pub(super) struct WholePlan {
    pub(super) columns: Vec<u8>,
    pub(super) path: Vec<u8>,
    pub(super) report: Value,
}

impl Shown {
    pub(super) fn new(machine: Value, name: Option<String>) -> Self {
        Self {
            machine,
            name,
            known: Mutex::default(),
        }
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn version(&self) -> u64 {
        self.known().version
    }

    /// The text of the program.
    pub(super) fn text(&self, lines: &[String]) {
        let mut known = self.known();
        known.text = lines.to_vec();
        known.lines = lines.len() as u64;
        known.version += 1;
    }

    /// The programmed path.
    pub(super) fn program(&self, path: Vec<u8>) {
        let mut known = self.known();
        known.program_path = Some(path.into());
        known.version += 1;
    }

    /// The plan.
    pub(super) fn plan(&self, plan: WholePlan) {
        let mut known = self.known();
        known.columns = Some(plan.columns.into());
        known.path = Some(plan.path.into());
        known.report = Some(plan.report);
        known.version += 1;
    }

    /// There will be no plan.
    pub(super) fn trouble(&self, why: &str) {
        let mut known = self.known();
        known.trouble = Some(why.to_owned());
        known.version += 1;
    }

    /// What is known, as `/api/plan` tells.
    pub(super) fn object(&self) -> Value {
        let known = self.known();
        let program = self.name.as_ref();
        json!({
            "machine": self.machine,
            "program": program.map(|name| json!({ "name": name, "lines": known.lines })),
            "program_path": known.program_path.is_some(),
            "report": known.report,
            "failed": known.trouble,
            "version": known.version,
        })
    }

    /// Some lines of the text.
    pub(super) fn lines(&self, from: usize, count: usize) -> Value {
        let known = self.known();
        let first = from.saturating_sub(1);
        known.text.iter().skip(first).take(count).cloned().collect()
    }

    pub(super) fn program_path(&self) -> Option<Numbers> {
        self.known().program_path.clone()
    }

    pub(super) fn columns(&self) -> Option<Numbers> {
        self.known().columns.clone()
    }

    pub(super) fn path(&self) -> Option<Numbers> {
        self.known().path.clone()
    }
}
