//! Tests of NURBS of all tolerances at all periods: the chord between two setpoints is within the
//! tolerance.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_gcode::Options;
use glidepath_planner::{NurbsSource, Output, Pipeline};
use glidepath_program::{Effort, Limits, Settings, Smoothing};
use std::path::Path;

const CURVES: [&str; 5] = ["butterfly", "trident_like", "needle", "star", "infinity"];
const TOLERANCES_MM: [f64; 5] = [0.001, 0.003, 0.01, 0.02, 0.05];
const PERIODS_T: [f64; 4] = [0.001, 0.002, 0.004, 0.008];

fn judged(text: &str, settings: Settings) -> AuditReport {
    let options = Options {
        default_feed_mm_min: Some(6000.0),
        ..Options::default()
    };
    let from = options.start;
    let source = NurbsSource::new(text.to_owned(), options, &settings).unwrap();
    let mut pipeline = Pipeline::new(source, settings, from);
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    loop {
        match pipeline.advance().unwrap() {
            Output::Item(item) => audit.program(&item),
            Output::Frame(frame) => audit.sample(&(&frame).into()),
            Output::Pending => {}
            Output::End => return audit.finish(),
        }
    }
}

#[test]
fn no_chord_is_beyond_the_tolerance() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/method");
    let mut beyond = Vec::new();
    for name in CURVES {
        let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
        for limits in [
            Limits::uniform(200.0, 2000.0, 40_000.0),
            Limits::uniform(100.0, 10_000.0, 1e6),
        ] {
            for tolerance_mm in TOLERANCES_MM {
                for period_t in PERIODS_T {
                    // With both a NURBS is driven along its path.
                    let both = [Effort::Fast, Effort::Optimal];
                    let count = if name == "needle" { 2 } else { 1 };
                    for effort in both.into_iter().take(count) {
                        let report = judged(
                            &text,
                            Settings {
                                limits,
                                tolerance_mm,
                                direction: glidepath_program::DirectionTolerance::default(),
                                smoothing: Smoothing::Auto,
                                corners: glidepath_program::Corners::default(),
                                period_t,
                                effort,
                            },
                        );
                        if !report.is_clean() {
                            let share = report.max_deviation_mm / tolerance_mm;
                            beyond.push(format!(
                                "{name} {tolerance_mm} mm {period_t} s {effort:?} a {}: {share:.4} of it, {}",
                                limits.acceleration[0], report.violations[0]
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(
        beyond.is_empty(),
        "{}:\n{}",
        beyond.len(),
        beyond.join("\n")
    );
}
