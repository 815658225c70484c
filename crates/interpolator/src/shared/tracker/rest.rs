//! The quickest way to rest at a place.
//!
//! Of all motions inside the limits, the one that drives towards the place at the highest speed for
//! as long as it can still stop there is the quickest: to drive is the quickest change to that
//! velocity, and to stop is the quickest change to none. Where it would come to rest if it stopped
//! after a time τ grows with τ, because the jerk of a drive is nowhere below that of a stop. So
//! there is one τ for each place, and it is found in three steps:
//!
//! 1. Where would it stop at once? The side of the place seen from there is the side to drive to.
//! 2. Where would it stop from the end of each phase of the drive? If all are before the place, it
//!    goes on at that velocity, and for how long is a division.
//! 3. Else τ is in the first phase whose end is too late, and is found between its ends, by Ridders'
//!    method: every round halves what it is known to be in, at least.
//!
//! The velocity may be above its limit at the beginning and the acceleration, too: both come back
//! without delay, as in any change of velocity.

use super::motion::{Bounds, Motion};
use super::profile::Profile;
use super::speed::{Phase, change};

/// Most rounds of the search: each halves the interval, and a phase is less than 2⁶⁰ times as long
/// as what rounding leaves of it.
const ROUNDS: usize = 60;
/// A place this much nearer than what numbers of its size can tell apart is the same.
const SAME: f64 = 4.0 * f64::EPSILON;

/// The quickest way to rest at `place`, at most at the velocity of `bounds` on the way, which is
/// above 0.
pub(super) fn profile(start: Motion, place: f64, bounds: &Bounds) -> Profile {
    let stop = Profile::to_stop(start, bounds);
    let gap = place - stop.end().x;
    if gap.abs() <= SAME * (place.abs() + start.x.abs()) {
        return arriving(stop, place);
    }
    let side = if gap > 0.0 { 1.0 } else { -1.0 };
    // From where it starts, so that the numbers are as small as the way is.
    let from = Motion { x: 0.0, ..start }.mirrored(side);
    let way = side * (place - start.x);
    let mut now = from;
    let mut profile = Profile::steady(start);
    for phase in change(from.v, from.a, bounds.v, bounds) {
        let end = now.after(phase.t, phase.jerk);
        let beyond = stops_at(end, bounds) - way;
        if phase.t > 0.0 && beyond >= 0.0 {
            let t = switch(now, phase, beyond, way, bounds);
            profile.push(mirrored(Phase { t, ..phase }, side));
            profile.change_speed(0.0, bounds);
            return arriving(profile, place);
        }
        profile.push(mirrored(phase, side));
        now = end;
    }
    let t = (way - stops_at(now, bounds)) / bounds.v;
    profile.push(Phase { t, jerk: 0.0 });
    profile.change_speed(0.0, bounds);
    arriving(profile, place)
}

/// Where it comes to rest if it stops at once.
fn stops_at(from: Motion, bounds: &Bounds) -> f64 {
    let mut now = from;
    for phase in change(from.v, from.a, 0.0, bounds) {
        now = now.after(phase.t, phase.jerk);
    }
    now.x
}

/// The time in a phase of driving after which a stop comes to rest at `way`. At its end, that is
/// `beyond` too far; at its beginning it is not far enough.
fn switch(from: Motion, phase: Phase, beyond: f64, way: f64, bounds: &Bounds) -> f64 {
    let miss = |t: f64| stops_at(from.after(t, phase.jerk), bounds) - way;
    let (mut low, mut high) = ((0.0, miss(0.0)), (phase.t, beyond));
    for _ in 0..ROUNDS {
        let middle = 0.5 * (low.0 + high.0);
        if middle <= low.0 || middle >= high.0 || low.1 >= 0.0 {
            break;
        }
        let at_middle = miss(middle);
        // The straight line through three points of the function times an exponential.
        let root = (at_middle * at_middle - low.1 * high.1).max(0.0).sqrt();
        let guess = if root > 0.0 {
            (middle - (middle - low.0) * at_middle / root).clamp(low.0, high.0)
        } else {
            middle
        };
        let at_guess = miss(guess);
        for (t, at) in [(middle, at_middle), (guess, at_guess)] {
            if at < 0.0 && t > low.0 {
                low = (t, at);
            } else if at >= 0.0 && t < high.0 {
                high = (t, at);
            }
        }
    }
    if -low.1 < high.1 { low.0 } else { high.0 }
}

const fn mirrored(phase: Phase, side: f64) -> Phase {
    Phase {
        jerk: phase.jerk * side,
        ..phase
    }
}

const fn arriving(mut profile: Profile, place: f64) -> Profile {
    profile.ends_at(place);
    profile
}
