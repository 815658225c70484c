//! What is known of a machine beside its status.

use super::machine::AwaitedEvent;
use super::work_offset::WorkOffset;
use glidepath_geometry::Axis;

/// What is known of a machine beside its status.
#[derive(Debug, Clone, Default)]
pub struct Beside {
    /// What it waits for.
    pub asked: AwaitedEvent,
    /// The coordinate system in force; `None` if none is kept.
    pub offset: Option<WorkOffset>,
    /// The axes that do not know where they are: their positions mean nothing yet.
    pub not_homed: Vec<Axis>,
}
