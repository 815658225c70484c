//! The certified preview: no region and no minimum is missed.
//!
//! Knot span by knot span:
//!
//! 1. A bound of the curvature over the whole span, from the coefficients of its polynomials, is
//!    below the threshold: nothing here, nothing evaluated.
//! 2. Else the extremes of the curvature are isolated by the sign variations of a polynomial, which
//!    never undercount roots. Between neighbours of them the signed curvature is monotone.
//! 3. So their values tell where the threshold is crossed; a bracketed search finds the point. The
//!    end of the bracket outside the region is taken.
//!
//! Regions are joined over knots, and over an inflection of a curve in a plane between two places
//! that are too sharp: the little stretch of slight curvature counts as part of the region. Where
//! the tangent itself jumps (a knot as often as the degree) there is a corner, and where the curve
//! stands still a cusp: both are minima of radius zero.
//!
//! *Rounding.* Two roots closer than about 1e-12 of a span may be lost; the curvature between them
//! changes by a negligible amount.

use super::probe::Probe;
use super::{Demand, Method, Minimum, Region};
use glidepath_geometry::{Nurbs, SpanCurvature};

/// Evaluations of one search for a crossing, at most. False position with halved ends needs a few;
/// bisection alone would halve the domain 37 times.
const MAX_SEARCH: u32 = 60;
/// Width at which such a search ends, relative to the domain of the curve. Whatever it is, the end outside
/// the region is taken: with more, regions are longer by it and as safe.
const CROSSING: f64 = 1e-11;
/// Curvatures that differ by less, relatively, are one plateau.
const PLATEAU: f64 = 1e-9;
/// Angle between tangents, in radians, from which a knot is a corner: far above what rounding makes of one
/// tangent.
const CORNER_RAD: f64 = 1e-6;
/// How far beyond its estimate the crossing is looked at, in widths at which the search ends: less than
/// one, so that the bracket closes, and far enough for rounding.
const BEYOND: f64 = 0.25;
/// Steps after which a bracket is to be half as wide, or is halved.
const PATIENCE: u32 = 3;
/// Parts of the way to a neighbour at which a curvature is looked for beside a point where the curve
/// stands still: from the first one on, each so many times the one before.
const BESIDE: f64 = 1e-6;
const BESIDE_GROWTH: f64 = 4.0;

/// The default method; it has no parameters.
#[derive(Debug, Clone, Copy, Default)]
pub struct Certified;

impl Method for Certified {
    fn name(&self) -> &'static str {
        "certified"
    }

    fn regions(&self, probe: &mut Probe<'_>, demand: &Demand) -> Vec<Region> {
        let curve = probe.path().curve();
        let (first, last) = curve.domain();
        let mut sweep = Sweep {
            demand,
            threshold_k: 1.0 / demand.critical_radius_mm(),
            tolerance_u: CROSSING * (last - first),
            open: None,
            regions: Vec::new(),
        };
        let mut nodes = Vec::new();
        for (index, span) in curve.spans().iter().enumerate() {
            if index > 0 && is_corner(curve, index, probe) {
                sweep.corner(span.from_u());
            }
            let curvature = SpanCurvature::new(span);
            if curvature.bound_k() <= sweep.threshold_k {
                sweep.settle(span.from_u(), 0.0);
                continue;
            }
            nodes.clear();
            nodes.push(span.from_u());
            curvature.critical(|u| nodes.push(u));
            nodes.push(span.to_u());
            sweep.span(probe, &curvature, &nodes);
        }
        sweep.settle(last, 0.0);
        sweep.regions
    }
}

/// True if the tangent jumps at the start of a span.
fn is_corner(curve: &Nurbs, index: usize, probe: &mut Probe<'_>) -> bool {
    let spans = curve.spans();
    let knot = spans[index].from_u();
    let multiplicity = curve.knots().partition_point(|u| *u <= knot)
        - curve.knots().partition_point(|u| *u < knot);
    if multiplicity < curve.degree() {
        return false;
    }
    let first = curve.feed_axes().start;
    let before = probe.end_tangent(&spans[index - 1]);
    let before = before.fixed_rows::<3>(first).into_owned();
    let after = probe.jet(knot).d1.fixed_rows::<3>(first).into_owned();
    let sine = before.cross(&after).norm();
    sine.atan2(before.dot(&after)) > CORNER_RAD
}

/// The regions as they grow from left to right.
struct Sweep<'a> {
    demand: &'a Demand,
    threshold_k: f64,
    tolerance_u: f64,
    /// The region that has begun.
    open: Option<Open>,
    regions: Vec<Region>,
}

struct Open {
    from_u: f64,
    /// Curvatures at the critical points passed, in order; a knot has two.
    passed: Vec<(f64, f64)>,
}

