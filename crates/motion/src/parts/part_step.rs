//! A step of the plan of a part.

use crate::PlanError;
use crate::on_path::Settled;
use glidepath_program::Frame;
use std::collections::VecDeque;

/// A step of the plan of a part, for [`crate::parts::Joiner`].
#[derive(Debug)]
pub struct PartStep(pub(crate) StepKind);

#[allow(
    clippy::large_enum_variant,
    reason = "where frames are made, nearly every step is one"
)]
#[derive(Debug)]
pub(crate) enum StepKind {
    /// Motion that is to be sampled.
    Motion(VecDeque<Settled>),
    /// A frame. Its number means nothing, its path position is counted from the origin.
    Frame(Frame),
    /// Path position is counted from so much further on.
    Origin(f64),
    /// Planning failed inside.
    Failed(PlanError),
}

impl PartStep {
    /// Memory that it keeps beside its own, bytes.
    #[must_use]
    pub fn heap_bytes(&self) -> usize {
        match &self.0 {
            StepKind::Motion(settled) => {
                let beside: usize = settled.iter().map(Settled::heap_bytes).sum();
                settled.capacity() * size_of::<Settled>() + beside
            }
            StepKind::Frame(_) | StepKind::Origin(_) | StepKind::Failed(_) => 0,
        }
    }
}
