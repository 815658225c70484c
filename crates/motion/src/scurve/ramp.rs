//! Ramps: speed changes with zero acceleration at both ends.

/// Bounds of motion along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathLimits {
    /// Largest acceleration along the path, mm/s², > 0.
    pub accel_a: f64,
    /// Largest jerk along the path, mm/s³, > 0.
    pub jerk_j: f64,
}

impl PathLimits {
    /// The weaker of two bounds each: what holds on both of two parts of a path.
    pub(crate) const fn weaker(self, other: Self) -> Self {
        Self {
            accel_a: self.accel_a.min(other.accel_a),
            jerk_j: self.jerk_j.min(other.jerk_j),
        }
    }
}

/// A speed change between two speeds, zero acceleration at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ramp {
    /// Length of each of the two jerk phases, s.
    pub(super) jerk_t: f64,
    /// Length of the phase of constant acceleration, s.
    pub(super) accel_t: f64,
    /// Jerk magnitude, mm/s³.
    pub(super) jerk_j: f64,
}

impl Ramp {
    pub(super) fn new(change_v: f64, limits: PathLimits) -> Self {
        let PathLimits { accel_a, jerk_j } = limits;
        let change_v = change_v.abs();
        if change_v * jerk_j >= accel_a * accel_a {
            let jerk_t = accel_a / jerk_j;
            Self {
                jerk_t,
                accel_t: change_v / accel_a - jerk_t,
                jerk_j,
            }
        } else {
            Self {
                jerk_t: (change_v / jerk_j).sqrt(),
                accel_t: 0.0,
                jerk_j,
            }
        }
    }

    pub(super) fn duration_t(self) -> f64 {
        2.0 * self.jerk_t + self.accel_t
    }
}

/// Duration of a ramp between two speeds, s.
fn ramp_duration(from_v: f64, to_v: f64, limits: PathLimits) -> f64 {
    Ramp::new(to_v - from_v, limits).duration_t()
}

/// Path length of a ramp between two speeds ≥ 0, mm.
#[must_use]
pub fn ramp_length(from_v: f64, to_v: f64, limits: PathLimits) -> f64 {
    0.5 * (from_v + to_v) * ramp_duration(from_v, to_v, limits)
}

/// How much longer than a length a ramp may be that fits into it.
const FITS_R: f64 = 1e-9;

/// True if a ramp between two speeds fits into a length, up to the rounding of the speeds: where
/// they hardly differ, their difference, and with it the length of the ramp, has few digits left.
#[must_use]
pub fn ramp_fits(from_v: f64, to_v: f64, length_s: f64, limits: PathLimits) -> bool {
    let change_v = (to_v - from_v).abs();
    let rounding_r =
        FITS_R + 8.0 * f64::EPSILON * from_v.max(to_v) / change_v.max(f64::MIN_POSITIVE);
    ramp_length(from_v, to_v, limits) <= length_s * (1.0 + rounding_r)
}

/// The length that is enough to slow down from `feed_v` to any lower speed, mm.
///
/// The largest [`ramp_length`] over all final speeds; longer than the stopping distance.
#[must_use]
pub fn slowing_horizon(feed_v: f64, limits: PathLimits) -> f64 {
    let PathLimits { accel_a, jerk_j } = limits;
    let knee_v = accel_a * accel_a / jerk_j;
    if feed_v >= 1.5 * knee_v {
        feed_v * feed_v / (2.0 * accel_a)
            + feed_v * accel_a / (2.0 * jerk_j)
            + accel_a.powi(3) / (8.0 * jerk_j * jerk_j)
    } else {
        // Without a phase of constant acceleration the worst final speed is a third; where that
        // ramp would have one, the change A²/J that just has none is the worst.
        let change_v = (2.0 / 3.0 * feed_v).min(knee_v);
        (feed_v - 0.5 * change_v) * 2.0 * (change_v / jerk_j).sqrt()
    }
}

/// The largest speed reachable from `from_v` over `length_s`, zero acceleration at both ends, mm/s.
///
/// Read backwards it is the largest speed from which one can slow down to `from_v`.
#[must_use]
pub fn reachable_speed(from_v: f64, length_s: f64, limits: PathLimits) -> f64 {
    from_v + reachable_rise(from_v, length_s, limits)
}

/// [`reachable_speed`] less the speed at the start: over a tiny length, the difference of the two
/// speeds would have few digits left.
pub(super) fn reachable_rise(from_v: f64, length_s: f64, limits: PathLimits) -> f64 {
    let PathLimits { accel_a, jerk_j } = limits;
    if length_s <= 0.0 {
        return 0.0;
    }
    let full_t = accel_a / jerk_j;
    // Up to a change of A²/J, which takes 2·A/J at a mean speed of v + A²/(2J), a ramp has no phase of
    // constant acceleration: with x half of its duration, (2v + J·x²)·x = L.
    if (2.0 * from_v + jerk_j * full_t * full_t) * full_t >= length_s {
        let x_t = solve_depressed_cubic(from_v, length_s, jerk_j);
        jerk_j * x_t * x_t
    } else {
        // Beyond it ½(v + w)((w − v)/A + A/J) = L, a square in w.
        let c = 0.5 * accel_a * full_t;
        ((from_v - c).powi(2) + 2.0 * accel_a * length_s).sqrt() - c - from_v
    }
}

/// From this argument on the linear term changes the root by less than 1e-8, which the Newton step behind
/// it squares.
const MOST_ARGUMENT: f64 = 1e12;

/// The positive root of J·x³ + 2·v·x = L. With both coefficients positive there is one real root, for
/// which hyperbolic functions take the place of Cardano's difference of roots: that one cancels where L is
/// small.
fn solve_depressed_cubic(v: f64, length_s: f64, jerk_j: f64) -> f64 {
    let linear = 2.0 * v / (3.0 * jerk_j);
    let p = linear.sqrt();
    let argument = length_s / (2.0 * jerk_j * p * p * p);
    // From rest p is 0; near it x is the root without the linear term, and the step below does the rest.
    let mut x = if argument.is_finite() && argument < MOST_ARGUMENT {
        2.0 * p * (argument.asinh() / 3.0).sinh()
    } else {
        (length_s / jerk_j).cbrt()
    };
    // One Newton step takes out the cancellation of the closed form.
    let slope = 3.0 * jerk_j * x * x + 2.0 * v;
    if slope > 0.0 {
        x -= (jerk_j * x * x * x + 2.0 * v * x - length_s) / slope;
    }
    x
}

/// Derivative of the length of a ramp by its change of speed, s.
pub(super) fn ramp_slope(from_v: f64, change_v: f64, limits: PathLimits) -> f64 {
    let PathLimits { accel_a, jerk_j } = limits;
    let middle_v = from_v + 0.5 * change_v;
    if change_v * jerk_j >= accel_a * accel_a {
        0.5 * (change_v / accel_a + accel_a / jerk_j) + middle_v / accel_a
    } else {
        let jerk_t = (change_v / jerk_j).sqrt();
        jerk_t + middle_v / (jerk_j * jerk_t)
    }
}
