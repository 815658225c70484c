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
            "tolerance_ratio": active.tolerance_ratio,
        })
    })
}

/// The program as a line below a status.
#[must_use]
pub fn active_text(active: &ActiveProgram) -> String {
    let mut text = format!(
        "  program       {}, {}, fingerprint {:016x}\n",
        active.file.display(),
        counted(active.bytes, "byte"),
        active.fingerprint
    );
    if active.tolerance_ratio.to_bits() != 1.0_f64.to_bits() {
        let ratio = active.tolerance_ratio;
        text += &format!("  tolerance     {ratio} times that of the program\n");
    }
    text
}
