//! Tests of whole programs, from text to frames, judged by the auditor and compared with kept
//! plans.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stderr,
    reason = "a test that fails may panic, and a skipped one says so"
)]

use std::fmt::Write as _;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use glidepath_audit::diagnosis::Diagnosis;
use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample};
use glidepath_gcode::{Options, Program};
use glidepath_geometry::AxisVector;
use glidepath_motion::Planner;
use glidepath_program::{Corners, Effort, Frame, Limits, Settings, Smoothing};
use serde_json::Value;

const PERIOD_T: f64 = 0.004;

/// A machine a program is planned for.
#[derive(Clone, Copy)]
struct Profile {
    limits: (f64, f64, f64),
    tolerance_mm: f64,
}

const MILL: Profile = Profile {
    limits: (200.0, 2000.0, 40_000.0),
    tolerance_mm: 0.02,
};
const SEED: Profile = Profile {
    limits: (100.0, 10_000.0, 1e6),
    tolerance_mm: 0.05,
};

/// Program, machine, and times in s: of a motion that stops at every corner, and of the optimal
/// plan kept.
const BENCH: [(&str, Profile, f64, f64); 14] = [
    ("seed5_seed", SEED, 0.10079, 0.06),
    ("seed5_mill", MILL, 0.29472, 0.188),
    ("square20_seed", SEED, 1.03303, 1.008),
    ("square20_mill", MILL, 1.2, 1.08),
    ("star_seed", SEED, 2.36925, 2.344),
    ("star_mill", MILL, 2.37705, 2.192),
    ("zigzag_seed", SEED, 2.09718, 1.212),
    ("zigzag_mill", MILL, 5.78084, 2.992),
    ("circle_g1_0.1_seed", SEED, 8.92756, 0.772),
    ("circle_g1_0.1_mill", MILL, 26.10434, 0.732),
    ("circle_g1_0.01_seed", SEED, 41.45145, 0.772),
    ("circle_g1_0.01_mill", MILL, 121.20477, 0.732),
    ("butterfly_g1_seed", SEED, 79.88193, 4.288),
    ("butterfly_g1_mill", MILL, 233.57619, 3.988),
];

impl Profile {
    /// Planned with the curve named; `Auto` is planned optimally, on either side of corners as the times to beat
    /// are.
    fn settings(self, smoothing: Smoothing) -> Settings {
        let (velocity, acceleration, jerk) = self.limits;
        Settings {
            limits: Limits::uniform(velocity, acceleration, jerk),
            tolerance_mm: self.tolerance_mm,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing,
            corners: Corners::Either,
            period_t: PERIOD_T,
            effort: Effort::Optimal,
        }
    }
}

fn data(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/data")
        .join(path)
}

/// Plans a program and audits it; `each` sees every frame. The error is the first diagnostic's
/// code.
fn plan(
    path: &Path,
    settings: Settings,
    options: Options,
    mut each: impl FnMut(&Frame),
) -> Result<AuditReport, String> {
    let file = File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    let mut diagnosis = Diagnosis::new(&AuditSettings::from(&settings));
    let mut shown = (0.0_f64, 0);
    let mut planner = Planner::new(settings, AxisVector::zeros());
    let mut take = |planner: &mut Planner, audit: &mut Audit, diagnosis: &mut Diagnosis| {
        while let Some(frame) = planner.pop_frame().expect("a motion") {
            audit.sample(&Sample::from(&frame));
            diagnosis.frame(&frame);
            let distance_mm = diagnosis.deviation().distance_mm;
            if distance_mm > shown.0 {
                shown = (distance_mm, frame.line);
            }
            each(&frame);
        }
    };
    for item in Program::new(BufReader::new(file), options) {
        let item =
            item.map_err(|diagnostic| format!("{}: {}", diagnostic.line, diagnostic.message))?;
        planner.push(&item).map_err(|error| error.to_string())?;
        audit.program(&item);
        diagnosis.program(&item);
        take(&mut planner, &mut audit, &mut diagnosis);
    }
    planner.finish();
    take(&mut planner, &mut audit, &mut diagnosis);
    let report = audit.finish();
    // Where a motion is furthest off, plots show what the auditor finds; its resolution is a nanometre, or
    // what that is in another unit.
    let found_mm = report.max_deviation_mm;
    assert!(
        (shown.0 - found_mm).abs() <= 2e-6 * found_mm.max(1.0),
        "{}: {} mm shown at line {}, {} mm found",
        path.display(),
        shown.0,
        shown.1,
        report.max_deviation_mm
    );
    Ok(report)
}

#[test]
fn bench_programs_do_not_tremble_with_effort_fast() {
    for (name, profile, ..) in BENCH {
        let settings = Settings {
            effort: Effort::Fast,
            ..profile.settings(Smoothing::Auto)
        };
        let path = data(&format!("bench/{name}.ngc"));
        let report = plan(&path, settings, Options::default(), |_| ())
            .unwrap_or_else(|diagnostic| panic!("{name}: {diagnostic}"));
        assert_eq!(report.tremor_count, 0, "{name}: {:?}", report.tremors);
    }
}

