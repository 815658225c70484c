//! Gear teeth with involute flanks.

use crate::random::Random;
use crate::text::{ArcTo, Text};
use core::f64::consts::{FRAC_PI_2, PI};

/// Teeth of a gear: root, flank, tip, flank, over a few teeth; flanks in chords or in two arcs.
pub(super) fn flanks(random: &mut Random) -> String {
    let module_mm = random.log_between(0.3, 3.0);
    let count = random.whole(14, 40);
    let pitch_mm = 0.5 * module_mm * f64::from(count);
    let base_mm = pitch_mm * 20.0_f64.to_radians().cos();
    let (root_mm, tip_mm) = (pitch_mm - 1.25 * module_mm, pitch_mm + module_mm);
    // An involute of the base circle: its angle at a radius.
    let involute = |radius_mm: f64| {
        let t = ((radius_mm / base_mm).powi(2) - 1.0).max(0.0).sqrt();
        t - t.atan()
    };
    let half_rad = FRAC_PI_2 / f64::from(count) + involute(pitch_mm);
    let flank = |radius_mm: f64| half_rad - involute(radius_mm);
    let polar = |radius_mm: f64, angle_rad: f64| {
        // The first tooth is upright.
        let turned_rad = FRAC_PI_2 - angle_rad;
        [radius_mm * turned_rad.cos(), radius_mm * turned_rad.sin()]
    };
    let points = random.pick([2, 5, 40]);
    let is_arcs = points == 2;
    let low_mm = base_mm.max(root_mm);
    let pitch_rad = 2.0 * PI / f64::from(count);
    let teeth = random.whole(1, 4);
    let start = polar(root_mm, -flank(low_mm));
    let mut text = Text::new([start[0], start[1], 0.0], random.log_between(600.0, 9000.0));
    let mut at = start;
    for tooth in 0..teeth {
        let middle_rad = pitch_rad * f64::from(tooth);
        if tooth > 0 {
            // The root, round the centre of the gear.
            let to = polar(root_mm, middle_rad - flank(low_mm));
            text.arc(&clockwise(at, to, [0.0, 0.0]));
            at = to;
        }
        // Up one flank, over the tip, down the other.
        let rise = |k: u32| low_mm + (tip_mm - low_mm) * f64::from(k) / f64::from(points);
        for k in 0..=points {
            let to = polar(rise(k), middle_rad - flank(rise(k)));
            at = side(&mut text, at, to, is_arcs && k > 0, 0.16 * base_mm);
        }
        let to = polar(tip_mm, middle_rad + flank(tip_mm));
        text.arc(&clockwise(at, to, [0.0, 0.0]));
        at = to;
        for k in (0..points).rev() {
            let to = polar(rise(k), middle_rad + flank(rise(k)));
            at = side(&mut text, at, to, is_arcs, 0.16 * base_mm);
        }
        let to = polar(root_mm, middle_rad + flank(low_mm));
        text.line_xy(to);
        at = to;
    }
    text.finish()
}

const fn clockwise(from: [f64; 2], to: [f64; 2], center: [f64; 2]) -> ArcTo {
    ArcTo {
        from,
        to,
        center,
        is_clockwise: true,
        z: None,
    }
}

/// A piece of a flank: a line, or an arc about as round as the involute, its centre inside the
/// tooth. Its radius is the one given, if that is large enough.
fn side(text: &mut Text, from: [f64; 2], to: [f64; 2], is_arc: bool, round_mm: f64) -> [f64; 2] {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length_mm = dx.hypot(dy);
    if is_arc && length_mm > 1e-3 {
        let radius_mm = round_mm.max(0.8 * length_mm);
        let rise_mm = (radius_mm * radius_mm - 0.25 * length_mm * length_mm).sqrt();
        // To the right of the way, which is where a tooth is when the gear is gone round clockwise.
        let center = [
            0.5 * (from[0] + to[0]) + rise_mm * dy / length_mm,
            0.5 * (from[1] + to[1]) - rise_mm * dx / length_mm,
        ];
        text.arc(&clockwise(from, to, center));
    } else {
        text.line_xy(to);
    }
    to
}
