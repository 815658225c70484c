//! The state that pages can ask for, as far as it is known: of one program at a time.

use crate::command::forecast::PlannedFor;
use crate::command::text_lines::TextLines;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Numbers as the page reads them.
pub(super) type Numbers = Arc<[u8]>;

/// The file of a program, and what it is planned for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct File {
    pub(super) path: PathBuf,
    pub(super) planned_for: PlannedFor,
}

#[derive(Debug, Default)]
struct Known {
    /// Counts what became known.
    version: u64,
    /// Which program of those that were shown it is.
    generation: u64,
    name: Option<String>,
    file: Option<File>,
    text: TextLines,
    program_path: Option<Numbers>,
    columns: Option<Numbers>,
    path: Option<Numbers>,
    report: Option<Value>,
    trouble: Option<String>,
    warnings: Vec<&'static str>,
}

/// What is known of machine and program, for all threads.
#[derive(Debug)]
pub(super) struct Shown {
    machine: Value,
    known: Mutex<Known>,
}

/// A whole plan.
pub(super) struct WholePlan {
    pub(super) columns: Vec<u8>,
    pub(super) path: Vec<u8>,
    pub(super) report: Value,
}

impl Shown {
    pub(super) fn new(machine: Value) -> Self {
        Self {
            machine,
            known: Mutex::default(),
        }
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Forgets the program before, and shows another one, or none. What is still found out of the one
    /// before is dropped.
    pub(super) fn begin(self: &Arc<Self>, name: Option<&str>) -> Board {
        let generation = self.generation() + 1;
        self.begin_at(generation, name)
    }

    /// The same with a number of its own, by which it is told from those that others show.
    pub(super) fn begin_with(self: &Arc<Self>, generation: u64, name: &str) -> Board {
        self.begin_at(generation, Some(name))
    }

    fn begin_at(self: &Arc<Self>, generation: u64, name: Option<&str>) -> Board {
        let mut known = self.known();
        *known = Known {
            version: known.version + 1,
            generation,
            name: name.map(str::to_owned),
            ..Known::default()
        };
        drop(known);
        let shown = Arc::clone(self);
        Board { shown, generation }
    }

    pub(super) fn version(&self) -> u64 {
        self.known().version
    }

    /// Which program is shown.
    pub(super) fn generation(&self) -> u64 {
        self.known().generation
    }

    /// What is known, as `/api/plan` tells.
    pub(super) fn object(&self) -> Value {
        let known = self.known();
        let program = known.name.as_ref();
        json!({
            "machine": self.machine,
            "program": program.map(|name| json!({ "name": name, "lines": known.text.count() })),
            "program_path": known.program_path.is_some(),
            "report": known.report,
            "failed": known.trouble,
            "warnings": known.warnings,
            "generation": known.generation,
            "version": known.version,
        })
    }

    /// Some lines of the text of a program; `None` if another one is shown by now.
    pub(super) fn lines(&self, of: u64, from: usize, count: usize) -> Option<Value> {
        let first = from.saturating_sub(1);
        self.of(of, |known| {
            Some(known.text.from(first).take(count).collect())
        })
    }

    pub(super) fn program_path(&self, of: u64) -> Option<Numbers> {
        self.of(of, |known| known.program_path.clone())
    }

    /// Where the program is.
    pub(super) fn file(&self, of: u64) -> Option<File> {
        self.of(of, |known| known.file.clone())
    }

    pub(super) fn columns(&self, of: u64) -> Option<Numbers> {
        self.of(of, |known| known.columns.clone())
    }

    pub(super) fn path(&self, of: u64) -> Option<Numbers> {
        self.of(of, |known| known.path.clone())
    }

    /// What is known of one program, and of no other.
    fn of<T>(&self, generation: u64, get: impl FnOnce(&Known) -> Option<T>) -> Option<T> {
        let known = self.known();
        (known.generation == generation)
            .then(|| get(&known))
            .flatten()
    }
}

/// Where what is found out of one program is put, as long as it is the one that is shown.
#[derive(Debug, Clone)]
pub(super) struct Board {
    shown: Arc<Shown>,
    generation: u64,
}

impl Board {
    fn put(&self, put: impl FnOnce(&mut Known)) {
        let mut known = self.shown.known();
        if known.generation == self.generation {
            put(&mut known);
            known.version += 1;
        }
    }

    /// Where the program is.
    pub(super) fn file(&self, path: &Path, planned_for: PlannedFor) {
        let path = path.to_owned();
        self.put(|known| known.file = Some(File { path, planned_for }));
    }

    /// The text of the program.
    pub(super) fn text(&self, lines: &TextLines) {
        self.put(|known| known.text = lines.clone());
    }

    /// The programmed path.
    pub(super) fn program(&self, path: Vec<u8>) {
        self.put(|known| known.program_path = Some(path.into()));
    }

    /// The plan.
    pub(super) fn plan(&self, plan: WholePlan) {
        self.put(|known| {
            known.columns = Some(plan.columns.into());
            known.path = Some(plan.path.into());
            known.report = Some(plan.report);
        });
    }

    /// What the program should say and does not.
    pub(super) fn warnings(&self, warnings: Vec<&'static str>) {
        self.put(|known| known.warnings = warnings);
    }

    /// There will be no plan.
    pub(super) fn trouble(&self, why: &str) {
        self.put(|known| known.trouble = Some(why.to_owned()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_found_out_of_another_program_is_dropped() {
        let shown = Arc::new(Shown::new(Value::Null));
        let first = shown.begin(Some("first.ngc"));
        let text = |text: &str| TextLines::of(text.as_bytes().to_vec());
        first.text(&text("G0 X1"));
        let second = shown.begin(Some("second.ngc"));
        let before = shown.object();
        first.text(&text("G0 X2"));
        first.program(vec![1]);
        first.trouble("it is no more");
        assert_eq!(shown.object(), before);
        assert_eq!(shown.lines(1, 1, 9), None);
        assert_eq!(shown.lines(2, 1, 9), Some(json!([])));
        assert!(shown.program_path(2).is_none());
        second.text(&text("G0 X3\nM2\n"));
        assert_eq!(shown.object()["program"]["lines"], 2);
        assert_eq!(shown.lines(2, 2, 9), Some(json!(["M2"])));
        assert!(shown.version() > before["version"].as_u64().unwrap());
        let _none = shown.begin(None);
        assert_eq!(shown.object()["program"], Value::Null);
    }
}
