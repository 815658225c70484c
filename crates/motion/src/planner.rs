//! The planner: items in, frames out.

use crate::path::{Element, PathFront};
use crate::sample::Sampler;
use crate::schedule::{Scheduler, Settled};
use crate::{Frame, Item, PlanError, Settings};
use glidepath_geometry::AxisVector;
use std::collections::VecDeque;

/// Plans a program as it comes, in memory that does not grow with its length.
///
/// Push items one by one and take frames whenever there are some. The frames depend on the items
/// alone, not on when they are taken. The first frame is at rest at the start, the last one (flag
/// `LAST`) at rest at the end.
///
/// ```
/// use glidepath_geometry::{AxisVector, Segment};
/// use glidepath_motion::{Effort, Item, ItemKind, Limits, PathMode, Planner, Rate, Settings, Smoothing};
///
/// let settings = Settings {
///     limits: Limits::uniform(200.0, 2000.0, 40_000.0),
///     tolerance_mm: 0.02,
///     smoothing: Smoothing::Sextic,
///     period_t: 0.004,
///     effort: Effort::Fast,
/// };
/// let start = AxisVector::zeros();
/// let mut end = start;
/// end[0] = 10.0;
/// let mut planner = Planner::new(settings, start);
/// planner.push(&Item {
///     line: 1,
///     kind: ItemKind::Move {
///         segment: Segment::line(start, end),
///         rate: Rate::Feed(100.0),
///         mode: PathMode::Continuous { tolerance_mm: None },
///     },
/// })?;
/// planner.finish();
/// let last = std::iter::from_fn(|| planner.pop_frame()).last();
/// assert_eq!(last.map(|frame| frame.position), Some(end));
/// # Ok::<(), glidepath_motion::PlanError>(())
/// ```
#[derive(Debug)]
pub struct Planner {
    front: PathFront,
    scheduler: Scheduler,
    sampler: Sampler,
    elements: Vec<Element>,
    settled: VecDeque<Settled>,
    finished: bool,
}

impl Planner {
    /// A planner for a machine at rest at `start`.
    #[must_use]
    pub fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            front: PathFront::new(settings, start),
            scheduler: Scheduler::new(),
            sampler: Sampler::new(settings.period_t, start),
            elements: Vec::new(),
            settled: VecDeque::new(),
            finished: false,
        }
    }

    /// Takes the next item.
    ///
    /// # Errors
    /// If the item is not finite, does not start where the last one ended, or has a feedrate,
    /// tolerance or dwell out of range. The planner is then as if the item had not been given.
    pub fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        self.front.push(item, &mut self.elements)?;
        self.schedule();
        Ok(())
    }

    /// No more items: what is planned ends at rest. Further calls do nothing.
    pub fn finish(&mut self) {
        if !self.finished {
            self.finished = true;
            self.front.finish(&mut self.elements);
            self.schedule();
        }
    }

    /// The next frame, if the motion is settled that far. Without more items it never is beyond a
    /// certain point until [`Planner::finish`].
    pub fn pop_frame(&mut self) -> Option<Frame> {
        self.sampler.next_frame(&mut self.settled)
    }

    fn schedule(&mut self) {
        for element in self.elements.drain(..) {
            self.scheduler.push(element, &mut self.settled);
        }
    }
}
