//! Events that do not stop the motion, and when in a period they happen.

use super::step::Step;
use glidepath_geometry::AxisVector;
use glidepath_program::Event;

/// Where the motion is along the path, and how fast.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathPoint {
    pub(crate) s: f64,
    pub(crate) v: f64,
}

impl PathPoint {
    /// The part of a period, 0 to 1, after which the motion from here to another point, by the cubic
    /// through both, is at a path position.
    fn part_to(self, to: Self, at_s: f64, period_t: f64) -> f64 {
        if at_s <= self.s {
            return 0.0;
        }
        if at_s >= to.s {
            return 1.0;
        }
        let (step, v0, v1) = (to.s - self.s, self.v * period_t, to.v * period_t);
        let (c2, c3) = (3.0 * step - 2.0 * v0 - v1, v0 + v1 - 2.0 * step);
        let passed = |u: f64| ((c3 * u + c2) * u + v0) * u >= at_s - self.s;
        let (mut low, mut high) = (0.0, 1.0);
        // To a billionth of the period.
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if passed(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }
}

/// A place beside which the motion may pass: a corner that is rounded.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beside {
    pub(crate) place: AxisVector,
    /// How far before and behind its path position the motion may be nearest to it, mm.
    pub(crate) reach_s: f64,
}

/// An event that is to happen.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DueEvent {
    pub(crate) event: Event,
    /// Its path position, mm.
    pub(crate) at_s: f64,
    /// Its place, if the motion may pass beside that.
    pub(crate) beside: Option<Beside>,
}

impl DueEvent {
    /// The part of a period after which it happens, if it does in that; at rest there is no step, and it does.
    pub(crate) fn part(
        &self,
        from: PathPoint,
        to: PathPoint,
        step: Option<&Step>,
        period_t: f64,
    ) -> Option<f64> {
        let passed = |at_s: f64| from.part_to(to, at_s, period_t);
        let Some((step, Beside { place, reach_s })) = step.zip(self.beside.as_ref()) else {
            let is_due = step.is_none() || self.at_s <= to.s;
            return is_due.then(|| passed(self.at_s));
        };
        if self.at_s - reach_s > to.s {
            return None;
        }
        let comes = passed(self.at_s - reach_s);
        if self.at_s > to.s {
            return step.turns_from(place, comes, 1.0);
        }
        let here = passed(self.at_s);
        step.turns_from(place, comes, here)
            .or_else(|| step.nearest_to(place, here))
    }
}
