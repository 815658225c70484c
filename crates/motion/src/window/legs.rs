//! Legs from vertex to vertex: what runs where no window is found.
//!
//! Legs follow each other without waiting for the next period, so that a chain of them takes no longer
//! than the sum of their times; only where the chord between two periods would cut off too much of a
//! vertex does the motion rest at it until the next one.

use super::bend::State;
use super::stop_leg::StopLeg;
use super::{Force, Period, WindowPlanner};
use glidepath_geometry::AxisVector;

impl WindowPlanner {
    /// One period of straight legs from vertex to vertex. `None` if more of the path is needed.
    pub(super) fn next_of_legs(&mut self) -> Option<Period> {
        let Force::Legs {
            leg: Some(leg),
            leg_t,
            wait,
            ..
        } = &self.force
        else {
            return None;
        };
        let (first, mut wait) = (StopLeg::clone(leg), *wait);
        let mut leg = first.clone();
        let mut t = leg_t + self.period_t;
        let mut is_resting = false;
        while t >= leg.duration_t() {
            if self.track.is_last(leg.piece) {
                is_resting = true;
                break;
            }
            t -= leg.duration_t();
            wait = wait.saturating_sub(1);
            leg = self.leg_from(leg.to, leg.piece + 1)?;
            if let Some(rival) = &mut self.rival {
                rival.end_t(&self.limits, &self.track, leg.piece);
            }
        }
        let mut period = if is_resting {
            Period::rest(leg.to)
        } else {
            leg.at(t)
        };
        self.follower.end = leg.piece + 1;
        let way = (&self.track, &mut self.follower);
        let is_kept = self
            .history
            .follow(&self.limits, self.period_t, way, &State::from(&period));
        // A leg begun before the rates were lowered is driven to its end as it was planned: what is
        // only too fast has been followed all the same.
        if !is_kept && self.history.last() != period.position {
            if leg.piece == first.piece && !is_resting {
                return None;
            }
            // The chord between two periods cuts off a vertex: rest there until the next period.
            period = Period::rest(first.to);
            leg = first;
            is_resting = true;
            let way = (&self.track, &mut self.follower);
            self.history
                .follow(&self.limits, self.period_t, way, &State::from(&period));
        }
        self.is_over = is_resting
            && self.track.is_last(leg.piece)
            && self.follower.place.is_at_end(&self.track);
        self.force = Force::Legs {
            leg: Some(Box::new(leg)).filter(|_| !is_resting),
            leg_t: if is_resting { 0.0 } else { t },
            wait,
            is_stale: false,
        };
        Some(period)
    }

    /// The leg to the end of the first piece from `index` on that does not end here.
    pub(super) fn leg_from(&self, from: AxisVector, index: usize) -> Option<StopLeg> {
        (index..self.track.end())
            .take_while(|&index| self.track.is_settled(index))
            .find_map(|index| StopLeg::new(&self.limits, from, index, self.track.get(index)?))
    }
}
