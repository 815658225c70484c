//! The search for the machine along a program.

use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind, PathMode};

use super::point::ResumePoint;
use crate::run::nearness::{ROUNDING_MM, distance};

/// Angle between two looks at an arc.
const ARC_STEP_RAD: f64 = 0.05;

/// How far the distance travelled may be from that along the program: rounded corners are shorter,
/// and the interpolator notices the beginning of a block up to a period late.
const SLACK_MM: f64 = 2.0;
const SLACK_R: f64 = 0.05;

/// A point of the program at which the machine may stand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Standpoint {
    /// The index of the item, counted from the block on.
    pub(super) item: usize,
    /// Part of its length.
    pub(super) part: f64,
    pub(super) distance_mm: f64,
    /// Difference between the length of the program up to there and the distance travelled, mm.
    mismatch_mm: f64,
}

/// The search for the machine along the program.
#[derive(Debug)]
pub(super) struct MachineSearch {
    position: AxisVector,
    travelled_mm: f64,
    tolerance_mm: f64,
    /// Length of the items looked at, mm, and their number.
    passed_mm: f64,
    items: usize,
    pub(super) best: Option<Standpoint>,
    /// From the nearest point that came into question to the machine.
    nearest: Option<AxisVector>,
    /// The same from the point to which it has travelled, and from the nearest of all.
    travelled_to: Option<AxisVector>,
    nearest_of_all: Option<AxisVector>,
    ended: bool,
}

impl MachineSearch {
    pub(super) fn new(point: ResumePoint, tolerance_mm: f64) -> Self {
        Self {
            position: point.position,
            travelled_mm: (point.path_s - point.block_path_s).max(0.0),
            tolerance_mm,
            passed_mm: 0.0,
            items: 0,
            best: None,
            nearest: None,
            travelled_to: None,
            nearest_of_all: None,
            ended: false,
        }
    }

    /// From where the program was left to the machine: from the nearest point that comes into question by
    /// the distance travelled; a machine that was moved along the path may be near none of them.
    pub(super) fn away(&self) -> Option<AxisVector> {
        self.nearest.or(self.travelled_to).or(self.nearest_of_all)
    }

    /// How far from the program the machine may be, mm.
    pub(super) const fn tolerance_mm(&self) -> f64 {
        self.tolerance_mm
    }

    /// Whether what follows may be nearer.
    pub(super) fn goes_on(&self) -> bool {
        let reach_mm = self.travelled_mm + SLACK_MM + SLACK_R * self.travelled_mm;
        !self.ended && self.passed_mm <= reach_mm
    }

    pub(super) fn look_at(&mut self, item: &Item) {
        let place = self.items;
        self.items += 1;
        match &item.kind {
            ItemKind::Move { segment, mode, .. } => {
                if let PathMode::Continuous {
                    tolerance_mm: Some(tolerance_mm),
                } = mode
                {
                    self.tolerance_mm = self.tolerance_mm.max(*tolerance_mm);
                }
                match segment {
                    Segment::Line(line) => {
                        let way = line.displacement();
                        let part = (self.position - line.start).dot(&way) / way.norm_squared();
                        // NaN for a line without length.
                        let part = if part > 0.0 { part.min(1.0) } else { 0.0 };
                        self.consider(place, segment, part);
                    }
                    Segment::Arc(arc) => self.look_along(place, segment, arc.sweep_rad.abs()),
                    // Its pieces turn little.
                    Segment::Curve(_) => self.look_along(place, segment, 0.0),
                }
                let length_mm = segment.length();
                let part = (self.travelled_mm - self.passed_mm) / length_mm;
                if (0.0..=1.0).contains(&part) {
                    self.travelled_to = Some(self.position - point_of(segment, part));
                }
                self.passed_mm += length_mm;
            }
            // The motion does not go on without resting here, and telling so by the block.
            ItemKind::Dwell(_) => self.ended = true,
            ItemKind::Event(event) => self.ended |= event.is_at_rest() || place == 0,
        }
    }

    /// Looks for the points of an arc that are nearer than those around them.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a number of steps, at least 1"
    )]
    fn look_along(&mut self, place: usize, segment: &Segment, sweep_rad: f64) {
        let steps = (sweep_rad / ARC_STEP_RAD).ceil().max(2.0);
        let at = |part: f64| distance(&(point_of(segment, part) - self.position));
        let mut found = Vec::new();
        for k in 0..=steps as u64 {
            let [before, here, after] =
                [-1.0, 0.0, 1.0].map(|d| ((k as f64 + d) / steps).clamp(0.0, 1.0));
            if at(here) <= at(before) && at(here) <= at(after) {
                found.push(nearest_between(before, after, at));
            }
        }
        for part in found {
            self.consider(place, segment, part);
        }
    }

    fn consider(&mut self, item: usize, segment: &Segment, part: f64) {
        let away = self.position - point_of(segment, part);
        let distance_mm = distance(&away);
        keep_nearer(&mut self.nearest_of_all, away);
        let along_mm = self.passed_mm + part * segment.length();
        let mismatch_mm = (along_mm - self.travelled_mm).abs();
        if mismatch_mm > SLACK_MM + SLACK_R * self.travelled_mm {
            return;
        }
        keep_nearer(&mut self.nearest, away);
        if distance_mm > self.tolerance_mm + ROUNDING_MM {
            return;
        }
        let place = Standpoint {
            item,
            part,
            distance_mm,
            mismatch_mm,
        };
        if self
            .best
            .is_none_or(|best| place.is_better_than(&best, self.tolerance_mm))
        {
            self.best = Some(place);
        }
    }
}

impl Standpoint {
    /// Places beside each other are told apart by their distance, others by the distance travelled.
    fn is_better_than(&self, other: &Self, tolerance_mm: f64) -> bool {
        let are_beside = (self.mismatch_mm - other.mismatch_mm).abs() <= 20.0 * tolerance_mm;
        if are_beside {
            self.distance_mm < other.distance_mm
        } else {
            self.mismatch_mm < other.mismatch_mm
        }
    }
}

fn keep_nearer(kept: &mut Option<AxisVector>, away: AxisVector) {
    if kept.is_none_or(|kept| distance(&away) < distance(&kept)) {
        *kept = Some(away);
    }
}

/// The point after a part of a segment.
fn point_of(segment: &Segment, part: f64) -> AxisVector {
    if part >= 1.0 {
        segment.end()
    } else {
        segment.jet(part * segment.length()).position
    }
}

/// Where a function with one valley between two places is lowest (golden section).
fn nearest_between(mut low: f64, mut high: f64, of: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let (start, end) = (low, high);
    for _ in 0..60 {
        let width = GOLDEN * (high - low);
        if of(high - width) <= of(low + width) {
            high = low + width;
        } else {
            low = high - width;
        }
    }
    let middle = 0.5 * (low + high);
    // The ends of the range exactly: the search only comes near them.
    [start, end]
        .into_iter()
        .find(|edge| of(*edge) <= of(middle))
        .unwrap_or(middle)
}
