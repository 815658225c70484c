//! A first guess of the time parametrisation: seven-phase speed changes between speed caps at the
//! vertices.
//!
//! Only a guess: it says when the motion should be on which piece. It had better be too fast, because a
//! sample that was given to a piece too early is corrected at once, one given too late moves on by a tube
//! length an iteration; how much faster than the guess it is played is learnt from window to window (the
//! pace, [`super::optimiser`]).
//!
//! The cap at a vertex is the speed at which the turn fits into the tube. Jerk +J for a time τ and −J for
//! another change a velocity by J·τ² = |Δt|·v, with a peak of acceleration of J·τ, and pass a vertex in
//! the middle of that at a distance of J·τ³/6. Here a quarter stands for the sixth, with which the cap is
//! .76 times as fast; why is not on record.
//!
//! Lengths are those of the window's space, in tolerances; so speeds (`_v`) are tolerances per second.

use super::scaled_path::ScaledPath;
use super::solver::dot;
use crate::in_tube::path::SHARP;
use crate::scurve::{PathLimits, Profile, reachable_speed};

/// Speed at and time of every vertex.
#[derive(Debug, Clone, Default)]
pub(crate) struct Guess {
    /// From the start of the scaled path, s, one more than pieces; at rest at both ends.
    times_t: Vec<f64>,
    speeds_v: Vec<f64>,
    /// The speed at every vertex at which the chord of a period is as high as the tube is wide.
    chords_v: Vec<f64>,
    /// The most speed on every piece, however fast the guess is played.
    tops_v: Vec<f64>,
}

/// Between two speeds whose S-curve does not fit, a piece is taken to be driven at their mean, and at
/// least at this share of its top speed: from rest to rest it takes long, but no infinite time.
const LEAST_MEAN_R: f64 = 1e-9;
/// Largest slope at the ends of a cubic from 0 to 1 that is sure to be monotone (Fritsch and Carlson
/// 1980): progress never falls.
const MONOTONE_SLOPE: f64 = 3.0;
/// Bisections of a piece for a time: to 1e-12 of what it takes.
const BISECTIONS: usize = 40;

impl Guess {
    pub(crate) fn make<const D: usize>(&mut self, path: &ScaledPath<D>, period_t: f64) {
        self.caps(path, period_t);
        self.tops(path, period_t);
        let count = path.segments.len();
        self.slow_down(
            count,
            |i| path.segments[i].s,
            |i| path.segments[i].length,
            |i| path.segments[i].limits,
        );
        self.times_t.clear();
        self.times_t.push(0.0);
        let mut time_t = 0.0;
        for (i, segment) in path.segments.iter().enumerate() {
            let (from_v, to_v) = (self.speeds_v[i], self.speeds_v[i + 1]);
            let top_v = segment.top.max(from_v).max(to_v);
            let profile = Profile::new(from_v, to_v, segment.length, top_v, segment.limits);
            time_t += profile.map_or_else(
                || 2.0 * segment.length / (from_v + to_v).max(LEAST_MEAN_R * segment.top),
                |profile| profile.duration_t(),
            );
            self.times_t.push(time_t);
        }
    }

