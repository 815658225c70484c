//! The seven-phase S-curve: speed changes along a path with bounded acceleration and jerk.
//!
//! ```text
//!      v                 _______
//!                       /       \
//!                     /           \___ v1          jerk  +J  0 −J  0 −J  0 +J
//!             v0 ___/                              phase  1  2  3  4  5  6  7
//! ```
//!
//! Acceleration is zero at both ends, so a speed change ("ramp") from `v0` to `v1` is symmetric in
//! time: with d = |v1 − v0| it takes 2·t_j + t_a, where t_j = A/J, t_a = d/A − A/J if d ≥ A²/J and
//! t_j = √(d/J), t_a = 0 otherwise, and it covers exactly ½(v0 + v1)(2·t_j + t_a).
//!
//! Two traps, both with numbers in the tests. The speed reachable over a length is *not* monotone in
//! the speed one starts from, and a full stop can need *less* room than slowing down partly. So no
//! search here runs over the lower speed of a ramp; and whoever looks ahead for a stop must look
//! [`slowing_horizon`] ahead, not the stopping distance.
//!
//! Formulas: the phase table of Gu, Zhou, Lin et al. (seven-phase feed along NURBS), the rest derived.

/// Bounds of motion along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathLimits {
    /// Largest acceleration along the path, mm/s², > 0.
    pub accel_a: f64,
    /// Largest jerk along the path, mm/s³, > 0.
    pub jerk_j: f64,
}

/// A speed change between two speeds, zero acceleration at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ramp {
    /// Length of each of the two jerk phases, s.
    jerk_t: f64,
    /// Length of the phase of constant acceleration, s.
    accel_t: f64,
    /// Jerk magnitude that gives exactly the wanted change, mm/s³.
    jerk_j: f64,
}

