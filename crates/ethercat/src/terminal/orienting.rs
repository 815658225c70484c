//! The way of a spindle to an angle, which its drive is led along in position (CiA 402, mode 8).
//!
//! ```text
//!  turning ──► stands ──► mode 8, where it stands ──► along the way ──► held
//!                                                        ▲ another angle │
//!                                                        └───────────────┘
//! ```
//!
//! Places are counts of the drive, which go round at 2³²: a turn is a power of two of them, so that an
//! angle is the same however often the counter went round.

use glidepath_program::OrientWay;

const TURN_DEG: f64 = 360.0;

/// The settings of a spindle that is turned to an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrientationSettings {
    /// Counts of a revolution of the spindle in 0x6064 and 0x607A, a power of two.
    pub counts_per_rev: u32,
    /// What the drive counts where the angle of the spindle is 0, degrees.
    pub zero_deg: f64,
    /// How fast it turns on the way at most, rev/min, > 0.
    pub max_rpm: f64,
    /// How near it has to be to its angle, degrees, > 0.
    pub window_deg: f64,
}

/// The angle that a spindle is to stand at, degrees from 0 to 360, and the way there.
pub(super) type Angle = (f64, OrientWay);

/// What the way is led by: the settings, what a turn of the spindle clockwise is for the drive, and how fast
/// the speed changes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Guide {
    pub(super) settings: OrientationSettings,
    pub(super) is_inverted: bool,
    pub(super) ramp_rpm_per_s: f64,
}

impl Guide {
    fn per_rev(&self) -> f64 {
        f64::from(self.settings.counts_per_rev)
    }

    /// Counts of degrees clockwise.
    fn counts(&self, deg: f64) -> f64 {
        let sign = if self.is_inverted { -1.0 } else { 1.0 };
        sign * deg / TURN_DEG * self.per_rev()
    }

    /// The way from a place to an angle, counts.
    fn way(&self, place: i32, (deg, way): Angle) -> f64 {
        let in_turn = f64::from(place).rem_euclid(self.per_rev());
        let sign = if self.is_inverted { -1.0 } else { 1.0 };
        let at_deg = sign * in_turn / self.per_rev() * TURN_DEG - sign * self.settings.zero_deg;
        let ahead = (deg - at_deg).rem_euclid(TURN_DEG);
        // One that stands at its angle already does not turn once round for it.
        let window = self.settings.window_deg;
        let is_back = match way {
            OrientWay::Shortest => ahead > 0.5 * TURN_DEG,
            OrientWay::Clockwise => ahead > TURN_DEG - window,
            OrientWay::Counterclockwise => ahead > window,
        };
        self.counts(if is_back { ahead - TURN_DEG } else { ahead })
    }
}

/// A spindle on its way to an angle, or held there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Orienting {
    angle: Angle,
    /// Where it stood when that angle was asked for.
    origin: i32,
    /// From there: where it is led to now, where to in the end, and how fast, counts and counts/s.
    at: f64,
    to: f64,
    velocity: f64,
}

impl Orienting {
    /// Sets out from a place, at rest.
    pub(super) fn begin(guide: &Guide, place: i32, angle: Angle) -> Self {
        Self {
            angle,
            origin: place,
            at: 0.0,
            to: guide.way(place, angle),
            velocity: 0.0,
        }
    }

    /// The place that the drive is told.
    #[allow(clippy::cast_possible_truncation, reason = "two turns at most")]
    pub(super) fn target(&self) -> i32 {
        self.origin.wrapping_add(self.at.round() as i32)
    }

    /// Whether it is to move no further.
    pub(super) fn has_arrived(&self) -> bool {
        self.velocity.abs() <= 0.0 && (self.to - self.at).abs() <= 0.0
    }

    /// Whether it stands where it is told to stand, by what the drive says.
    pub(super) fn is_near(&self, guide: &Guide, place: i32) -> bool {
        let off = f64::from(place.wrapping_sub(self.target()));
        off.abs() <= guide.counts(guide.settings.window_deg).abs().max(1.0)
    }

