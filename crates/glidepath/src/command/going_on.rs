//! How to go on with a program whose motion ended before it did.

use crate::machine_options::resume;
use glidepath_link::TOLD_TO_END;
use glidepath_planner::{FramePublisher, RunError};
use std::path::Path;

/// Where a program was left, and the command that goes on with it; `None` where nothing of it was executed,
/// or the interpolator that knows is no more.
pub(super) fn told(
    error: &RunError,
    publisher: &FramePublisher<'_>,
    (command, file, first_block): (&str, &Path, u32),
) -> Option<String> {
    let is_known = match error {
        RunError::Aborted | RunError::Fault(_) | RunError::Interrupted => true,
        RunError::Ended { why } => why != TOLD_TO_END,
        _ => false,
    };
    let point = publisher.resume_point().ok().filter(|_| is_known)?;
    let line = publisher.line();
    if point.block > 0 && point.block < first_block {
        let beginning = match line {
            0 => "the line".to_owned(),
            line => format!("line {line},"),
        };
        return Some(format!(
            "it was left on the way to {beginning} where it was to begin: run it from that line again"
        ));
    }
    (point.block > 0 && line > 0).then(|| {
        let command = resume(command, &file.display().to_string());
        let where_from = if publisher.was_off_path() {
            "there, once the axes, which were jogged away, are back where it was held"
        } else {
            "there"
        };
        format!("it was left in line {line}, and {command} goes on from {where_from}")
    })
}
