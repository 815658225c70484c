//! What is added to the motion of an axis, as text and as JSON.

use glidepath_link::{FreezeReason, Status, SuperpositionState};

/// What the superposition is called that does this; nothing on a machine without one.
pub(super) fn name(status: &Status) -> Option<&'static str> {
    let state = status.superposition().ok()?;
    (state != SuperpositionState::None).then(|| state.name())
}

/// What it does, and why it stands still where it does; nothing on a machine without one.
pub(super) fn does(status: &Status) -> Option<String> {
    let does = status.superposition().ok()?.text();
    let why = status.freeze_reason().map_or("", FreezeReason::text);
    if does.is_empty() {
        None
    } else if why.is_empty() {
        Some(does.to_owned())
    } else {
        Some(format!("{does}: {why}"))
    }
}
