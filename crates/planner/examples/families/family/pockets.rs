//! Pockets, cleared in rows or from the inside outwards.

use super::arcs::turn;
use crate::random::Random;
use crate::text::{ArcTo, Text};
use core::f64::consts::TAU;

/// A pocket.
pub(super) fn pocket(random: &mut Random) -> String {
    let width_mm = random.log_between(2.0, 40.0);
    let step_mm = width_mm / f64::from(random.whole(4, 14));
    let feed_mm_min = random.log_between(600.0, 12_000.0);
    match random.whole(0, 3) {
        0 => rows(random, width_mm, step_mm, feed_mm_min),
        1 => squares(random, width_mm, step_mm, feed_mm_min),
        2 => rings(random, width_mm, step_mm, feed_mm_min),
        _ => trochoids(random, width_mm, step_mm, feed_mm_min),
    }
}

/// Rows to and fro, with half circles at their ends, short lines, or sharp corners.
fn rows(random: &mut Random, width_mm: f64, step_mm: f64, feed_mm_min: f64) -> String {
    let mut text = Text::new([0.0; 3], feed_mm_min);
    let is_round = random.chance(0.5);
    let is_slanted = random.chance(0.3);
    let (mut y, mut way) = (0.0, 1.0);
    for _ in 0..random.whole(4, 16) {
        let x = if way > 0.0 { width_mm } else { 0.0 };
        text.line_xy([x, y]);
        if is_round {
            text.arc(&ArcTo {
                from: [x, y],
                to: [x, y + step_mm],
                center: [x, y + 0.5 * step_mm],
                is_clockwise: way < 0.0,
                z: None,
            });
        } else if !is_slanted {
            text.line_xy([x, y + step_mm]);
        }
        y += step_mm;
        way = -way;
    }
    text.finish()
}

/// Rectangles one round the other, each entered by a short line, their corners sharp or round.
fn squares(random: &mut Random, width_mm: f64, step_mm: f64, feed_mm_min: f64) -> String {
    let depth_mm = random.between(0.2, 2.0);
    let aspect_r = random.between(0.4, 1.0);
    let round_r = if random.chance(0.5) {
        random.between(0.1, 0.8)
    } else {
        0.0
    };
    let mut text = Text::new([0.0; 3], feed_mm_min);
    text.line([0.0, 0.0, -depth_mm]);
    let mut half = step_mm;
    while half <= 0.5 * width_mm {
        let (right, top) = (half, half * aspect_r);
        let radius_mm = round_r * step_mm.min(top);
        text.line_xy([right, 0.0]);
        let corners = [[right, top], [-right, top], [-right, -top], [right, -top]];
        let ways = [[0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
        for (corner, way) in corners.iter().zip(ways.windows(2)) {
            let before = [
                corner[0] - radius_mm * way[0][0],
                corner[1] - radius_mm * way[0][1],
            ];
            text.line_xy(before);
            if radius_mm > 0.0 {
                let to = [
                    corner[0] + radius_mm * way[1][0],
                    corner[1] + radius_mm * way[1][1],
                ];
                let center = [
                    before[0] + radius_mm * way[1][0],
                    before[1] + radius_mm * way[1][1],
                ];
                text.arc(&ArcTo {
                    from: before,
                    to,
                    center,
                    is_clockwise: false,
                    z: None,
                });
            }
        }
        text.line_xy([right, 0.0]);
        half += step_mm;
    }
    text.finish()
}

/// Full circles one round the other, or a spiral of half circles.
fn rings(random: &mut Random, width_mm: f64, step_mm: f64, feed_mm_min: f64) -> String {
    let mut text = Text::new([step_mm, 0.0, 0.0], feed_mm_min);
    let is_spiral = random.chance(0.5);
    let (mut radius_mm, mut at) = (step_mm, step_mm);
    while radius_mm <= 0.5 * width_mm {
        if is_spiral {
            for _ in 0..2 {
                let to = -at.signum() * (at.abs() + 0.5 * step_mm);
                text.arc(&ArcTo {
                    from: [at, 0.0],
                    to: [to, 0.0],
                    center: [0.5 * (at + to), 0.0],
                    is_clockwise: false,
                    z: None,
                });
                at = to;
            }
            radius_mm = at.abs();
        } else {
            text.arc(&turn(radius_mm, false, None));
            radius_mm += step_mm;
            text.line_xy([radius_mm, 0.0]);
        }
    }
    text.finish()
}

/// A slot in trochoids, in chords.
fn trochoids(random: &mut Random, width_mm: f64, step_mm: f64, feed_mm_min: f64) -> String {
    let radius_mm = 0.1 * width_mm;
    let count = random.whole(24, 120);
    let mut text = Text::new([radius_mm, 0.0, 0.0], feed_mm_min);
    for k in 1..=count * random.whole(2, 6) {
        let turns = f64::from(k) / f64::from(count);
        let angle_rad = TAU * turns;
        text.line_xy([
            radius_mm * angle_rad.cos() + 0.3 * step_mm * turns,
            radius_mm * angle_rad.sin(),
        ]);
    }
    text.finish()
}
