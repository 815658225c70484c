//! The bracket of the *first* crossing of a sphere around a point of the curve.
//!
//! The end of a chord of length L from C(t) is the first point at distance L. A curve may come
//! back to the sphere (a helix of small pitch), or leave it behind (a closed curve has distance 0
//! after a period): a change of sign proves neither that a crossing is the first nor that there is
//! none. Two facts do:
//!
//! 1. If on [t, t + m] the curvature is at most κ < 2/L and s_lo ≤ |C′| ≤ s_hi, the distance grows
//!    all along an arc of length π/κ, and the crossing is in `dt ∈ [ L/s_hi, (2/κ) asin(κL/2)/s_lo
//!    ]`, alone, if that interval is inside the window and `(s_hi/s_lo) · 2 asin(κL/2) ≤ π`.
//! 2. Distance changes no faster than arc length: from a point at distance d < L the crossing is at
//!    least (L − d)/s_hi away. Steps of that size never jump over it, whatever the curve does.
//!
//! κ, s_lo and s_hi come from interval arithmetic over the window, so both are proofs. The first is
//! tried at once, the second where it fails (near cusps, for chords as long as the curve's radius).

use super::{Bounds, Local, ParametricCurve};
use crate::CurveError;
use core::f64::consts::PI;
use glidepath_geometry::number::{Interval, Number};

/// Room for rounding where a crossing is at the very end of its interval, as on a circle.
const ROOM: f64 = 1e-6;
/// The first window is so many guesses of the step wide, so that the crossing is well inside it.
const FIRST_WIDTH_R: f64 = 1.5;
/// How often fact 1 is tried, each time with a window that fits what was learnt, before the march: where it
/// fails by the curve, and not by the window, more tries only cost enclosures.
const TRIES: u32 = 3;
/// A window over which nothing is bounded is made shorter by the first, one that proves nothing by the
/// second, one that is too short longer than what it proves by the third.
const UNBOUNDED_R: f64 = 0.5;
const UNPROVEN_R: f64 = 0.7;
const BEYOND_R: f64 = 1.01;
/// Steps of the march at most.
const MARCH: u32 = 100_000;

/// Parameters between which the distance from the start passes the chord length once, for the first
/// time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// Distance at most the chord.
    pub low: f64,
    /// Distance at least the chord.
    pub high: f64,
    /// Evaluations of the curve at a point.
    pub evaluations: u32,
    /// Evaluations over an interval.
    pub enclosures: u32,
}

/// The first crossing by fact 1, from bounds over [t, t + m]: least and greatest dt.
#[must_use]
pub fn certify_bracket(bounds: &Bounds, chord_mm: f64) -> Option<(f64, f64)> {
    let (slow, fast) = (bounds.speed.low(), bounds.speed.high());
    let half = 0.5 * bounds.curvature_k * chord_mm;
    if slow <= 0.0 || half >= 1.0 {
        return None;
    }
    let turn = 2.0 * half.asin();
    if fast / slow * turn > PI {
        return None;
    }
    let arc = if turn > 1e-9 {
        turn / bounds.curvature_k
    } else {
        chord_mm
    };
    Some((chord_mm / fast, arc / slow * (1.0 + ROOM)))
}

/// The first point beyond `t` at a distance from C(t), before `limit`; `None` if there is none.
///
/// # Errors
/// The curve is not defined or not bounded there.
pub fn bracket(
    curve: &ParametricCurve,
    t: f64,
    at: &Local,
    chord_mm: f64,
    limit: f64,
) -> Result<Option<Bracket>, CurveError> {
    let mut width = FIRST_WIDTH_R * at.guess(chord_mm);
    let mut enclosures = 0;
    for _ in 0..TRIES {
        if !width.is_finite() {
            break;
        }
        let end = (t + width).min(limit);
        enclosures += 1;
        let Some(bounds) = curve.bounds(t, end) else {
            width *= UNBOUNDED_R;
            continue;
        };
        let Some((low, high)) = certify_bracket(&bounds, chord_mm) else {
            width *= UNPROVEN_R;
            continue;
        };
        if t + high <= end {
            return Ok(Some(Bracket {
                low: t + low,
                high: t + high,
                evaluations: 0,
                enclosures,
            }));
        }
        if end >= limit {
            if t + low > limit {
                return Ok(None);
            }
            break;
        }
        width = BEYOND_R * high;
    }
    March {
        curve,
        start: t,
        origin: at,
        chord_mm,
        limit,
        evaluations: 0,
        enclosures,
    }
    .run()
}

/// Fact 2, until fact 1 or monotony of the distance closes the bracket.
struct March<'a> {
    curve: &'a ParametricCurve,
    start: f64,
    origin: &'a Local,
    chord_mm: f64,
    limit: f64,
    evaluations: u32,
    enclosures: u32,
}

impl March<'_> {
    fn found(&self, low: f64, high: f64) -> Bracket {
        Bracket {
            low,
            high,
            evaluations: self.evaluations,
            enclosures: self.enclosures,
        }
    }

    fn distance(&mut self, t: f64) -> f64 {
        self.evaluations += 1;
        (self.curve.point(t) - self.origin.point).norm()
    }

    fn run(&mut self) -> Result<Option<Bracket>, CurveError> {
        let mut low = self.start;
        let mut width = self
            .origin
            .guess(self.chord_mm)
            .min(self.limit - self.start);
        if !width.is_finite() {
            width = self.limit - self.start;
        }
        for _ in 0..MARCH {
            let rest = self.chord_mm - self.distance(low);
            if rest <= 1e-12 * self.chord_mm {
                return Ok(Some(self.found(low, low)));
            }
            if low >= self.limit {
                return Ok(None);
            }
            if let Some(high) = self.close(low, rest) {
                return Ok(Some(self.found(low, high)));
            }
            let end = (low + width).min(self.limit);
            self.enclosures += 1;
            let Some(bounds) = self.curve.bounds(low, end) else {
                width *= 0.5;
                if low + width <= low.next_up() {
                    return Err(CurveError::Unbounded { t: low });
                }
                continue;
            };
            let safe = rest / bounds.speed.high();
            if low + safe >= end {
                low = end;
                width *= 2.0;
            } else {
                low += safe;
                width = 2.0 * safe;
            }
            if low.is_nan() {
                break;
            }
        }
        Err(CurveError::Unbounded { t: low })
    }

    /// A parameter beyond the crossing up to which the distance grows, from `low` on.
    fn close(&mut self, low: f64, rest: f64) -> Option<f64> {
        let here = self.curve.local(low);
        self.evaluations += 1;
        let out = here.point - self.origin.point;
        let rate = out.dot(&here.d1) / out.norm();
        let high = low + 1.5 * rest / rate;
        // Not worth trying where the distance does not grow, or not yet.
        if rate.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) || high > self.limit {
            return None;
        }
        let [point, d1, _] = self.curve.enclosure(low, high);
        self.enclosures += 1;
        let growth = (0..3).fold(Interval::constant(0.0), |sum, i| {
            sum + (point[i] - Interval::constant(self.origin.point[i])) * d1[i]
        });
        (growth.low() > 0.0 && self.distance(high) >= self.chord_mm).then_some(high)
    }
}
