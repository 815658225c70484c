//! Tests of NURBS files to frames, and what is wrong with them.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

use crate::support::items::settings;
use glidepath_audit::{Audit, AuditSettings};
use glidepath_gcode::{AxisTravel, Diagnostic, DiagnosticCode, Machine, Options, Program};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_motion::Planner;
use glidepath_planner::{ItemSource, NurbsSource, Output, Pipeline, Supply};
use glidepath_program::{Frame, Item, ItemKind};

const ARCH: &str = "\
kind = \"nurbs\"
feed = 3000.0
degree = 3
control_points = [[0.0, 0.0], [0.0, 20.0], [30.0, 20.0], [30.0, 0.0]]
weights = [1.0, 0.5, 2.0, 1.0]
knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]
";

/// The same curve as a program: G6.2, and in the form of FANUC.
const ARCH_G6_2: &str = "\
G6.2 P4 F3000 X0 Y0 R1 K0
X0 Y20 R0.5 K0
X30 Y20 R2 K0
X30 Y0 R1 K0
K1
K1
K1
K1
";

fn refused(text: &str, options: Options) -> Diagnostic {
    match NurbsSource::new(text.to_owned(), options, &settings()) {
        Err(diagnostic) => *diagnostic,
        Ok(source) => source.check().diagnostics.into_iter().next().unwrap(),
    }
}

/// Plans, audits, and returns the frames.
fn planned(text: &str, options: Options) -> Vec<Frame> {
    let from = options.start;
    let source = NurbsSource::new(text.to_owned(), options, &settings()).unwrap();
    let mut pipeline = Pipeline::new(source, settings(), from);
    let mut audit = Audit::new(&AuditSettings::from(&settings()));
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
        report.is_clean() && report.is_complete,
        "{:?}",
        report.violations
    );
    frames
}

#[test]
fn a_curve_begins_with_a_rapid_and_leaves_other_axes_where_they_are() {
    let mut start = AxisVector::zeros();
    (start[0], start[2]) = (-5.0, 7.0);
    let options = Options {
        start,
        ..Options::default()
    };
    let frames = planned(ARCH, options);
    let last = frames.last().unwrap().position;
    let mut end = AxisVector::zeros();
    (end[0], end[2]) = (30.0, 7.0);
    assert_eq!(last, end);
    assert!(
        frames
            .iter()
            .all(|frame| frame.position[2].to_bits() == 7.0_f64.to_bits())
    );
    assert!(frames.iter().any(|frame| frame.position[1] > 12.0));
}

#[test]
fn a_program_of_the_same_curve_moves_alike() {
    let by_file = planned(ARCH, Options::default());
    let items: Vec<Item> = Program::new(ARCH_G6_2.as_bytes(), Options::default())
        .map(Result::unwrap)
        .collect();
    let mut planner = Planner::new(settings(), AxisVector::zeros());
    let mut by_program = Vec::new();
    for item in items
        .iter()
        .filter(|item| matches!(item.kind, ItemKind::Move { .. }))
    {
        planner.push(item).unwrap();
    }
    planner.finish();
    while let Some(frame) = planner.pop_frame().unwrap() {
        by_program.push(frame);
    }
    let positions = |frames: &[Frame]| -> Vec<AxisVector> {
        frames.iter().map(|frame| frame.position).collect()
    };
    let (file, program) = (positions(&by_file), positions(&by_program));
    assert!(
        file.len().abs_diff(program.len()) <= 2,
        "{} {}",
        file.len(),
        program.len()
    );
    let gap = |i: usize| (file[i] - program[i]).norm();
    let most = (0..file.len().min(program.len()))
        .map(gap)
        .fold(0.0, f64::max);
    assert!(most < 0.05, "{most}");
}

#[test]
fn rotary_axes_go_along_within_the_tolerance() {
    let text = ARCH
        .replace("[0.0, 0.0], [0.0, 20.0], [30.0, 20.0], [30.0, 0.0]",
            "[0.0, 0.0, 0.0, 0.0], [0.0, 20.0, 0.0, 10.0], [30.0, 20.0, 0.0, 30.0], [30.0, 0.0, 0.0, 0.0]");
    let machine = Machine::new(&[Axis::X, Axis::Y, Axis::Z, Axis::A]);
    let options = Options {
        machine,
        ..Options::default()
    };
    let frames = planned(&text, options);
    assert!(frames.iter().any(|frame| frame.position[3] > 15.0));
}

#[test]
fn findings_have_a_place_and_a_remedy() {
    let place = |text: &str| {
        let diagnostic = refused(text, Options::default());
        assert!(!diagnostic.help.is_empty());
        (
            diagnostic.line,
            diagnostic.column,
            diagnostic.code,
            diagnostic.message,
        )
    };
    let (line, column, code, message) = place(&ARCH.replace("0.5", "-0.5"));
    assert_eq!((line, column, code), (5, 17, DiagnosticCode::CurveFile));
    assert_eq!(message, "weight 1 is -0.5: weights are greater than zero");
    let (line, _, code, _) =
        place(&ARCH.replace("0.0, 1.0, 1.0, 1.0, 1.0", "0.0, 1.0, 0.5, 1.0, 1.0"));
    assert_eq!((line, code), (6, DiagnosticCode::CurveFile));
    let (line, _, code, message) = place(&ARCH.replace("degree = 3", "degree = 7"));
    assert_eq!((line, code), (4, DiagnosticCode::CurveFile), "{message}");
    let (line, _, code, _) = place(&ARCH.replace("feed = 3000.0\n", ""));
    assert_eq!((line, code), (3, DiagnosticCode::MissingFeed));
    let (line, _, code, _) = place(&ARCH.replace("\"nurbs\"", "\"spiral\""));
    assert_eq!((line, code), (1, DiagnosticCode::CurveFile));
    let (line, _, code, _) = place(
        "{\"degree\": 1,\n \"control_points\": [[0, 0], [1, 0]],\n \"knots\": [0, 0, 1, 0.5]}",
    );
    assert_eq!((line, code), (3, DiagnosticCode::CurveFile));
}

#[test]
fn the_machine_must_have_the_axes_and_the_travel() {
    let narrow = Machine::new(&[Axis::X, Axis::Y, Axis::Z]).with_travel(
        Axis::Y,
        AxisTravel {
            min: -1.0,
            max: 10.0,
        },
    );
    let diagnostic = refused(
        ARCH,
        Options {
            machine: narrow,
            ..Options::default()
        },
    );
    assert_eq!(
        (diagnostic.code, diagnostic.line),
        (DiagnosticCode::SoftLimit, 4)
    );
    let flat = Machine::new(&[Axis::X]);
    let diagnostic = refused(
        ARCH,
        Options {
            machine: flat,
            ..Options::default()
        },
    );
    assert_eq!(diagnostic.code, DiagnosticCode::Curve);
    assert!(
        diagnostic.message.contains("no axis Y"),
        "{}",
        diagnostic.message
    );
}

#[test]
fn the_fingerprint_tells_curves_apart() {
    let of = |text: &str| {
        NurbsSource::new(text.to_owned(), Options::default(), &settings())
            .unwrap()
            .fingerprint()
    };
    assert_ne!(of(ARCH), of(&ARCH.replace("20.0", "21.0")));
    let mut source = NurbsSource::new(ARCH.to_owned(), Options::default(), &settings()).unwrap();
    while let Supply::Item(item) = source.next_item() {
        assert_eq!(item.line, 4);
    }
}
