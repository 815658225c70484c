//! Spirals, clothoids and curves round a rotary axis, in chords.

use crate::random::Random;
use crate::text::Text;
use core::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// Most chords of a program.
const MOST_CHORDS: f64 = 2500.0;

/// A spiral of Archimedes outwards; before some a line that comes from where the spiral goes, so
/// that it begins with a reversal.
pub(super) fn spiral(random: &mut Random) -> String {
    let turns = random.between(1.0, 6.0);
    let inner_mm = random.log_between(0.05, 2.0);
    let pitch_mm = random.log_between(0.05, 1.5);
    let outer_mm = inner_mm + pitch_mm * turns;
    let length_mm = PI * turns * (inner_mm + outer_mm);
    let chord_mm = random.log_between(0.005, 0.1).max(length_mm / MOST_CHORDS);
    let point = |angle_rad: f64| {
        let radius_mm = inner_mm + pitch_mm * angle_rad / TAU;
        [radius_mm * angle_rad.cos(), radius_mm * angle_rad.sin()]
    };
    let start = point(0.0);
    let feed_mm_min = random.log_between(600.0, 9000.0);
    let lead_mm = random.log_between(0.5, 10.0);
    let ahead = point(1e-6);
    let along = [ahead[0] - start[0], ahead[1] - start[1]];
    let norm = along[0].hypot(along[1]);
    // From ahead of it (a reversal), from behind (straight on), from the side, or not at all.
    let lead = random.pick([Some(1.0), Some(1.0), Some(-1.0), None]);
    let first = lead.map_or(start, |way| {
        [
            start[0] + way * lead_mm * along[0] / norm,
            start[1] + way * lead_mm * along[1] / norm,
        ]
    });
    let mut text = Text::new([first[0], first[1], 0.0], feed_mm_min);
    if lead.is_some() {
        text.line_xy(start);
    }
    let mut angle_rad = 0.0;
    while angle_rad < TAU * turns {
        let radius_mm = inner_mm + pitch_mm * angle_rad / TAU;
        angle_rad += chord_mm / radius_mm.hypot(pitch_mm / TAU);
        text.line_xy(point(angle_rad));
    }
    if random.chance(0.4) {
        text.line_xy([0.0, 0.0]);
    }
    text.finish()
}

/// Clothoids there and back: the curvature grows to a largest one and falls again, once or several
/// times, to the left and to the right.
pub(super) fn clothoid(random: &mut Random) -> String {
    let radius_mm = random.log_between(0.2, 10.0);
    let turn_rad = random.between(0.3, 2.5);
    // Of curvature that grows evenly to 1/R the angle is L/(2R).
    let half_mm = turn_rad * radius_mm;
    let bends = random.whole(1, 6);
    let chord_mm = random
        .log_between(0.01, 0.2)
        .max(2.0 * half_mm * f64::from(bends) / MOST_CHORDS);
    let mut text = Text::new([0.0; 3], random.log_between(600.0, 12_000.0));
    let (mut at, mut heading_rad) = ([0.0_f64; 2], 0.0_f64);
    let mut side = 1.0;
    for _ in 0..bends {
        let mut s = 0.0;
        while s < 2.0 * half_mm {
            let middle = s + 0.5 * chord_mm;
            let share_r = 1.0 - (middle / half_mm - 1.0).abs();
            let change_rad = side * chord_mm * share_r.max(0.0) / radius_mm;
            let middle_rad = heading_rad + 0.5 * change_rad;
            at[0] += chord_mm * middle_rad.cos();
            at[1] += chord_mm * middle_rad.sin();
            heading_rad += change_rad;
            s += chord_mm;
            text.line_xy(at);
        }
        if random.chance(0.7) {
            side = -side;
        }
    }
    text.finish()
}

/// X, Y and A: engraving on a drum, where A stands for some of the way, moves alone for some and
/// with the others for the rest.
pub(super) fn rotary(random: &mut Random) -> String {
    let mut text = Text::new([0.0; 3], random.log_between(300.0, 6000.0));
    let (mut x, mut y, mut a) = (0.0_f64, 0.0_f64, 0.0_f64);
    for _ in 0..random.whole(2, 10) {
        let mut lines = String::new();
        let mut write = |x: f64, y: f64, a: f64| {
            let _ = writeln!(lines, "G1 X{x:.5} Y{y:.5} A{a:.5}");
        };
        let length_mm = random.log_between(0.5, 20.0);
        match random.whole(0, 3) {
            // A stands.
            0 => {
                x += random.sign() * length_mm;
                y += random.between(-length_mm, length_mm);
                write(x, y, a);
            }
            // A alone.
            1 => {
                a += random.sign() * random.between(5.0, 180.0);
                write(x, y, a);
            }
            // A sharp line round the drum.
            2 => {
                x += random.between(-length_mm, length_mm);
                a += random.sign() * random.between(1.0, 60.0);
                write(x, y, a);
            }
            // A wave round it, in chords.
            _ => {
                let count = random.whole(20, 200);
                let height_mm = random.log_between(0.1, 3.0);
                let turn_deg = random.sign() * random.between(10.0, 120.0);
                let (left, bottom, first) = (x, y, a);
                for k in 1..=count {
                    let share_r = f64::from(k) / f64::from(count);
                    x = left + length_mm * share_r;
                    y = bottom + height_mm * (TAU * share_r).sin();
                    a = first + turn_deg * share_r * share_r;
                    write(x, y, a);
                }
            }
        }
        text.raw(lines.trim_end());
    }
    text.finish()
}
