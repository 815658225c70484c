//! The selection among candidates: a short stretch is planned in several ways, and the fastest is driven.
//!
//! Neither engine is the faster one for certain. In the tube corners are cut as far as the tolerance
//! allows, but where the mode of the path changes the motion stops, and curves come in chords;
//! along the path nothing stops that need not. And what is found in the tube is the best of its
//! neighbourhood only, so it is searched again with another bias, twice where it is small: a few
//! periods are some per cent there. What takes more than a second or so is searched again only if it
//! is slower than along the path. The plan from rest to rest with the fewest frames is taken; where
//! they are equal, the one of the usual search, which is smoother.
//! With that no such stretch takes longer than with effort "fast", which in turn knows the way with
//! a stop at every block.

use super::engine_run::{EngineRun, InitialState, Strategy};
use super::entry::{Entry, SuppliedRun};
use super::tight_arcs::has_tight_arcs;
use crate::PlanError;
use crate::guard::Guard;
use crate::in_tube::SearchBias;
use glidepath_geometry::Segment;
use glidepath_program::{Frame, Item, ItemKind, PathMode};
use std::sync::Arc;

/// The longest motion that is kept, s. Many short moves may take far longer than at their rates, and
/// all of a stretch is planned before its first frame is given out.
const MOST_T: f64 = 8.0;
/// From one place to the next at which a run can be taken up again, s: about as much as is published
/// ahead.
const PLACE_T: f64 = 0.5;
/// The longest stretch that is searched twice in any case, s at its rates: of longer ones a few
/// periods are not much, and the work is.
///
/// On random programs one search takes 1.8 % longer than the best of many below .1 s, .4 % at .3 s,
/// .2 % at 1 s; two take .4, .15 and .05 %, three .05, .03 and .02 %.
const MOST_TWICE_T: f64 = 1.25;
/// The longest stretch that is searched a third time, s at its rates.
const MOST_THRICE_T: f64 = 0.4;
/// Most work of the first two searches, multiplications for a second of motion, with which a third
/// one is begun: with more of it, small stretches in a row would be driven faster than planned. Where joints are
/// not the axes, it is begun all the same: what is found there is further from the best.
const EASY_WORK_PER_S: f64 = 3e8;

/// How a stretch is driven that is planned as it comes: there is nothing to hold its windows against. Of twelve programs
/// for machines whose joints are not axes, repeated to 20 s, windows in a row took 4 to 25 % less than the way along the path.
pub(crate) const ALONE: Strategy = Strategy::InTube(SearchBias::USUAL);
/// The longest motion that is tried of a stretch with tight arcs, s: its moves take 5 s at their rates.
const MOST_TRIED_T: f64 = 60.0;

/// How a stretch is driven that is planned as it comes: in the tube; if it has tight arcs, or joints limit it that are not
/// the axes, the way that is faster along the items given, which it begins with.
pub(crate) fn strategy_of(entry: &Entry) -> Strategy {
    let settings = &entry.initial_state.settings;
    if entry.initial_state.joints.is_none() && !has_tight_arcs(&entry.items, settings) {
        return ALONE;
    }
    if is_settled(&entry.items) {
        return Strategy::OnPath;
    }
    let tried = |strategy, most_t| {
        let planned = PlannedStretch::within(strategy, entry.clone(), most_t);
        planned
            .ok()
            .flatten()
            .filter(|planned| planned.is_allowed(&entry.initial_state))
    };
    let Some(on_path) = tried(Strategy::OnPath, MOST_TRIED_T) else {
        return ALONE;
    };
    // What takes longer in the tube is not followed to its end: it may take many times as long.
    let most_t = (on_path.frames.len() as f64 + 0.5) * settings.period_t;
    if tried(ALONE, most_t).is_some() {
        ALONE
    } else {
        Strategy::OnPath
    }
}

/// A stretch whose motion is planned to its end.
#[derive(Debug, Clone)]
pub(crate) struct PlannedStretch {
    frames: Arc<[Frame]>,
    taken: usize,
    length_s: f64,
    /// Multiplications of the solvers.
    work: usize,
    /// The run after some of the frames, ascending from none: whoever goes on differently does not
    /// have to plan it from its start.
    places: Arc<[(usize, SuppliedRun)]>,
}