    /// A step of `step_t` seconds towards an angle, or to rest where there is none. Returns whether it rests.
    pub(super) fn step(&mut self, guide: &Guide, step_t: f64, angle: Option<Angle>) -> bool {
        if let Some(angle) = angle.filter(|angle| *angle != self.angle) {
            let target = self.target();
            *self = Self {
                velocity: self.velocity,
                ..Self::begin(guide, target, angle)
            };
        }
        let per_rpm = guide.per_rev() / 60.0;
        let gain_v = guide.ramp_rpm_per_s * per_rpm * step_t;
        let left = self.to - self.at;
        // The speed from which it comes to rest there in whole steps; counts are whole.
        let wanted_v = if angle.is_none() || left.abs() < 0.5 || gain_v <= 0.0 {
            0.0
        } else {
            let steps = 2.0 * left.abs() / (gain_v * step_t);
            let most_v = gain_v * ((1.0 + steps).sqrt() - 1.0);
            most_v.min(guide.settings.max_rpm * per_rpm).copysign(left)
        };
        self.velocity += (wanted_v - self.velocity).clamp(-gain_v, gain_v);
        self.at += self.velocity * step_t;
        let rests = self.velocity.abs() <= 0.0;
        if rests && left.abs() < 0.5 {
            self.at = self.to;
        }
        rests
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TURN: i32 = 1 << 16;

    fn guide(is_inverted: bool) -> Guide {
        Guide {
            settings: OrientationSettings {
                counts_per_rev: 1 << 16,
                zero_deg: 90.0,
                max_rpm: 60.0,
                window_deg: 0.5,
            },
            is_inverted,
            ramp_rpm_per_s: 600.0,
        }
    }

    /// The angle that a place is, by its definition: what the drive counts, less what it counts at 0.
    fn angle_of(place: i32, is_inverted: bool) -> f64 {
        let deg = 360.0 * f64::from(place) / f64::from(TURN) - 90.0;
        (if is_inverted { -deg } else { deg }).rem_euclid(360.0)
    }

    #[test]
    fn it_comes_to_every_angle_the_way_that_is_asked_for() {
        for is_inverted in [false, true] {
            let guide = guide(is_inverted);
            for (place, deg) in (-40..40).flat_map(|n| (0..8).map(move |m| (n * 7_919, m))) {
                let deg = f64::from(deg) * 51.0;
                let sign = if is_inverted { -1.0 } else { 1.0 };
                for way in [
                    OrientWay::Shortest,
                    OrientWay::Clockwise,
                    OrientWay::Counterclockwise,
                ] {
                    let mut orienting = Orienting::begin(&guide, place, (deg, way));
                    let went = sign * orienting.to / f64::from(TURN);
                    assert!(match way {
                        OrientWay::Shortest => went.abs() <= 0.5,
                        OrientWay::Clockwise => (-0.01..1.0).contains(&went),
                        OrientWay::Counterclockwise => (-1.0..0.01).contains(&went),
                    });
                    for _ in 0..2000 {
                        orienting.step(&guide, 0.001, Some((deg, way)));
                    }
                    let found = angle_of(orienting.target(), is_inverted);
                    let off = (found - deg + 180.0).rem_euclid(360.0) - 180.0;
                    assert!(
                        orienting.has_arrived() && off.abs() < 0.01,
                        "{place} {deg} {off}"
                    );
                }
            }
        }
    }

    #[test]
    fn speed_and_its_change_are_kept_and_it_never_goes_beyond() {
        let guide = guide(false);
        let (most_v, most_a) = (f64::from(TURN), 10.0 * f64::from(TURN));
        for step_t in [0.000_25, 0.001, 0.004] {
            let angle = (200.0, OrientWay::Clockwise);
            let mut orienting = Orienting::begin(&guide, 0, angle);
            let mut before = orienting;
            for step in 0..8000 {
                // Another angle on the way, and none at all.
                let angle = match f64::from(step) * step_t {
                    t if t < 0.2 => Some(angle),
                    t if t < 0.9 => Some((10.0, OrientWay::Counterclockwise)),
                    t if t < 1.2 => None,
                    _ => Some((300.0, OrientWay::Shortest)),
                };
                orienting.step(&guide, step_t, angle);
                let gain = (orienting.velocity - before.velocity).abs() / step_t;
                assert!(orienting.velocity.abs() <= most_v + 1e-6);
                assert!(gain <= most_a * (1.0 + 1e-9), "{gain}");
                before = orienting;
            }
            assert!(orienting.has_arrived());
        }
        let mut orienting = Orienting::begin(&guide, 0, (200.0, OrientWay::Clockwise));
        for _ in 0..4000 {
            orienting.step(&guide, 0.001, Some(orienting.angle));
            assert!(orienting.at <= orienting.to + 0.5, "{orienting:?}");
        }
    }

    #[test]
    fn the_counter_may_go_round_on_the_way() {
        let guide = guide(false);
        let angle = (0.0, OrientWay::Clockwise);
        let mut orienting = Orienting::begin(&guide, i32::MAX - 5, angle);
        for _ in 0..4000 {
            orienting.step(&guide, 0.001, Some(angle));
        }
        assert!(orienting.target() < 0);
        assert!(orienting.is_near(&guide, orienting.target().wrapping_add(91)));
        assert!(!orienting.is_near(&guide, orienting.target().wrapping_sub(92)));
        assert_eq!(orienting.target().rem_euclid(TURN), TURN / 4);
    }
}