    fn caps<const D: usize>(&mut self, path: &ScaledPath<D>, period_t: f64) {
        let segments = &path.segments;
        self.speeds_v.clear();
        self.speeds_v.push(0.0);
        self.chords_v.clear();
        self.chords_v.push(f64::INFINITY);
        for i in 1..segments.len() {
            let (before, after) = (&segments[i - 1], &segments[i]);
            let mut cap_v = before.top.min(after.top);
            let jumps = path.corner(i - 1);
            for k in 0..D {
                let jump = jumps[k].abs();
                let [most_a, most_j] = path.usual.map(|of_axis| of_axis[k]);
                // As long as the tube allows: by jerk J·τ², where J·τ³/4 is the radius, and by a constant
                // acceleration over T, which strays by A·T²/8, A·T. Both are the same where τ = 2·A/J.
                let radius = before.radius.min(after.radius);
                let tau_t = (4.0 * radius / most_j).cbrt();
                let most_v = (most_j * tau_t * tau_t).min((8.0 * most_a * radius).sqrt());
                if jump * cap_v > most_v {
                    cap_v = most_v / jump;
                }
            }
            let (curve_v, chord_v) = curve_speeds(path, i, period_t);
            // A sharp corner is no bend.
            let is_bend = path.turn(i - 1, i) <= SHARP;
            let chord_v = if is_bend { chord_v } else { f64::INFINITY };
            self.speeds_v.push(cap_v.min(curve_v).min(chord_v));
            self.chords_v.push(chord_v);
        }
        self.speeds_v.push(0.0);
        self.chords_v.push(f64::INFINITY);
    }

    /// The feed on every piece, and what the chords of periods allow on those of a bend. A piece that a period
    /// does not get across is no part of one: the chord is along it but at its ends.
    fn tops<const D: usize>(&mut self, path: &ScaledPath<D>, period_t: f64) {
        let chords_v = self.chords_v.windows(2).map(|ends| ends[0].min(ends[1]));
        let pieces = path.segments.iter().zip(chords_v);
        self.tops_v.clear();
        self.tops_v.extend(pieces.map(|(segment, chord_v)| {
            if segment.length <= chord_v * period_t {
                segment.top.min(chord_v)
            } else {
                segment.top
            }
        }));
    }

    /// Lowers the caps to what can be slowed down from and reached, counting from the last vertex
    /// whose cap binds: speed changes go on across the vertices between. From each vertex to the next
    /// they would begin and end without acceleration at all of them, and hardly get anywhere on short
    /// pieces.
    fn slow_down(
        &mut self,
        count: usize,
        s: impl Fn(usize) -> f64,
        length: impl Fn(usize) -> f64,
        limits: impl Fn(usize) -> PathLimits,
    ) {
        let narrow = |a: PathLimits, b: PathLimits| PathLimits {
            accel_a: a.accel_a.min(b.accel_a),
            jerk_j: a.jerk_j.min(b.jerk_j),
        };
        let end_s = |i: usize| s(i) + length(i);
        if count == 0 {
            return;
        }
        // The place and speed that are counted from, and the weakest limits since there.
        let mut from = (end_s(count - 1), 0.0, limits(count - 1));
        for i in (0..count).rev() {
            from.2 = narrow(from.2, limits(i));
            let reach = reachable_speed(from.1, from.0 - s(i), from.2);
            if self.speeds_v[i] <= reach {
                from = (s(i), self.speeds_v[i], limits(i));
            } else {
                self.speeds_v[i] = reach;
            }
        }
        self.speeds_v[0] = 0.0;
        let mut from = (0.0, 0.0, limits(0));
        for i in 0..count {
            from.2 = narrow(from.2, limits(i));
            let reach = reachable_speed(from.1, end_s(i) - from.0, from.2);
            if self.speeds_v[i + 1] <= reach {
                from = (end_s(i), self.speeds_v[i + 1], limits(i));
            } else {
                self.speeds_v[i + 1] = reach;
            }
        }
    }

    /// The most speed on piece `i`.
    pub(crate) fn top_v(&self, i: usize) -> f64 {
        self.tops_v[i]
    }

