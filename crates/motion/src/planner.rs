//! The motion planner: items in, frames out.

use super::event_pace::{EventPace, Paced};
use super::guard::GuardedFrames;
use super::on_path::OnPathEngine;
use super::stretches::StretchEngine;
use crate::engine_kind::EngineKind;
use crate::{Joints, PlanError};
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Item, Override, Settings};
use std::sync::Arc;

/// Plans a program as it comes, in memory that does not grow with its length.
///
/// Push items one by one and take frames whenever there are some. The frames depend on the items
/// alone, not on when they are taken. The first frame is at rest at the start, the last one (flag
/// `LAST`) at rest at the end.
///
/// There is an example at [`crate`].
#[derive(Debug, Clone)]
pub struct Planner {
    engine: Engine,
    frames: GuardedFrames,
    pace: EventPace,
}

/// How motion is planned.
#[derive(Debug, Clone)]
enum Engine {
    OnPath(Box<OnPathEngine>),
    Stretches(Box<StretchEngine>),
}

impl Engine {
    fn new(settings: Settings, start: AxisVector) -> Self {
        match EngineKind::of(&settings) {
            EngineKind::InTube => Self::Stretches(Box::new(StretchEngine::new(settings, start))),
            EngineKind::OnPath => {
                Self::OnPath(Box::new(OnPathEngine::new(settings, start, Override::NONE)))
            }
        }
    }

    fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        match self {
            Self::OnPath(engine) => engine.push(item),
            Self::Stretches(engine) => engine.push(item),
        }
    }
}

impl Planner {
    /// A planner for a machine at rest at `start`.
    #[must_use]
    pub fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            engine: Engine::new(settings, start),
            frames: GuardedFrames::new(&settings, start),
            pace: EventPace::new(&settings),
        }
    }

    /// The same planner, before its first item, for a machine whose joints are not its axes.
    ///
    /// Along a path they are limits like those of the axes. In the tube, where a short stretch is searched
    /// with [`glidepath_program::Effort::Optimal`], axes do no more than leaves every joint what it can do.
    #[must_use]
    pub fn with_joints(mut self, joints: Arc<dyn Joints>) -> Self {
        self.engine = match self.engine {
            Engine::OnPath(engine) => Engine::OnPath(Box::new(engine.with_joints(Some(joints)))),
            Engine::Stretches(mut engine) => {
                engine.set_joints(joints);
                Engine::Stretches(engine)
            }
        };
        self
    }

    /// The same planner, before its first item, for moves that come while the motion waits for them,
    /// as they do through a pipe.
    ///
    /// With [`glidepath_program::Effort::Optimal`] up to 5 s of moves at their rates are planned as
    /// a whole, before the first frame of them; of a stream, 1.25 s. Longer stretches are planned as
    /// they come, which may take some periods more.
    #[must_use]
    pub fn of_stream(mut self) -> Self {
        if let Engine::Stretches(engine) = &mut self.engine {
            engine.set_stream();
        }
        self
    }

    /// Takes the next item.
    ///
    /// # Errors
    /// If the item is not finite, does not start where the last one ended, or has a feedrate,
    /// tolerance or dwell out of range. The planner is then as if the item had not been given.
    /// After [`Planner::pop_frame`] has failed, its error.
    pub fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        self.frames.check()?;
        let mut pace = self.pace;
        let Paced { rest, item } = pace.take(item);
        if let Some(rest) = rest {
            self.engine.push(&rest)?;
        }
        self.engine.push(&item)?;
        self.pace = pace;
        Ok(())
    }

    /// No more items: what is planned ends at rest. Further calls do nothing.
    pub fn finish(&mut self) {
        match &mut self.engine {
            Engine::OnPath(engine) => engine.finish(),
            Engine::Stretches(engine) => engine.finish(),
        }
    }

    /// The next frame, if the motion is settled that far. Without more items it never is beyond a
    /// certain point until [`Planner::finish`].
    ///
    /// # Errors
    /// [`PlanError::NoMotion`] if planning failed inside: there is no frame that continues the
    /// motion within the limits; [`PlanError::BeyondTravel`] if it leads out of the travel of an axis.
    /// No more frames follow, and every call gives the same error.
    /// Whoever plays the frames must then stop on those it has.
    pub fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        Ok(self.make_frame()?.then_some(*self.frame()))
    }

    /// As [`Planner::pop_frame`], but the frame stays where [`Planner::frame`] shows it: a frame is
    /// large, and making one costs little more than copying it. False if there is none.
    ///
    /// # Errors
    /// As [`Planner::pop_frame`].
    pub fn make_frame(&mut self) -> Result<bool, PlanError> {
        self.frames.make(|made| match &mut self.engine {
            Engine::OnPath(engine) => engine.make_frame(made),
            Engine::Stretches(engine) => engine.pop_frame().map(|frame| {
                let is_made = frame.is_some();
                *made = frame.unwrap_or(*made);
                is_made
            }),
        })
    }

    /// [`Planner::frame`], for who completes it: numbers its line and path position by others.
    pub const fn frame_mut(&mut self) -> &mut Frame {
        self.frames.frame_mut()
    }

    /// The frame that was made last; before the first one at rest at the start.
    #[must_use]
    pub const fn frame(&self) -> &Frame {
        self.frames.frame()
    }

    /// Plans what no frame was taken of with another override: rates times their override, limits
    /// unchanged.
    ///
    /// A lower override takes effect as soon as the speed can be brought down; the on-path engine
    /// begins at the next place where the motion has no acceleration along the path. Each frame
    /// tells the override it was planned with: while the speed is brought down, one in between.
    ///
    /// # Errors
    /// If a factor is not a positive number, or that of rapids is above 1. As
    /// [`Planner::pop_frame`], if the motion at hand cannot be planned again.
    pub fn set_override(&mut self, wanted: Override) -> Result<(), PlanError> {
        let Override { feed_r, rapid_r } = wanted;
        let valid = feed_r > 0.0 && feed_r.is_finite() && rapid_r > 0.0 && rapid_r <= 1.0;
        if !valid {
            return Err(PlanError::Override { feed_r, rapid_r });
        }
        match &mut self.engine {
            Engine::OnPath(engine) => engine.set_override(wanted),
            Engine::Stretches(engine) => engine.set_override(wanted)?,
        }
        Ok(())
    }
}
