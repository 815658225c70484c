//! Limit boosting: faster S-curves over the same path, checked.
//!
//! The limits that speeds are planned with ([`crate::on_path::pieces::SpeedLimit`]) hold for any
//! motion below the top speed of a piece: acceleration, jerk and speed may all be used at once,
//! anywhere on it. A given S-curve never does that: it is slow where its jerk is large at the start
//! of a ramp, and has no acceleration where it is fast. So when the speeds at both ends of some
//! path are settled, stronger limits are tried for the S-curves between them, and what they demand
//! of every axis is computed piece by piece. The strongest that keeps all limits is taken:
//!
//! * for each S-curve by itself ([`boost_limits`]);
//! * for neighbouring runs together ([`drive_together`]), so that the junction between them need
//!   not be passed without acceleration.

use super::piece_sequence::{Leg, PieceSequence};
use super::valley_first::{Limiting, Section, ValleyFirst};
use crate::on_path::pieces::{Piece, Shape};
use crate::scurve::{PathLimits, Profile};
use glidepath_program::Limits;

/// Shares of the way from what the pieces allow without a check to what they allow at most,
/// strongest first. Found by bisection among these, so ten cost four trials; each trial goes through all
/// pieces of a leg. Without a check at all there is the last one.
const SHARES: [f64; 10] = [1.0, 0.8, 0.65, 0.5, 0.4, 0.3, 0.2, 0.12, 0.06, 0.0];
/// Where both cannot be had: equal shares, more acceleration, more jerk.
const WAYS: [BoostedLimits; 3] = [
    BoostedLimits::Both,
    BoostedLimits::Acceleration,
    BoostedLimits::Jerk,
];

#[derive(Debug, Clone, Copy)]
enum BoostedLimits {
    Both,
    Acceleration,
    Jerk,
}

/// What comes out of a trial.
enum TrialOutcome<T> {
    /// The motion breaks a limit: weaker ones may not.
    Breaks,
    /// It is not faster: stronger limits may be.
    IsSlow,
    Good(T),
}

/// Limits to try.
#[derive(Debug, Clone, Copy)]
struct Trial {
    share_r: f64,
    way: BoostedLimits,
}

impl Trial {
    /// The strongest trial of one way that is good, by bisection.
    fn strongest<T>(
        way: BoostedLimits,
        mut judge: impl FnMut(Self) -> TrialOutcome<T>,
    ) -> Option<T> {
        let mut found = None;
        let mut left = 0..SHARES.len();
        while !left.is_empty() {
            let middle = left.start.midpoint(left.end);
            let share_r = SHARES[middle];
            match judge(Self { share_r, way }) {
                TrialOutcome::Breaks => left.start = middle + 1,
                TrialOutcome::IsSlow => left.end = middle,
                TrialOutcome::Good(motion) => {
                    left.end = middle;
                    found = Some(motion);
                }
            }
        }
        found
    }

    fn limits(self, safe: PathLimits, alone: PathLimits) -> PathLimits {
        let share_r = self.share_r;
        // With a share below one its root is more and its square less.
        let (more_r, less_r) = (share_r.sqrt(), share_r * share_r);
        let (accel_r, jerk_r) = match self.way {
            BoostedLimits::Both => (share_r, share_r),
            BoostedLimits::Acceleration => (more_r, less_r),
            BoostedLimits::Jerk => (less_r, more_r),
        };
        let between = |a: f64, b: f64, share_r: f64| a + share_r * (b - a).max(0.0);
        PathLimits {
            accel_a: between(safe.accel_a, alone.accel_a, accel_r),
            jerk_j: between(safe.jerk_j, alone.jerk_j, jerk_r),
        }
    }

    fn cap_v(self, piece: &Piece) -> f64 {
        let limit = &piece.limit;
        limit.top_v + (SPEED_R * self.share_r).min(1.0) * (limit.peak_v - limit.top_v).max(0.0)
    }
}

/// How much more a share of speed counts than one of acceleration and jerk, up to all of it: half of the
/// way for those already allows the peak speed of a piece.
const SPEED_R: f64 = 2.0;

/// A time counts as less if it is by this factor.
const LESS_R: f64 = 1.0 - 1e-4;

/// The weakest limits of some pieces, safe and alone.
fn weakest(pieces: &[Piece]) -> Option<(PathLimits, PathLimits)> {
    let both = pieces.iter().map(|p| (p.limit.change, p.limit.alone));
    both.reduce(|a, b| (a.0.weaker(b.0), a.1.weaker(b.1)))
}

/// How long a motion takes, s.
fn duration_t(legs: &[Leg]) -> f64 {
    legs.iter().map(|leg| leg.profile.duration_t()).sum()
}

