//! Runs: stretches of path that one S-curve, or a few, drive through.
//!
//! Junctions between runs are passed with zero acceleration along the path. Where the path allows a
//! useful change of speed within one piece, the piece is a run by itself and nothing is lost. Where
//! pieces are so short that it does not, many form one run, and the speed inside is found valley
//! first:
//!
//! 1. Drive the whole run with one S-curve as if nothing but the ends bounded it.
//! 2. Of the pieces on which it is too fast, take the slowest one, with top speed V.
//! 3. Drive the run again, nowhere faster than V. It then cruises at V around that piece, or near it.
//!    What lies before the piece, as far as the cruise, is a run of its own from the old start to V;
//!    what lies after it likewise from V to the old end. Go on with each from step 1.
//!
//! ```text
//!   cap  ‾‾‾‾‾‾|__        ____|‾‾‾‾‾‾‾
//!                 |__    |
//!                    |___|  ← slowest violated piece: junctions at its two ends, speed V
//! ```
//!
//! The end speeds never exceed a cap inside that is still to be violated: caps are taken in rising
//! order, and lowering the peak of an S-curve lowers it everywhere. So every step is feasible, and
//! there is nothing to go back on.

use crate::piece::Piece;
use crate::scurve::{PathLimits, Profile, ramp_fits, reachable_speed, slowing_horizon};
use crate::speed_limit::SpeedLimit;

/// A stretch of path with zero acceleration along it at both ends.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub pieces: Vec<Piece>,
    pub length_s: f64,
    /// Lowest and highest top speed of its pieces.
    pub low_v: f64,
    pub high_v: f64,
    /// The weakest limits of its pieces.
    pub change: PathLimits,
    /// Above this speed the speed has to be constant.
    pub constant_above_v: f64,
    /// Lowest top speed of its curved pieces.
    curved_v: f64,
}

/// One S-curve of a run, and where in the run it starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Leg {
    pub from_s: f64,
    pub profile: Profile,
}

/// Most pieces of one run.
const MOST_PIECES: usize = 512;
/// A run is short if it does not allow this share of the speed around it to be gained.
const USEFUL_CHANGE_R: f64 = 0.1;
/// Curved pieces belong to one run while their top speeds differ by at most this factor.
const SIMILAR_SPEED_R: f64 = 2.5;
/// A speed above a cap by less than this is rounding.
const SPEED_ROUNDING_R: f64 = 1e-9;

impl Run {
    pub(crate) fn new(piece: Piece) -> Self {
        let SpeedLimit {
            top_v,
            change,
            constant_above_v,
        } = piece.limit;
        Self {
            length_s: piece.length_s,
            low_v: top_v,
            high_v: top_v,
            change,
            constant_above_v,
            curved_v: if piece.is_straight() {
                f64::INFINITY
            } else {
                top_v
            },
            pieces: vec![piece],
        }
    }

    /// The length on which the speed may change.
    pub(crate) const fn slowing_room_s(&self) -> f64 {
        if self.constant_above_v < self.low_v {
            0.0
        } else {
            self.length_s
        }
    }

    /// Adds the pieces of the next run if both are driven better as one; gives it back if not.
    pub(crate) fn absorb(&mut self, next: Self) -> Option<Self> {
        let full = self.pieces.len() >= MOST_PIECES
            || self.length_s > 4.0 * slowing_horizon(self.high_v, self.change);
        if full || !(self.continues_straight(&next) || self.is_short_beside(&next)) {
            return Some(next);
        }
        self.length_s += next.length_s;
        self.low_v = self.low_v.min(next.low_v);
        self.high_v = self.high_v.max(next.high_v);
        self.curved_v = self.curved_v.min(next.curved_v);
        self.change = weaker(self.change, next.change);
        self.pieces.extend(next.pieces);
        None
    }

    /// Two straight runs of one direction: nothing is lost by driving them as one.
    fn continues_straight(&self, next: &Self) -> bool {
        self.curved_v.is_infinite() && next.curved_v.is_infinite() && self.change == next.change
    }

