//! A long stretch under way: both ways, until the override changes, and then the one that is driven.

use super::numbers::Numbers;
use super::race::Race;
use super::way::Way;
use crate::PlanError;
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Item, Override, Settings};
use std::collections::VecDeque;

/// What moves the machine along a stretch that is planned as it comes.
#[derive(Debug, Clone)]
pub(super) struct LongStretch {
    numbers: Numbers,
    drive: Drive,
    is_finished: bool,
}

#[derive(Debug, Clone)]
enum Drive {
    Race(Box<Race>),
    Alone(Box<Alone>),
}

/// A way that is gone on by itself.
#[derive(Debug, Clone)]
struct Alone {
    /// Frames to be given out before it.
    before: VecDeque<Frame>,
    way: Way,
    /// What is added to its path positions.
    shift_s: f64,
}

impl LongStretch {
    /// At rest at `start`.
    pub(super) fn new(settings: Settings, start: AxisVector, wanted: Override) -> Self {
        Self {
            numbers: Numbers::new(),
            drive: Drive::Race(Box::new(Race::new(settings, start, wanted))),
            is_finished: false,
        }
    }

    /// Takes the next item of the stretch.
    pub(super) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        let item = self.numbers.number(item);
        match &mut self.drive {
            Drive::Race(race) => race.push(&item),
            Drive::Alone(alone) => alone.way.push(&item),
        }
    }

    /// The stretch ends with what has been pushed.
    pub(super) fn finish(&mut self) {
        self.is_finished = true;
        match &mut self.drive {
            Drive::Race(race) => race.finish(),
            Drive::Alone(alone) => alone.way.finish(),
        }
    }

    /// Plans what follows with another override, from the frame given out last, or from the end of
    /// the joint it is in.
    pub(super) fn set_override(&mut self, wanted: Override) -> Result<(), PlanError> {
        if let Drive::Race(race) = &self.drive {
            let (before, way, shift_s) = race.resumed()?;
            self.drive = Drive::Alone(Box::new(Alone {
                before,
                way,
                shift_s,
            }));
        }
        if let Drive::Alone(alone) = &mut self.drive {
            alone.way.set_override(wanted);
        }
        Ok(())
    }

    /// The next frame, as far as the stretch is known.
    pub(super) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        let frame = match &mut self.drive {
            Drive::Race(race) => race.pop_frame()?,
            Drive::Alone(alone) => alone.pop_frame()?,
        };
        Ok(frame.map(|mut frame| {
            self.numbers.restore(&mut frame);
            frame
        }))
    }

    /// True if the whole stretch is known.
    pub(super) const fn is_finished(&self) -> bool {
        self.is_finished
    }

    /// How long the way is, mm, once all frames on it are taken.
    pub(super) fn length_s(&self) -> Option<f64> {
        match &self.drive {
            Drive::Race(race) => race.length_s(),
            Drive::Alone(alone) => {
                let length_s = alone.way.length_s().filter(|_| alone.before.is_empty());
                length_s.map(|length_s| length_s + alone.shift_s)
            }
        }
    }
}

impl Alone {
    fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        if let Some(frame) = self.before.pop_front() {
            return Ok(Some(frame));
        }
        Ok(self.way.pop_frame()?.map(|mut frame| {
            frame.path_s += self.shift_s;
            frame
        }))
    }
}
