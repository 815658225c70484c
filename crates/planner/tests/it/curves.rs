//! Tests of curve files to frames: the whole way from a formula to setpoints keeps the tolerance,
//! lap after lap.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

use crate::support::items::settings;
use glidepath_audit::{Audit, AuditSettings};
use glidepath_curve::{ImplicitCurve, ParametricCurve};
use glidepath_gcode::{AxisTravel, Diagnostic, DiagnosticCode, Machine, Options};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_planner::{CurveSource, Output, Pipeline};
use glidepath_program::Frame;
use nalgebra::Vector3;

const VIVIANI: &str = "\
kind = \"implicit\"
f = \"x^2 + y^2 + z^2 - 1600\"
g = \"(x - 20)^2 + y^2 - 400\"
start = [20.0, 20.0, 28.2843]
direction = [-1.0, 0.0, 0.0]
end = \"closed\"
laps = 10
feed = 3000.0
";

const CYLINDERS: &str = "\
kind = \"parametric\"
x = \"15*cos(t)\"
y = \"15*sin(t)\"
z = \"sqrt(400 - 225*sin(t)^2)\"
from = 0
to = \"2*pi\"
laps = 10
feed = 3000.0
";

fn start_at(point: [f64; 3]) -> Options {
    let mut start = AxisVector::zeros();
    start.as_mut_slice()[..3].copy_from_slice(&point);
    Options {
        start,
        ..Options::default()
    }
}

/// Plans, audits, and returns the frames.
fn planned(text: &str, start: [f64; 3]) -> Vec<Frame> {
    let (options, settings) = (start_at(start), settings());
    let from = options.start;
    let source = CurveSource::new(text.to_owned(), options, &settings).unwrap();
    let mut pipeline = Pipeline::new(source, settings, from);
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    let mut frames = Vec::new();
    loop {
        match pipeline.advance().unwrap() {
            Output::Item(item) => audit.program(&item),
            Output::Frame(frame) => {
                audit.sample(&(&frame).into());
                frames.push(frame);
            }
            Output::Pending => {}
            Output::End => break,
        }
    }
    let report = audit.finish();
    assert!(
        report.violations.is_empty(),
        "{:?}",
        report.violations.first()
    );
    frames
}

/// Distance of a frame from a curve: over the residual, corrected by the angle of the surfaces,
/// which away from nodes is the distance to first order.
fn off_mm(frame: &Frame, curve: &ParametricCurve, near_t: &mut f64) -> f64 {
    let p: Vector3<f64> = frame.position.fixed_rows::<3>(0).into_owned();
    for _ in 0..30 {
        let at = curve.local(*near_t);
        let out = at.point - p;
        *near_t -= out.dot(&at.d1) / (at.d1.norm_squared() + out.dot(&at.d2)).max(1.0);
    }
    (curve.point(*near_t) - p).norm()
}

/// The laps' motion: within the tolerance of the true curve, and as good late as early.
fn laps_keep_to(frames: &[Frame], curve: &ParametricCurve, start_t: f64, lap_t: f64) {
    let tolerance_mm = settings().tolerance_mm;
    let mut t = start_t;
    let mut worst = [0.0_f64; 11];
    for frame in frames {
        let off = off_mm(frame, curve, &mut t);
        assert!(off <= tolerance_mm, "{off} at t = {t}");
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 to 10"
        )]
        let lap = (((t - start_t) / lap_t).max(0.0) as usize).min(10);
        worst[lap] = worst[lap].max(off);
    }
    assert!((t - start_t - 10.0 * lap_t).abs() < 1e-6, "ten laps: {t}");
    let last = frames.last().unwrap().position;
    let start = curve.point(start_t);
    assert!((last.fixed_rows::<3>(0) - start).norm() < 1e-6);
    // Chords repeat exactly; the motion differs by where its periods fall on them. In the first lap and
    // in the last one it swings in from a line, and out onto one.
    assert!(
        worst[8] < 1.5 * worst[1] && worst[1] < 1.5 * worst[8],
        "{worst:?}"
    );
}

