//! The planner of one part.

use super::part_step::{PartStep, StepKind};
use crate::engine_kind::EngineKind;
use crate::on_path::OnPathEngine;
use crate::stretches::StretchEngine;
use crate::{Joints, PlanError};
use glidepath_geometry::AxisVector;
use glidepath_program::{FrameFlags, Item, Override, Settings};
use std::sync::Arc;

/// Plans a part of a program from where it begins.
#[derive(Debug)]
pub struct PartPlanner {
    engine: PartEngine,
    /// The part is the program's first: the frame it begins at is told.
    is_first: bool,
    /// To be told after the frame told last.
    origin_s: Option<f64>,
    failure: Failure,
}

/// Whether planning failed inside.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Failure {
    None,
    /// To be told.
    New(PlanError),
    Told,
}

#[derive(Debug)]
enum PartEngine {
    OnPath(Box<OnPathEngine>),
    Stretches(Box<StretchEngine>),
}

impl PartPlanner {
    /// A planner for a part that begins at `start` (mm, degrees); `is_first`: with the program.
    #[must_use]
    pub fn new(settings: Settings, start: AxisVector, is_first: bool) -> Self {
        Self {
            engine: match EngineKind::of(&settings) {
                EngineKind::OnPath => {
                    PartEngine::OnPath(Box::new(OnPathEngine::new(settings, start, Override::NONE)))
                }
                EngineKind::InTube => {
                    PartEngine::Stretches(Box::new(StretchEngine::new(settings, start)))
                }
            },
            is_first,
            origin_s: None,
            failure: Failure::None,
        }
    }

    /// As [`crate::Planner::with_joints`].
    #[must_use]
    pub fn with_joints(mut self, joints: Arc<dyn Joints>) -> Self {
        self.engine = match self.engine {
            PartEngine::OnPath(engine) => {
                PartEngine::OnPath(Box::new(engine.with_joints(Some(joints))))
            }
            PartEngine::Stretches(mut engine) => {
                engine.set_joints(joints);
                PartEngine::Stretches(engine)
            }
        };
        self
    }

    /// Takes the next item of the part, which a [`crate::parts::Cutter`] has accepted. Before it,
    /// [`PartPlanner::step`] must have had no more to give.
    pub fn push(&mut self, item: &Item) {
        let pushed = match &mut self.engine {
            PartEngine::OnPath(engine) => engine.push(item),
            PartEngine::Stretches(engine) => engine.push(item),
        };
        if let Err(error) = pushed {
            self.fail(error);
        }
    }

    fn fail(&mut self, error: PlanError) {
        if self.failure == Failure::None {
            self.failure = Failure::New(error);
        }
    }

    /// The program ends with this part, and no more items come. Other parts just end.
    pub fn finish(&mut self) {
        match &mut self.engine {
            PartEngine::OnPath(engine) => engine.finish(),
            PartEngine::Stretches(engine) => engine.finish(),
        }
    }

    /// The next step of the plan, if the motion is settled that far. After a failure, no more.
    pub fn step(&mut self) -> Option<PartStep> {
        if let Some(origin_s) = self.origin_s.take() {
            return Some(PartStep(StepKind::Origin(origin_s)));
        }
        match self.failure {
            Failure::None => self.next_step(),
            Failure::New(error) => {
                self.failure = Failure::Told;
                Some(PartStep(StepKind::Failed(error)))
            }
            Failure::Told => None,
        }
    }

    fn next_step(&mut self) -> Option<PartStep> {
        let engine = match &mut self.engine {
            PartEngine::OnPath(engine) => {
                let settled = engine.take_settled();
                return (!settled.is_empty()).then_some(PartStep(StepKind::Motion(settled)));
            }
            PartEngine::Stretches(engine) => engine,
        };
        loop {
            let made = engine.pop_frame();
            let origin_s = engine.take_origin();
            match made {
                // The part before has told it.
                Ok(Some(frame)) if !self.is_first && frame.flags.contains(FrameFlags::FIRST) => {}
                Ok(Some(frame)) => {
                    self.origin_s = origin_s;
                    return Some(PartStep(StepKind::Frame(frame)));
                }
                Ok(None) => return origin_s.map(|s| PartStep(StepKind::Origin(s))),
                Err(error) => {
                    self.failure = Failure::Told;
                    return Some(PartStep(StepKind::Failed(error)));
                }
            }
        }
    }
}