impl Sweep<'_> {
    /// Passes a span whose curvature is monotone between the nodes.
    fn span(&mut self, probe: &mut Probe<'_>, curvature: &SpanCurvature, nodes: &[f64]) {
        let mut from_u = nodes[0];
        let mut from_k = probe.curvature(curvature, from_u);
        self.settle(from_u, from_k);
        for &to_u in &nodes[1..] {
            let to_k = probe.curvature(curvature, to_u);
            self.piece(probe, curvature, (from_u, from_k), (to_u, to_k));
            (from_u, from_k) = (to_u, to_k);
        }
    }

    /// Passes a piece on which the curvature is monotone, up to and with its end.
    fn piece(
        &mut self,
        probe: &mut Probe<'_>,
        curvature: &SpanCurvature,
        from: (f64, f64),
        to: (f64, f64),
    ) {
        let (sharp_from, sharp_to) = (self.is_sharp(from.1), self.is_sharp(to.1));
        if sharp_from != sharp_to {
            // The threshold is passed once, with the sign of the sharp end. An infinite curvature
            // has the sign of its neighbourhood.
            let (u, k, other_u) = if sharp_to {
                (to.0, to.1, from.0)
            } else {
                (from.0, from.1, to.0)
            };
            let sign = if k.is_finite() {
                k
            } else {
                // How far the curve counts as standing still depends on how it sets out.
                core::iter::successors(Some(BESIDE), |part| Some(BESIDE_GROWTH * part))
                    .take_while(|part| *part < 1.0)
                    .map(|part| probe.curvature(curvature, u + part * (other_u - u)))
                    .find(|k| k.is_finite())
                    .unwrap_or(k)
            };
            let level = self.threshold_k.copysign(sign);
            let (before, after) = self.crossing(probe, curvature, [from, to], level);
            if sharp_to {
                self.enter(before);
            } else {
                self.leave(after);
            }
        }
        if let Some(open) = &mut self.open {
            if sharp_from && sharp_to && from.1 * to.1 < 0.0 {
                // An inflection somewhere between.
                open.passed.push((0.5 * (from.0 + to.0), 0.0));
            }
            open.passed.push((to.0, to.1.abs()));
        }
    }

    fn is_sharp(&self, k: f64) -> bool {
        k.abs() > self.threshold_k
    }

    /// A bracket, no wider than the tolerance, of the point between two points (u, κ) where the
    /// curvature passes `level`: false position with halved stale ends, a bisection where three
    /// steps did not halve the bracket. Where the curvature is infinite it has the sign of `level`.
    fn crossing(
        &self,
        probe: &mut Probe<'_>,
        curvature: &SpanCurvature,
        [from, to]: [(f64, f64); 2],
        level: f64,
    ) -> (f64, f64) {
        // Of the sign of κ − level, but tame where the curvature is many times the level.
        let offset = |k: f64| {
            if k.is_finite() {
                (k - level) / (k.abs() + level.abs())
            } else {
                level.signum()
            }
        };
        let (mut a, mut b) = (from.0, to.0);
        let (mut fa, mut fb) = (offset(from.1), offset(to.1));
        let rising = fb > 0.0;
        let mut moved_b = None;
        let mut checkpoint = f64::INFINITY;
        for step in 0..MAX_SEARCH {
            if b - a <= self.tolerance_u {
                break;
            }
            // A little beyond the estimate, so that the bracket closes from both sides.
            let reach = if moved_b == Some(true) {
                -BEYOND
            } else {
                BEYOND
            };
            let mut u = (a * fb - b * fa) / (fb - fa) + reach * self.tolerance_u;
            let stuck = step % PATIENCE == 0 && b - a > 0.5 * checkpoint;
            if step % PATIENCE == 0 {
                checkpoint = b - a;
            }
            if stuck || !(u > a && u < b) {
                u = 0.5 * (a + b);
            }
            let f = offset(probe.curvature(curvature, u));
            if (f > 0.0) == rising {
                (b, fb) = (u, f);
                if moved_b == Some(true) {
                    fa *= 0.5;
                }
                moved_b = Some(true);
            } else {
                (a, fa) = (u, f);
                if moved_b == Some(false) {
                    fb *= 0.5;
                }
                moved_b = Some(false);
            }
        }
        (a, b)
    }

    /// Begins or ends a region where a span starts with curvature `k`.
    fn settle(&mut self, u: f64, k: f64) {
        match (self.is_sharp(k), self.open.is_some()) {
            (true, false) => self.enter(u),
            (false, true) => self.leave(u),
            _ => {}
        }
        if let Some(open) = &mut self.open {
            open.passed.push((u, k.abs()));
        }
    }

    fn enter(&mut self, u: f64) {
        self.open = Some(Open {
            from_u: u,
            passed: Vec::new(),
        });
    }

    fn leave(&mut self, u: f64) {
        if let Some(open) = self.open.take() {
            let minima = maxima(&open.passed)
                .map(|(u, k)| {
                    let radius_mm = 1.0 / k;
                    Minimum {
                        u,
                        radius_mm,
                        cap_v: self.demand.cap_v(radius_mm),
                    }
                })
                .collect();
            self.regions.push(Region {
                from_u: open.from_u,
                to_u: u,
                minima,
            });
        }
    }

    fn corner(&mut self, u: f64) {
        match &mut self.open {
            Some(open) => open.passed.push((u, f64::INFINITY)),
            None => {
                self.enter(u);
                if let Some(open) = &mut self.open {
                    open.passed.push((u, f64::INFINITY));
                }
            }
        }
    }
}

/// The values that have no larger neighbour; of a plateau, the first.
fn maxima(passed: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> + '_ {
    let higher = |a: f64, b: f64| a > b * (1.0 + PLATEAU) || (a.is_infinite() && b.is_finite());
    let mut rising = true;
    passed.iter().enumerate().filter_map(move |(i, &(u, k))| {
        if i > 0 {
            let before = passed[i - 1].1;
            if higher(k, before) {
                rising = true;
            } else if higher(before, k) {
                rising = false;
            }
        }
        let goes_on = passed
            .get(i + 1..)
            .unwrap_or_default()
            .iter()
            .map(|(_, next)| *next)
            .find(|&next| higher(next, k) || higher(k, next))
            .is_some_and(|next| higher(next, k));
        let plateau = i > 0 && !higher(k, passed[i - 1].1);
        let first = !plateau || i == 0;
        (rising && !goes_on && first).then_some((u, k))
    })
}
