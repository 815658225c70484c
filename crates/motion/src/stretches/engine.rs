//! The engine: stretches and rests one after the other, on one grid of frames.

use super::contest::{Entry, Planned};
use super::gathering::{Gathering, Task};
use super::long_stretch::LongStretch;
use super::way::{Manner, Way};
use crate::PlanError;
use crate::grid::FrameGrid;
use crate::in_tube::SearchWeights;
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Item, ItemKind, Override, Settings};

/// How a short stretch is driven whose motion takes too long to be kept.
const ALONE: Manner = Manner::InTube(SearchWeights::USUAL);

/// Whether an item is of a pass of a thread. It is to be at its rate exactly between run-in and
/// run-out, which S-curves are.
fn follows_spindle(item: &Item) -> bool {
    matches!(item.kind, ItemKind::Move { rate, .. } if rate.is_synchronised())
}

/// Plans stretch by stretch, as [`crate::Planner`] uses it.
#[derive(Debug, Clone)]
pub(crate) struct StretchEngine {
    settings: Settings,
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
    Planned(Box<Planned>),
    /// The same, planned as it comes: it takes too long to be kept, its override was changed, or it
    /// follows the spindle.
    Live(Way),
    /// A long stretch.
    Long(Box<LongStretch>),
}

impl StretchEngine {
    /// An engine for a machine at rest at `start`.
    pub(crate) fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            settings,
            wanted: Override::NONE,
            gathering: Gathering::new(settings, start),
            grid: FrameGrid::new(settings.period_t, start),
            drive: Drive::None,
            position: start,
            end: start,
            path_s: 0.0,
        }
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
        match &mut self.drive {
            Drive::None | Drive::Planned(_) => Ok(()),
            Drive::Live(way) => {
                way.set_override(wanted);
                Ok(())
            }
            Drive::Long(stretch) => stretch.set_override(wanted),
        }
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
                Drive::Live(way) => (way.pop_frame()?, way.length_s()),
                Drive::Long(stretch) => (stretch.pop_frame()?, stretch.length_s()),
            };
            if let Some(mut frame) = moved {
                frame.path_s += self.path_s;
                return Ok(Some(self.grid.relay(frame)));
            }
            if let Some(length_s) = length_s {
                self.arrive(length_s);
            } else if self.is_stuck() {
                let line = self.grid.line().number;
                return Err(PlanError::NoMotion { line });
            } else if !self.supply()? {
                return Ok(None);
            }
        }
    }

    fn arrive(&mut self, length_s: f64) {
        self.position = self.end;
        self.path_s += length_s;
        self.grid.leave(self.end, self.path_s);
        self.drive = Drive::None;
    }

    /// True if a stretch whose end is known gives no motion: there is nothing to wait for.
    fn is_stuck(&self) -> bool {
        match &self.drive {
            Drive::None | Drive::Planned(_) => false,
            Drive::Live(way) => way.is_finished(),
            Drive::Long(stretch) => stretch.is_finished(),
        }
    }

    /// Does what comes next; false if the program is not known further.
    fn supply(&mut self) -> Result<bool, PlanError> {
        let Some(task) = self.gathering.next() else {
            return Ok(false);
        };
        match task {
            Task::Whole { items, end } => {
                self.end = end;
                let entry = Entry {
                    settings: self.settings,
                    start: self.position,
                    wanted: self.wanted,
                    items: items.into(),
                };
                let is_pass = entry.items.iter().any(follows_spindle);
                self.drive = if is_pass {
                    Drive::Live(entry.way(Manner::OnPath)?)
                } else if let Some(planned) = Planned::new(entry.clone())? {
                    Drive::Planned(Box::new(planned))
                } else {
                    Drive::Live(entry.way(ALONE)?)
                };
            }
            Task::Part(item) => {
                if matches!(self.drive, Drive::None) {
                    self.drive = if follows_spindle(&item) {
                        let way =
                            Way::new(Manner::OnPath, self.settings, self.position, self.wanted);
                        Drive::Live(way)
                    } else {
                        let stretch = LongStretch::new(self.settings, self.position, self.wanted);
                        Drive::Long(Box::new(stretch))
                    };
                }
                match &mut self.drive {
                    Drive::Long(stretch) => stretch.push(&item)?,
                    // A pass of a thread.
                    Drive::Live(way) => way.push(&item)?,
                    Drive::None | Drive::Planned(_) => {}
                }
            }
            Task::End(end) => {
                self.end = end;
                match &mut self.drive {
                    Drive::Long(stretch) => stretch.finish(),
                    Drive::Live(way) => way.finish(),
                    Drive::None | Drive::Planned(_) => {}
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