impl PlannedStretch {
    /// The fastest run along a stretch; `None` if it takes too long to be kept.
    pub(crate) fn new(entry: Entry) -> Result<Option<Self>, PlanError> {
        let on_path = Self::by(Strategy::OnPath, entry.clone());
        if is_settled(&entry.items) || matches!(on_path, Ok(None)) {
            return on_path;
        }
        let allowed = |run: Result<Option<Self>, PlanError>| {
            run.map(|run| run.filter(|run| run.is_allowed(&entry.initial_state)))
        };
        let on_path = allowed(on_path);
        let in_tube = |bias| allowed(Self::by(Strategy::InTube(bias), entry.clone()));
        let usual = in_tube(SearchBias::USUAL);
        if entry.at_rates_t > MOST_TWICE_T && is_as_fast(&usual, &on_path) {
            return usual;
        }
        let light = in_tube(SearchBias::LIGHT);
        let may_go_on = entry.at_rates_t <= MOST_THRICE_T
            && (entry.initial_state.joints.is_some()
                || is_easy(&[&usual, &light], entry.initial_state.settings.period_t));
        let mut fastest = Self::faster(usual, light);
        if may_go_on {
            fastest = Self::faster(fastest, in_tube(SearchBias::HURRIED));
        }
        Self::faster(fastest, on_path)
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

    fn by(strategy: Strategy, entry: Entry) -> Result<Option<Self>, PlanError> {
        Self::within(strategy, entry, MOST_T)
    }

    /// The run by a strategy; `None` if it takes longer than that.
    fn within(strategy: Strategy, entry: Entry, most_t: f64) -> Result<Option<Self>, PlanError> {
        let InitialState {
            settings, start, ..
        } = &entry.initial_state;
        let mut guard = Guard::new(settings).resting_at(*start);
        let period_t = settings.period_t;
        let mut run = SuppliedRun::new(strategy, entry);
        let mut places = vec![(0, run.clone())];
        let mut frames = Vec::new();
        let mut time_t = 0.0;
        while let Some(frame) = run.pop_frame()? {
            // A run that cannot be driven loses against any other.
            guard.check(&frame)?;
            time_t += period_t;
            if time_t > most_t {
                return Ok(None);
            }
            frames.push(frame);
            if time_t >= PLACE_T * places.len() as f64 {
                places.push((frames.len(), run.clone()));
            }
        }
        let length_s = run.length_s()?;
        Ok(Some(Self {
            frames: frames.into(),
            taken: 0,
            length_s,
            work: run.work(),
            places: places.into(),
        }))
    }

    /// True if joints that are not the axes can follow, as far as they are known.
    fn is_allowed(&self, initial_state: &InitialState) -> bool {
        let Some(joints) = &initial_state.joints else {
            return true;
        };
        let mut recent = [initial_state.start; 4];
        self.frames.iter().all(|frame| {
            recent.rotate_right(1);
            recent[0] = frame.position;
            joints.allow(&recent, initial_state.settings.period_t)
        })
    }

    /// The next frame of the run.
    pub(crate) fn pop_frame(&mut self) -> Option<Frame> {
        let frame = self.frames.get(self.taken)?;
        self.taken += 1;
        Some(*frame)
    }

    /// How long its path is, mm, once all frames of it are taken.
    pub(crate) fn length_s(&self) -> Option<f64> {
        (self.taken == self.frames.len()).then_some(self.length_s)
    }

    /// The same run after the frame given out last: to be gone on differently.
    pub(crate) fn resumed(&self) -> Result<EngineRun, PlanError> {
        let passed = self.places.partition_point(|(at, _)| *at <= self.taken);
        let (at, mut run) = self.places[passed - 1].clone();
        for _ in at..self.taken {
            run.pop_frame()?;
        }
        run.whole()
    }
}

/// True if searches have taken little work for the motion they found.
fn is_easy(searches: &[&Result<Option<PlannedStretch>, PlanError>], period_t: f64) -> bool {
    let found = searches
        .iter()
        .filter_map(|search| search.as_ref().ok()?.as_ref());
    let work: usize = found.clone().map(|planned| planned.work).sum();
    let least = found.map(|planned| planned.frames.len()).min().unwrap_or(0);
    work as f64 <= EASY_WORK_PER_S * least as f64 * period_t
}

/// True if the first of two plans takes no longer.
fn is_as_fast(
    first: &Result<Option<PlannedStretch>, PlanError>,
    second: &Result<Option<PlannedStretch>, PlanError>,
) -> bool {
    matches!((first, second), (Ok(Some(first)), Ok(Some(second)))
        if first.frames.len() <= second.frames.len())
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

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::AxisVector;
    use glidepath_program::{Effort, Limits, Override, ProgramLine, Rate, Settings, Smoothing};

    /// Some seconds of teeth.
    fn teeth() -> Entry {
        let at = |k: u32| {
            let mut position = AxisVector::zeros();
            (position[0], position[1]) = (0.7 * f64::from(k), 3.0 * f64::from(k % 2));
            position
        };
        let items = (0..40).map(|k| {
            ProgramLine {
                number: k + 1,
                block: k + 1,
            }
            .item(ItemKind::Move {
                segment: Segment::line(at(k), at(k + 1)),
                rate: Rate::Feed(60.0),
                mode: PathMode::Continuous { tolerance_mm: None },
            })
        });
        Entry {
            initial_state: InitialState {
                settings: Settings {
                    limits: Limits::uniform(200.0, 2000.0, 40_000.0),
                    tolerance_mm: 0.02,
                    direction: glidepath_program::DirectionTolerance::default(),
                    smoothing: Smoothing::Auto,
                    corners: glidepath_program::Corners::default(),
                    period_t: 0.004,
                    effort: Effort::Optimal,
                },
                joints: None,
                start: at(0),
                wanted: Override::NONE,
            },
            items: items.collect(),
            at_rates_t: 2.0,
        }
    }

    #[test]
    fn a_way_that_is_taken_up_again_goes_on_as_it_was() {
        for strategy in [Strategy::OnPath, Strategy::InTube(SearchBias::USUAL)] {
            let mut planned = PlannedStretch::by(strategy, teeth()).unwrap().unwrap();
            let frames = planned.frames.clone();
            assert!(planned.places.len() > 3, "{} places", planned.places.len());
            for k in 0..frames.len() {
                if k % 131 == 0 || planned.places.iter().any(|(at, _)| *at == k) {
                    let mut run = planned.resumed().unwrap();
                    for frame in &frames[k..] {
                        assert_eq!(
                            run.pop_frame().unwrap().as_ref(),
                            Some(frame),
                            "{strategy:?}, {k}"
                        );
                    }
                    assert_eq!(run.pop_frame().unwrap(), None);
                }
                planned.pop_frame();
            }
        }
    }
}