    /// True if both runs are about as fast, and neither is long enough for a useful change of that
    /// speed.
    fn is_short_beside(&self, next: &Self) -> bool {
        let (mine_v, its_v) = (self.curved_v, next.curved_v);
        let slower_v = mine_v.min(its_v);
        let similar = mine_v.is_infinite()
            || its_v.is_infinite()
            || mine_v.max(its_v) <= SIMILAR_SPEED_R * slower_v;
        let may_change = |run: &Self| run.constant_above_v.is_infinite();
        // What has been put together before was short.
        let short = |run: &Self| {
            let is_made_up = run.pieces.len() > 1 && run.curved_v.is_finite();
            is_made_up
                || reachable_speed(slower_v, run.length_s, run.change)
                    < (1.0 + USEFUL_CHANGE_R) * slower_v
        };
        slower_v.is_finite()
            && similar
            && may_change(self)
            && may_change(next)
            && short(self)
            && short(next)
    }

    /// The highest speed at which the run can be entered if it is left at `exit_v`.
    pub(crate) fn highest_entry(&self, exit_v: f64) -> f64 {
        if exit_v >= self.constant_above_v {
            return exit_v;
        }
        reachable_speed(exit_v, self.length_s, self.change)
            .min(self.low_v)
            .min(self.constant_above_v)
    }

    /// The speed at which to leave the run if it is entered at `entry_v` and may be left at up to
    /// `highest_v`; `None` if it is too short to slow down to that.
    pub(crate) fn exit_speed(&self, entry_v: f64, highest_v: f64) -> Option<f64> {
        if entry_v >= self.constant_above_v {
            return (entry_v <= highest_v * (1.0 + SPEED_ROUNDING_R)).then_some(entry_v);
        }
        let highest_v = highest_v.min(self.constant_above_v);
        if entry_v <= highest_v {
            return Some(highest_v.min(reachable_speed(entry_v, self.length_s, self.change)));
        }
        ramp_fits(entry_v, highest_v, self.length_s, self.change).then_some(highest_v)
    }

    /// The S-curves through the run, from `entry_v` to `exit_v`, both at most [`Run::low_v`] and
    /// feasible over its length.
    pub(crate) fn drive(&self, entry_v: f64, exit_v: f64) -> Vec<Leg> {
        let mut legs = Vec::new();
        if self.constant_above_v < self.low_v {
            let top_v = self.constant_above_v.max(entry_v);
            let profile = Profile::new(entry_v, exit_v, self.length_s, top_v, self.change);
            legs.extend(profile.map(|profile| Leg {
                from_s: 0.0,
                profile,
            }));
            return legs;
        }
        let mut starts_s = Vec::with_capacity(self.pieces.len() + 1);
        let mut s = 0.0;
        for piece in &self.pieces {
            starts_s.push(s);
            s += piece.length_s;
        }
        starts_s.push(s);
        let valley = ValleyFirst {
            pieces: &self.pieces,
            starts_s: &starts_s,
        };
        let span = Span {
            from_s: 0.0,
            to_s: s,
            entry_v,
            exit_v,
        };
        valley.drive(span, self.change, &mut legs);
        legs
    }
}

fn weaker(a: PathLimits, b: PathLimits) -> PathLimits {
    PathLimits {
        accel_a: a.accel_a.min(b.accel_a),
        jerk_j: a.jerk_j.min(b.jerk_j),
    }
}

struct ValleyFirst<'a> {
    pieces: &'a [Piece],
    /// Where each piece starts, and where the last one ends.
    starts_s: &'a [f64],
}

/// A part of the run, to be driven from one speed to another.
#[derive(Clone, Copy)]
struct Span {
    from_s: f64,
    to_s: f64,
    entry_v: f64,
    exit_v: f64,
}

