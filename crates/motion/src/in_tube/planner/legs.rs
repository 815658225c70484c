//! Legs from vertex to vertex: what runs where no window is found.
//!
//! Legs follow each other without waiting for the next period, so that a chain of them takes no
//! longer than the sum of their times; only where chords between two periods would cut off too much
//! of a vertex does the motion rest at it, until the next period or for one more.
//!
//! ```text
//!        vertex         A chord that begins before the vertex ends up to a period after it: where
//!   ──────┬●            periods may end elsewhere, because time runs slower, the vertex is cut off
//!          ╲│           by chords of this period and of the next one. So a leg is begun only if it
//!           │           can be followed for some more periods, or to its end and rest.
//! ```

use super::state::{ActiveMotion, PlannerState};
use crate::in_tube::fallback::StopLeg;
use crate::in_tube::period::{Period, State};

/// Periods that are followed of a leg before it is begun: chords that begin before it end by the
/// first, and what they may lose depends on the last two.
const AHEAD: usize = 2;

/// Where a chain of legs is.
#[derive(Debug, Clone)]
struct LegProgress {
    leg: StopLeg,
    leg_t: f64,
    /// At rest at the end of the leg until the next period.
    is_resting: bool,
    /// Legs that are to end before a window is tried.
    wait: usize,
}

impl LegProgress {
    fn period(&self) -> Period {
        if self.leg_t >= self.leg.duration_t() {
            Period::rest(self.leg.to)
        } else {
            self.leg.at(self.leg_t)
        }
    }

    /// So much later, at the end of the leg if it is over by then.
    fn later(&self, t: f64) -> Self {
        let leg_t = self.leg_t + t;
        Self {
            is_resting: leg_t >= self.leg.duration_t(),
            leg_t,
            ..self.clone()
        }
    }
}

impl PlannerState {
    /// One period of straight legs from vertex to vertex. `None` if more of the path is needed.
    pub(crate) fn next_of_legs(&mut self) -> Option<Period> {
        let ActiveMotion::Legs {
            leg: Some(leg),
            leg_t,
            wait,
            ..
        } = &self.active
        else {
            return None;
        };
        let now = LegProgress {
            leg: StopLeg::clone(leg),
            leg_t: *leg_t,
            is_resting: false,
            wait: *wait,
        };
        let passed = self.passed_on(&now)?;
        let next = self.checked(now, passed);
        let period = next.period();
        self.follower.end = next.leg.piece + 1;
        let way = (&self.reference_path, &mut self.follower);
        let followed = self
            .history
            .follow(&self.limits, self.period_t, way, &State::from(&period));
        // A leg begun before the rates were lowered is driven to its end as it was planned, though it is too
        // fast now. One that stands is where it was, whatever is said of that.
        if !followed.is_there() && self.history.last() != period.position {
            return None;
        }
        self.is_over = next.is_resting
            && self.ends_path(&next.leg)
            && self.follower.reachable.is_at_end(&self.reference_path);
        self.active = ActiveMotion::Legs {
            leg_t: if next.is_resting { 0.0 } else { next.leg_t },
            leg: Some(Box::new(next.leg)).filter(|_| !next.is_resting),
            wait: next.wait,
            is_stale: false,
        };
        Some(period)
    }

    /// Whether a leg ends where the path does.
    fn ends_path(&self, leg: &StopLeg) -> bool {
        leg.ends_piece() && self.reference_path.is_last(leg.piece)
    }

    /// A period later, past every vertex on the way. `None` if more of the path is needed.
    fn passed_on(&mut self, now: &LegProgress) -> Option<LegProgress> {
        let mut next = now.later(self.period_t);
        while next.is_resting && !self.ends_path(&next.leg) {
            let leg_t = next.leg_t - next.leg.duration_t();
            let leg = self.leg_from(next.leg.to, next.leg.next_piece())?;
            if let Some(baseline) = &mut self.baseline {
                let machine = (&self.limits, self.joint_rows.as_ref());
                baseline.end_t(machine, &self.reference_path, leg.piece);
            }
            next = LegProgress {
                is_resting: leg_t >= leg.duration_t(),
                leg,
                leg_t,
                wait: next.wait.saturating_sub(1),
            };
        }
        Some(next)
    }

    /// The furthest of what can be next: past the vertices, at rest at the first one, or still at
    /// rest.
    fn checked(&self, now: LegProgress, passed: LegProgress) -> LegProgress {
        let is_another =
            passed.leg.piece != now.leg.piece || passed.leg.ends_piece() != now.leg.ends_piece();
        let begins = now.leg_t <= 0.0 || is_another;
        if !begins || self.can_go_on(&passed) {
            return passed;
        }
        let later = now.later(self.period_t);
        // What has rested for long enough can begin any leg, and a leg once begun can be ended.
        if now.leg_t > 0.0 || self.history.has_rested() || self.can_go_on(&later) {
            later
        } else {
            now
        }
    }

    /// True if a leg can be followed that has been begun in the next period: every chord comes to
    /// its piece. One that has missed the vertex goes on beside the piece before, and where that
    /// leads back beside this one, leaves it much later.
    fn can_go_on(&self, next: &LegProgress) -> bool {
        let mut history = self.history.clone();
        let mut follower = self.follower.to(next.leg.piece + 1);
        let mut next = next.clone();
        let is_followed = (0..=AHEAD).all(|_| {
            let state = State::from(&next.period());
            let way = (&self.reference_path, &mut follower);
            let followed = history.follow(&self.limits, self.period_t, way, &state);
            next = next.later(self.period_t);
            followed.is_there() || history.last() == state.position
        });
        is_followed && follower.least_reach() >= next.leg.piece
    }
}
