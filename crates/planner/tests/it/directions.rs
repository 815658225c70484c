//! The direction of the tool on machines with five axes and six struts: never further from the programmed one than its
//! tolerance, with both efforts, by the auditor and by a search over the program that shares nothing with either.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stderr,
    reason = "a test that fails may panic, and tells why"
)]

use crate::joints::machines::{Machine, machines};
use crate::joints::tool::tool_axis;
use crate::support::random::Random;
use core::fmt::Write as _;
use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_kinematics::Mechanism;
use glidepath_planner::{Output, Pipeline, ProgramSource};
use glidepath_program::{
    Corners, DirectionTolerance, Effort, ItemKind, Limits, Settings, Smoothing,
};
use nalgebra::{Rotation3, Unit, Vector3};

const TOLERANCE_MM: f64 = 0.02;
/// Points of each programmed move that a setpoint may be near, and how often the best of them is looked at more closely.
const POINTS: u32 = 40;
const ROUNDS: u32 = 4;
/// Every so many setpoints one is looked at.
const STEP: usize = 12;

/// The direction of the tool by rotations of a library.
fn direction(machine: &Machine, at: &AxisVector) -> Vector3<f64> {
    let turned = |about: Vector3<f64>, deg: f64| {
        Rotation3::from_axis_angle(&Unit::new_normalize(about), deg.to_radians())
    };
    let tool = match &machine.mechanism {
        Mechanism::FiveAxis(five) => {
            let sign = |reversed: bool| if reversed { -1.0 } else { 1.0 };
            let about = match &five.tilt {
                glidepath_kinematics::Tilt::A => Vector3::x(),
                glidepath_kinematics::Tilt::B => Vector3::y(),
                glidepath_kinematics::Tilt::Skewed(skewed) => *skewed.direction(),
            };
            let tilt = turned(
                about,
                sign(five.tilt_reversed) * at[five.tilt_axis().index()],
            );
            let rotary = turned(Vector3::z(), sign(five.rotary_reversed) * at[5]);
            match five.rotaries {
                // The work turns: what it sees is the other way round.
                glidepath_kinematics::Rotaries::TableTable { .. } => (tilt * rotary).inverse(),
                glidepath_kinematics::Rotaries::HeadHead { .. } => rotary * tilt,
                glidepath_kinematics::Rotaries::TableHead { .. } => rotary.inverse() * tilt,
            }
        }
        _ => {
            turned(Vector3::z(), at[5]) * turned(Vector3::y(), at[4]) * turned(Vector3::x(), at[3])
        }
    };
    tool * Vector3::z()
}

fn settings(machine: &Machine, effort: Effort, angle_deg: Option<f64>) -> Settings {
    let mut limits = Limits::uniform(Limits::UNLIMITED, Limits::UNLIMITED, Limits::UNLIMITED);
    for (axis, low, high) in &machine.travel {
        let k = axis.index();
        (limits.velocity[k], limits.acceleration[k], limits.jerk[k]) = (300.0, 3000.0, 60_000.0);
        (limits.travel.lowest[k], limits.travel.highest[k]) = (*low, *high);
    }
    let travel = limits.travel;
    Settings {
        limits,
        tolerance_mm: TOLERANCE_MM,
        direction: DirectionTolerance {
            angle_deg,
            turn_r: machine
                .mechanism
                .direction_gain(&travel.lowest, &travel.highest),
        },
        smoothing: Smoothing::Auto,
        corners: Corners::Inner,
        period_t: 0.004,
        effort,
    }
}

/// Moves of all axes with corners, some long, some short, rows of dense lines among them.
fn program(machine: &Machine, seed: u64) -> String {
    let mut random = Random(seed);
    let mut text = String::from("G21 G90 G94 G17 G64 F6000\n");
    let mut place = machine.home;
    for _ in 0..12 {
        let mut next = place;
        let size = random.of(&[1.0, 4.0, 12.0]);
        for (axis, low, high) in &machine.travel {
            let k = axis.index();
            let way = (random.share() - 0.5) * size * if axis.is_rotary() { 2.0 } else { 1.0 };
            let room = 0.3 * (high - low);
            let middle = 0.5 * (low + high);
            next[k] = (place[k] + way).clamp(middle - room, middle + room);
        }
        let parts = random.of(&[1, 1, 1, 8]);
        for part in 1..=parts {
            let share = f64::from(part) / f64::from(parts);
            text.push_str("G1");
            for (axis, ..) in &machine.travel {
                let k = axis.index();
                // A row of dense lines that bends.
                let bend = 0.2 * size * share * (1.0 - share) * f64::from(u8::from(parts > 1));
                let at = place[k] + (next[k] - place[k]) * share + bend;
                write!(text, " {axis}{at:.5}").unwrap();
            }
            text.push('\n');
        }
        place = next;
    }
    text.push_str("M2\n");
    text
}

