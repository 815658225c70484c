//! Tests of effort "optimal": as fast as the tube allows, and of the motions as fast the smooth one
//! near the program. Figures are those of finite differences of positions, as a drive is given
//! them.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use core::f64::consts::TAU;
use std::fmt::Write as _;

use crate::support::family::{audited, family};
use glidepath_audit::AuditReport;
use glidepath_geometry::AxisVector;
use glidepath_program::{Corners, Effort, Limits, Settings, Smoothing};

const PERIOD_T: f64 = 0.004;
const JERK_J: f64 = 40_000.0;
/// Periods after a corner in which the motion settles: 50 ms.
const SETTLING: usize = 13;

/// Program, and the least time in s of all motions within 0.02 mm of it on the mill (computed
/// offline by two independent solvers).
const FAMILIES: [(&str, f64); 18] = [
    ("circ_r0.05_c0.005", 0.18171),
    ("circ_r0.1_c0.01", 0.25222),
    ("circ_r0.1_g2", 0.25222),
    ("circ_r0.2_c0.01", 0.33065),
    ("circ_r0.5_g2", 0.4588),
    ("circ_r2_c0.05", 0.74023),
    ("clothoid_r0.5_l10", 0.34473),
    ("fsquare_5", 0.91898),
    ("helix_r3", 0.60421),
    ("letters_ab3", 1.17321),
    ("noisy_r5", 0.43086),
    ("relief_0.8", 0.31077),
    ("sawarc_r2", 1.0548),
    ("sine_0.5_4", 0.72049),
    ("spiral_0.2_3", 1.04364),
    ("star_4", 0.54245),
    ("teeth_z20", 0.84137),
    ("zigzag_s0.3", 1.32851),
];
/// Times of it that a plan may take, or two periods more than it.
const MOST: f64 = 1.06;

/// Periods more after which an axis stands still to the bit.
const STANDING: usize = 27;

/// A frame: line and position.
type Place = (u32, AxisVector);

fn settings() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, JERK_J),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        // As the least times are.
        corners: Corners::Either,
        period_t: PERIOD_T,
        effort: Effort::Optimal,
    }
}

fn planned(text: &str) -> (Vec<Place>, AuditReport) {
    planned_with(text, settings())
}

fn planned_with(text: &str, settings: Settings) -> (Vec<Place>, AuditReport) {
    let mut places = Vec::new();
    let report = audited("smooth", text, settings, |frame| {
        places.push((frame.line, frame.position));
    });
    (places, report)
}

/// Jerk about frame `k`, mm/s³.
fn jerk_at(places: &[Place], k: usize) -> AxisVector {
    let [a, b, c, d] = [k - 2, k - 1, k, k + 1].map(|k| places[k].1);
    (d - c * 3.0 + b * 3.0 - a) / PERIOD_T.powi(3)
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| {
        (count + 1.0, sum + value * value)
    });
    assert!(count > 0.0, "nothing to look at");
    f64::sqrt(sum / count)
}

/// The frames of a line without those in which the motion settles.
fn settled(places: &[Place], line: u32) -> std::ops::Range<usize> {
    let first = places.iter().position(|place| place.0 == line);
    let last = places.iter().rposition(|place| place.0 == line);
    let range = first.expect("the line") + SETTLING..last.expect("the line") - SETTLING;
    assert!(range.len() > 8, "line {line} is long enough");
    range
}

/// A plate, 100 by 50, with corners of radius 8, at 60 mm/s.
const OUTLINE: &str = "G21 G90 G17 G64
G0 X50 Y0 Z5
G1 Z-1 F300
G1 X92 F3600
G3 X100 Y8 I0 J8
G1 Y42
G3 X92 Y50 I-8 J0
G1 X8
G3 X0 Y42 I0 J-8
G1 Y8
G3 X8 Y0 I8 J0
G1 X50
G0 Z5
M2
";

