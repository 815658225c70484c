//! The program that the machine executes, as text and as JSON.

use super::quantity::counted;
use glidepath_link::ActiveProgram;
use serde_json::{Value, json};

/// The program as an object; null where it is not known.
#[must_use]
pub fn active_object(active: Option<&ActiveProgram>) -> Value {
    active.map_or(Value::Null, |active| {
        json!({
            "name": active.name(),
            "file": active.file.display().to_string(),
            "bytes": active.bytes,
            "fingerprint": format!("{:016x}", active.fingerprint),
        })
    })
}

/// The program as a line below a status.
#[must_use]
pub fn active_text(active: &ActiveProgram) -> String {
    format!(
        "  program       {}, {}, fingerprint {:016x}\n",
        active.file.display(),
        counted(active.bytes, "byte"),
        active.fingerprint
    )
}