struct Planned {
    report: AuditReport,
    positions: Vec<AxisVector>,
    moves: Vec<Segment>,
}

fn planned(machine: &Machine, text: &str, settings: Settings) -> Planned {
    let source = ProgramSource::new(text.as_bytes(), crate::joints::judge::options(machine));
    let mut pipeline =
        Pipeline::new(source, settings, machine.home).with_joints(Some(machine.limited()));
    let mut audit =
        Audit::new(&AuditSettings::from(&settings)).with_tool(tool_axis(&machine.mechanism));
    let (mut positions, mut moves) = (Vec::new(), Vec::new());
    loop {
        match pipeline.advance().unwrap() {
            Output::Item(item) => {
                if let ItemKind::Move { segment, .. } = &item.kind {
                    moves.push(*segment);
                }
                audit.program(&item);
            }
            Output::Frame(frame) => {
                positions.push(frame.position);
                audit.frame(&frame);
            }
            Output::Pending => {}
            Output::End => break,
        }
    }
    Planned {
        report: audit.finish(),
        positions,
        moves,
    }
}

/// The most that the worse of tip and direction is of its tolerance, at the place of the program where that is least.
fn most_used(machine: &Machine, planned: &Planned, allowed_deg: f64) -> f64 {
    let off = |position: &AxisVector| {
        let way = direction(machine, position);
        let at = |segment: &Segment, share: f64| {
            let place = segment.jet(segment.length() * share).position;
            let tip_mm = (position - place).fixed_rows::<3>(0).norm();
            let angle_deg = way
                .cross(&direction(machine, &place))
                .norm()
                .asin()
                .to_degrees();
            (tip_mm / TOLERANCE_MM).max(angle_deg / allowed_deg)
        };
        let least = |segment: &Segment| {
            let (mut from, mut to) = (0.0, 1.0);
            let mut least = f64::INFINITY;
            // Ever nearer to the best of some points.
            for _ in 0..ROUNDS {
                let step = (to - from) / f64::from(POINTS);
                let of = |k: u32| (at(segment, from + step * f64::from(k)), k);
                let (found, k) = (0..=POINTS)
                    .map(of)
                    .min_by(|a, b| a.0.total_cmp(&b.0))
                    .unwrap();
                least = found.min(least);
                let middle = from + step * f64::from(k);
                (from, to) = ((middle - step).max(0.0), (middle + step).min(1.0));
            }
            least
        };
        planned
            .moves
            .iter()
            .map(least)
            .fold(f64::INFINITY, f64::min)
    };
    let some = planned.positions.iter().step_by(STEP);
    some.map(off).fold(0.0, f64::max)
}

#[test]
fn the_direction_keeps_its_tolerance() {
    for (name, seed) in [
        ("table-table", 3),
        ("head-head", 5),
        ("table-head, skewed", 7),
        ("hexapod", 11),
    ] {
        let machine = machines().into_iter().find(|m| m.name == name).expect("it");
        let text = program(&machine, seed);
        for effort in [Effort::Optimal, Effort::Fast] {
            let mut times = Vec::new();
            for angle_deg in [Some(0.002), None, Some(0.3)] {
                let planned = planned(&machine, &text, settings(&machine, effort, angle_deg));
                let report = &planned.report;
                assert!(
                    report.is_clean() && report.is_complete,
                    "{name}, {effort:?}, {angle_deg:?}: {:?}",
                    report.violations
                );
                let allowed_deg = angle_deg.unwrap_or(TOLERANCE_MM);
                let found_deg = report.max_direction_deg.unwrap();
                let used = most_used(&machine, &planned, allowed_deg);
                eprintln!(
                    "{name}, {effort:?}, {allowed_deg}: {:.3} s, {found_deg:.5} degrees, {used:.3}",
                    report.cycle_time_s
                );
                assert!(found_deg <= allowed_deg * (1.0 + 1e-3), "{found_deg}");
                assert!(used <= 1.001, "{name}, {effort:?}, {allowed_deg}: {used}");
                times.push(report.cycle_time_s);
            }
            assert!(
                times[0] > times[1] && times[1] >= times[2],
                "{name}, {effort:?}: {times:?}"
            );
        }
    }
}
