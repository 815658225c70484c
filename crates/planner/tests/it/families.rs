//! Tests of effort "fast" along curves: families of small programs with the least time along their
//! exact curve, circles of any size, and paths of arcs that meet at corners. Nothing takes longer
//! than the same program with a stop at the end of every block.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use core::f64::consts::TAU;
use std::fmt::Write as _;

use crate::support::family::{HEADER, audited, circles_of_chords, family};
use glidepath_program::{Effort, Limits, Settings, Smoothing};

const PERIODS_T: [f64; 2] = [0.004, 0.001];
const MILL: (f64, f64, f64) = (200.0, 2000.0, 40_000.0);
const STIFF: (f64, f64, f64) = (200.0, 2000.0, 1e6);
const SEED: (f64, f64, f64) = (100.0, 10_000.0, 1e6);

/// Program, the least time in s that the mill takes along its exact curve (at rest wherever its
/// curvature jumps; computed offline by two independent solvers, to a thousandth), and how many
/// times as long the plan may take.
const FAMILIES: [(&str, f64, f64); 18] = [
    ("circ_r0.05_c0.005", 0.22467, 1.04),
    ("circ_r0.1_c0.01", 0.28307, 1.05),
    ("circ_r0.1_g2", 0.28307, 1.05),
    ("circ_r0.2_c0.01", 0.35664, 1.04),
    ("circ_r0.5_g2", 0.48404, 1.04),
    ("circ_r2_c0.05", 0.76837, 1.03),
    ("clothoid_r0.5_l10", 0.36082, 1.05),
    ("fsquare_5", 1.9207, 1.03),
    ("helix_r3", 0.62179, 1.04),
    ("letters_ab3", 2.13784, 0.82),
    ("noisy_r5", 0.43446, 1.05),
    ("relief_0.8", 0.3214, 1.06),
    ("sawarc_r2", 1.45517, 1.07),
    ("sine_0.5_4", 0.73753, 1.04),
    ("spiral_0.2_3", 1.09236, 1.03),
    ("star_4", 0.71182, 1.01),
    ("teeth_z20", 1.28666, 1.08),
    ("zigzag_s0.3", 2.206, 1.03),
];

fn settings((velocity, acceleration, jerk): (f64, f64, f64), period_t: f64) -> Settings {
    Settings {
        limits: Limits::uniform(velocity, acceleration, jerk),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t,
        effort: Effort::Fast,
    }
}

/// How long a program takes; it keeps every limit and its tolerance.
fn cycle_time(name: &str, text: &str, settings: Settings) -> f64 {
    audited(name, text, settings, |_| {}).cycle_time_s
}

/// The same program at rest after every block.
fn stopping(text: &str, tolerance: &str) -> String {
    let stopping = text.replace(tolerance, "G61.1");
    assert_ne!(stopping, text, "no {tolerance} in the program");
    stopping
}

/// A program takes no longer than at rest after every block, but for the period in which it ends.
fn beats_stopping(name: &str, text: &str, tolerance: &str, settings: Settings) {
    let passing_t = cycle_time(name, text, settings);
    let stopping_t = cycle_time(name, &stopping(text, tolerance), settings);
    assert!(
        passing_t <= stopping_t + settings.period_t,
        "{name}, {settings:?}: {passing_t} s, with stops {stopping_t} s"
    );
}

#[test]
fn families_come_near_the_least_time_along_their_curve() {
    for (name, exact_t, most_r) in FAMILIES {
        for period_t in PERIODS_T {
            let cycle_t = cycle_time(name, &family(name), settings(MILL, period_t));
            assert!(
                cycle_t <= most_r * exact_t,
                "{name}, {period_t} s: {cycle_t} s, {} times the least",
                cycle_t / exact_t
            );
        }
    }
}

#[test]
fn families_are_never_slower_than_with_stops() {
    for (name, ..) in FAMILIES {
        for (limits, period_t) in [(MILL, 0.004), (STIFF, 0.004), (SEED, 0.001)] {
            beats_stopping(name, &family(name), "G64 P0.02", settings(limits, period_t));
        }
    }
}

