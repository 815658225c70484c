//! The initial iterate: the coefficients that the least time is sought from, those of the S-curves, slowed down.

use super::interval::Interval;
use super::knot_times::RestPhase;
use super::knots::KnotPath;

impl KnotPath {
    /// The coefficient of b on an interval, as the S-curves have it: where the tangents of b at the
    /// ends have the middle, on average. Exact for a parabola.
    fn coefficient(&self, interval: &Interval) -> f64 {
        let half_s = 0.5 * interval.length_s;
        let after = |s: f64| self.legs.partition_point(|leg| leg.from_s <= s);
        let tangent = |s: f64, step_s: f64| {
            let leg = self.legs.get(after(s).saturating_sub(1));
            leg.map_or(0.0, |leg| {
                let state = leg.profile.at_position(s - leg.from_s);
                state.speed_v * state.speed_v + 2.0 * state.accel_a * step_s
            })
        };
        let [from_s, to_s] = [interval.from_s, interval.from_s + interval.length_s];
        0.5 * (tangent(from_s, half_s) + tangent(to_s, -half_s))
    }

    /// How fast the initial iterate is at a path position, in speeds of the S-curves; `rate_r` away from the
    /// ends.
    fn rate_at(&self, s: f64, rate_r: f64) -> f64 {
        let sides_s = [s, self.extent - s];
        let mut at_r = rate_r;
        for ((end_r, ramp_s), side_s) in self.ends_r.iter().zip(self.ramps_s).zip(sides_s) {
            if let Some(end_r) = end_r {
                let u = (side_s / ramp_s).clamp(0.0, 1.0);
                // The quintic with no slope and no second derivative at its ends: neither acceleration
                // nor jerk jumps there.
                let passed_r = u * u * u * (10.0 + u * (6.0 * u - 15.0));
                at_r += (end_r - rate_r) * (1.0 - passed_r);
            }
        }
        at_r
    }

    /// How fast the motion is at start and end, in speeds of the S-curves.
    pub(crate) fn ends_at(&self, rate_r: f64) -> [f64; 2] {
        self.ends_r.map(|end_r| end_r.unwrap_or(rate_r))
    }

    /// The initial iterate of the optimisation: coefficients of the S-curves, `rate_r` times as fast, but for
    /// the ends.
    pub(crate) fn initial(&self, rate_r: f64) -> Vec<f64> {
        if self.nominal.is_some() {
            return self.initial_rates(rate_r);
        }
        let square_r = rate_r * rate_r;
        let count = self.intervals.len();
        let mut x = Vec::with_capacity(count + 2);
        let speed = |rest: Option<RestPhase>, end_v: f64| match rest {
            Some(r) => {
                let speed_v = 0.5 * r.jerk_j * r.duration_t * r.duration_t;
                (speed_v * speed_v, r.jerk_j * r.duration_t)
            }
            None => (end_v * end_v, 0.0),
        };
        let (start_b, start_a) = speed(self.rests[0], self.ends_v[0]);
        let (end_b, end_a) = speed(self.rests[1], self.ends_v[1]);
        // The coefficient next to an end is where the tangent of b there leads to in the middle of the interval,
        // b ± b′·h/2, and b′ is twice the acceleration. `end_a` is without its sign: there the motion slows down.
        x.push(start_b);
        for interval in &self.intervals {
            x.push(self.coefficient(interval));
        }
        x.push(end_b);
        if let (Some(first), Some(last)) = (self.intervals.first(), self.intervals.last()) {
            x[1] = start_b + start_a * first.length_s;
            x[count] = end_b + end_a * last.length_s;
        }
        if self.ends_r == [None; 2] {
            for b in &mut x {
                *b *= square_r;
            }
            return x;
        }
        let middle = |interval: &Interval| interval.from_s + 0.5 * interval.length_s;
        for (b, interval) in x[1..=count].iter_mut().zip(&self.intervals) {
            *b *= self.rate_at(middle(interval), rate_r).powi(2);
        }
        let [start_r, end_r] = self.ends_at(rate_r);
        x[0] = start_b * start_r * start_r;
        x[count + 1] = end_b * end_r * end_r;
        // Nothing but the speed is given there.
        if self.ends_r[0].is_some() {
            x[1] = x[0];
        }
        if self.ends_r[1].is_some() {
            x[count] = x[count + 1];
        }
        x
    }

    /// The same in nominal time, where the S-curves have coefficients of 1.
    fn initial_rates(&self, rate_r: f64) -> Vec<f64> {
        let middle = |interval: &Interval| interval.from_s + 0.5 * interval.length_s;
        let inner = self.intervals.iter();
        let inner = inner.map(|interval| self.rate_at(middle(interval), rate_r));
        let [start_r, end_r] = self.ends_at(rate_r);
        let mut x: Vec<f64> = core::iter::once(start_r).chain(inner).collect();
        x.push(end_r);
        let count = self.intervals.len();
        (x[1], x[count]) = (start_r, end_r);
        x.into_iter().map(|rate_r| rate_r * rate_r).collect()
    }
}