impl Ramp {
    fn new(change_v: f64, limits: PathLimits) -> Self {
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

    fn duration_t(self) -> f64 {
        2.0 * self.jerk_t + self.accel_t
    }
}

/// Duration of a ramp between two speeds, s.
#[must_use]
pub fn ramp_duration(from_v: f64, to_v: f64, limits: PathLimits) -> f64 {
    Ramp::new(to_v - from_v, limits).duration_t()
}

/// Path length of a ramp between two speeds ≥ 0, mm.
#[must_use]
pub fn ramp_length(from_v: f64, to_v: f64, limits: PathLimits) -> f64 {
    0.5 * (from_v + to_v) * ramp_duration(from_v, to_v, limits)
}

/// True if a ramp between two speeds fits into a length, up to the rounding of the speeds: where they
/// hardly differ, their difference, and with it the length of the ramp, has few digits left.
#[must_use]
pub fn ramp_fits(from_v: f64, to_v: f64, length_s: f64, limits: PathLimits) -> bool {
    let change_v = (to_v - from_v).abs();
    let rounding_r = 1e-9 + 8.0 * f64::EPSILON * from_v.max(to_v) / change_v.max(f64::MIN_POSITIVE);
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
fn reachable_rise(from_v: f64, length_s: f64, limits: PathLimits) -> f64 {
    let PathLimits { accel_a, jerk_j } = limits;
    if length_s <= 0.0 {
        return 0.0;
    }
    let full_t = accel_a / jerk_j;
    if (2.0 * from_v + jerk_j * full_t * full_t) * full_t >= length_s {
        let x_t = solve_depressed_cubic(from_v, length_s, jerk_j);
        jerk_j * x_t * x_t
    } else {
        let c = 0.5 * accel_a * full_t;
        ((from_v - c).powi(2) + 2.0 * accel_a * length_s).sqrt() - c - from_v
    }
}

/// The positive root of J·x³ + 2·v·x = L.
fn solve_depressed_cubic(v: f64, length_s: f64, jerk_j: f64) -> f64 {
    let linear = 2.0 * v / (3.0 * jerk_j);
    let p = linear.sqrt();
    let argument = length_s / (2.0 * jerk_j * p * p * p);
    let mut x = if argument.is_finite() && argument < 1e12 {
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

/// One phase of constant jerk, with the state at its start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Phase {
    start_t: f64,
    duration_t: f64,
    jerk_j: f64,
    accel_a: f64,
    speed_v: f64,
    position_s: f64,
}

/// Motion along the path at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathState {
    /// Position from the start of the profile, mm.
    pub position_s: f64,
    /// Speed, mm/s.
    pub speed_v: f64,
    /// Acceleration, mm/s².
    pub accel_a: f64,
}

/// A motion of seven phases over a given length, zero acceleration at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    phases: [Phase; 7],
    duration_t: f64,
    peak_v: f64,
    end: PathState,
}

impl Profile {
    /// The fastest motion over `length_s` ≥ 0 from `entry_v` to `exit_v`, nowhere faster than
    /// `top_v` ≥ both.
    ///
    /// `None` if the length is too short for the change of speed, see [`ramp_fits`].
    #[must_use]
    pub fn new(
        entry_v: f64,
        exit_v: f64,
        length_s: f64,
        top_v: f64,
        limits: PathLimits,
    ) -> Option<Self> {
        if !ramp_fits(entry_v, exit_v, length_s, limits) {
            return None;
        }
        let base_v = entry_v.max(exit_v);
        let headroom_v = (top_v - base_v).max(0.0);
        let rise_v = peak_rise(entry_v, exit_v, length_s, headroom_v, limits);
        let peak_v = base_v + rise_v;
        // From the differences, not from the rounded peak: they matter where the length is tiny.
        let up = Ramp::new(base_v - entry_v + rise_v, limits);
        let down = Ramp::new(base_v - exit_v + rise_v, limits);
        let ramps_s = 0.5 * (entry_v + peak_v) * up.duration_t()
            + 0.5 * (peak_v + exit_v) * down.duration_t();
        let cruise_t = if peak_v > 0.0 {
            ((length_s - ramps_s) / peak_v).max(0.0)
        } else {
            0.0
        };
        let mut profile = Self::from_phases(
            entry_v,
            [
                (up.jerk_t, up.jerk_j),
                (up.accel_t, 0.0),
                (up.jerk_t, -up.jerk_j),
                (cruise_t, 0.0),
                (down.jerk_t, -down.jerk_j),
                (down.accel_t, 0.0),
                (down.jerk_t, down.jerk_j),
            ],
        );
        profile.peak_v = peak_v;
        profile.end = PathState {
            position_s: length_s,
            speed_v: exit_v,
            accel_a: 0.0,
        };
        Some(profile)
    }

    fn from_phases(entry_v: f64, table: [(f64, f64); 7]) -> Self {
        let mut phases = [Phase::default(); 7];
        let mut now = PathState {
            position_s: 0.0,
            speed_v: entry_v,
            accel_a: 0.0,
        };
        let mut start_t = 0.0;
        for (phase, (duration_t, jerk_j)) in phases.iter_mut().zip(table) {
            *phase = Phase {
                start_t,
                duration_t,
                jerk_j,
                accel_a: now.accel_a,
                speed_v: now.speed_v,
                position_s: now.position_s,
            };
            now = phase.at(duration_t);
            start_t += duration_t;
        }
        Self {
            phases,
            duration_t: start_t,
            peak_v: entry_v,
            end: now,
        }
    }

    /// How long the motion takes, s.
    #[must_use]
    pub const fn duration_t(&self) -> f64 {
        self.duration_t
    }

    /// Its greatest speed, mm/s.
    #[must_use]
    pub const fn peak_v(&self) -> f64 {
        self.peak_v
    }

    /// The durations of the seven phases, s.
    #[must_use]
    pub fn phase_durations_t(&self) -> [f64; 7] {
        self.phases.map(|phase| phase.duration_t)
    }

    /// Where the phase of constant speed starts and ends, mm from the start of the profile.
    #[must_use]
    pub fn cruise_s(&self) -> (f64, f64) {
        (self.phases[3].position_s, self.phases[4].position_s)
    }