const FEED_V: f64 = 100.0;

fn full_circles(radius_mm: f64, turns: u32) -> String {
    let mut text = HEADER.to_owned();
    for _ in 0..turns {
        writeln!(text, "G2 X0 Y0 I{} J0", -radius_mm).expect("a string");
    }
    text
}

/// The time at the highest constant speed, and that for run-up and stop.
fn steady_time(
    radius_mm: f64,
    turns: u32,
    (velocity_v, accel_a, jerk_j): (f64, f64, f64),
) -> (f64, f64) {
    let by_curve_v = (accel_a * radius_mm).sqrt();
    let by_jerk_v = (jerk_j * radius_mm * radius_mm).cbrt();
    let v = FEED_V.min(velocity_v).min(by_curve_v).min(by_jerk_v);
    let ramp_t = if v > accel_a * accel_a / jerk_j {
        v / accel_a + accel_a / jerk_j
    } else {
        2.0 * (v / jerk_j).sqrt()
    };
    (TAU * radius_mm * f64::from(turns) / v, ramp_t)
}

#[test]
fn circles_are_driven_near_the_steady_speed() {
    for limits in [MILL, STIFF] {
        for radius_mm in [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0] {
            let turns = if radius_mm < 5.0 { 3 } else { 1 };
            let (steady_t, ramp_t) = steady_time(radius_mm, turns, limits);
            let mut programs = vec![("arcs", full_circles(radius_mm, turns))];
            for chord_mm in [0.001, 0.01, 0.05, 0.2] {
                if chord_mm <= 0.5 * radius_mm && chord_mm >= 0.0005 * radius_mm {
                    programs.push(("chords", circles_of_chords(radius_mm, turns, chord_mm)));
                }
            }
            for (kind, text) in programs {
                for period_t in PERIODS_T {
                    let name = format!("{kind} of radius {radius_mm}");
                    let cycle_t = cycle_time(&name, &text, settings(limits, period_t));
                    assert!(
                        cycle_t <= 1.25 * steady_t + ramp_t + 2.0 * period_t,
                        "{name}, {limits:?}, {period_t} s: {cycle_t} s, steady {steady_t} s, \
                         run-up and stop {ramp_t} s"
                    );
                }
            }
        }
    }
}

/// A wave in chords of 0.05 mm, from a path position on.
fn wave(from_x: f64) -> String {
    let mut text = String::new();
    for k in 1..=750 {
        let x = 0.05 * f64::from(k);
        writeln!(text, "G1 X{:.5} Y{:.5}", from_x + x, 1.0 - x.cos()).expect("a string");
    }
    text
}

/// S-curves are good enough on the straights, and not on the wave between them.
#[test]
fn a_curve_between_long_straights_takes_no_longer_than_between_stops() {
    let straight = format!("{HEADER}G1 X300 Y0\n");
    let all = format!("{straight}{}G1 X600 Y0\n", wave(300.0));
    for (limits, period_t) in [(MILL, 0.004), (MILL, 0.001), (STIFF, 0.004)] {
        let time = |text: &str| cycle_time("straight and wave", text, settings(limits, period_t));
        let (straight_t, wave_t) = (time(&straight), time(&format!("{HEADER}{}", wave(0.0))));
        let behind_t = time(&format!("{HEADER}G1 X262.5 Y0\n"));
        let (all_t, apart_t) = (time(&all), straight_t + wave_t + behind_t);
        assert!(
            all_t <= apart_t,
            "{limits:?}, {period_t} s: {all_t} s, apart {apart_t} s"
        );
    }
}

/// Arcs of two millimetres that meet in sharp corners, up and down.
fn sawtooth(teeth: u32, tolerance: &str) -> String {
    let mut text = format!("G21 G90 G94 G17 {tolerance} F6000\n");
    for k in 1..=teeth {
        let x = std::f64::consts::SQRT_2 * f64::from(k);
        if k % 2 == 1 {
            writeln!(text, "G2 X{x:.6} Y1.414214 I1.931852 J-0.517638").expect("a string");
        } else {
            writeln!(text, "G3 X{x:.6} Y0 I1.931852 J0.517638").expect("a string");
        }
    }
    text
}

