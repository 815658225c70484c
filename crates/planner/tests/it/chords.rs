//! Tests of effort "optimal" on curves in chords: the same curve takes the same time, however it is
//! cut.

use crate::support::family::{audited, circles_of_chords};
use glidepath_program::{Effort, Limits, Settings, Smoothing};

/// From one number of knots to the next, s.
const KNOT_T: f64 = 0.004;

/// Of two ways round a small circle one takes up to 8 % longer, and which of them is found first
/// depends on where chords end.
#[test]
fn small_circles_take_as_long_in_chords_of_any_length() {
    for period_t in [0.004, 0.001] {
        let settings = Settings {
            limits: Limits::uniform(200.0, 2000.0, 40_000.0),
            tolerance_mm: 0.02,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: glidepath_program::Corners::default(),
            period_t,
            effort: Effort::Optimal,
        };
        for (radius_mm, chords_mm) in [
            (0.1, [0.01, 0.02, 0.036]),
            (0.5, [0.02, 0.05, 0.08]),
            (1.0, [0.03, 0.036, 0.05]),
            (2.0, [0.04, 0.05, 0.1]),
        ] {
            let times = chords_mm.map(|chord_mm| {
                let text = circles_of_chords(radius_mm, 1, chord_mm);
                let name = format!("circle of {radius_mm} in chords of {chord_mm}");
                audited(&name, &text, settings, |_| {}).cycle_time_s
            });
            let (least, most) = times
                .iter()
                .fold((f64::INFINITY, 0.0_f64), |(low, high), t| {
                    (low.min(*t), high.max(*t))
                });
            assert!(
                most - least <= KNOT_T + 1e-9,
                "radius {radius_mm}, chords {chords_mm:?}, {period_t} s: {times:?}"
            );
        }
    }
}