#[test]
fn a_planar_cut_is_planar_straight_and_round() {
    let (places, report) = planned(OUTLINE);
    let cut = settled(&places, 4).start + STANDING..settled(&places, 12).end - STANDING;
    for (line, position) in &places[cut] {
        assert_eq!(position[2].to_bits(), (-1.0_f64).to_bits(), "line {line}");
    }
    for (line, axis, at) in [(6, 0, 100.0), (8, 1, 50.0), (10, 0, 0.0)] {
        let range = settled(&places, line);
        for k in range.clone() {
            assert!((places[k].1[axis] - at).abs() <= 0.2e-3, "line {line}");
        }
        for axis in 0..2 {
            let jerk_j = rms(range.clone().map(|k| jerk_at(&places, k)[axis]));
            assert!(jerk_j <= 0.01 * JERK_J, "line {line}: {jerk_j}");
        }
    }
    for (line, x, y) in [
        (5, 92.0, 8.0),
        (7, 92.0, 42.0),
        (9, 8.0, 42.0),
        (11, 8.0, 8.0),
    ] {
        round_about(&places, settled(&places, line), (x, y, 8.0), 1.1);
    }
    assert_eq!(report.tremor_count, 0, "{:#?}", report.tremors);
}

/// The motion keeps its radius, and has hardly more jerk than it takes to go round at 60 mm/s.
fn round_about(
    places: &[Place],
    range: std::ops::Range<usize>,
    (x, y, radius_mm): (f64, f64, f64),
    most: f64,
) {
    #[expect(clippy::cast_precision_loss, reason = "thousands")]
    let count = range.len() as f64;
    let off_mm: f64 = range
        .clone()
        .map(|k| (places[k].1[0] - x).hypot(places[k].1[1] - y) - radius_mm)
        .sum();
    assert!((off_mm / count).abs() <= 1e-3, "{} mm off", off_mm / count);
    let jerk_j = rms(range.map(|k| jerk_at(places, k).norm()));
    let of_arc_j = 60.0_f64.powi(3) / (radius_mm * radius_mm);
    assert!(jerk_j <= most * of_arc_j, "{jerk_j}, the arc {of_arc_j}");
}

#[test]
fn circles_are_round_however_they_are_written() {
    let as_arcs = "G21 G90 G17 G64\nG0 X20\nG3 X20 Y0 I-20 F3600\nG3 X20 Y0 I-20\nM2\n";
    let mut as_chords = String::from("G21 G90 G17 G64\nG0 X20\n");
    let chords = 1256;
    for k in 1..=2 * chords {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(chords)).sin_cos();
        writeln!(as_chords, "G1 X{:.4} Y{:.4} F3600", 20.0 * cos, 20.0 * sin).expect("a string");
    }
    as_chords.push_str("M2\n");
    for (text, most) in [(as_arcs, 1.1), (&as_chords, 1.5)] {
        let (places, _) = planned(text);
        let first = places.iter().position(|place| place.0 >= 3).expect("line");
        // After the run-up, up to a while before the stop.
        let range = first + 60..places.len() - 60;
        round_about(&places, range, (0.0, 0.0, 20.0), most);
    }
}

/// A hole milled by a helix and a circle at its bottom, slow enough for the feed to bind all the way:
/// inside of it the way is up to 4 % shorter. The last window rests as early as it can, wherever it is
/// in the tube.
#[test]
fn small_holes_keep_their_radius() {
    for (radius_mm, feed) in [(0.5, 500), (0.8, 780), (1.5, 1100), (4.0, 2000)] {
        let turn = format!("G2 X{radius_mm} Y0 I{} J0", -radius_mm);
        let text = format!(
            "G21 G90 G17 G64\nG0 X{radius_mm} Y0 Z0.2\nF{feed}\n{turn} Z0\n{turn} Z-0.2\n{turn} Z-0.4\n\
             {turn}\n{turn}\nG0 Z2\nM2\n"
        );
        let (places, _) = planned(&text);
        let on_line = |line: u32| places.iter().position(|place| place.0 >= line);
        let first = on_line(4).expect("the first turn") + 2 * SETTLING;
        let last = on_line(9).expect("the way out") - 4 * SETTLING;
        let off_mm = |place: &Place| place.1[0].hypot(place.1[1]) - radius_mm;
        let cut = &places[first..last];
        let most_mm = cut
            .iter()
            .map(off_mm)
            .fold(0.0, |most: f64, off| most.max(off.abs()));
        #[expect(clippy::cast_precision_loss, reason = "thousands")]
        let mean_mm = cut.iter().map(off_mm).sum::<f64>() / cut.len() as f64;
        assert!(
            mean_mm.abs() <= 0.3e-3,
            "radius {radius_mm}: {mean_mm} mm off"
        );
        assert!(most_mm <= 2e-3, "radius {radius_mm}: {most_mm} mm off");
    }
}

