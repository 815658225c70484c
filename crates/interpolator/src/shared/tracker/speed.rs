//! The quickest change to another velocity, at acceleration 0 in the end.
//!
//! Acceleration taken straight to 0 leaves the velocity v + a |a| / 2J. If that is below the one
//! wanted, the acceleration has to rise to a peak P first, and to fall from there:
//!
//! ```text
//!   Δv = (P² - a²) / 2J + P² / 2J      so      P = √(J Δv + a² / 2)
//! ```
//!
//! or, where that is above the limit A, to A, and to stay there for (P² - A²) / AJ. What is above A
//! already falls to A first. If it is above the one wanted, all of this with the other sign.

use super::motion::Bounds;

/// A time with a constant jerk.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Phase {
    pub(super) t: f64,
    pub(super) jerk: f64,
}

/// Phases of a change of velocity.
pub(super) const PHASES: usize = 3;

/// The phases from a velocity and acceleration to another velocity. Whatever the first two are, the
/// acceleration is never above the limit for longer than it takes to come back, and nowhere above
/// what it was.
pub(super) fn change(v: f64, a: f64, to: f64, bounds: &Bounds) -> [Phase; PHASES] {
    let Bounds { a: most, j, .. } = *bounds;
    let side = if to >= v + a * a.abs() / (2.0 * j) {
        1.0
    } else {
        -1.0
    };
    let (a, dv) = (side * a, side * (to - v));
    let phase = |t: f64, jerk: f64| Phase {
        t: t.max(0.0),
        jerk: side * jerk,
    };
    if a > most {
        return [
            phase((a - most) / j, -j),
            phase((dv - a * a / (2.0 * j)) / most, 0.0),
            phase(most / j, -j),
        ];
    }
    let peak_squared = (j * dv + 0.5 * a * a).max(0.0);
    if peak_squared > most * most {
        return [
            phase((most - a) / j, j),
            phase((peak_squared - most * most) / (most * j), 0.0),
            phase(most / j, -j),
        ];
    }
    let peak = peak_squared.sqrt();
    [
        phase((peak - a) / j, j),
        phase(0.0, 0.0),
        phase(peak / j, -j),
    ]
}
