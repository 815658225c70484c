//! The run channels: the state that a program shares with whoever supervises its run.

use crate::source::changes::{ChangeLog, PositionOffsetsLog};
use crate::source::input_arbiter::InputArbiter;
use crate::source::remarks::RemarkLog;

/// The run channels: the state that a program shares with whoever supervises its run. Clones are the same.
#[derive(Debug, Clone, Default)]
pub struct RunChannels {
    /// Where changes of how the machine is set up are noted.
    pub changes: Option<ChangeLog>,
    /// Where the length of the tool in force is noted: at the beginning, and where it changes.
    pub position_offsets: Option<PositionOffsetsLog>,
    /// Where is noted what the program says to people.
    pub remarks: Option<RemarkLog>,
    /// Where inputs are asked, where the program's inputs are real.
    pub inputs: Option<InputArbiter>,
}