#[test]
fn ten_laps_of_a_parametric_curve() {
    let frames = planned(CYLINDERS, [15.0, 0.0, 20.0]);
    let curve =
        ParametricCurve::parse(["15*cos(t)", "15*sin(t)", "sqrt(400 - 225*sin(t)^2)"]).unwrap();
    laps_keep_to(&frames, &curve, 0.0, std::f64::consts::TAU);
}

#[test]
fn ten_laps_of_an_implicit_curve_through_its_node() {
    let curve = ParametricCurve::parse(["20*(1+cos(t))", "20*sin(t)", "40*sin(t/2)"]).unwrap();
    let start_t = 0.5 * std::f64::consts::PI;
    let start = curve.point(start_t);
    // The file's start is rounded; here the laps must end where the formula says.
    let exact = VIVIANI.replace("28.2843", "28.284271247461902");
    let frames = planned(&exact, start.into());
    laps_keep_to(&frames, &curve, start_t, 2.0 * std::f64::consts::TAU);
}

#[test]
fn the_machine_goes_to_the_start_and_rests_there() {
    let frames = planned(CYLINDERS, [0.0, 0.0, 50.0]);
    let start = Vector3::new(15.0, 0.0, 20.0);
    let at = |frame: &Frame| (frame.position.fixed_rows::<3>(0) - start).norm();
    assert!(
        frames
            .iter()
            .any(|frame| at(frame) < 1e-9 && frame.velocity.norm() < 1e-9)
    );
}

fn refused(text: &str, options: Options) -> Diagnostic {
    match CurveSource::new(text.to_owned(), options, &settings()) {
        Ok(source) => source.check().diagnostics.remove(0),
        Err(mut diagnostics) => diagnostics.remove(0),
    }
}

#[test]
fn findings_have_line_and_column() {
    let wrong = refused(&VIVIANI.replace("x - 20", "x - a"), Options::default());
    assert_eq!(
        (wrong.code, wrong.line, wrong.column),
        (DiagnosticCode::CurveFile, 3, 11)
    );
    assert_eq!(wrong.excerpt.text, "g = \"(x - a)^2 + y^2 - 400\"");
    let off = refused(&VIVIANI.replace("28.2843", "29.0"), Options::default());
    assert_eq!((off.code, off.line), (DiagnosticCode::Curve, 4));
    let no_feed = refused(&VIVIANI.replace("feed = 3000.0\n", ""), Options::default());
    assert_eq!(no_feed.code, DiagnosticCode::MissingFeed);
    // sqrt becomes undefined in the middle of the curve.
    let half = refused(&CYLINDERS.replace("400 -", "200 -"), Options::default());
    assert_eq!((half.code, half.line), (DiagnosticCode::Curve, 2));
    let machine = Machine::new(&[Axis::X, Axis::Y]);
    let flat = refused(
        CYLINDERS,
        Options {
            machine,
            ..Options::default()
        },
    );
    assert!(flat.message.contains("no axis Z"), "{}", flat.message);
    let machine = Machine::unlimited().with_travel(
        Axis::Y,
        AxisTravel {
            min: -10.0,
            max: 100.0,
        },
    );
    let outside = refused(
        CYLINDERS,
        Options {
            machine,
            ..Options::default()
        },
    );
    assert_eq!(outside.code, DiagnosticCode::SoftLimit);
    assert!(outside.message.contains("Y-10"), "{}", outside.message);
}

#[test]
fn a_check_counts_what_will_be_run() {
    let source = CurveSource::new(CYLINDERS.to_owned(), start_at([0.0; 3]), &settings()).unwrap();
    let report = source.check();
    assert!(report.is_accepted());
    assert!(
        (report.totals.feed_length_mm - 988.8).abs() < 0.2,
        "{}",
        report.totals.feed_length_mm
    );
    assert_eq!(report.totals.rapids, 1);
    assert_eq!(report.totals.straight_feeds % 10, 0);
    let judge = ImplicitCurve::parse(["x^2 + y^2 - 225", "y^2 + z^2 - 400"]).unwrap();
    let end: Vector3<f64> = report.final_position.fixed_rows::<3>(0).into_owned();
    assert!(judge.residual_mm(&end) < 1e-9);
}
