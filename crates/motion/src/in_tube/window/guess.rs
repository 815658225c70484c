//! A first guess of the time parametrisation: seven-phase speed changes between speed caps at the
//! vertices.
//!
//! Only a guess: it says when the motion should be on which piece, and errs on the side of too
//! fast, because a sample that was given to a piece too early is corrected at once, one given too
//! late moves on by a tube length an iteration. The cap at a vertex is the speed at which the turn
//! fits into the tube: with jerk J a change of velocity takes the time τ, J·τ² = |Δt|·v, and strays
//! by about J·τ³/4.

use super::scaled_path::ScaledPath;
use super::solver::dot;
use crate::scurve::{PathLimits, Profile, reachable_speed};

/// Speed at and time of every vertex.
#[derive(Debug, Clone, Default)]
pub(crate) struct Guess {
    /// Seconds from the start of the scaled path, one more than pieces.
    times: Vec<f64>,
    speeds: Vec<f64>,
}

impl Guess {
    pub(crate) fn make<const D: usize>(&mut self, path: &ScaledPath<D>) {
        self.caps(path);
        let count = path.segments.len();
        self.slow_down(
            count,
            |i| path.segments[i].s,
            |i| path.segments[i].length,
            |i| path.segments[i].limits,
        );
        self.times.clear();
        self.times.push(0.0);
        let mut time = 0.0;
        for (i, segment) in path.segments.iter().enumerate() {
            let (from, to) = (self.speeds[i], self.speeds[i + 1]);
            let top = segment.top.max(from).max(to);
            time += Profile::new(from, to, segment.length, top, segment.limits).map_or_else(
                || 2.0 * segment.length / (from + to).max(1e-9 * segment.top),
                |profile| profile.duration_t(),
            );
            self.times.push(time);
        }
    }

    fn caps<const D: usize>(&mut self, path: &ScaledPath<D>) {
        let segments = &path.segments;
        self.speeds.clear();
        self.speeds.push(0.0);
        for i in 1..segments.len() {
            let (before, after) = (&segments[i - 1], &segments[i]);
            let mut cap = before.top.min(after.top);
            let jumps = path.corner(i - 1);
            for k in 0..D {
                let jump = jumps[k].abs();
                let (a, j) = (path.acceleration[k], path.jerk[k]);
                let tau = (4.0 * before.radius.min(after.radius) / j)
                    .cbrt()
                    .min(2.0 * a / j);
                if jump * cap > j * tau * tau {
                    cap = j * tau * tau / jump;
                }
            }
            self.speeds.push(cap.min(curve_speed(path, i)));
        }
        self.speeds.push(0.0);
    }

    /// Lowers the caps to what can be slowed down from and reached, counting from the last vertex
    /// whose cap binds: speed changes go on across the vertices between.
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
        let mut from = (end_s(count - 1), 0.0, limits(count - 1));
        for i in (0..count).rev() {
            from.2 = narrow(from.2, limits(i));
            let reach = reachable_speed(from.1, from.0 - s(i), from.2);
            if self.speeds[i] <= reach {
                from = (s(i), self.speeds[i], limits(i));
            } else {
                self.speeds[i] = reach;
            }
        }
        self.speeds[0] = 0.0;
        let mut from = (0.0, 0.0, limits(0));
        for i in 0..count {
            from.2 = narrow(from.2, limits(i));
            let reach = reachable_speed(from.1, end_s(i) - from.0, from.2);
            if self.speeds[i + 1] <= reach {
                from = (end_s(i), self.speeds[i + 1], limits(i));
            } else {
                self.speeds[i + 1] = reach;
            }
        }
    }

    /// Where the guess is at a time; `hint` is the piece to look at first.
    pub(crate) fn s_at<const D: usize>(
        &self,
        path: &ScaledPath<D>,
        t: f64,
        hint: &mut usize,
    ) -> f64 {
        let count = path.segments.len();
        while *hint + 1 < count && self.times[*hint + 1] <= t {
            *hint += 1;
        }
        while *hint > 0 && self.times[*hint] > t {
            *hint -= 1;
        }
        let i = *hint;
        let segment = &path.segments[i];
        let span = self.times[i + 1] - self.times[i];
        let x = if span > 0.0 {
            ((t - self.times[i]) / span).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let slope = |speed: f64| (speed * span / segment.length).min(3.0);
        let (m0, m1) = (slope(self.speeds[i]), slope(self.speeds[i + 1]));
        let y = 1.0 - x;
        let part = x * x * (3.0 - 2.0 * x) + m0 * x * y * y - m1 * x * x * y;
        segment.s + segment.length * part.clamp(0.0, 1.0)
    }

    /// When the guess is at a place of piece `i`.
    pub(crate) fn t_at<const D: usize>(&self, path: &ScaledPath<D>, s: f64, i: usize) -> f64 {
        let (mut low, mut high) = (self.times[i], self.times[i + 1]);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.s_at(path, middle, &mut i.clone()) < s {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

/// The time from rest to rest over a length, s.
pub(crate) fn rest_to_rest_t(length: f64, top: f64, limits: PathLimits) -> f64 {
    Profile::new(0.0, 0.0, length, top, limits).map_or(0.0, |profile| profile.duration_t())
}

/// The speed at which the path can be driven round a vertex as a curve: many gentle corners in a
/// row are one bend, and the room that the tube gives is there for all of them once.
fn curve_speed<const D: usize>(path: &ScaledPath<D>, i: usize) -> f64 {
    let segments = &path.segments;
    let at = segments[i].s;
    let room = 2.0 * segments[i - 1].radius.min(segments[i].radius);
    let mut speed = f64::INFINITY;
    let (mut low, mut high) = (i - 1, i);
    // Outwards, nearer side first, until the path has left the line by the room.
    loop {
        let reach = (at - segments[low].s).min(segments[high].s + segments[high].length - at);
        let turn: [f64; D] =
            core::array::from_fn(|k| segments[high].tangent[k] - segments[low].tangent[k]);
        let angle = dot(&turn, &turn).sqrt();
        if 0.5 * angle * reach >= room {
            let curvature = angle / reach;
            for k in 0..D {
                let share = turn[k].abs() / angle;
                let (a, j) = (path.acceleration[k], path.jerk[k]);
                speed = speed
                    .min((a / (curvature * share)).sqrt())
                    .min((j / (curvature * curvature * share)).cbrt());
            }
            return speed;
        }
        let (before, after) = (
            at - segments[low].s,
            segments[high].s + segments[high].length - at,
        );
        if before <= after {
            if low == 0 {
                return speed;
            }
            low -= 1;
        } else {
            if high + 1 == segments.len() {
                return speed;
            }
            high += 1;
        }
    }
}