#[test]
fn bench_programs_keep_limits_and_tolerance_and_beat_stopping() {
    for (name, profile, stopping_t, optimal_t) in BENCH {
        let path = data(&format!("bench/{name}.ngc"));
        for smoothing in [
            Smoothing::Auto,
            Smoothing::Sextic,
            Smoothing::BezierPair,
            Smoothing::ExactStop,
        ] {
            let report = plan(
                &path,
                profile.settings(smoothing),
                Options::default(),
                |_| (),
            )
            .unwrap_or_else(|diagnostic| panic!("{name}: {diagnostic}"));
            assert!(
                report.is_clean() && report.is_complete,
                "{name} {smoothing:?}: {report:#?}"
            );
            assert!(
                report.max_deviation_mm <= profile.tolerance_mm,
                "{name} {smoothing:?}: {} mm",
                report.max_deviation_mm
            );
            // A motion begins and ends between samples: a period at each end.
            let most_t = match smoothing {
                Smoothing::Auto => 1.03 * optimal_t + 2.0 * PERIOD_T,
                _ => stopping_t + 2.0 * PERIOD_T,
            };
            assert!(
                report.cycle_time_s <= most_t,
                "{name} {smoothing:?}: {}",
                report.cycle_time_s
            );
        }
    }
}

#[test]
fn plots_show_the_deviation_that_the_auditor_finds_on_either_side_of_corners() {
    for (name, profile, ..) in BENCH {
        for effort in [Effort::Optimal, Effort::Fast] {
            for corners in [Corners::Either, Corners::Inner] {
                let settings = Settings {
                    effort,
                    corners,
                    ..profile.settings(Smoothing::Auto)
                };
                let path = data(&format!("bench/{name}.ngc"));
                let report = plan(&path, settings, Options::default(), |_| ());
                assert!(report.is_ok(), "{name} {effort:?} {corners:?}: {report:?}");
            }
        }
    }
}

/// Compares with kept plans, to a nanometre: not to the bit, since another machine may round
/// otherwise. `GLIDEPATH_BLESS=1` keeps the plans of today.
#[test]
fn plans_are_those_kept() {
    let bless = std::env::var_os("GLIDEPATH_BLESS").is_some();
    for (name, profile, smoothing, every) in [
        ("seed5_seed", SEED, Smoothing::Sextic, 1),
        ("zigzag_mill", MILL, Smoothing::Sextic, 20),
        ("butterfly_g1_seed", SEED, Smoothing::Sextic, 40),
        ("seed5_mill", MILL, Smoothing::Auto, 1),
        ("square20_mill", MILL, Smoothing::Auto, 5),
        ("zigzag_seed", SEED, Smoothing::Auto, 5),
    ] {
        let mut plan_text = String::from("sequence,line,X,Y,Z\n");
        let path = data(&format!("bench/{name}.ngc"));
        let settings = profile.settings(smoothing);
        plan(&path, settings, Options::default(), |frame| {
            if frame.sequence % every == 0 {
                let [x, y, z] = [0, 1, 2].map(|i| frame.position[i]);
                writeln!(
                    plan_text,
                    "{},{},{x:.9},{y:.9},{z:.9}",
                    frame.sequence, frame.line
                )
                .expect("text");
            }
        })
        .unwrap_or_else(|diagnostic| panic!("{name}: {diagnostic}"));
        let kept_path = data(&format!("golden/{name}.csv"));
        if bless {
            std::fs::write(&kept_path, &plan_text).expect("writable");
        }
        let kept = std::fs::read_to_string(&kept_path).expect("a kept plan");
        assert_eq!(
            plan_text.lines().count(),
            kept.lines().count(),
            "{name}: number of frames"
        );
        for (now, then) in plan_text.lines().zip(kept.lines()).skip(1) {
            let close = now.split(',').zip(then.split(',')).all(|(a, b)| {
                let number = |text: &str| text.parse::<f64>().expect("a number");
                (number(a) - number(b)).abs() <= 2e-9
            });
            assert!(close, "{name}: {now} where {then} was kept");
        }
    }
}

