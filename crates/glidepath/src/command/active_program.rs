//! The program that the machine executes, as far as its planner has said.

use glidepath_link::{ActiveProgram, LinkConfig, Status};

/// The program that the machine executes, or has executed last; `None` for a line, a pipe or a stream,
/// and where nobody has said.
pub(super) fn active_program(link: &LinkConfig, status: &Status) -> Option<ActiveProgram> {
    if status.program == 0 {
        return None;
    }
    // A note that cannot be read says nothing.
    let note = ActiveProgram::read(link).ok().flatten()?;
    (note.fingerprint == status.program).then_some(note)
}