    /// Where the guess is at a time; `hint` is the piece to look at first. Along a piece it is the cubic
    /// through times and speeds at its ends, not the S-curve itself.
    pub(crate) fn s_at<const D: usize>(
        &self,
        path: &ScaledPath<D>,
        t: f64,
        hint: &mut usize,
    ) -> f64 {
        let count = path.segments.len();
        while *hint + 1 < count && self.times_t[*hint + 1] <= t {
            *hint += 1;
        }
        while *hint > 0 && self.times_t[*hint] > t {
            *hint -= 1;
        }
        let i = *hint;
        let segment = &path.segments[i];
        let span_t = self.times_t[i + 1] - self.times_t[i];
        let x = if span_t > 0.0 {
            ((t - self.times_t[i]) / span_t).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let slope = |speed_v: f64| (speed_v * span_t / segment.length).min(MONOTONE_SLOPE);
        let (m0, m1) = (slope(self.speeds_v[i]), slope(self.speeds_v[i + 1]));
        let y = 1.0 - x;
        // Hermite's cubic from 0 to 1.
        let part = x * x * (3.0 - 2.0 * x) + m0 * x * y * y - m1 * x * x * y;
        segment.s + segment.length * part.clamp(0.0, 1.0)
    }

    /// When the guess is at a place of piece `i`.
    pub(crate) fn t_at<const D: usize>(&self, path: &ScaledPath<D>, s: f64, i: usize) -> f64 {
        let (mut low_t, mut high_t) = (self.times_t[i], self.times_t[i + 1]);
        for _ in 0..BISECTIONS {
            let middle_t = 0.5 * (low_t + high_t);
            if self.s_at(path, middle_t, &mut i.clone()) < s {
                low_t = middle_t;
            } else {
                high_t = middle_t;
            }
        }
        0.5 * (low_t + high_t)
    }
}

/// The time from rest to rest over a length, s.
pub(crate) fn rest_to_rest_t(length: f64, top: f64, limits: PathLimits) -> f64 {
    Profile::new(0.0, 0.0, length, top, limits).map_or(0.0, |profile| profile.duration_t())
}

/// The speed at which the path can be driven round a vertex as a curve: many gentle corners in a
/// row are one bend, and the room that the tube gives is there for all of them once. Without it every
/// chord of an arc would be a corner with a cap of its own. And the speed at which the chord of a period
/// there is as high as the tube is wide.
fn curve_speeds<const D: usize>(path: &ScaledPath<D>, i: usize, period_t: f64) -> (f64, f64) {
    let segments = &path.segments;
    let at = segments[i].s;
    let middle = |i: usize| segments[i].s + 0.5 * segments[i].length;
    // An arc that turns by an angle over twice the reach is angle·reach/4 high: a radius, where half of
    // angle·reach is two.
    let room = 2.0 * segments[i - 1].radius.min(segments[i].radius);
    let mut speed_v = f64::INFINITY;
    let (mut low, mut high) = (i - 1, i);
    // Outwards, nearer side first, until the path has left the line by the room.
    loop {
        let reach = (at - segments[low].s).min(segments[high].s + segments[high].length - at);
        let turn: [f64; D] =
            core::array::from_fn(|k| segments[high].tangent[k] - segments[low].tangent[k]);
        let angle = dot(&turn, &turn).sqrt();
        if 0.5 * angle * reach >= room {
            // Chords have the directions of an arc in their middles. Where one side goes on far, the bend
            // is within the reach.
            let bend = (middle(high) - middle(low)).min(2.0 * reach);
            let curvature = angle / bend;
            // The chord of a period is v²·T²·κ/8 high.
            let chord_v = (8.0 * room / curvature).sqrt() / period_t;
            for k in 0..D {
                let share = turn[k].abs() / angle;
                let [most_a, most_j] = path.usual.map(|of_axis| of_axis[k]);
                // Across a curve of constant speed acceleration is v²·κ, jerk v³·κ².
                speed_v = speed_v
                    .min((most_a / (curvature * share)).sqrt())
                    .min((most_j / (curvature * curvature * share)).cbrt());
            }
            return (speed_v, chord_v);
        }
        let (before, after) = (
            at - segments[low].s,
            segments[high].s + segments[high].length - at,
        );
        if before <= after {
            if low == 0 {
                return (speed_v, f64::INFINITY);
            }
            low -= 1;
        } else {
            if high + 1 == segments.len() {
                return (speed_v, f64::INFINITY);
            }
            high += 1;
        }
    }
}