/// Flat arcs up and down that a machine may drive faster than its axes are along one of them.
fn slanted_teeth(teeth: u32) -> String {
    let mut text = "G21 G90 G94 G17 G64 P0.05 F7769\n".to_owned();
    for k in 0..teeth {
        let (x, y) = (18.334736 * f64::from(k), 8.116836 * f64::from(k));
        writeln!(
            text,
            "G2 X{:.6} Y{y:.6} I5.482020 J-3.454908",
            x + 10.964040
        )
        .expect("a string");
        let (x, y) = (x + 18.334736, y + 8.116836);
        writeln!(text, "G3 X{x:.6} Y{y:.6} I1.127630 J6.381018").expect("a string");
    }
    text
}

#[test]
fn arcs_faster_than_an_axis_are_never_slower_than_stops() {
    let light = Settings {
        tolerance_mm: 0.05,
        ..settings(SEED, 0.004)
    };
    beats_stopping("slanted teeth", &slanted_teeth(10), "G64 P0.05", light);
    for radius_mm in [9.193_233, 11.972_934] {
        let text = full_circles(radius_mm, 3).replace("F6000", "F9000");
        beats_stopping("circles", &text, "G64 P0.02", light);
    }
}

#[test]
fn corners_between_arcs_are_never_slower_than_stops() {
    for tolerance in ["G64 P0.005", "G64 P0.01", "G64 P0.02", "G64 P0.05"] {
        for (limits, period_t) in [(MILL, 0.004), (MILL, 0.001), (STIFF, 0.004)] {
            let settings = settings(limits, period_t);
            for teeth in [12, 100] {
                let text = sawtooth(teeth, tolerance);
                beats_stopping(&format!("{teeth} teeth"), &text, tolerance, settings);
            }
            let text = family("teeth_z20").replace("G64 P0.02", tolerance);
            beats_stopping("tooth flanks", &text, tolerance, settings);
        }
    }
}

/// A circle behind a line of some seconds, so that the stretch is planned as it goes.
fn circle_behind_a_line(radius_mm: f64, tolerance: &str) -> String {
    format!(
        "G21 G90 G94 G17 {tolerance} F1200\nG1 X-180\nG1 X0 F6000\nG3 X0 Y0 I{radius_mm}\nG1 Y10\n"
    )
}

#[test]
fn a_circle_behind_a_line_does_not_stop_at_its_chords_where_the_tolerance_is_tight() {
    for (radius_mm, tolerance) in [
        (3.0, "G64 P0.001"),
        (3.0, "G64 P0.002"),
        (1.0, "G64 P0.0005"),
    ] {
        let settings = settings(MILL, 0.004);
        let text = circle_behind_a_line(radius_mm, tolerance);
        let stopping = stopping(&text, tolerance);
        let [passing_t, stopping_t] =
            [&text, &stopping].map(|text| cycle_time("circle", text, settings));
        // A few chords at its corners with the lines may be driven one by one; driven so all along, a circle took two
        // to four times as long.
        let line_t = 10.8;
        assert!(
            passing_t - line_t <= 1.3 * (stopping_t - line_t),
            "{radius_mm} mm, {tolerance}: {passing_t} s, with stops {stopping_t} s"
        );
    }
}

/// Longer than is planned both ways; there is no corner in it, and the chords of the periods bound the speed.
#[test]
fn circles_at_a_tight_tolerance_are_never_slower_than_with_stops() {
    for (radius_mm, turns, tolerance_mm) in [(10.0, 8, 0.001), (10.0, 12, 0.002), (50.0, 4, 0.001)]
    {
        let tolerance = format!("G64 P{tolerance_mm}");
        let text = full_circles(radius_mm, turns).replace("G64 P0.02", &tolerance);
        // An arc that ends in an exact stop is followed within the tolerance of the configuration.
        let settings = Settings {
            tolerance_mm,
            ..settings(MILL, 0.004)
        };
        beats_stopping("circles", &text, &tolerance, settings);
    }
}
