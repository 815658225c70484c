//! One of two ways along a long stretch: its frames since where both met last, and copies of it from
//! which it can be gone on differently.

use super::program_path::{Place, ProgramPath};
use super::way::{Manner, Way};
use crate::PlanError;
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Item, Override, Settings};
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::Arc;

/// Frames between two copies of a way: what is planned once more, at most, when an override changes.
const MARK_FRAMES: usize = 128;

/// A way whose frames are kept until they are driven, or passed by. Frames are numbered by periods
/// since the start of the stretch.
#[derive(Debug, Clone)]
pub(super) struct Runner {
    way: Way,
    frames: VecDeque<PlacedFrame>,
    /// Number of the first of them.
    first: usize,
    /// Events that were told before it.
    events: usize,
    marks: VecDeque<Mark>,
    failure: Option<PlanError>,
}

/// A frame, and where it is on the program, if that is known.
#[derive(Debug, Clone)]
struct PlacedFrame {
    frame: Frame,
    place: Option<Place>,
}

/// A way as it was before a frame, when so many items had been pushed.
#[derive(Debug, Clone)]
struct Mark {
    frame: usize,
    items: u64,
    way: Arc<Way>,
}

/// The last items pushed, from a number on.
#[derive(Debug, Clone, Default)]
pub(super) struct ItemLog {
    first: u64,
    items: VecDeque<Item>,
    is_finished: bool,
}

impl ItemLog {
    pub(super) fn push(&mut self, item: Item) {
        self.items.push_back(item);
    }

    pub(super) const fn finish(&mut self) {
        self.is_finished = true;
    }

    fn count(&self) -> u64 {
        self.first + self.items.len() as u64
    }

    /// Drops the items before a number.
    pub(super) fn forget_before(&mut self, number: u64) {
        while self.first < number && self.items.pop_front().is_some() {
            self.first += 1;
        }
    }

    fn since(&self, number: u64) -> impl Iterator<Item = &Item> {
        let passed = usize::try_from(number.saturating_sub(self.first)).unwrap_or(usize::MAX);
        self.items.iter().skip(passed)
    }
}

impl Runner {
    pub(super) fn new(
        manner: Manner,
        settings: Settings,
        start: AxisVector,
        wanted: Override,
    ) -> Self {
        let way = Way::new(manner, settings, start, wanted);
        let mark = Mark {
            frame: 1,
            items: 0,
            way: Arc::new(way.clone()),
        };
        Self {
            way,
            frames: VecDeque::new(),
            first: 1,
            events: 0,
            marks: VecDeque::from([mark]),
            failure: None,
        }
    }

    pub(super) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        self.way.push(item)
    }

    pub(super) fn finish(&mut self) {
        self.way.finish();
    }

    /// Plans up to a frame, not included. False if the program is not known far enough; true also if
    /// the way ends before or no motion is found.
    pub(super) fn plan_to(&mut self, end: usize, program: &ProgramPath, log: &ItemLog) -> bool {
        while self.end() < end && !self.is_over() {
            let marked = self.marks.back().map_or(0, |mark| mark.frame);
            if self.end() >= marked + MARK_FRAMES {
                self.marks.push_back(Mark {
                    frame: self.end(),
                    items: log.count(),
                    way: Arc::new(self.way.clone()),
                });
            }
            match self.way.pop_frame() {
                Ok(Some(frame)) => {
                    let place = program.place(frame.block, &frame.position);
                    self.frames.push_back(PlacedFrame { frame, place });
                }
                Ok(None) if self.way.length_s().is_some() => {}
                Ok(None) if self.way.is_finished() => {
                    let line = self.frames.back().map_or(0, |last| last.frame.line);
                    self.failure = Some(PlanError::NoMotion { line });
                }
                Ok(None) => return false,
                Err(error) => self.failure = Some(error),
            }
        }
        true
    }

    /// True if there are no frames but those that are known.
    pub(super) const fn is_over(&self) -> bool {
        self.failure.is_some() || self.way.length_s().is_some()
    }

    /// Why the way does not lead to the end of the stretch, if it does not.
    pub(super) const fn failure(&self) -> Option<PlanError> {
        self.failure
    }

    /// How long the way is, mm, once it is planned to its end.
    pub(super) const fn length_s(&self) -> Option<f64> {
        self.way.length_s()
    }

    /// Number of the first frame that is kept.
    pub(super) const fn first(&self) -> usize {
        self.first
    }

    /// Number of the frame after the last one planned.
    pub(super) fn end(&self) -> usize {
        self.first + self.frames.len()
    }

    pub(super) fn frame(&self, number: usize) -> Option<&Frame> {
        let placed = self.frames.get(number.checked_sub(self.first)?);
        placed.map(|placed| &placed.frame)
    }

    /// Where a frame is on the program.
    pub(super) fn place(&self, number: usize) -> Option<&Place> {
        let placed = self.frames.get(number.checked_sub(self.first)?);
        placed.and_then(|placed| placed.place.as_ref())
    }

    /// When a place is passed, in frames, among some.
    pub(super) fn passes(&self, at_s: f64, among: &Range<usize>) -> Option<f64> {
        let place_s = |number: usize| self.place(number).map(|place| place.at_s);
        let after = among.clone().find(|&number| place_s(number) > Some(at_s))?;
        if after == among.start {
            return None;
        }
        let (before_s, after_s) = (place_s(after - 1)?, place_s(after)?);
        #[expect(clippy::cast_precision_loss, reason = "exact for any stretch")]
        let after = after as f64;
        Some(after - (after_s - at_s) / (after_s - before_s))
    }

    /// How many events are told before a frame.
    pub(super) fn events_before(&self, number: usize) -> usize {
        let kept = self.frames.iter().take(number.saturating_sub(self.first));
        self.events + kept.filter(|placed| placed.frame.event.is_some()).count()
    }

    /// The next frame, which is not kept any more.
    pub(super) fn take(&mut self) -> Option<Frame> {
        let PlacedFrame { frame, .. } = self.frames.pop_front()?;
        self.first += 1;
        self.events += usize::from(frame.event.is_some());
        self.forget_marks();
        Some(frame)
    }

    /// Drops the frames before a number.
    pub(super) fn pass_to(&mut self, number: usize) {
        while self.first < number && self.take().is_some() {}
    }

    fn forget_marks(&mut self) {
        while self
            .marks
            .get(1)
            .is_some_and(|next| next.frame <= self.first)
        {
            self.marks.pop_front();
        }
    }

    /// Number of the first item that is needed to go on from a frame that is kept.
    pub(super) fn first_item(&self) -> u64 {
        self.marks.front().map_or(0, |mark| mark.items)
    }

    /// The way after the frames before the first one kept.
    pub(super) fn resumed(&self, log: &ItemLog) -> Result<Way, PlanError> {
        let Some(mark) = self.marks.front() else {
            return Err(PlanError::NoMotion { line: 0 });
        };
        let mut way = Way::clone(&mark.way);
        for item in log.since(mark.items) {
            way.push(item)?;
        }
        if log.is_finished {
            way.finish();
        }
        for _ in mark.frame..self.first {
            way.pop_frame()?;
        }
        Ok(way)
    }
}
