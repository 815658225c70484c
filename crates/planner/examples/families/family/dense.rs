//! Circles, and curves in dense chords as CAM systems write them.

use super::arcs::turn;
use crate::random::Random;
use crate::text::Text;
use core::f64::consts::TAU;

/// Most chords of a program.
const MOST_CHORDS: f64 = 4000.0;

/// A circle, told apart from others because there is a time to compare with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Circle {
    pub(crate) radius_mm: f64,
    pub(crate) length_mm: f64,
    pub(crate) feed_v: f64,
}

/// Full turns of a circle, as arcs or in chords of 1 µm to 0.1 mm.
pub(super) fn circle(random: &mut Random) -> super::Drawn {
    let radius_mm = random.log_between(0.05, 20.0);
    let turns = random.whole(1, 3);
    let is_clockwise = random.chance(0.5);
    let feed_mm_min = random.pick([600.0, 3000.0, 6000.0, 9000.0]);
    let length_mm = TAU * radius_mm * f64::from(turns);
    let mut text = Text::new([radius_mm, 0.0, 0.0], feed_mm_min);
    if random.chance(0.4) {
        for _ in 0..turns {
            text.arc(&turn(radius_mm, is_clockwise, None));
        }
    } else {
        let chord_mm = random
            .log_between(0.001, 0.1)
            .max(length_mm / MOST_CHORDS)
            .min(0.5 * radius_mm);
        let count = (length_mm / chord_mm).ceil();
        let way = if is_clockwise { -1.0 } else { 1.0 };
        let mut done = 0.0;
        while done < count {
            done += 1.0;
            let angle_rad = way * TAU * f64::from(turns) * done / count;
            text.line_xy([radius_mm * angle_rad.cos(), radius_mm * angle_rad.sin()]);
        }
    }
    let circle = Circle {
        radius_mm,
        length_mm,
        feed_v: feed_mm_min / 60.0,
    };
    super::Drawn {
        text: text.finish(),
        circle: Some(circle),
    }
}

/// A smooth curve in dense chords, every point off by up to 0.1 to 2 µm, in three to five
/// decimals.
pub(super) fn noisy(random: &mut Random) -> String {
    let chord_mm = random.log_between(0.01, 0.4);
    let noise_mm = random.log_between(1e-4, 2e-3);
    let size_mm = random.log_between(1.0, 20.0);
    let length_mm = (TAU * size_mm).min(2000.0 * chord_mm);
    let lobes = f64::from(random.whole(0, 5));
    let depth_r = if lobes > 0.5 {
        random.between(0.02, 0.4)
    } else {
        0.0
    };
    let height_mm = if random.chance(0.5) {
        random.log_between(0.1, 2.0)
    } else {
        0.0
    };
    let point = |angle_rad: f64| {
        let radius_mm = size_mm * (1.0 + depth_r * (lobes * angle_rad).sin());
        [
            radius_mm * angle_rad.cos(),
            radius_mm * angle_rad.sin(),
            height_mm * (3.0 * angle_rad).sin(),
        ]
    };
    let decimals = random.pick([3, 4, 5]);
    let mut text = Text::new(point(0.0), random.log_between(600.0, 9000.0)).rounded(decimals);
    let mut s = 0.0;
    while s < length_mm {
        s += chord_mm * random.between(0.6, 1.4);
        let exact = point(s / size_mm);
        text.line(exact.map(|at| at + random.between(-noise_mm, noise_mm)));
    }
    text.finish()
}

/// Finishing of a relief in rows: X to and fro, Z over the bumps, a step of Y between.
pub(super) fn relief(random: &mut Random) -> String {
    let width_mm = random.log_between(2.0, 20.0);
    let chord_mm = (width_mm / 200.0).max(random.log_between(0.02, 0.3));
    let step_mm = random.log_between(0.05, 0.5);
    let height_mm = random.log_between(0.05, 2.0);
    let wave_mm = width_mm / random.between(0.7, 5.0);
    let height =
        |x: f64, y: f64| height_mm * (TAU * x / wave_mm).sin() * (TAU * y / (3.0 * wave_mm)).cos();
    let mut text = Text::new(
        [0.0, 0.0, height(0.0, 0.0)],
        random.log_between(600.0, 9000.0),
    )
    .rounded(random.pick([3, 4]));
    let (mut x, mut y, mut way) = (0.0, 0.0, 1.0);
    for _ in 0..random.whole(2, 6) {
        let end = if way > 0.0 { width_mm } else { 0.0 };
        while way * (end - x) > 1e-9 {
            x = if way > 0.0 {
                (x + chord_mm).min(end)
            } else {
                (x - chord_mm).max(end)
            };
            text.line([x, y, height(x, y)]);
        }
        y += step_mm;
        text.line([x, y, height(x, y)]);
        way = -way;
    }
    text.finish()
}
