//! The ways of a motor, between the steps in which it is led.

use std::collections::VecDeque;

/// The way of a motor in a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Way {
    pub(crate) from_ns: u64,
    pub(crate) to_ns: u64,
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Time constant of its lag, s; 0 for a steady speed.
    pub(crate) lag_t: f64,
}

impl Way {
    #[allow(clippy::cast_precision_loss, reason = "a step")]
    fn step_t(&self) -> f64 {
        (self.to_ns - self.from_ns) as f64 * 1e-9
    }

    /// The part of the way that is done after a part of the time, or the reverse.
    fn done(&self, of_time: f64) -> f64 {
        if self.lag_t <= 0.0 {
            return of_time;
        }
        let steps = self.step_t() / self.lag_t;
        (-steps * of_time).exp_m1() / (-steps).exp_m1()
    }

    fn time_of(&self, done: f64) -> f64 {
        if self.lag_t <= 0.0 {
            return done;
        }
        let steps = self.step_t() / self.lag_t;
        -(done * (-steps).exp_m1()).ln_1p() / steps
    }

    /// When it passes a place that is on it, ns.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a part of a step"
    )]
    pub(crate) fn passes_ns(&self, place: f64) -> u64 {
        let done = ((place - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        self.from_ns + (self.time_of(done) * self.step_t() * 1e9).round() as u64
    }

    /// Where the motor is at a time.
    #[allow(clippy::cast_precision_loss, reason = "a step")]
    fn at(&self, now_ns: u64) -> f64 {
        let since_t = now_ns.saturating_sub(self.from_ns) as f64 * 1e-9;
        let of_time = (since_t / self.step_t()).clamp(0.0, 1.0);
        self.from + (self.to - self.from) * self.done(of_time)
    }
}

/// The last ways of a motor.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ways(VecDeque<Way>);

impl Ways {
    const MOST: usize = 64;

    pub(crate) fn push(&mut self, way: Way) {
        if self.0.len() == Self::MOST {
            self.0.pop_front();
        }
        self.0.push_back(way);
    }

    pub(crate) fn last_ns(&self) -> u64 {
        self.0.back().map_or(0, |way| way.to_ns)
    }

    /// All of them, the oldest first.
    pub(crate) fn all(&self) -> impl Iterator<Item = &Way> {
        self.0.iter()
    }

    /// Where the motor was at a time.
    pub(crate) fn at(&self, now_ns: u64) -> Option<f64> {
        let way = self.0.iter().find(|way| now_ns <= way.to_ns);
        way.or(self.0.back()).map(|way| way.at(now_ns))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_passed_when_the_motor_is_there() {
        for lag_t in [0.0, 0.000_5, 0.002, 0.1] {
            let way = Way {
                from_ns: 1_000_000_000,
                to_ns: 1_004_000_000,
                from: 100.0,
                to: -60.0,
                lag_t,
            };
            for place in [100.0, 99.0, 20.0, -59.999, -60.0] {
                let at_ns = way.passes_ns(place);
                assert!((way.at(at_ns) - place).abs() < 1e-3, "{lag_t} {place}");
            }
            assert!(way.at(1_002_000_000) <= 20.0 + 1e-9);
        }
    }
}
