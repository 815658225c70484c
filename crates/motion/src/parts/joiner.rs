//! The joiner of the plans of parts.

use super::part_step::{PartStep, StepKind};
use crate::PlanError;
use crate::engine_kind::EngineKind;
use crate::guard::GuardedFrames;
use crate::on_path::OnPathEngine;
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Override, Settings};
use std::collections::VecDeque;

/// Makes the frames of a program of the plans of its parts.
#[derive(Debug)]
pub struct Joiner {
    joint: Joint,
    frames: GuardedFrames,
}

#[derive(Debug)]
enum Joint {
    /// The motion of all parts is sampled by one engine, which settles none itself.
    OnPath(Box<OnPathEngine>),
    /// The frames are numbered, and their path positions counted, from part to part.
    InTube {
        waiting: VecDeque<StepKind>,
        sequence: u64,
        origin_s: f64,
    },
}

impl Joiner {
    /// For a machine at rest at `start`.
    #[must_use]
    pub fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            joint: match EngineKind::of(&settings) {
                EngineKind::OnPath => {
                    Joint::OnPath(Box::new(OnPathEngine::new(settings, start, Override::NONE)))
                }
                EngineKind::InTube => Joint::InTube {
                    waiting: VecDeque::new(),
                    sequence: 0,
                    origin_s: 0.0,
                },
            },
            frames: GuardedFrames::new(&settings, start),
        }
    }

    /// Takes the next step of the plan of the part at hand, all of that of the part before taken.
    pub fn add(&mut self, step: PartStep) {
        match (&mut self.joint, step.0) {
            (Joint::OnPath(engine), StepKind::Motion(settled)) => engine.add_settled(settled),
            (Joint::InTube { waiting, .. }, step) => waiting.push_back(step),
            (Joint::OnPath(_), StepKind::Failed(error)) => self.frames.fail(error),
            (Joint::OnPath(_), StepKind::Frame(_) | StepKind::Origin(_)) => {}
        }
    }

    /// Makes the next frame, [`Joiner::frame`], of the steps taken; false if there is none.
    ///
    /// # Errors
    /// As [`crate::Planner::make_frame`].
    pub fn make_frame(&mut self) -> Result<bool, PlanError> {
        self.frames.make(|made| match &mut self.joint {
            Joint::OnPath(engine) => engine.make_frame(made),
            Joint::InTube {
                waiting,
                sequence,
                origin_s,
            } => next_frame(waiting, sequence, origin_s, made),
        })
    }

    /// [`Joiner::frame`], for who completes it.
    pub const fn frame_mut(&mut self) -> &mut Frame {
        self.frames.frame_mut()
    }

    /// The frame that was made last; before the first one at rest at the start.
    #[must_use]
    pub const fn frame(&self) -> &Frame {
        self.frames.frame()
    }
}

fn next_frame(
    waiting: &mut VecDeque<StepKind>,
    sequence: &mut u64,
    origin_s: &mut f64,
    made: &mut Frame,
) -> Result<bool, PlanError> {
    while let Some(step) = waiting.pop_front() {
        match step {
            StepKind::Frame(frame) => {
                *made = Frame {
                    sequence: *sequence,
                    path_s: *origin_s + frame.path_s,
                    ..frame
                };
                *sequence += 1;
                return Ok(true);
            }
            StepKind::Origin(further_s) => *origin_s += further_s,
            StepKind::Failed(error) => return Err(error),
            StepKind::Motion(_) => {}
        }
    }
    Ok(false)
}
