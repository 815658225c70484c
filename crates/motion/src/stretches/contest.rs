//! A short stretch, planned three ways: the fastest is driven.
//!
//! Neither wing is the faster one for certain. In the tube corners are cut as far as the tolerance
//! allows, but where the mode of the path changes the motion stops, and curves come in chords;
//! along the path nothing stops that need not. And what is found in the tube is the best of its
//! neighbourhood only, so it is searched twice, with heavier and with lighter weights beside time:
//! on small things a few periods are some per cent. The plan from rest to rest with the fewest frames
//! is taken; where they are equal, the one in the tube with the heavier weights, which is smoother.
//! With that no such stretch takes longer than with effort "fast", which in turn knows the way with
//! a stop at every block.

use super::way::{Manner, Outset, Way};
use crate::PlanError;
use crate::in_tube::SearchWeights;
use glidepath_geometry::Segment;
use glidepath_program::{Frame, Item, ItemKind, PathMode};
use std::sync::Arc;

/// The longest motion that is kept, s. Many short moves may take far longer than at their rates, and
/// all of a stretch is planned before its first frame is given out.
const MOST_T: f64 = 5.0;

/// What a stretch is planned with, from its first item on.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) outset: Outset,
    pub(crate) items: Arc<[Item]>,
}

/// A stretch whose motion is planned to its end.
#[derive(Debug, Clone)]
pub(crate) struct Planned {
    entry: Entry,
    manner: Manner,
    frames: Arc<[Frame]>,
    taken: usize,
    length_s: f64,
}

impl Planned {
    /// The faster way along a stretch; `None` if it takes too long to be kept.
    pub(crate) fn new(entry: Entry) -> Result<Option<Self>, PlanError> {
        let on_path = Self::by(Manner::OnPath, entry.clone());
        if is_settled(&entry.items) || matches!(on_path, Ok(None)) {
            return on_path;
        }
        let usual = Self::by(Manner::InTube(SearchWeights::USUAL), entry.clone());
        let light = Self::by(Manner::InTube(SearchWeights::LIGHT), entry);
        Self::faster(Self::faster(usual, light), on_path)
    }

    /// Of two plans the one that takes less time, if there are two; the first if it takes as long.
    fn faster(
        first: Result<Option<Self>, PlanError>,
        second: Result<Option<Self>, PlanError>,
    ) -> Result<Option<Self>, PlanError> {
        match (first, second) {
            (Ok(Some(first)), Ok(Some(second))) if second.frames.len() < first.frames.len() => {
                Ok(Some(second))
            }
            (Ok(Some(first)), _) => Ok(Some(first)),
            (_, second) => second,
        }
    }

    fn by(manner: Manner, entry: Entry) -> Result<Option<Self>, PlanError> {
        let mut way = entry.way(manner)?;
        let mut frames = Vec::new();
        let mut time_t = 0.0;
        while let Some(frame) = way.pop_frame()? {
            time_t += entry.outset.settings.period_t;
            if time_t > MOST_T {
                return Ok(None);
            }
            frames.push(frame);
        }
        let length_s = way.length_s().ok_or(entry.no_motion())?;
        Ok(Some(Self {
            entry,
            manner,
            frames: frames.into(),
            taken: 0,
            length_s,
        }))
    }

    /// The next frame on the way.
    pub(crate) fn pop_frame(&mut self) -> Option<Frame> {
        let frame = self.frames.get(self.taken)?;
        self.taken += 1;
        Some(*frame)
    }

    /// How long the way is, mm, once all frames on it are taken.
    pub(crate) fn length_s(&self) -> Option<f64> {
        (self.taken == self.frames.len()).then_some(self.length_s)
    }

    /// The same way under way after the frame given out last: to be gone on differently.
    pub(crate) fn resumed(&self) -> Result<Way, PlanError> {
        let mut way = self.entry.way(self.manner)?;
        for _ in 0..self.taken {
            way.pop_frame()?;
        }
        Ok(way)
    }
}

impl Entry {
    /// The whole stretch, to be driven in some manner.
    pub(crate) fn way(&self, manner: Manner) -> Result<Way, PlanError> {
        let mut way = Way::new(manner, self.outset.clone());
        for item in &*self.items {
            way.push(item)?;
        }
        way.finish();
        Ok(way)
    }

    fn no_motion(&self) -> PlanError {
        let line = self.items.last().map_or(0, |item| item.line);
        PlanError::NoMotion { line }
    }
}

/// True if nothing is left to choose: a single line, or a path to be passed exactly.
fn is_settled(items: &[Item]) -> bool {
    let mut moves = items.iter().filter_map(|item| match item.kind {
        ItemKind::Move { segment, mode, .. } => Some((segment, mode)),
        ItemKind::Dwell(_) | ItemKind::Event(_) => None,
    });
    let is_line = |(segment, _)| matches!(segment, Segment::Line(_));
    let is_single = moves.clone().count() == 1 && moves.clone().all(is_line);
    is_single || moves.all(|(_, mode)| mode == PathMode::ExactPath)
}
