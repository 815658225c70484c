//! What a pipeline is built with besides its source: joints, events to begin with, a clock.

use std::time::Duration;

use glidepath_kinematics::LimitedMechanism;
use glidepath_program::{Event, Item, ItemKind};

use super::Pipeline;
use crate::plan::joint_bounds::JointBounds;
use crate::source::item_source::ItemSource;

impl<S: ItemSource> Pipeline<S> {
    /// The same pipeline for a machine whose joints are not its axes: speeds are kept where joints
    /// can follow.
    #[must_use]
    pub fn with_joints(self, caps: Option<LimitedMechanism>) -> Self {
        Self {
            planning: self.planning.with_joints(caps.map(JointBounds::shared)),
            ..self
        }
    }

    /// The same pipeline for a source that gives its items while the motion waits for them: with
    /// effort "optimal" it begins to move sooner ([`glidepath_motion::Planner::of_stream`]).
    #[must_use]
    pub fn of_stream(self) -> Self {
        Self {
            planning: self.planning.of_stream(),
            ..self
        }
    }

    /// The same pipeline, which begins with these events: they are not of the program, and happen in
    /// its first block.
    #[must_use]
    pub fn beginning_with(self, events: impl IntoIterator<Item = Event>, line: u32) -> Self {
        let aside = |event| Item {
            block: 0,
            line,
            kind: ItemKind::Event(event),
        };
        Self {
            before: events.into_iter().map(aside).collect(),
            ..self
        }
    }

    /// The same pipeline, with the time of its steps counted by a clock: time since any fixed
    /// instant.
    #[must_use]
    pub fn with_clock(self, clock: fn() -> Duration) -> Self {
        Self {
            clock: Some(clock),
            ..self
        }
    }
}