    /// The state `t` seconds after the start, held before the start and after the end.
    #[must_use]
    pub fn at(&self, t: f64) -> PathState {
        if t >= self.duration_t {
            return self.end;
        }
        let t = t.max(0.0);
        let index = self
            .phases
            .iter()
            .rposition(|p| p.start_t <= t)
            .unwrap_or(0);
        let phase = &self.phases[index];
        phase.at(t - phase.start_t)
    }

    /// The greatest speed on the path interval from `from_s` to `to_s`, mm/s.
    ///
    /// Speed rises up to the cruise and falls after it, so this is the speed at one end of the
    /// interval, or the peak.
    #[must_use]
    pub fn greatest_speed_between(&self, from_s: f64, to_s: f64) -> f64 {
        let (cruise_from_s, cruise_to_s) = self.cruise_s();
        if to_s < cruise_from_s {
            self.speed_at(to_s, 0..3)
        } else if from_s > cruise_to_s {
            self.speed_at(from_s, 4..7)
        } else {
            self.peak_v
        }
    }

    /// Speed where the position is `s`, among monotone phases: cubic in time, solved by bisection
    /// with Newton steps.
    fn speed_at(&self, s: f64, phases: core::ops::Range<usize>) -> f64 {
        let candidates = &self.phases[phases];
        let Some(phase) = candidates.iter().rev().find(|p| p.position_s <= s) else {
            return candidates.first().map_or(0.0, |p| p.speed_v);
        };
        let (mut low_t, mut high_t) = (0.0, phase.duration_t);
        let mut t = 0.5 * high_t;
        for _ in 0..60 {
            let state = phase.at(t);
            let error_s = state.position_s - s;
            if error_s > 0.0 {
                high_t = t;
            } else {
                low_t = t;
            }
            let newton_t = t - error_s / state.speed_v;
            let next_t = if newton_t > low_t && newton_t < high_t {
                newton_t
            } else {
                0.5 * (low_t + high_t)
            };
            if (next_t - t).abs() <= 1e-12 * phase.duration_t {
                return phase.at(next_t).speed_v;
            }
            t = next_t;
        }
        phase.at(t).speed_v
    }
}

impl Phase {
    fn at(&self, t: f64) -> PathState {
        PathState {
            position_s: self.position_s
                + t * (self.speed_v + t * (self.accel_a / 2.0 + t * (self.jerk_j / 6.0))),
            speed_v: self.speed_v + t * (self.accel_a + t * (self.jerk_j / 2.0)),
            accel_a: self.accel_a + t * self.jerk_j,
        }
    }
}

/// How far the peak speed lies above the greater end speed, at most `headroom_v`.
fn peak_rise(entry_v: f64, exit_v: f64, length_s: f64, headroom_v: f64, limits: PathLimits) -> f64 {
    let PathLimits { accel_a, jerk_j } = limits;
    let (low_v, base_v) = (entry_v.min(exit_v), entry_v.max(exit_v));
    let ramp_s = |from_v: f64, change_v: f64| {
        (from_v + 0.5 * change_v) * Ramp::new(change_v, limits).duration_t()
    };
    let covered_s = |rise_v: f64| ramp_s(low_v, base_v - low_v + rise_v) + ramp_s(base_v, rise_v);
    if covered_s(headroom_v) <= length_s {
        return headroom_v;
    }
    // Both ramps with a phase of constant acceleration: closed form.
    let knee_v = accel_a * accel_a / jerk_j;
    let c = 0.5 * knee_v;
    let closed_v = -c
        + (c * c + 0.5 * (entry_v * entry_v + exit_v * exit_v) - c * (entry_v + exit_v)
            + accel_a * length_s)
            .sqrt();
    if closed_v - base_v >= knee_v {
        return (closed_v - base_v).min(headroom_v);
    }
    // In x = √rise the length is smooth, nearly a cubic; Newton inside a bracket. The start is exact
    // for equal ends.
    let room_s = (length_s - ramp_s(low_v, base_v - low_v)).max(0.0);
    let mut x = (reachable_rise(base_v, 0.5 * room_s, limits))
        .min(headroom_v)
        .sqrt();
    let (mut under_x, mut over_x) = (0.0, headroom_v.sqrt());
    for _ in 0..60 {
        let rise_v = x * x;
        let excess_s = covered_s(rise_v) - length_s;
        if excess_s > 0.0 {
            over_x = x;
        } else {
            under_x = x;
        }
        let slope = 2.0
            * x
            * (ramp_slope(low_v, base_v - low_v + rise_v, limits)
                + ramp_slope(base_v, rise_v, limits));
        let newton_x = x - excess_s / slope;
        let next_x = if newton_x > under_x && newton_x < over_x {
            newton_x
        } else {
            0.5 * (under_x + over_x)
        };
        if (next_x - x).abs() <= 4.0 * f64::EPSILON * x {
            break;
        }
        x = next_x;
    }
    x * x
}

/// Derivative of the length of a ramp by its change of speed, s.
fn ramp_slope(from_v: f64, change_v: f64, limits: PathLimits) -> f64 {
    let PathLimits { accel_a, jerk_j } = limits;
    let middle_v = from_v + 0.5 * change_v;
    if change_v * jerk_j >= accel_a * accel_a {
        0.5 * (change_v / accel_a + accel_a / jerk_j) + middle_v / accel_a
    } else {
        let jerk_t = (change_v / jerk_j).sqrt();
        jerk_t + middle_v / (jerk_j * jerk_t)
    }
}

/// A time-optimal change from one speed and acceleration to another, position free: three phases of
/// jerk +, 0, − or −, 0, +.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedChange {
    /// Durations of the three phases, s.
    pub durations_t: [f64; 3],
    /// Their jerks, mm/s³.
    pub jerks_j: [f64; 3],
    /// The path it takes, mm.
    pub length_s: f64,
}

