//! The run of an engine over one stretch: an engine that is given the items of it, and no others.

use crate::PlanError;
use crate::in_tube::{InTubeEngine, SearchBias};
use crate::joints::SharedJoints;
use crate::on_path::OnPathEngine;
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, FrameFlags, Item, Override, Settings};

/// One stretch under way, from rest to rest.
#[derive(Debug, Clone)]
pub(crate) struct EngineRun {
    engine: Engine,
    is_finished: bool,
    /// How long it is, mm, once its last frame is taken.
    length_s: Option<f64>,
}

/// What a run begins with: at rest at `start`, under an override.
#[derive(Debug, Clone)]
pub(crate) struct InitialState {
    pub(crate) settings: Settings,
    pub(crate) joints: SharedJoints,
    pub(crate) start: AxisVector,
    pub(crate) wanted: Override,
}

/// How a stretch is driven: the strategy.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Strategy {
    OnPath,
    InTube(SearchBias),
}

#[derive(Debug, Clone)]
enum Engine {
    OnPath(Box<OnPathEngine>),
    InTube(Box<InTubeEngine>),
}

impl EngineRun {
    /// A run of which nothing is known yet.
    pub(crate) fn new(strategy: Strategy, initial_state: InitialState) -> Self {
        let InitialState {
            settings,
            joints,
            start,
            wanted,
        } = initial_state;
        let engine = match strategy {
            Strategy::OnPath => {
                let engine = OnPathEngine::new(settings, start, wanted);
                Engine::OnPath(Box::new(engine.with_joints(joints)))
            }
            Strategy::InTube(bias) => {
                let engine = InTubeEngine::new(settings, start, wanted, bias);
                Engine::InTube(Box::new(engine.with_joints(joints)))
            }
        };
        Self {
            engine,
            is_finished: false,
            length_s: None,
        }
    }

    /// Takes the next item of the stretch.
    pub(crate) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        match &mut self.engine {
            Engine::OnPath(engine) => engine.push(item),
            Engine::InTube(engine) => engine.push(item),
        }
    }

    /// The stretch ends with what has been pushed.
    pub(crate) fn finish(&mut self) {
        self.is_finished = true;
        match &mut self.engine {
            Engine::OnPath(engine) => engine.finish(),
            Engine::InTube(engine) => engine.finish(),
        }
    }

    /// Plans what follows with another override, from the frame given out last.
    pub(crate) fn set_override(&mut self, wanted: Override) {
        match &mut self.engine {
            Engine::OnPath(engine) => engine.set_override(wanted),
            Engine::InTube(engine) => engine.set_override(wanted),
        }
    }

    /// The next frame of the run, as far as the stretch is known: neither the first one, at rest
    /// where it sets out, nor the last one, at rest where it ends.
    pub(crate) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        loop {
            let frame = match &mut self.engine {
                Engine::OnPath(engine) => engine.pop_frame()?,
                Engine::InTube(engine) => engine.pop_frame()?,
            };
            let Some(frame) = frame else {
                return Ok(None);
            };
            if frame.flags.contains(FrameFlags::LAST) {
                self.length_s = Some(frame.path_s);
                return Ok(None);
            }
            if !frame.flags.contains(FrameFlags::FIRST) {
                return Ok(Some(frame));
            }
        }
    }

    /// How long its path is, mm, once all frames of it are taken.
    pub(crate) const fn length_s(&self) -> Option<f64> {
        self.length_s
    }

    /// Multiplications of the solvers so far; closed forms take none.
    pub(crate) fn work(&self) -> usize {
        match &self.engine {
            Engine::OnPath(_) => 0,
            Engine::InTube(engine) => engine.work(),
        }
    }

    /// True if the whole stretch is known.
    pub(crate) const fn is_finished(&self) -> bool {
        self.is_finished
    }
}