#[test]
fn families_come_near_the_least_time_in_the_tube_and_do_not_tremble() {
    for (name, tube_t) in FAMILIES {
        let (_, report) = planned(&family(name));
        let most_t = (MOST * tube_t).max(tube_t + 2.0 * PERIOD_T);
        let cycle_t = report.cycle_time_s;
        assert!(cycle_t <= most_t, "{name}: {cycle_t} s of {tube_t} s");
        assert_eq!(report.tremor_count, 0, "{name}: {:#?}", report.tremors);
    }
}

/// Three axes, arcs, pockets and dense curves, at several feeds.
#[test]
fn the_example_does_not_tremble() {
    for (corners, most_t) in [(Corners::Either, 27.23), (Corners::Inner, 27.76)] {
        let text = include_str!("../../../glidepath/examples/part.ngc");
        let (_, report) = planned_with(
            text,
            Settings {
                corners,
                ..settings()
            },
        );
        let cycle_t = report.cycle_time_s;
        assert!(cycle_t <= most_t, "{corners:?}: {cycle_t} s");
        assert_eq!(report.tremor_count, 0, "{corners:?}: {:#?}", report.tremors);
    }
}

/// A corner so sharp that the way out of it leads back beside the way in. Where periods may end
/// elsewhere, a chord that misses it goes on beside the way in, and cannot be led on from there.
#[test]
fn a_corner_that_turns_back_is_come_out_of() {
    let light = Settings {
        limits: Limits::uniform(100.0, 10_000.0, 1e6),
        tolerance_mm: 0.05,
        ..settings()
    };
    let text = "G21 G90 G94 G17 F426\n\
         G2 X4.050349 Y-1.656741 I-0.169241 J-6.193212\n\
         G1 X-0.034673 Y0.601945\n\
         G1 X1.369663 Y4.931059\n\
         G2 X-10.707442 Y6.835121 I-5.532290 J4.163162\n\
         G1 X-11.742487 Y9.312474\n\
         G3 X-7.549277 Y4.300760 I10.213356 J4.285281\n\
         G3 X-5.319186 Y4.800125 I0.127218 J4.661180\n\
         G2 X-7.368016 Y12.873790 I-7.170897 J2.477058\n\
         G2 X15.257087 Y8.628642 I9.317273 J-12.756684\n\
         G3 X16.131652 Y8.952363 I-0.271594 J2.076961\nM2\n";
    audited("a corner that turns back", text, light, |_| {});
}

/// Slots with a line of hundredths of a millimetre before each long one.
const SLOTS: &str = "G21 G90 G94 G17 G64 P0.02
G0 Z5
G0 X29.321 Y8.901
G1 Z-1 F1000
X29.299 Y8.9
X9.9
Y30
X9.921 Y30.3
X40.2
Y8.9
G0 Z5
M2
";

#[test]
fn a_long_line_is_straight_whatever_precedes() {
    for effort in [Effort::Optimal, Effort::Fast] {
        let mut places: Vec<Place> = Vec::new();
        let settings = Settings {
            effort,
            ..settings()
        };
        audited("slots", SLOTS, settings, |frame| {
            places.push((frame.line, frame.position));
        });
        for (line, axis, at) in [(6, 1, 8.9), (7, 0, 9.9), (9, 1, 30.3), (10, 0, 40.2)] {
            let of_line: Vec<_> = places.iter().filter(|place| place.0 == line).collect();
            let quarter = of_line.len() / 4;
            for (_, position) in &of_line[quarter..of_line.len() - quarter] {
                let off_mm = (position[axis] - at).abs();
                assert!(off_mm < 1e-3, "{effort:?}, line {line}: {off_mm} mm off");
            }
        }
    }
}
