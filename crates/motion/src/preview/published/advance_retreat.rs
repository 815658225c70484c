//! The preview by advance and retreat.
//!
//! ```text
//! advance   u ──h──► ──2h──► ────4h────►            while the chord error is below the tolerance
//! retreat                    ◄─2h─ ◄h               from the first point that is too sharp: the start
//! scan                         ├┼┼┼┼┼┼┼┤            in first steps, to the end of the region
//! refine                          ├┼┤               bisection around the sharpest point
//! ```
//!
//! As published the method cannot be run; what was repaired:
//!
//! * retreat and scan test the chord error at the points they move, not at the one they started
//!   from;
//! * the last step is a bisection for the sign of dκ/du. The published one compares the speed with
//!   its unknown minimum, which it can only ever exceed, so it would always go the same way;
//! * the number of doublings is bounded, [`AdvanceRetreat::max_growth`]: unbounded steps pass over
//!   most regions.
//!
//! What cannot be repaired: a region shorter than the step that meets it is passed over in silence,
//! and of several minima in a region only the sharpest is found.

use crate::preview::{Demand, Method, Minimum, Probe, Region};

/// Refinement ends when the allowed speed changes by less than this from step to step, mm/s.
const REFINED_V: f64 = 1e-3;
/// Bisections at most.
const MAX_REFINEMENTS: u32 = 40;

/// Parameters of the method. The first step is one tick at the mean of du/ds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdvanceRetreat {
    /// β: factor of a step that went well, > 1.
    pub growth: f64,
    /// η: the longest step in first steps, ≥ 1; infinite for no bound.
    pub max_growth: f64,
}

impl Default for AdvanceRetreat {
    /// β = 2, η = 8.
    fn default() -> Self {
        Self {
            growth: 2.0,
            max_growth: 8.0,
        }
    }
}

/// Factor of a step back.
const SHRINK: f64 = 0.5;

impl Method for AdvanceRetreat {
    fn name(&self) -> &'static str {
        "advance-retreat"
    }

    fn regions(&self, probe: &mut Probe<'_>, demand: &Demand) -> Vec<Region> {
        let (first, last) = probe.path().curve().domain();
        let length = probe.path().length();
        let mut search = RegionSearch {
            demand,
            critical_mm: demand.critical_radius_mm(),
            first_step: (last - first) * demand.feed_v * demand.period_t / length,
            last,
            probe,
        };
        let mut regions = Vec::new();
        let (mut u, mut step) = (first, search.first_step);
        if search.radius_mm(first) < search.critical_mm {
            let region = search.scan(first, first);
            u = region.to_u;
            regions.push(region);
        }
        while u < last {
            let next = (u + step).min(last);
            if search.radius_mm(next) >= search.critical_mm {
                u = next;
                step = (step * self.growth).min(self.max_growth * search.first_step);
                continue;
            }
            let from_u = search.retreat(next, u, step);
            let region = search.scan(from_u, next);
            u = region.to_u;
            step = search.first_step;
            regions.push(region);
        }
        regions
    }
}

struct RegionSearch<'a, 'p> {
    demand: &'a Demand,
    critical_mm: f64,
    first_step: f64,
    last: f64,
    probe: &'a mut Probe<'p>,
}

impl RegionSearch<'_, '_> {
    fn radius_mm(&mut self, u: f64) -> f64 {
        self.probe.at(u).radius_mm
    }

    /// From `u`, which is too sharp, back to where it is not; at most to `floor`, which is not.
    fn retreat(&mut self, mut u: f64, floor: f64, mut step: f64) -> f64 {
        loop {
            step = (step * SHRINK).max(self.first_step);
            u -= step;
            if u <= floor {
                return floor;
            }
            if self.radius_mm(u) >= self.critical_mm {
                return u;
            }
        }
    }

    /// The region that starts at `from_u` and contains `sharp_u`: its end, and its sharpest point.
    fn scan(&mut self, from_u: f64, sharp_u: f64) -> Region {
        let mut to_u = sharp_u;
        while to_u < self.last {
            to_u = (to_u + self.first_step).min(self.last);
            if self.radius_mm(to_u) >= self.critical_mm {
                break;
            }
        }
        let (mut sharpest, mut least_mm) = (from_u, f64::INFINITY);
        let mut u = from_u;
        while u < to_u {
            let radius_mm = self.radius_mm(u);
            if radius_mm < least_mm {
                (sharpest, least_mm) = (u, radius_mm);
            }
            u += self.first_step;
        }
        if self.radius_mm(to_u) < least_mm {
            sharpest = to_u;
        }
        let minimum = self.refine(
            (sharpest - self.first_step).max(from_u),
            sharpest,
            (sharpest + self.first_step).min(to_u),
        );
        Region {
            from_u,
            to_u,
            minima: vec![minimum],
        }
    }

    /// Bisection for the sign of dκ/du between the neighbours of the sharpest point.
    fn refine(&mut self, mut low: f64, sharpest: f64, mut high: f64) -> Minimum {
        let mut u = sharpest;
        let mut best: Option<Minimum> = None;
        for _ in 0..MAX_REFINEMENTS {
            let reading = self.probe.at(u);
            let cap_v = self.demand.cap_v(reading.radius_mm);
            let change_v = best.map_or(f64::INFINITY, |best| (cap_v - best.cap_v).abs());
            if best.is_none_or(|best| reading.radius_mm < best.radius_mm) {
                best = Some(Minimum {
                    u,
                    radius_mm: reading.radius_mm,
                    cap_v,
                });
            }
            if change_v <= REFINED_V || reading.tightening == 0.0 {
                break;
            }
            if reading.tightening > 0.0 {
                low = u;
            } else {
                high = u;
            }
            u = 0.5 * (low + high);
        }
        best.unwrap_or(Minimum {
            u,
            radius_mm: 0.0,
            cap_v: 0.0,
        })
    }
}
