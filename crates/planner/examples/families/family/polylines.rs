//! Straight moves and letters.

use crate::random::Random;
use crate::text::{ArcTo, Text};
use core::f64::consts::{PI, TAU};

/// Straight moves of any length and direction, some of them short ones in a row, some in space.
pub(super) fn polyline(random: &mut Random) -> String {
    let mut text = Text::new([0.0; 3], random.log_between(300.0, 12_000.0));
    let is_spatial = random.chance(0.3);
    let longest_mm = random.log_between(0.2, 40.0);
    let sharpest_rad = random.pick([0.05, 0.6, PI]);
    let (mut at, mut heading_rad) = ([0.0; 3], random.between(0.0, TAU));
    for _ in 0..random.whole(2, 50) {
        heading_rad += random.between(-sharpest_rad, sharpest_rad);
        let length_mm = random.log_between(0.01 * longest_mm, longest_mm);
        at[0] += length_mm * heading_rad.cos();
        at[1] += length_mm * heading_rad.sin();
        if is_spatial && random.chance(0.5) {
            at[2] += length_mm * random.between(-1.0, 1.0);
        }
        text.line(at);
    }
    text.finish()
}

/// A part of a letter, from (0, 0) in the left corner below to (1, 1): ends of lines, and half
/// circles about the middle between where they start and end.
enum Stroke {
    Line(f64, f64),
    Half(f64, f64),
    HalfClockwise(f64, f64),
}

/// Letters by their strokes, each with a starting point.
fn letter(which: u32) -> Vec<([f64; 2], Vec<Stroke>)> {
    use Stroke::{Half, HalfClockwise, Line};
    match which {
        0 => vec![
            ([0.0, 0.0], vec![Line(0.5, 1.0), Line(1.0, 0.0)]),
            ([0.25, 0.5], vec![Line(0.75, 0.5)]),
        ],
        1 => vec![(
            [0.0, 0.0],
            vec![
                Line(0.0, 1.0),
                Line(0.5, 1.0),
                HalfClockwise(0.5, 0.5),
                Line(0.2, 0.5),
                Line(0.5, 0.5),
                HalfClockwise(0.5, 0.0),
                Line(0.0, 0.0),
            ],
        )],
        2 => vec![(
            [0.8, 1.0],
            vec![Line(0.5, 1.0), Half(0.5, 0.0), Line(0.8, 0.0)],
        )],
        3 => vec![(
            [0.9, 0.75],
            vec![Half(0.4, 0.5), HalfClockwise(0.4, 0.0), Line(0.0, 0.1)],
        )],
        4 => vec![([0.0, 0.5], vec![Half(1.0, 0.5), Half(0.0, 0.5)])],
        5 => vec![
            (
                [0.0, 1.0],
                vec![Line(0.0, 0.5), Half(1.0, 0.5), Line(1.0, 1.0)],
            ),
            ([0.5, 0.0], vec![Line(0.5, 0.1)]),
        ],
        _ => vec![(
            [0.0, 0.0],
            vec![
                Line(0.0, 1.0),
                Line(0.5, 0.4),
                Line(1.0, 1.0),
                Line(1.0, 0.0),
            ],
        )],
    }
}

/// Letters, the tool lifted between their strokes.
pub(super) fn lettering(random: &mut Random) -> String {
    let height_mm = random.log_between(0.5, 15.0);
    let lift_mm = random.log_between(0.2, 2.0);
    let depth_mm = random.between(0.05, 0.3);
    let mut text = Text::new([0.0; 3], random.log_between(300.0, 6000.0));
    let mut left_mm = 0.0;
    for _ in 0..random.whole(1, 6) {
        for (start, strokes) in letter(random.whole(0, 6)) {
            let place = |at: [f64; 2]| [left_mm + 0.7 * height_mm * at[0], height_mm * at[1]];
            let round = |at: [f64; 2]| [left_mm + height_mm * at[0], height_mm * at[1]];
            // Half circles must stay round: letters with them are as wide as high.
            let is_straight = strokes
                .iter()
                .all(|stroke| matches!(stroke, Stroke::Line(..)));
            let placed = |at| if is_straight { place(at) } else { round(at) };
            let mut at = placed(start);
            text.line([at[0], at[1], lift_mm]);
            text.line([at[0], at[1], -depth_mm]);
            for stroke in strokes {
                let (to, is_clockwise) = match stroke {
                    Stroke::Line(x, y) => (placed([x, y]), None),
                    Stroke::Half(x, y) => (placed([x, y]), Some(false)),
                    Stroke::HalfClockwise(x, y) => (placed([x, y]), Some(true)),
                };
                match is_clockwise {
                    None => text.line_xy(to),
                    Some(is_clockwise) => text.arc(&ArcTo {
                        from: at,
                        to,
                        center: [0.5 * (at[0] + to[0]), 0.5 * (at[1] + to[1])],
                        is_clockwise,
                        z: None,
                    }),
                }
                at = to;
            }
            text.line([at[0], at[1], lift_mm]);
        }
        left_mm += 1.2 * height_mm;
    }
    text.finish()
}
