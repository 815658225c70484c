//! The stretch engine: stretches and rests one after the other, on one grid of frames.

use super::candidate_selection::{ALONE, PlannedStretch, strategy_of};
use super::engine_run::{EngineRun, InitialState};
use super::entry::Entry;
use super::gathering::{Gathering, Task};
use crate::grid::FrameGrid;
use crate::joints::SharedJoints;
use crate::{Joints, PlanError};
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Item, Override, Settings};
use std::sync::Arc;

/// Plans stretch by stretch, as [`crate::Planner`] uses it.
#[derive(Debug, Clone)]
pub(crate) struct StretchEngine {
    settings: Settings,
    joints: SharedJoints,
    wanted: Override,
    gathering: Gathering,
    grid: FrameGrid,
    drive: Drive,
    /// Where the stretch at hand begins, and where it ends once that is known: exactly where the
    /// program does, whatever the last frame on the way is rounded to.
    position: AxisVector,
    end: AxisVector,
    path_s: f64,
}

/// What moves the machine.
#[derive(Debug, Clone)]
enum Drive {
    /// At rest.
    None,
    /// A short stretch, planned to its end.
    Planned(Box<PlannedStretch>),
    /// A stretch that is planned as it comes, or whose override was changed.
    Live(EngineRun),
}

impl StretchEngine {
    /// An engine for a machine at rest at `start`.
    pub(crate) fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            settings,
            joints: None,
            wanted: Override::NONE,
            gathering: Gathering::new(settings, start),
            grid: FrameGrid::new(settings.period_t, start),
            drive: Drive::None,
            position: start,
            end: start,
            path_s: 0.0,
        }
    }

    /// See [`crate::Planner::with_joints`].
    pub(crate) fn set_joints(&mut self, joints: Arc<dyn Joints>) {
        self.joints = Some(joints);
    }

    /// See [`crate::Planner::of_stream`].
    pub(crate) const fn set_stream(&mut self) {
        self.gathering.set_stream();
    }

    /// Takes the next item; see [`crate::Planner::push`].
    pub(crate) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        self.gathering.push(item)
    }

    /// No more items.
    pub(crate) fn finish(&mut self) {
        self.gathering.finish();
    }

    /// Plans what follows with another override, from the frame given out last.
    pub(crate) fn set_override(&mut self, wanted: Override) -> Result<(), PlanError> {
        self.wanted = wanted;
        if let Drive::Planned(planned) = &self.drive {
            self.drive = Drive::Live(planned.resumed()?);
        }
        if let Drive::Live(run) = &mut self.drive {
            run.set_override(wanted);
        }
        Ok(())
    }

    /// The next frame; see [`crate::Planner::pop_frame`].
    pub(crate) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        loop {
            if let Some(frame) = self.grid.rest_frame() {
                return Ok(Some(frame));
            }
            let (moved, length_s) = match &mut self.drive {
                Drive::None => (None, None),
                Drive::Planned(planned) => (planned.pop_frame(), planned.length_s()),
                Drive::Live(run) => (run.pop_frame()?, run.length_s()),
            };
            if let Some(mut frame) = moved {
                frame.path_s += self.path_s;
                return Ok(Some(self.grid.relay(frame)));
            }
            if let Some(length_s) = length_s {
                self.arrive(length_s);
            } else if matches!(&self.drive, Drive::Live(run) if run.is_finished()) {
                let line = self.grid.line().number;
                return Err(PlanError::NoMotion { line });
            } else if !self.supply()? {
                return Ok(None);
            }
        }
    }

    /// What the next stretch begins with.
    fn initial_state(&self) -> InitialState {
        InitialState {
            settings: self.settings,
            joints: self.joints.clone(),
            start: self.position,
            wanted: self.wanted,
        }
    }

    fn arrive(&mut self, length_s: f64) {
        self.position = self.end;
        self.path_s += length_s;
        self.grid.leave(self.end, self.path_s);
        self.drive = Drive::None;
    }

    /// Does what comes next; false if the program is not known further.
    fn supply(&mut self) -> Result<bool, PlanError> {
        let Some(task) = self.gathering.next() else {
            return Ok(false);
        };
        match task {
            Task::Whole {
                items,
                at_rates_t,
                end,
            } => {
                self.end = end;
                let entry = Entry {
                    initial_state: self.initial_state(),
                    items: items.into(),
                    at_rates_t,
                };
                self.drive = match PlannedStretch::new(entry.clone())? {
                    Some(planned) => Drive::Planned(Box::new(planned)),
                    None => {
                        let strategy = strategy_of(&entry);
                        Drive::Live(entry.run(strategy)?)
                    }
                };
            }
            Task::Begin { items, at_rates_t } => {
                let entry = Entry {
                    initial_state: self.initial_state(),
                    items: items.into(),
                    at_rates_t,
                };
                let mut run = EngineRun::new(strategy_of(&entry), self.initial_state());
                for item in entry.items.iter() {
                    run.push(item)?;
                }
                self.drive = Drive::Live(run);
            }
            Task::Part(item) => {
                if matches!(self.drive, Drive::None) {
                    let run = EngineRun::new(ALONE, self.initial_state());
                    self.drive = Drive::Live(run);
                }
                if let Drive::Live(run) = &mut self.drive {
                    run.push(&item)?;
                }
            }
            Task::End(end) => {
                self.end = end;
                if let Drive::Live(run) = &mut self.drive {
                    run.finish();
                }
            }
            Task::Rest(rest) => {
                self.grid.enter_rest(rest);
            }
        }
        Ok(true)
    }

    /// After each frame: where the stretch that ended with it ends, if one did, in path position as
    /// the frame counts it. From there on it is counted anew, from 0.
    ///
    /// Frames tell path position as the sum of where their stretch begins and how far they are in
    /// it. Whoever knows where stretches begin in a whole program adds that up to the same bits.
    pub(crate) fn take_origin(&mut self) -> Option<f64> {
        let origin_s = core::mem::take(&mut self.path_s);
        (origin_s != 0.0).then(|| {
            self.grid.count_from_here();
            origin_s
        })
    }
}