impl SpeedChange {
    /// From `(from_v, from_a)` to `(to_v, to_a)`; both accelerations within ±A.
    #[must_use]
    pub fn new(from: (f64, f64), to: (f64, f64), limits: PathLimits) -> Self {
        let PathLimits { accel_a, jerk_j } = limits;
        let ((from_v, from_a), (to_v, to_a)) = (from, to);
        let direct_v =
            from_v + (to_a - from_a).signum() * (to_a * to_a - from_a * from_a) / (2.0 * jerk_j);
        let direction = if to_v >= direct_v { 1.0 } else { -1.0 };
        let peak_a = (0.5 * (from_a * from_a + to_a * to_a) + direction * jerk_j * (to_v - from_v))
            .max(0.0)
            .sqrt();
        let (peak_a, hold_t) = if peak_a > accel_a {
            let hold_v = to_v
                - from_v
                - direction * (accel_a * accel_a - from_a * from_a) / (2.0 * jerk_j)
                - direction * (accel_a * accel_a - to_a * to_a) / (2.0 * jerk_j);
            (direction * accel_a, hold_v / (direction * accel_a))
        } else {
            (direction * peak_a, 0.0)
        };
        let durations_t = [
            direction * (peak_a - from_a) / jerk_j,
            hold_t,
            direction * (peak_a - to_a) / jerk_j,
        ];
        let jerks_j = [direction * jerk_j, 0.0, -direction * jerk_j];
        let mut state = PathState {
            position_s: 0.0,
            speed_v: from_v,
            accel_a: from_a,
        };
        for (duration_t, jerk_j) in durations_t.into_iter().zip(jerks_j) {
            let phase = Phase {
                jerk_j,
                accel_a: state.accel_a,
                speed_v: state.speed_v,
                position_s: state.position_s,
                ..Phase::default()
            };
            state = phase.at(duration_t);
        }
        Self {
            durations_t,
            jerks_j,
            length_s: state.position_s,
        }
    }
}
