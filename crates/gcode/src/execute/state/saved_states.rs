//! The modal state that M70 and M73 save, level by level of subroutine calls.

use glidepath_geometry::AxisVector;

use crate::execute::compensation::path::Compensated;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::modal::Modal;
use crate::execute::state::spindle::Spindle;

/// What M70 and M73 save.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Saved {
    pub(crate) modal: Modal,
    pub(crate) compensated: Option<Compensated>,
    /// Index of the active coordinate system.
    pub(crate) system: usize,
    /// Tool offset in force.
    pub(crate) tool_offset: AxisVector,
    pub(crate) spindle: Spindle,
    pub(crate) coolant: Coolant,
    pub(crate) overrides_off: bool,
}

/// The place of a subroutine in progress, or of the program.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SavedLevel {
    pub(crate) saved: Option<Saved>,
    /// M73: restored on return.
    pub(crate) on_return: bool,
}

/// What is saved, for the program and the subroutines in progress.
#[derive(Debug, Clone, Default)]
pub(crate) struct SavedStates {
    pub(crate) program: SavedLevel,
    pub(crate) calls: Vec<SavedLevel>,
}

impl SavedStates {
    /// A subroutine begins.
    pub(crate) fn enter(&mut self) {
        self.calls.push(SavedLevel::default());
    }

    pub(crate) fn present(&mut self) -> &mut SavedLevel {
        self.calls.last_mut().unwrap_or(&mut self.program)
    }
}
