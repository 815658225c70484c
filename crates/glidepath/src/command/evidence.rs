//! The evidence of a run that ended before its end: figures and files of what was played, and where
//! the machine stood.

use crate::report::decimals;
use serde_json::{Value, json};
use std::fmt;
use std::path::PathBuf;

/// Figures and files of what was played, and where the machine stood.
#[derive(Debug)]
pub(super) struct Evidence {
    pub(super) figures: Value,
    pub(super) played_s: f64,
    pub(super) line: u32,
    pub(super) position: Vec<(String, f64)>,
    pub(super) files: Vec<PathBuf>,
    pub(super) fault: Option<String>,
}

impl Evidence {
    /// As it stands in the object of a failure.
    pub(super) fn object(&self) -> Value {
        let position: serde_json::Map<String, Value> = self
            .position
            .iter()
            .map(|(axis, value)| (axis.clone(), (*value).into()))
            .collect();
        json!({
            "ended_early": true,
            "line": self.line,
            "position": position,
            "fault": self.fault,
            "played": self.figures,
        })
    }
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let position: Vec<String> = self
            .position
            .iter()
            .map(|(axis, value)| format!("{axis} {}", decimals(*value, 4)))
            .collect();
        let position = position.join(" ");
        match self.line {
            0 => write!(
                f,
                "it ended before its first line, with the machine at {position}"
            )?,
            line => write!(
                f,
                "it ended in line {line}, after {:.3} s, with the machine at {position}",
                self.played_s
            )?,
        }
        let files: Vec<String> = self
            .files
            .iter()
            .map(|file| file.display().to_string())
            .collect();
        if !files.is_empty() {
            write!(f, "; what was played is in {}", files.join(" and "))?;
        }
        f.write_str("; the machine was imitated and has ended, so mend the cause and run it again")
    }
}
