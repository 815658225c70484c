//! The on-path engine: path front, look-ahead, refiner and sampler one behind the other.

mod halves;

use super::front::PathFront;
use super::look_ahead::{Scheduler, Settled};
use super::pieces::Element;
use super::refining::{RATE_R, Refiner};
use super::sampler::{NextFrame, Sampler};
use super::slowing::Slowing;
use crate::PlanError;
use crate::joints::{MachineLimits, SharedJoints};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Frame, Item, ItemKind, Limits, Override, Settings};
use std::collections::VecDeque;

/// The on-path engine, as [`crate::Planner`] uses it.
#[derive(Debug, Clone)]
pub(crate) struct OnPathEngine {
    front: PathFront,
    scheduler: Scheduler,
    refiner: Refiner,
    sampler: Sampler,
    elements: Vec<Element>,
    settled: VecDeque<Settled>,
    finished: bool,
    limits: Limits,
    period_t: f64,
    /// An override that is not in the plan yet.
    wanted: Option<Override>,
}

impl OnPathEngine {
    /// A planner for a machine at rest at `start`, under an override from the first move on.
    pub(crate) fn new(settings: Settings, start: AxisVector, wanted: Override) -> Self {
        let mut front = PathFront::new(settings, start);
        front.set_override(wanted);
        Self {
            front,
            scheduler: Scheduler::new(settings.limits, settings.period_t),
            refiner: Refiner::new(MachineLimits::of_axes(settings.limits)),
            sampler: Sampler::new(settings.period_t, start),
            elements: Vec::new(),
            settled: VecDeque::new(),
            finished: false,
            limits: settings.limits,
            period_t: settings.period_t,
            wanted: None,
        }
    }

    /// The same, before its first item, for joints that are not the axes.
    pub(crate) fn with_joints(mut self, joints: SharedJoints) -> Self {
        let limits = MachineLimits::of_axes(self.limits).with_joints(joints);
        self.front = self.front.with_joints(limits.joints.clone());
        self.refiner = Refiner::new(limits);
        self
    }

    /// Takes the next item; see [`crate::Planner::push`].
    pub(crate) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        self.front.push(item, &mut self.elements)?;
        let segment = match item.kind {
            ItemKind::Move { segment, .. } => Some(segment),
            ItemKind::Dwell(_) | ItemKind::Event(_) => None,
        };
        if matches!(segment, Some(Segment::Curve(_))) {
            self.refiner.want();
        }
        self.schedule();
        Ok(())
    }

    /// No more items: what is planned ends at rest. Further calls do nothing.
    pub(crate) fn finish(&mut self) {
        if !self.finished {
            self.finished = true;
            self.front.finish(&mut self.elements);
            self.schedule();
        }
    }

    /// The next frame; see [`crate::Planner::pop_frame`].
    pub(crate) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        let mut frame = Frame::blank(AxisVector::zeros());
        Ok(self.make_frame(&mut frame)?.then_some(frame))
    }

    /// The next frame, in `frame`; see [`crate::Planner::make_frame`].
    pub(crate) fn make_frame(&mut self, frame: &mut Frame) -> Result<bool, PlanError> {
        loop {
            let was_planned = self.plan_anew();
            match self
                .sampler
                .next_frame(&mut self.settled, !was_planned, frame)
            {
                NextFrame::Frame => return Ok(true),
                NextFrame::Junction => {}
                NextFrame::End => return Ok(false),
                NextFrame::Broken { line } => return Err(PlanError::NoMotion { line }),
            }
            // At a junction. If the override cannot be had from here, go on to the next one.
            if !self.plan_anew() {
                match self.sampler.next_frame(&mut self.settled, false, frame) {
                    NextFrame::Frame => return Ok(true),
                    NextFrame::Junction | NextFrame::End => return Ok(false),
                    NextFrame::Broken { line } => return Err(PlanError::NoMotion { line }),
                }
            }
        }
    }

    /// Plans what no frame was taken of with another override: rates times their override, limits
    /// unchanged.
    ///
    /// The new plan begins at the next place where the motion has no acceleration along the path; a
    /// lower override takes effect as soon after that as the speed can be brought down. Each frame
    /// tells the override it was planned with.
    pub(crate) fn set_override(&mut self, wanted: Override) {
        self.front.set_override(wanted);
        self.wanted = Some(wanted);
    }

    /// Puts a wanted override into the plan if that can be done from the last frame. True if there
    /// is none left to put in.
    fn plan_anew(&mut self) -> bool {
        let Some(wanted) = self.wanted else {
            return true;
        };
        let Some(entry_v) = self.sampler.steady_v() else {
            return false;
        };
        // Where a parametrisation is driven, another one can follow it where it is as much slower
        // than S-curves as it begins.
        let may_go_on = entry_v > 0.0 && self.sampler.is_after_parametrisation();
        (may_go_on && self.plan_from(entry_v, RATE_R, wanted))
            || self.plan_from(entry_v, 1.0, wanted)
    }

    /// Plans anew from a speed, which is some rate of that of the S-curves. False if that cannot be
    /// done, and nothing is changed.
    fn plan_from(&mut self, speed_v: f64, rate_r: f64, wanted: Override) -> bool {
        let entry_v = speed_v / rate_r;
        let mut scheduler = Scheduler::entered_at(entry_v, self.limits, self.period_t);
        let mut planned = VecDeque::new();
        let limits = self.limits;
        let remaining_piece = self.sampler.remaining_piece().map(Element::Piece);
        let elements = remaining_piece
            .into_iter()
            .chain(self.settled.iter().flat_map(Settled::elements))
            .chain(self.refiner.elements())
            .chain(self.scheduler.elements());
        let mut slowing = Slowing::new(entry_v, wanted);
        for element in elements {
            let piece = match element {
                Element::Piece(piece) => piece,
                Element::Stops { .. } => continue,
                rest @ (Element::Rest(_) | Element::InnerRest(_)) => {
                    slowing.over = true;
                    scheduler.push(rest, &mut planned);
                    continue;
                }
            };
            let (old, new) = slowing.split(piece);
            if let Some(old) = old {
                scheduler.push(Element::Piece(old), &mut planned);
            }
            if let Some(new) = new {
                if !core::mem::replace(&mut slowing.over, true) {
                    scheduler.close_run();
                }
                scheduler.push(Element::Piece(new.under(wanted, &limits)), &mut planned);
            }
        }
        if !scheduler.is_feasible() {
            return false;
        }
        self.sampler.drop_motion();
        self.scheduler = scheduler;
        let is_slowed = rate_r < 1.0;
        self.refiner.restart(entry_v, is_slowed);
        self.settled.clear();
        for planned in planned {
            if is_slowed {
                self.refiner.push(planned, &mut self.settled);
            } else {
                self.settled.extend(planned.by_s_curves());
            }
        }
        self.wanted = None;
        true
    }

    fn schedule(&mut self) {
        let mut planned = VecDeque::new();
        for element in self.elements.drain(..) {
            self.scheduler.push(element, &mut planned);
        }
        for planned in planned {
            self.refiner.push(planned, &mut self.settled);
        }
    }
}
