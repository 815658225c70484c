//! Faster S-curves over the same path, checked.
//!
//! The limits that speeds are planned with ([`crate::speed_limit`]) hold for any motion below the top
//! speed of a piece: acceleration, jerk and speed may all be used at once, anywhere on it. A given
//! S-curve never does that: it is slow where its jerk is large at the start of a ramp, and has no
//! acceleration where it is fast. So when the speeds at both ends of some path are settled, stronger
//! limits are tried for the S-curves between them, and what they demand of every axis is computed
//! piece by piece. The strongest that keeps all limits is taken:
//!
//! * for each S-curve by itself ([`hasten`]);
//! * for neighbouring runs together ([`drive_together`]), so that the junction between them need not
//!   be passed without acceleration.

use crate::piece::Piece;
use crate::scurve::{PathLimits, Profile};
use crate::valley::{Course, Leg, Limiting, ValleyFirst};
use crate::{Limits, run::weaker};

/// Shares of the way from what the pieces allow without a check to what they allow at most,
/// strongest first.
const SHARES: [f64; 12] = [
    1.0, 0.85, 0.7, 0.6, 0.5, 0.42, 0.34, 0.26, 0.19, 0.12, 0.06, 0.0,
];
/// Where both cannot be had, acceleration or jerk: powers of the share that acceleration and jerk
/// get.
const WAYS: [(f64, f64); 3] = [(1.0, 1.0), (0.6, 2.0), (2.0, 0.6)];

/// Limits to try.
#[derive(Debug, Clone, Copy)]
struct Trial {
    share_r: f64,
    way: (f64, f64),
}

impl Trial {
    /// The trials of one way, strongest first.
    fn along(way: (f64, f64)) -> impl Iterator<Item = Self> {
        SHARES.into_iter().map(move |share_r| Self { share_r, way })
    }

    fn limits(self, safe: PathLimits, alone: PathLimits) -> PathLimits {
        let between = |a: f64, b: f64, power: f64| a + self.share_r.powf(power) * (b - a).max(0.0);
        PathLimits {
            accel_a: between(safe.accel_a, alone.accel_a, self.way.0),
            jerk_j: between(safe.jerk_j, alone.jerk_j, self.way.1),
        }
    }

    fn cap_v(self, piece: &Piece) -> f64 {
        let limit = &piece.limit;
        limit.top_v + (2.0 * self.share_r).min(1.0) * (limit.peak_v - limit.top_v).max(0.0)
    }
}

/// The weakest limits of some pieces, safe and alone.
fn weakest(pieces: &[Piece]) -> Option<(PathLimits, PathLimits)> {
    let both = pieces.iter().map(|p| (p.limit.change, p.limit.alone));
    both.reduce(|a, b| (weaker(a.0, b.0), weaker(a.1, b.1)))
}

/// How long a motion takes, s.
pub(crate) fn duration_t(legs: &[Leg]) -> f64 {
    legs.iter().map(|leg| leg.profile.duration_t()).sum()
}

/// Replaces S-curves by faster ones over the same path between the same speeds.
pub(crate) fn hasten(legs: &mut [Leg], pieces: &[Piece], limits: &Limits) {
    let course = Course::new(pieces);
    for leg in legs {
        let to_s = leg.from_s + leg.profile.length_s();
        let touched = course.touched(leg.from_s, to_s);
        let Some((safe, alone)) = weakest(&pieces[touched.clone()]) else {
            continue;
        };
        for way in WAYS {
            let found = Trial::along(way).find_map(|trial| {
                let (entry_v, exit_v) = (leg.profile.entry_v(), leg.profile.exit_v());
                let top_v = pieces[touched.clone()]
                    .iter()
                    .map(|piece| trial.cap_v(piece))
                    .fold(entry_v.max(exit_v), f64::max);
                let tried = trial.limits(safe, alone);
                let profile = Profile::new(entry_v, exit_v, to_s - leg.from_s, top_v, tried)?;
                let faster = Leg {
                    from_s: leg.from_s,
                    profile,
                };
                let is_faster = profile.duration_t() < leg.profile.duration_t();
                (is_faster && holds(&faster, &course, limits)).then_some(faster)
            });
            if let Some(faster) = found {
                *leg = faster;
            }
        }
    }
}

/// S-curves over pieces of several runs as one, from one speed to another, in less than a given
/// time; `None` if no trial gives any.
pub(crate) fn drive_together(
    pieces: &[Piece],
    (entry_v, exit_v): (f64, f64),
    below_t: f64,
    limits: &Limits,
) -> Option<Vec<Leg>> {
    let course = Course::new(pieces);
    let (safe, alone) = weakest(pieces)?;
    let mut best: Option<Vec<Leg>> = None;
    for way in WAYS {
        let below_t = best.as_deref().map_or(below_t, duration_t);
        let found = Trial::along(way).find_map(|trial| {
            let caps_v: Vec<f64> = pieces.iter().map(|piece| trial.cap_v(piece)).collect();
            let valley = ValleyFirst {
                course: &course,
                caps_v: &caps_v,
                limiting: Limiting::Fixed(trial.limits(safe, alone)),
            };
            let legs = valley.drive(entry_v, exit_v)?;
            let is_good =
                duration_t(&legs) < below_t && legs.iter().all(|leg| holds(leg, &course, limits));
            is_good.then_some(legs)
        });
        best = found.or(best);
    }
    best
}

/// True if an S-curve keeps every limit on every piece.
fn holds(leg: &Leg, course: &Course<'_>, limits: &Limits) -> bool {
    let to_s = leg.from_s + leg.profile.length_s();
    let mut place = leg.profile.start();
    course.touched(leg.from_s, to_s).all(|m| {
        let piece = &course.pieces[m];
        let piece_to_s = course.starts_s[m + 1].min(to_s) - leg.from_s;
        let (most, next) = leg.profile.extremes(&place, piece_to_s);
        place = next;
        piece.rule.permits(&piece.limit, &most, limits)
    })
}
