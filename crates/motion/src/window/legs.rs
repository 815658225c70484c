//! Legs from vertex to vertex: what runs where no window is found.
//!
//! Legs follow each other without waiting for the next period, so that a chain of them takes no longer
//! than the sum of their times; only where the chord between two periods would cut off too much of a
//! vertex does the motion rest at it until the next one.

use super::attempt::View;
use super::stop_leg::StopLeg;
use super::{Force, Period, WindowPlanner};
use glidepath_geometry::AxisVector;

impl WindowPlanner {
    /// The time from rest to the end of the path, stopping at every vertex, if the end is in view.
    pub(super) fn legs_t(&self, view: &View) -> Option<f64> {
        let mut from = self.history.last();
        let mut sum_t = 0.0;
        for index in self.progress.0..view.pieces.end {
            let piece = self.track.get(index)?;
            if let Some(leg) = StopLeg::new(&self.limits, from, index, piece) {
                sum_t += leg.duration_t();
            }
            from = piece.end;
        }
        Some(sum_t).filter(|_| self.track.is_last(view.pieces.end - 1))
    }

    /// One period of straight legs from vertex to vertex; `Some(None)` if they are over.
    #[expect(clippy::option_option, reason = "not known yet, and over")]
    pub(super) fn next_of_legs(&mut self) -> Option<Option<Period>> {
        let Force::Legs { leg, leg_t, left } = &self.force else {
            return Some(None);
        };
        if *left == 0 {
            return Some(None);
        }
        let position = self.history.last();
        let mut left = *left;
        let mut leg = match leg {
            Some(leg) => StopLeg::clone(leg),
            None => self.leg_from(position, self.follower.place.last())?,
        };
        let first = leg.clone();
        let mut t = leg_t + self.period_t;
        let mut is_resting = false;
        while t >= leg.duration_t() {
            t -= leg.duration_t();
            left -= 1;
            if left == 0 || self.track.is_last(leg.piece) {
                is_resting = true;
                break;
            }
            leg = self.leg_from(leg.to, leg.piece + 1)?;
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
            .follow(&self.limits, self.period_t, way, &period.position);
        // A leg begun before the rates were lowered is driven to its end as it was planned: what is
        // only too fast has been followed all the same.
        if !is_kept && self.history.last() != period.position {
            if leg.piece == first.piece && !is_resting {
                return None;
            }
            // The chord between two periods cuts off a vertex: rest there until the next period.
            period = Period::rest(first.to);
            is_resting = true;
            let way = (&self.track, &mut self.follower);
            self.history
                .follow(&self.limits, self.period_t, way, &period.position);
        }
        self.is_over = is_resting && self.follower.place.is_at_end(&self.track);
        self.force = Force::Legs {
            leg: Some(Box::new(leg)).filter(|_| !is_resting),
            leg_t: if is_resting { 0.0 } else { t },
            left,
        };
        Some(Some(period))
    }

    /// The leg to the end of the first piece from `index` on that does not end here.
    fn leg_from(&self, from: AxisVector, index: usize) -> Option<StopLeg> {
        (index..self.track.end())
            .take_while(|&index| self.track.is_settled(index))
            .find_map(|index| StopLeg::new(&self.limits, from, index, self.track.get(index)?))
    }
}
