//! The messages between the threads of a plan.

use std::sync::mpsc::{Receiver, Sender};

use glidepath_geometry::AxisVector;
use glidepath_motion::parts::PartStep;
use glidepath_program::Item;

/// A part of a program, for a worker.
#[derive(Debug)]
pub(super) struct Part {
    /// From 0.
    pub(super) number: u64,
    pub(super) start: AxisVector,
    pub(super) items: Receiver<Batch>,
    pub(super) plan: Sender<PlanPiece>,
}

/// Items of a part.
#[derive(Debug)]
pub(super) enum Batch {
    Items {
        items: Vec<Item>,
        /// Lines of the program read so far.
        lines: u64,
    },
    /// There are no more; `is_last`: and neither are in the program.
    End { is_last: bool },
}

/// A piece of the plan of a part.
#[derive(Debug)]
pub(super) enum PlanPiece {
    Steps {
        steps: Vec<PlanStep>,
        weight: usize,
        /// Lines of the program read for it.
        lines: u64,
    },
    /// All of it was handed over.
    End,
}

/// A step of a plan.
#[allow(clippy::large_enum_variant, reason = "both are large")]
#[derive(Debug)]
pub(super) enum PlanStep {
    /// The planner took an item.
    Item(Item),
    Motion(PartStep),
}

/// The other side is gone: there is nothing left to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Gone;
