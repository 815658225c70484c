//! Arcs, helices and sawteeth of arcs.

use crate::random::Random;
use crate::text::{ArcTo, Text};
use core::f64::consts::{PI, TAU};

/// The arc that sets out in a direction and turns by an angle, to the left if it is > 0; and the
/// direction in which it ends.
fn arc(from: [f64; 2], heading_rad: f64, radius_mm: f64, turn_rad: f64) -> (ArcTo, f64) {
    let side = turn_rad.signum();
    let center = [
        from[0] - side * radius_mm * heading_rad.sin(),
        from[1] + side * radius_mm * heading_rad.cos(),
    ];
    let end_rad = heading_rad + turn_rad;
    let to = [
        center[0] + side * radius_mm * end_rad.sin(),
        center[1] - side * radius_mm * end_rad.cos(),
    ];
    let is_clockwise = turn_rad < 0.0;
    let arc = ArcTo {
        from,
        to,
        center,
        is_clockwise,
        z: None,
    };
    (arc, end_rad)
}

/// Arcs in a row, with lines between some of them; most go on in the direction of the last.
pub(super) fn chain(random: &mut Random) -> String {
    let mut text = Text::new([0.0; 3], random.log_between(300.0, 12_000.0));
    let (smallest_mm, largest_mm) = random.pick([(0.05, 1.0), (0.3, 5.0), (1.0, 20.0)]);
    let tangent_r = random.pick([0.0, 0.7, 1.0]);
    let (mut at, mut heading_rad) = ([0.0; 2], random.between(0.0, TAU));
    for _ in 0..random.whole(2, 24) {
        if !random.chance(tangent_r) {
            heading_rad += random.between(-PI, PI);
        }
        let radius_mm = random.log_between(smallest_mm, largest_mm);
        if random.chance(0.3) {
            at[0] += radius_mm * heading_rad.cos();
            at[1] += radius_mm * heading_rad.sin();
            text.line_xy(at);
        } else {
            let turn_rad = random.sign() * random.log_between(0.2, 5.5);
            let (next, end_rad) = arc(at, heading_rad, radius_mm, turn_rad);
            text.arc(&next);
            (at, heading_rad) = (next.to, end_rad);
        }
    }
    text.finish()
}

/// Arcs that turn to the left and to the right in turns, with corners or without.
pub(super) fn sawtooth(random: &mut Random) -> String {
    let mut text = Text::new([0.0; 3], random.log_between(600.0, 12_000.0));
    let radius_mm = random.log_between(0.2, 10.0);
    let turn_rad = random.between(0.3, 2.5);
    let corner_rad = if random.chance(0.5) {
        0.0
    } else {
        random.between(0.1, 2.0)
    };
    let (mut at, mut heading_rad, mut side) = ([0.0; 2], 0.5 * turn_rad, -1.0);
    for _ in 0..random.whole(4, 24) {
        let (next, end_rad) = arc(at, heading_rad, radius_mm, side * turn_rad);
        text.arc(&next);
        side = -side;
        (at, heading_rad) = (next.to, end_rad + side * corner_rad);
    }
    text.finish()
}

/// Helices: bores in full turns with a turn without pitch at the bottom, or a thread in chords.
pub(super) fn helix(random: &mut Random) -> String {
    let radius_mm = random.log_between(0.2, 10.0);
    let pitch_mm = radius_mm * random.between(0.02, 0.6);
    let turns = random.whole(1, 5);
    let feed_mm_min = random.log_between(600.0, 9000.0);
    let is_clockwise = random.chance(0.5);
    let mut text = Text::new([radius_mm, 0.0, 0.0], feed_mm_min);
    let mut z = 0.0;
    if random.chance(0.6) {
        for _ in 0..turns {
            z -= pitch_mm;
            text.arc(&turn(radius_mm, is_clockwise, Some(z)));
        }
        text.arc(&turn(radius_mm, is_clockwise, None));
        text.line([0.0, 0.0, z]);
        text.line([0.0, 0.0, 1.0]);
        return text.finish();
    }
    let way = if is_clockwise { -1.0 } else { 1.0 };
    let chord_mm = random.log_between(0.01, 0.5).max(TAU * radius_mm / 600.0);
    let step_rad = way * chord_mm / radius_mm;
    let mut angle_rad = 0.0_f64;
    while angle_rad.abs() < TAU * f64::from(turns) {
        angle_rad += step_rad;
        let z = -pitch_mm * angle_rad.abs() / TAU;
        text.line([radius_mm * angle_rad.cos(), radius_mm * angle_rad.sin(), z]);
    }
    text.finish()
}

/// A full turn from the right.
pub(super) const fn turn(radius_mm: f64, is_clockwise: bool, z: Option<f64>) -> ArcTo {
    ArcTo {
        from: [radius_mm, 0.0],
        to: [radius_mm, 0.0],
        center: [0.0, 0.0],
        is_clockwise,
        z,
    }
}