/// Multiplies coordinates and feedrates of a bench program.
fn scaled(text: &str, factor: f64) -> String {
    let word = |word: &str| match word.split_at(word.len().min(1)) {
        (letter @ ("X" | "Y" | "Z" | "F"), number) => {
            format!(
                "{letter}{}",
                number.parse::<f64>().expect("a number") * factor
            )
        }
        _ => word.to_owned(),
    };
    let line = |line: &str| match line.starts_with('(') {
        true => line.to_owned(),
        false => line.split(' ').map(word).collect::<Vec<_>>().join(" "),
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Positions at every period of a bench program on its machine, both told in another unit of
/// length.
fn motion_in_unit(
    name: &str,
    profile: Profile,
    smoothing: Smoothing,
    factor: f64,
) -> Vec<AxisVector> {
    let (velocity, acceleration, jerk) = profile.limits;
    let settings = Settings {
        limits: Limits::uniform(factor * velocity, factor * acceleration, factor * jerk),
        tolerance_mm: factor * profile.tolerance_mm,
        ..profile.settings(smoothing)
    };
    let text = std::fs::read_to_string(data(&format!("bench/{name}.ngc"))).expect("a program");
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(&file, scaled(&text, factor)).expect("writable");
    let mut positions = Vec::new();
    let report = plan(file.path(), settings, Options::default(), |frame| {
        positions.push(frame.position);
    })
    .unwrap_or_else(|diagnostic| panic!("{name}: {diagnostic}"));
    assert!(report.is_clean(), "{name} x {factor}: {report:#?}");
    positions
}

/// A share of the programs' size in which no move is as long as those that are straight in their middle half (5 mm): that
/// length, and what such a line may bend, are the only ones that are built into the planner.
const SMALL: f64 = 1.0 / 64.0;

/// Motion is the same to the bit where the unit of length changes by a power of two, so that nothing is rounded
/// otherwise. `glidepath-motion` tests the same in the tube.
#[test]
fn motion_does_not_depend_on_the_unit_of_length() {
    for (name, profile, ..) in BENCH {
        let smoothing = Smoothing::Sextic;
        let motion = motion_in_unit(name, profile, smoothing, SMALL);
        let smaller: Vec<_> = motion.iter().map(|position| position / 64.0).collect();
        let other = motion_in_unit(name, profile, smoothing, SMALL / 64.0);
        let is_same = other == smaller;
        assert!(is_same, "{name}");
        let tenths = motion_in_unit(name, profile, smoothing, 0.1 * SMALL);
        assert_eq!(motion.len(), tenths.len(), "{name}");
    }
}

/// The corpus programs that a run of the test leaves out unless `GLIDEPATH_LONG` is set: hours of
/// motion, minutes of audit.
const LONG: [&str; 3] = [
    "dense/finish-tiger-65k.nc",
    "axes/4axis-rotary-xza-51k.ngc",
    "dense/engrave-dxf473-119k.gcode",
];

#[test]
fn corpus_programs_keep_limits_and_tolerance() {
    let Some(corpus) = glidepath_testing::corpus() else {
        return;
    };
    let long = std::env::var_os("GLIDEPATH_LONG").is_some();
    let text = std::fs::read_to_string(corpus.join("EXPECTED.json")).expect("EXPECTED.json");
    let expected: Value = serde_json::from_str(&text).expect("JSON");
    let mut planned = 0;
    for program in expected["programs"].as_array().expect("programs") {
        let name = program["file"].as_str().expect("file");
        if LONG.contains(&name) && !long {
            continue;
        }
        let accepted = program["accepted"] == true || program["missing_program_end"] == true;
        let applicable = program["linuxcnc_applicable"] == true;
        let settings = MILL.settings(Smoothing::Sextic);
        let options = Options {
            default_feed_mm_min: Some(1000.0),
            ..Options::default()
        };
        let report = match plan(&corpus.join(name), settings, options, |_| ()) {
            Ok(report) => report,
            Err(diagnostic) => {
                eprintln!("{name}: refused, {diagnostic}");
                continue;
            }
        };
        planned += 1;
        eprintln!(
            "{name}: {} segments, {:.2} s, {:.4} mm",
            report.segments, report.cycle_time_s, report.max_deviation_mm
        );
        assert!(
            report.is_clean() && report.is_complete,
            "{name}: {report:#?}"
        );
        if accepted && applicable && program["complete"] == true {
            let ends = program["final_mm_deg"].as_object().expect("final_mm_deg");
            for (letter, value) in ends {
                let axis = letter
                    .chars()
                    .next()
                    .and_then(glidepath_geometry::Axis::from_letter);
                let (Some(axis), Some(value)) = (axis, value.as_f64()) else {
                    continue;
                };
                let end = report.final_position[axis.index()];
                let close = (end - value).abs() <= 1e-6 * value.abs().max(1.0);
                assert!(
                    close || DIFFERENT_ENDS.contains(&(name, axis.letter())),
                    "{name}: {axis} ends at {end}, expected {value}"
                );
            }
        }
    }
    assert!(planned > 30, "only {planned} programs planned");
}

/// Ends that differ from the reference: there G92 and G92.1 move the reported position, and
/// nothing else.
const DIFFERENT_ENDS: [(&str, char); 2] = [
    ("axes/4axis-rotary-xza-51k.ngc", 'A'),
    ("spline/quadratic-g51-text.ngc", 'X'),
];