/// Replaces S-curves by faster ones over the same path between the same speeds.
pub(crate) fn boost_limits(legs: &mut [Leg], sequence: &PieceSequence<'_>, limits: &Limits) {
    let pieces = sequence.pieces;
    for leg in legs {
        let to_s = leg.from_s + leg.profile.length_s();
        let touched = sequence.touched(leg.from_s, to_s);
        let is_bent = |piece: &Piece| matches!(piece.shape, Shape::Spline(_));
        if pieces[touched].iter().any(is_bent) {
            boost_leg(leg, sequence, |faster| holds(faster, sequence, limits));
        }
    }
}

/// Replaces an S-curve by a faster one over the same path between the same speeds that a judge lets pass.
pub(crate) fn boost_leg(leg: &mut Leg, sequence: &PieceSequence<'_>, holds: impl Fn(&Leg) -> bool) {
    let pieces = sequence.pieces;
    let to_s = leg.from_s + leg.profile.length_s();
    let touched = sequence.touched(leg.from_s, to_s);
    if let Some((safe, alone)) = weakest(&pieces[touched.clone()]) {
        let (from_s, length_s) = (leg.from_s, leg.profile.length_s());
        let (entry_v, exit_v) = (leg.profile.entry_v(), leg.profile.exit_v());
        // One after the other from the best so far: whatever is not faster than that is not looked at.
        for way in WAYS {
            let below_t = leg.profile.duration_t() * LESS_R;
            let faster = Trial::strongest(way, |trial| {
                let caps_v = pieces[touched.clone()].iter().map(|p| trial.cap_v(p));
                let top_v = caps_v.fold(entry_v.max(exit_v), f64::max);
                let tried = trial.limits(safe, alone);
                let Some(profile) = Profile::new(entry_v, exit_v, length_s, top_v, tried) else {
                    return TrialOutcome::Breaks;
                };
                let faster = Leg { from_s, profile };
                if profile.duration_t() >= below_t {
                    TrialOutcome::IsSlow
                } else if holds(&faster) {
                    TrialOutcome::Good(faster)
                } else {
                    TrialOutcome::Breaks
                }
            });
            *leg = faster.unwrap_or(*leg);
        }
    }
}

/// S-curves over two that follow each other as one; `None` if that is not faster.
pub(crate) fn drive_together(
    (before, after): (&Leg, &Leg),
    sequence: &PieceSequence<'_>,
    limits: &Limits,
) -> Option<Vec<Leg>> {
    let section = Section {
        from_s: before.from_s,
        to_s: after.from_s + after.profile.length_s(),
        entry_v: before.profile.entry_v(),
        exit_v: after.profile.exit_v(),
    };
    let touched = sequence.touched(section.from_s, section.to_s);
    let pieces = &sequence.pieces[touched.clone()];
    let (safe, alone) = weakest(pieces)?;
    let apart_t = before.profile.duration_t() + after.profile.duration_t();
    let mut best: Option<Vec<Leg>> = None;
    let mut caps_v = vec![0.0; sequence.pieces.len()];
    for way in WAYS {
        let below_t = best.as_deref().map_or(apart_t, duration_t);
        let faster = Trial::strongest(way, |trial| {
            for (cap_v, piece) in caps_v[touched.clone()].iter_mut().zip(pieces) {
                *cap_v = trial.cap_v(piece);
            }
            let valley = ValleyFirst {
                sequence,
                caps_v: &caps_v,
                limiting: Limiting::Fixed(trial.limits(safe, alone)),
            };
            let Some(legs) = valley.drive(section) else {
                return TrialOutcome::Breaks;
            };
            if duration_t(&legs) >= below_t * LESS_R {
                TrialOutcome::IsSlow
            } else if legs.iter().all(|leg| holds(leg, sequence, limits)) {
                TrialOutcome::Good(legs)
            } else {
                TrialOutcome::Breaks
            }
        });
        best = faster.or(best);
    }
    best
}

/// True if an S-curve keeps every limit on every piece.
fn holds(leg: &Leg, sequence: &PieceSequence<'_>, limits: &Limits) -> bool {
    let to_s = leg.from_s + leg.profile.length_s();
    let mut place = leg.profile.start();
    sequence.touched(leg.from_s, to_s).all(|m| {
        let piece = &sequence.pieces[m];
        let piece_to_s = sequence.starts_s[m + 1].min(to_s) - leg.from_s;
        let (most, next) = leg.profile.extremes(&place, piece_to_s);
        place = next;
        piece.permits(&most, limits)
    })
}
