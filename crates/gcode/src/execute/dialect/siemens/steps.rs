//! What is still to be executed of a cycle, and what the program has declared.

use std::collections::VecDeque;

use glidepath_geometry::{AXES, AxisVector};

use crate::execute::dialect::tape::TapePlace;
use crate::execute::state::frame::Frame;
use crate::execute::state::modal::Modal;
use crate::execute::state::shared::Shared;
use crate::syntax::dialect::siemens::arguments::Argument;
use crate::syntax::dialect::siemens::variables::Variables;

/// A step of a cycle.
#[derive(Debug, Clone)]
pub(crate) enum Step {
    /// A line in RS274/NGC's words.
    Line(String),
    /// A position of a pattern, in the two axes of the plane: the cycle of MCALL is made there.
    Position([f64; 2]),
    /// What was in force before the cycle.
    Restore(Box<Before>),
}

/// What is in force before a cycle, and again behind it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Before {
    pub(super) modal: Modal,
    /// The radius of all corners, mm.
    pub(super) rounds_mm: f64,
    /// DIAM90.
    pub(super) diameter_by_distance: bool,
}

/// A cycle with the values of its arguments.
#[derive(Debug, Clone)]
pub(crate) struct CycleCall {
    /// Its name in capitals.
    pub(crate) name: &'static str,
    pub(crate) arguments: Vec<Option<f64>>,
}

/// What is made behind every move (MCALL).
#[derive(Debug, Clone)]
pub(crate) enum ModalCall {
    Cycle(CycleCall),
    /// A subprogram, from its first line, with its arguments, which are values.
    Subprogram(TapePlace, Vec<Option<Argument>>),
}

/// What a subprogram in progress has, and what its caller gets back.
#[derive(Debug)]
pub(crate) struct CallState {
    /// The caller's variables.
    pub(super) variables: Shared<Variables>,
    /// The arguments of the call.
    pub(super) arguments: Vec<Option<Argument>>,
    /// The modes and the frame of the caller, where PROC says SAVE.
    pub(super) saved: Option<Box<(Modal, Frame)>>,
    /// What MCALL had called it, and what is left of a pattern of positions.
    pub(super) modal_call: Option<ModalCall>,
    pub(super) steps: Vec<Step>,
}

/// The shift of a frame in its two parts, as TRANS and ATRANS have said them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShiftParts {
    /// The frame that they are of.
    pub(super) frame: Frame,
    /// TRANS, G58.
    pub(super) coarse: AxisVector,
    /// ATRANS, G59.
    pub(super) fine: AxisVector,
    /// The axes whose fine part G59 has set.
    pub(super) is_own: [bool; AXES],
}

/// What a SINUMERIK program has besides the state of the interpreter.
#[derive(Debug, Default)]
pub(crate) struct SiemensState {
    pub(crate) variables: Shared<Variables>,
    /// What is left of the cycle in progress.
    pub(crate) steps: VecDeque<Step>,
    /// The cycle that is made behind every move (MCALL).
    pub(crate) modal_call: Option<ModalCall>,
    /// The subprograms in progress.
    pub(crate) calls: Vec<CallState>,
    /// The parts of the frame's shift; of no use where another frame is in force.
    pub(crate) shift: Option<ShiftParts>,
}
