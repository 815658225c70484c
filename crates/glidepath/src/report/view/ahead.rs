//! What is to come of a program, and how long it takes under the overrides in force.

use glidepath_link::Status;

/// What is to come of a plan: its time at overrides of 100 %, by what that obeys.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ahead {
    /// Of what obeys the feed override, s, ≥ 0.
    pub feed_t: f64,
    /// Of rapids, which obey their own override, s, ≥ 0.
    pub rapid_t: f64,
    /// Of dwells, which obey no override, s, ≥ 0.
    pub dwell_t: f64,
}

impl Ahead {
    /// How long it takes with the overrides of a status, s. What an input lets through slows all of it. `None` where
    /// the motion goes back, and where it stands at an override of 0 before it is over.
    pub(super) fn lasting_t(&self, status: &Status) -> Option<f64> {
        let (feed_r, input_r) = (status.feed_override, status.adaptive_feed);
        if feed_r * input_r < 0.0 {
            return None;
        }
        // At a feed override of 0 a dwell does not begin, either.
        let is_barred = feed_r == 0.0 && self.dwell_t > 0.0;
        let part = |time_t: f64, ratio: f64| match time_t {
            0.0 => Some(0.0),
            _ => (ratio > 0.0).then(|| time_t / ratio),
        };
        let feed_t = part(self.feed_t, feed_r.abs() * input_r.abs())?;
        let rapid_t = part(self.rapid_t, status.rapid_override * input_r.abs())?;
        let dwell_t = part(self.dwell_t, input_r.abs())?;
        (!is_barred).then_some(feed_t + rapid_t + dwell_t)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "values are exact")]

    use super::*;
    use bytemuck::Zeroable as _;

    fn lasting(ahead: [f64; 3], [feed_r, rapid_r, input_r]: [f64; 3]) -> Option<f64> {
        let [feed_t, rapid_t, dwell_t] = ahead;
        let mut status = Status::zeroed();
        (status.feed_override, status.rapid_override) = (feed_r, rapid_r);
        status.adaptive_feed = input_r;
        let ahead = Ahead {
            feed_t,
            rapid_t,
            dwell_t,
        };
        ahead.lasting_t(&status)
    }

    #[test]
    fn each_part_obeys_its_own_override() {
        let all = [60.0, 20.0, 7.0];
        assert_eq!(lasting(all, [1.0, 1.0, 1.0]), Some(87.0));
        // 60 / 0.5 + 20 + 7, 60 + 20 / 0.25 + 7, 60 / 2 + 20 / 0.5 + 7.
        assert_eq!(lasting(all, [0.5, 1.0, 1.0]), Some(147.0));
        assert_eq!(lasting(all, [1.0, 0.25, 1.0]), Some(147.0));
        assert_eq!(lasting(all, [2.0, 0.5, 1.0]), Some(77.0));
        // An input lets through a half of everything: (60 / 0.5 + 20 / 0.25 + 7) / 0.5.
        assert_eq!(lasting(all, [0.5, 0.25, 0.5]), Some(414.0));
    }

    #[test]
    fn what_stands_or_goes_back_has_no_time() {
        for (ahead, ratios) in [
            ([60.0, 0.0, 0.0], [0.0, 1.0, 1.0]),
            ([60.0, 20.0, 0.0], [1.0, 0.0, 1.0]),
            ([0.0, 0.0, 7.0], [0.0, 1.0, 1.0]),
            ([0.0, 0.0, 7.0], [1.0, 1.0, 0.0]),
            ([60.0, 20.0, 7.0], [-1.0, 1.0, 1.0]),
            ([0.0, 20.0, 0.0], [0.5, 1.0, -0.5]),
        ] {
            assert_eq!(lasting(ahead, ratios), None, "{ahead:?} {ratios:?}");
        }
        // What is not to come is not waited for; reversed twice it goes onward.
        assert_eq!(lasting([60.0, 0.0, 0.0], [0.5, 0.0, 1.0]), Some(120.0));
        assert_eq!(lasting([0.0, 20.0, 0.0], [0.0, 0.5, 1.0]), Some(40.0));
        assert_eq!(lasting([60.0, 20.0, 0.0], [-1.0, 1.0, -0.5]), Some(160.0));
        assert_eq!(lasting([0.0; 3], [0.0, 0.0, 0.0]), Some(0.0));
    }
}
