//! The seven phases over a given length.

use super::phase::{PathState, Phase};
use super::ramp::{PathLimits, Ramp, ramp_fits, ramp_slope, reachable_rise};

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
        let outline = Outline::new(entry_v, exit_v, length_s, top_v, limits)?;
        let mut profile = Self::from_phases(entry_v, outline.phases());
        profile.peak_v = outline.peak_v;
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

    /// The speed at the start, mm/s.
    #[must_use]
    pub const fn entry_v(&self) -> f64 {
        self.phases[0].speed_v
    }

    /// The path it covers, mm.
    #[must_use]
    pub const fn length_s(&self) -> f64 {
        self.end.position_s
    }

    /// The speed at the end, mm/s.
    #[must_use]
    pub const fn exit_v(&self) -> f64 {
        self.end.speed_v
    }

    /// When the phase of constant speed starts and ends, s from the start of the profile.
    #[must_use]
    pub fn cruise_t(&self) -> core::ops::Range<f64> {
        self.phases[3].start_t..self.phases[4].start_t
    }

    /// Where the phase of constant speed starts and ends, mm from the start of the profile.
    #[must_use]
    pub fn cruise_s(&self) -> (f64, f64) {
        (self.phases[3].position_s, self.phases[4].position_s)
    }

    /// How long each phase takes, its state at the start, and its jerk.
    pub(crate) fn phases(&self) -> impl Iterator<Item = (f64, PathState, f64)> {
        let phases = self.phases.into_iter();
        phases.map(|phase| (phase.duration_t, phase.at(0.0), phase.jerk_j))
    }

    /// The state at a path position of the profile.
    pub(crate) fn at_position(&self, s: f64) -> PathState {
        let phases = self.phases.iter().rev();
        let passed = phases.filter(|p| p.duration_t > 0.0 && p.position_s <= s);
        match passed.into_iter().next() {
            Some(phase) => phase.at(phase.time_at(s)),
            None => self.phases[0].at(0.0),
        }
    }

    /// When the path position of the profile is `s`, s after its start.
    pub(crate) fn time_at(&self, s: f64) -> f64 {
        let phases = self.phases.iter().rev();
        let passed = phases.filter(|p| p.duration_t > 0.0 && p.position_s <= s);
        let own = passed.into_iter().next();
        own.map_or(0.0, |phase| phase.start_t + phase.time_at(s))
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

    /// Speed where the position is `s`, among monotone phases.
    fn speed_at(&self, s: f64, phases: core::ops::Range<usize>) -> f64 {
        let candidates = &self.phases[phases];
        match candidates.iter().rev().find(|p| p.position_s <= s) {
            Some(phase) => phase.at(phase.time_at(s)).speed_v,
            None => candidates.first().map_or(0.0, |p| p.speed_v),
        }
    }

    /// A bound of speed, acceleration and jerk, as magnitudes, on the path interval from `from` to
    /// `to_s`, and the place where it ends.
    pub(crate) fn extremes(
        &self,
        from: &ProfilePosition,
        to_s: f64,
    ) -> (Extremes, ProfilePosition) {
        let mut phase = from.phase;
        while phase < 6 && self.phases[phase + 1].position_s <= to_s {
            phase += 1;
        }
        let at = &self.phases[phase];
        let state = at.at(at.time_at(to_s));
        let mut most = Extremes {
            speed_v: from.state.speed_v.max(state.speed_v),
            accel_a: from.state.accel_a.abs().max(state.accel_a.abs()),
            jerk_j: 0.0,
        };
        for (i, passed) in self
            .phases
            .iter()
            .enumerate()
            .take(phase + 1)
            .skip(from.phase)
        {
            if passed.duration_t > 0.0 {
                most.jerk_j = most.jerk_j.max(passed.jerk_j.abs());
            }
            if i > from.phase {
                most.speed_v = most.speed_v.max(passed.speed_v);
                most.accel_a = most.accel_a.max(passed.accel_a.abs());
            }
        }
        (most, ProfilePosition { phase, state })
    }

    /// The place where the profile starts.
    pub(crate) fn start(&self) -> ProfilePosition {
        ProfilePosition {
            phase: 0,
            state: self.phases[0].at(0.0),
        }
    }
}

/// The phases of a profile without their states.
pub(crate) struct Outline {
    up: Ramp,
    cruise_t: f64,
    down: Ramp,
    peak_v: f64,
}

impl Outline {
    /// As [`Profile::new`].
    pub(crate) fn new(
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
        // What rounding leaves of the length below zero is none.
        let cruise_t = if peak_v > 0.0 {
            ((length_s - ramps_s) / peak_v).max(0.0)
        } else {
            0.0
        };
        Some(Self {
            up,
            cruise_t,
            down,
            peak_v,
        })
    }

    /// How long the motion takes, s.
    pub(crate) fn duration_t(&self) -> f64 {
        self.phases().into_iter().map(|(phase_t, _)| phase_t).sum()
    }

    /// Duration and jerk of each.
    const fn phases(&self) -> [(f64, f64); 7] {
        let Self { up, down, .. } = self;
        [
            (up.jerk_t, up.jerk_j),
            (up.accel_t, 0.0),
            (up.jerk_t, -up.jerk_j),
            (self.cruise_t, 0.0),
            (down.jerk_t, -down.jerk_j),
            (down.accel_t, 0.0),
            (down.jerk_t, down.jerk_j),
        ]
    }
}

/// A place on a profile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProfilePosition {
    phase: usize,
    state: PathState,
}

/// The largest magnitudes on a part of a profile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extremes {
    pub(crate) speed_v: f64,
    pub(crate) accel_a: f64,
    pub(crate) jerk_j: f64,
}

/// Steps for the peak, which bisection alone would take, and the change of its root that is rounding.
const PEAK_STEPS: u32 = 60;
const PEAK_ROUNDING_R: f64 = 4.0 * f64::EPSILON;

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
    // Both ramps with a phase of constant acceleration: closed form. A ramp from v takes
    // ½(v + p)((p − v)/A + A/J); both lengths add up to a square in the peak p, with c = A²/(2J):
    // p² + 2c·p = ½(v₀² + v₁²) − c(v₀ + v₁) + A·L.
    let knee_v = accel_a * accel_a / jerk_j;
    let c = 0.5 * knee_v;
    let closed_v = -c
        + (c * c + 0.5 * (entry_v * entry_v + exit_v * exit_v) - c * (entry_v + exit_v)
            + accel_a * length_s)
            .sqrt();
    if closed_v - base_v >= knee_v {
        return (closed_v - base_v).min(headroom_v);
    }
    // In x = √rise the length is smooth, nearly a cubic (a ramp without such a phase takes 2·√(d/J));
    // Newton inside a bracket. The start is exact for equal ends.
    let room_s = (length_s - ramp_s(low_v, base_v - low_v)).max(0.0);
    let mut x = (reachable_rise(base_v, 0.5 * room_s, limits))
        .min(headroom_v)
        .sqrt();
    let (mut under_x, mut over_x) = (0.0, headroom_v.sqrt());
    for _ in 0..PEAK_STEPS {
        let rise_v = x * x;
        let excess_s = covered_s(rise_v) - length_s;
        if excess_s > 0.0 {
            over_x = x;
        } else {
            under_x = x;
        }
        // d(length)/dx, with d(rise)/dx = 2x.
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
        if (next_x - x).abs() <= PEAK_ROUNDING_R * x {
            break;
        }
        x = next_x;
    }
    x * x
}
