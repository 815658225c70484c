//! The split of the tolerance: how much of it a corner's transition may use, and how much is left
//! to the chords.
//!
//! The servo goes straight from one setpoint to the next, so a motion with acceleration of at most
//! `a` strays from its own curve by at most a·T²/8 (*chord error*), whatever its speed Blend:: That
//! and the deviation δ of the transition share the tolerance ε: δ + e ≤ ε.
//!
//! A larger δ makes a gentler transition: its curvature is k = c/δ with a constant of the family
//! and the turn, so the corner speed is limited by
//!
//! ```text
//! v² ≤ A·δ/c  (acceleration)        v² ≤ 8·e·δ/(c·T²)  (chords)
//! ```
//!
//! The first rises with δ, the second is largest at δ = e = ε/2. If the acceleration limit keeps
//! the chords below half the tolerance, A·T²/8 ≤ ε/2, the best is where the two meet, e = A·T²/8;
//! otherwise it is ε/2 each. Two corrections to the published rule: a transition that is short of
//! length uses less than its share and the rest belongs to the chords; and where the feed or the
//! jerk limits the corner, the acceleration and with it the chord error stay below A·T²/8, so the
//! transition may use more.

use glidepath_geometry::Blend;

/// Largest distance between a motion and the chords of its samples, mm, when the magnitude of its
/// acceleration (normal and tangential together) never exceeds `acceleration_a` mm/s².
#[must_use]
pub(crate) fn chord_error(acceleration_a: f64, period_t: f64) -> f64 {
    acceleration_a * period_t * period_t / 8.0
}

/// The acceleration that uses up a chord error, mm/s².
#[must_use]
pub(crate) fn chord_acceleration(chord_mm: f64, period_t: f64) -> f64 {
    8.0 * chord_mm / (period_t * period_t)
}

/// The constant speed at which a curve of curvature up to `max_k` has a chord error, mm/s. It must
/// hold over the whole curve: following the curvature point by point overshoots the error.
#[must_use]
pub(crate) fn chord_speed(max_k: f64, chord_mm: f64, period_t: f64) -> f64 {
    (8.0 * chord_mm / max_k).sqrt() / period_t
}

/// The limits of the motion through a corner, along its change of direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CornerLimits {
    /// Largest rate of path position, mm/s.
    pub(crate) feed_v: f64,
    /// Largest acceleration, mm/s².
    pub(crate) acceleration_a: f64,
    /// Largest jerk, mm/s³.
    pub(crate) jerk_j: f64,
}

/// Shares of a tolerance; together they are the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ToleranceSplit {
    /// Deviation of the transition from the corner, mm.
    pub(crate) smoothing_mm: f64,
    /// Chord error, mm.
    pub(crate) chord_mm: f64,
}

impl ToleranceSplit {
    /// The split that allows the highest corner speed when acceleration binds. All arguments > 0.
    #[must_use]
    pub(crate) fn new(tolerance_mm: f64, acceleration_a: f64, period_t: f64) -> Self {
        let chord_mm = chord_error(acceleration_a, period_t).min(0.5 * tolerance_mm);
        Self {
            smoothing_mm: tolerance_mm - chord_mm,
            chord_mm,
        }
    }

    /// The split of a transition that is short of length and deviates by less than its share;
    /// `None` if it deviates by more than the tolerance.
    #[must_use]
    pub(crate) fn with_deviation(tolerance_mm: f64, deviation_mm: f64) -> Option<Self> {
        (deviation_mm <= tolerance_mm).then_some(Self {
            smoothing_mm: deviation_mm,
            chord_mm: tolerance_mm - deviation_mm,
        })
    }

    /// The split that allows the highest speed through a uniform blend when feed and jerk may bind
    /// as well. `sb` is the sine of half the turn, > 0.
    ///
    /// It solves δ + e(δ) = ε for the largest δ, where the acceleration that makes e is the
    /// smallest of three: the limit; that at full feed, ∝ 1/δ; that at the jerk cap, ∝ ∛δ.
    #[must_use]
    pub(crate) fn for_blend(
        sb: f64,
        tolerance_mm: f64,
        limits: &CornerLimits,
        period_t: f64,
    ) -> Self {
        let by_acceleration = Self::new(tolerance_mm, limits.acceleration_a, period_t).smoothing_mm;

        let unit_d = Blend::distance_for(1.0, sb);
        let at_feed = Blend::peak_acceleration(unit_d, sb, limits.feed_v);
        let discriminant = tolerance_mm * tolerance_mm - 4.0 * chord_error(at_feed, period_t);
        let by_feed = if discriminant >= 0.0 {
            0.5 * (tolerance_mm + discriminant.sqrt())
        } else {
            0.0
        };

        let jerk_v = Blend::jerk_cap(unit_d, sb, limits.jerk_j);
        let at_jerk = chord_error(Blend::peak_acceleration(unit_d, sb, jerk_v), period_t);
        let by_jerk = depressed_cubic_root(at_jerk, tolerance_mm).powi(3);

        let smoothing_mm = by_acceleration.max(by_feed).max(by_jerk).min(tolerance_mm);
        Self {
            smoothing_mm,
            chord_mm: tolerance_mm - smoothing_mm,
        }
    }
}

/// The root of x³ + p·x = q for p, q ≥ 0.
fn depressed_cubic_root(p: f64, q: f64) -> f64 {
    // Newton from above on a convex function: monotone, and quadratic at the end.
    let mut x = q.cbrt();
    for _ in 0..60 {
        let slope = 3.0 * x * x + p;
        if slope <= 0.0 {
            break;
        }
        let next = x - (x * x * x + p * x - q) / slope;
        if next >= x {
            break;
        }
        x = next;
    }
    x
}
