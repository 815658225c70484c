//! Tests of space curves, in parametric and in implicit form, on a Cartesian machine and on a
//! hexapod: the motion is within the tolerance of the true curve, limits of axes and joints are
//! kept, chords are equal, and nothing drifts in ten laps.

#![allow(clippy::unwrap_used, clippy::panic, reason = "test code")]

use crate::support::items::settings;
use core::f64::consts::TAU;
use glidepath_audit::{Audit, AuditSettings};
use glidepath_curve::ParametricCurve;
use glidepath_gcode::Options;
use glidepath_geometry::{AxisVector, Segment};
use glidepath_kinematics::{
    Hexapod, JointLimit, JointLimits, JointWatch, LimitedMechanism, Mechanism,
};
use glidepath_planner::{CurveSource, Output, Pipeline};
use glidepath_program::{ItemKind, Settings};
use nalgebra::Vector3;

/// mm, everything included.
const TOLERANCE_MM: f64 = 0.1;
/// mm/s, and the way of one period at it.
const FEED_V: f64 = 100.0;
const CHORD_MM: f64 = 0.4;
const LAPS: u32 = 10;

/// A curve in both forms, where a hexapod can reach it, starting at t = 0.
struct Case {
    name: &'static str,
    xyz: [&'static str; 3],
    fg: [&'static str; 2],
    /// Of t, per lap.
    lap_t: f64,
    is_closed: bool,
}

const CASES: [Case; 5] = [
    Case {
        name: "Viviani",
        // From the top, so that the start is no node.
        xyz: ["20*(1-cos(t))", "-20*sin(t)", "500+40*cos(t/2)"],
        fg: ["x^2+y^2+(z-500)^2-1600", "(x-20)^2+y^2-400"],
        lap_t: 2.0 * TAU,
        is_closed: true,
    },
    Case {
        name: "plane, sphere",
        xyz: ["20*cos(t)", "20*sin(t)", "515"],
        fg: ["x^2+y^2+(z-500)^2-625", "z-515"],
        lap_t: TAU,
        is_closed: true,
    },
    Case {
        name: "cylinders",
        xyz: ["15*cos(t)", "15*sin(t)", "500+sqrt(400-225*sin(t)^2)"],
        fg: ["x^2+y^2-225", "y^2+(z-500)^2-400"],
        lap_t: TAU,
        is_closed: true,
    },
    Case {
        name: "ellipse",
        xyz: ["40*cos(t)", "15*sin(t)", "500"],
        fg: ["(x/40)^2+(y/15)^2-1", "z-500"],
        lap_t: TAU,
        is_closed: true,
    },
    Case {
        name: "helix",
        xyz: ["15*cos(t)", "15*sin(t)", "450+t"],
        fg: ["x-15*cos(z-450)", "y-15*sin(z-450)"],
        lap_t: TAU,
        is_closed: false,
    },
];

impl Case {
    fn curve(&self) -> ParametricCurve {
        ParametricCurve::parse(self.xyz).unwrap()
    }

    fn common(&self) -> String {
        let mut text = format!(
            "feed = {}\ntolerance = {TOLERANCE_MM:?}\nchord = {CHORD_MM:?}\n",
            60.0 * FEED_V
        );
        if self.is_closed {
            text.push_str(&format!("laps = {}\n", LAPS));
        }
        text
    }

    fn parametric(&self) -> String {
        let [x, y, z] = self.xyz;
        let turns = if self.is_closed { 1 } else { LAPS };
        let to = self.lap_t * f64::from(turns);
        let head = format!("kind = \"parametric\"\nx = \"{x}\"\ny = \"{y}\"\nz = \"{z}\"\n");
        format!("{head}from = 0\nto = {to:?}\n{}", self.common())
    }

    fn implicit(&self) -> String {
        let ([f, g], at) = (self.fg, self.curve().local(0.0));
        let vector = |v: Vector3<f64>| format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z);
        let (start, direction) = (vector(at.point), vector(at.d1));
        let end = if self.is_closed {
            "\"closed\"".to_owned()
        } else {
            vector(self.curve().point(self.lap_t * f64::from(LAPS)))
        };
        let head = format!("kind = \"implicit\"\nf = \"{f}\"\ng = \"{g}\"\nstart = {start}\n");
        format!(
            "{head}direction = {direction}\nend = {end}\n{}",
            self.common()
        )
    }
}

/// Joints of a hexapod that are no stronger than they have to be.
struct Joints {
    caps: LimitedMechanism,
    watch: JointWatch,
}

fn hexapod() -> (Settings, Joints) {
    let mechanism = Mechanism::Hexapod(Hexapod::paired(400.0, 150.0, 15.0));
    let joint = JointLimit {
        min_position: 430.0,
        max_position: 720.0,
        velocity: 60.0,
        acceleration: 1500.0,
        jerk: 40_000.0,
    };
    let mut limits = JointLimits::NONE;
    limits.0[..6].fill(joint);
    let settings = settings();
    let joints = Joints {
        caps: LimitedMechanism { mechanism, limits },
        watch: JointWatch::new(mechanism, limits, settings.period_t),
    };
    (settings, joints)
}

/// The distance of a point from a curve, near a parameter that follows.
fn off_mm(curve: &ParametricCurve, p: &Vector3<f64>, near_t: &mut f64) -> f64 {
    for _ in 0..30 {
        let at = curve.local(*near_t);
        let out = at.point - p;
        let step = out.dot(&at.d1) / (at.d1.norm_squared() + out.dot(&at.d2)).max(1.0);
        *near_t -= step;
        if step.abs() < 1e-14 {
            break;
        }
    }
    (curve.point(*near_t) - p).norm()
}

fn xyz(position: &AxisVector) -> Vector3<f64> {
    position.fixed_rows::<3>(0).into_owned()
}

/// Plans a curve and judges all of it; the cycle time in s.
fn judge(case: &Case, text: &str, settings: Settings, mut joints: Option<Joints>) -> f64 {
    let curve = case.curve();
    let mut from = AxisVector::zeros();
    from.fixed_rows_mut::<3>(0).copy_from(&curve.point(0.0));
    let options = Options {
        start: from,
        ..Options::default()
    };
    let source = CurveSource::new(text.to_owned(), options, &settings).unwrap();
    let mut pipeline =
        Pipeline::new(source, settings, from).with_joints(joints.as_ref().map(|j| j.caps));
    let mut audit = Audit::new(&AuditSettings {
        limits: settings.limits,
        period_t: settings.period_t,
        tolerance_mm: TOLERANCE_MM,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    });
    let (mut chord_t, mut frame_t, mut uneven) = (0.0, 0.0, 0);
    let mut end = from;
    loop {
        match pipeline.advance().unwrap() {
            Output::Item(item) => {
                audit.program(&item);
                let ItemKind::Move { segment, .. } = item.kind else {
                    continue;
                };
                assert!(matches!(segment, Segment::Line(_)));
                end = segment.end();
                // Every chord ends on the curve, in the last lap as in the first.
                let off = off_mm(&curve, &xyz(&end), &mut chord_t);
                assert!(off <= 1e-9, "{}: {off} at {chord_t}", case.name);
                let is_even = (segment.length() - CHORD_MM).abs() <= 1e-9;
                uneven += u32::from(!is_even);
            }
            Output::Frame(frame) => {
                audit.sample(&(&frame).into());
                let off = off_mm(&curve, &xyz(&frame.position), &mut frame_t);
                assert!(off <= TOLERANCE_MM, "{}: {off} at {frame_t}", case.name);
                if let Some(joints) = &mut joints {
                    joints.watch.take(&frame.position).unwrap();
                }
            }
            Output::Pending => {}
            Output::End => break,
        }
    }
    let report = audit.finish();
    assert!(
        report.violations.is_empty(),
        "{}: {:?}",
        case.name,
        report.violations
    );
    // What is left at the end of each lap, and at the end of the curve.
    assert!(uneven <= LAPS, "{}: {uneven}", case.name);
    let last_t = case.lap_t * f64::from(LAPS);
    assert!((chord_t - last_t).abs() < 1e-9 * last_t, "{}", case.name);
    assert!(
        (xyz(&end) - curve.point(last_t)).norm() <= 1e-9,
        "{}",
        case.name
    );
    report.cycle_time_s
}

#[test]
fn space_curves_on_a_cartesian_machine_and_on_a_hexapod() {
    for case in &CASES {
        for text in [case.parametric(), case.implicit()] {
            let cartesian_t = judge(case, &text, settings(), None);
            let (settings, joints) = hexapod();
            let hexapod_t = judge(case, &text, settings, Some(joints));
            println!("{:14} {cartesian_t:8.3} s {hexapod_t:8.3} s", case.name);
        }
    }
}