impl ValleyFirst<'_> {
    /// The pieces a span touches.
    fn touched(&self, span: Span) -> core::ops::Range<usize> {
        let starts_s = &self.starts_s[..self.pieces.len()];
        let first = starts_s
            .partition_point(|&s| s <= span.from_s)
            .saturating_sub(1);
        let last = starts_s.partition_point(|&s| s < span.to_s).max(first + 1);
        first..last
    }

    fn drive(&self, span: Span, outer: PathLimits, legs: &mut Vec<Leg>) {
        let touched = self.touched(span);
        let own = self.pieces[touched]
            .iter()
            .map(|piece| piece.limit.change)
            .reduce(weaker)
            .unwrap_or(outer);
        let Some((used, profile, violated)) = self.unbounded(span, own, outer) else {
            return;
        };
        let Some(slowest) = violated else {
            legs.push(Leg {
                from_s: span.from_s,
                profile,
            });
            return;
        };
        let cap_v = self.pieces[slowest]
            .limit
            .top_v
            .max(span.entry_v)
            .max(span.exit_v);
        let Some(capped) = Self::profile(span, cap_v, used) else {
            return;
        };
        let (cruise_from_s, cruise_to_s) = capped.cruise_s();
        let (cruise_from_s, cruise_to_s) = (span.from_s + cruise_from_s, span.from_s + cruise_to_s);
        let before_s = self.starts_s[slowest].min(cruise_to_s);
        let after_s = self.starts_s[slowest + 1].max(cruise_from_s);

        let mut middle = span;
        if before_s >= cruise_from_s && before_s > span.from_s {
            self.drive(
                Span {
                    to_s: before_s,
                    exit_v: cap_v,
                    ..span
                },
                used,
                legs,
            );
            middle = Span {
                from_s: before_s,
                entry_v: cap_v,
                ..middle
            };
        }
        let goes_on = after_s <= cruise_to_s && after_s < span.to_s;
        if goes_on {
            middle = Span {
                to_s: after_s,
                exit_v: cap_v,
                ..middle
            };
        }
        if let Some(profile) = Self::profile(middle, cap_v, used) {
            legs.push(Leg {
                from_s: middle.from_s,
                profile,
            });
        }
        if goes_on {
            self.drive(
                Span {
                    from_s: after_s,
                    entry_v: cap_v,
                    ..span
                },
                used,
                legs,
            );
        }
    }

    /// The S-curve with only the ends given, by the span's own limits, or by those of the span it
    /// was cut from where its own make it too fast on a piece slower than its ends.
    fn unbounded(
        &self,
        span: Span,
        own: PathLimits,
        outer: PathLimits,
    ) -> Option<(PathLimits, Profile, Option<usize>)> {
        let ends_v = span.entry_v.max(span.exit_v);
        let highest_v = self.pieces[self.touched(span)]
            .iter()
            .map(|piece| piece.limit.top_v)
            .fold(ends_v, f64::max);
        let mut found = None;
        for limits in [own, outer] {
            let profile = Self::profile(span, highest_v, limits)?;
            let violated = self.slowest_violated(span, &profile);
            found = Some((limits, profile, violated));
            let sound = violated
                .is_none_or(|m| self.pieces[m].limit.top_v >= ends_v * (1.0 - SPEED_ROUNDING_R));
            if sound {
                break;
            }
        }
        found
    }

    fn profile(span: Span, top_v: f64, limits: PathLimits) -> Option<Profile> {
        Profile::new(
            span.entry_v,
            span.exit_v,
            span.to_s - span.from_s,
            top_v,
            limits,
        )
    }

    fn slowest_violated(&self, span: Span, profile: &Profile) -> Option<usize> {
        let mut slowest: Option<usize> = None;
        for m in self.touched(span) {
            let top_v = self.pieces[m].limit.top_v;
            if profile.peak_v() <= top_v * (1.0 + SPEED_ROUNDING_R)
                || slowest.is_some_and(|s| self.pieces[s].limit.top_v <= top_v)
            {
                continue;
            }
            let from_s = self.starts_s[m].max(span.from_s) - span.from_s;
            let to_s = self.starts_s[m + 1].min(span.to_s) - span.from_s;
            let greatest_v = profile.greatest_speed_between(from_s, to_s);
            if greatest_v > top_v * (1.0 + SPEED_ROUNDING_R) {
                slowest = Some(m);
            }
        }
        slowest
    }
}
