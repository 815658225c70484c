//! The plan of a file, ahead of time: on one core or on all.

use crate::config::MachineConfig;
use glidepath_geometry::AxisVector;
use glidepath_planner::{FileSource, ParallelPipeline, Pipeline, Refusal, Statistics, Step};
use glidepath_program::{Frame, Item};
use std::num::NonZeroUsize;
use std::thread::available_parallelism;

/// Gives items and frames in order, which are the same on one core and on all.
#[derive(Debug)]
pub(crate) enum PlanSteps {
    OneCore(Box<Pipeline<FileSource>>),
    AllCores(Box<ParallelPipeline>),
}

impl PlanSteps {
    /// Plans with all cores, from a position.
    ///
    /// # Errors
    /// The source cannot be had.
    pub(crate) fn on_all_cores(
        source: impl Fn() -> Result<FileSource, Refusal>,
        config: &MachineConfig,
        start: AxisVector,
    ) -> Result<Self, Refusal> {
        let cores = available_parallelism().unwrap_or(NonZeroUsize::MIN);
        if cores > NonZeroUsize::MIN {
            let (settings, joints) = (config.settings(), config.limited_mechanism());
            let planned = ParallelPipeline::start(source()?, settings, start, joints, cores);
            if let Ok(pipeline) = planned {
                return Ok(Self::AllCores(Box::new(pipeline)));
            }
            // Where no threads are to be had, this one does it.
        }
        Ok(Self::on_one_core(source()?, config, start))
    }

    /// Plans in the calling thread, as it is asked for steps.
    pub(crate) fn on_one_core(
        source: FileSource,
        config: &MachineConfig,
        start: AxisVector,
    ) -> Self {
        let pipeline = Pipeline::new(source, config.settings(), start);
        Self::OneCore(Box::new(pipeline.with_joints(config.limited_mechanism())))
    }

    /// As [`Pipeline::step`].
    ///
    /// # Errors
    /// As [`Pipeline::advance`].
    pub(crate) fn step(&mut self) -> Result<Step, Refusal> {
        match self {
            Self::OneCore(pipeline) => pipeline.step(),
            Self::AllCores(pipeline) => pipeline.step(),
        }
    }

    /// As [`Pipeline::next_frame`].
    ///
    /// # Errors
    /// As [`Pipeline::advance`].
    pub(crate) fn next_frame(&mut self) -> Result<Option<Frame>, Refusal> {
        match self {
            Self::OneCore(pipeline) => pipeline.next_frame(),
            Self::AllCores(pipeline) => pipeline.next_frame(),
        }
    }

    /// As [`Pipeline::item`].
    pub(crate) fn item(&self) -> &Item {
        match self {
            Self::OneCore(pipeline) => pipeline.item(),
            Self::AllCores(pipeline) => pipeline.item(),
        }
    }

    /// As [`Pipeline::frame`].
    pub(crate) fn frame(&self) -> &Frame {
        match self {
            Self::OneCore(pipeline) => pipeline.frame(),
            Self::AllCores(pipeline) => pipeline.frame(),
        }
    }

    /// As [`Pipeline::statistics`].
    pub(crate) fn statistics(&self) -> Statistics {
        match self {
            Self::OneCore(pipeline) => pipeline.statistics(),
            Self::AllCores(pipeline) => pipeline.statistics(),
        }
    }
}
