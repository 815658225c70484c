//! A hole that a spindle taps that is an axis: both axes are in the plan, and stay on their line
//! whatever becomes of the time.

use super::*;
use crate::testing::{blocks, planned};
use glidepath_geometry::Segment;
use glidepath_link::Setpoint;
use glidepath_program::{Effort, ItemKind, Limits, PathMode, Rate as Speed};

const PITCH_MM: f64 = 1.25;
const DEPTH_MM: f64 = 15.0;

/// 3000 rev/min of the spindle, which reaches them in a fifth of a second.
fn limits() -> Limits {
    let mut limits = mill();
    let most = [18_000.0, 90_000.0, 2_000_000.0];
    (limits.velocity[5], limits.acceleration[5], limits.jerk[5]) = (most[0], most[1], most[2]);
    limits
}

/// Three depths of a hole at 1200 rev/min.
fn program() -> Vec<SetpointFrame> {
    let at = |depth: f64| {
        let mut point = AxisVector::zeros();
        (point[2], point[5]) = (-depth, depth / PITCH_MM * 360.0);
        point
    };
    let depths = [0.0, 5.0, 0.0, 10.0, 0.0, DEPTH_MM, 0.0];
    let feed_v = PITCH_MM * 20.0;
    let kinds = depths.windows(2).map(|pair| ItemKind::Move {
        segment: Segment::line(at(pair[0]), at(pair[1])),
        rate: Speed::FeedUpTo {
            feed_v,
            most_v: feed_v,
        },
        mode: PathMode::ExactStop,
    });
    let start = AxisVector::zeros();
    planned(&blocks(kinds), limits(), start, Effort::Optimal)
}

/// How far both axes are from their line at most, mm; the depth reached, mm.
fn off_line(rig: &Rig) -> (f64, f64) {
    let mut most = (0.0_f64, 0.0_f64);
    for setpoint in &rig.setpoints {
        let [.., z, _, _, c, _, _, _] = setpoint.position;
        most.0 = most.0.max((z + c / 360.0 * PITCH_MM).abs());
        most.1 = most.1.max(-z);
    }
    most
}

#[test]
fn both_axes_stay_on_their_line_under_overrides_holds_and_an_abort() {
    let mut worst_mm = 0.0_f64;
    for seed in 0..24 {
        let mut rig = Rig::new(Config::new(limits(), 4_000_000));
        rig.feed.extend(program());
        let mut numbers = Numbers::new(seed);
        for _ in 0..12 {
            rig.run((5.0 + 80.0 * numbers.unit()) as usize);
            rig.command(match (numbers.unit() * 5.0) as u32 {
                0 => Command::Hold,
                1 => Command::Resume,
                2 => Command::Reverse,
                3 => Command::Forward,
                _ => Command::FeedOverride(0.1 + 1.2 * numbers.unit()),
            });
        }
        let is_aborted = seed % 3 == 0;
        rig.command(Command::FeedOverride(1.2));
        rig.command(Command::Forward);
        rig.command(if is_aborted {
            Command::Abort
        } else {
            Command::Resume
        });
        assert!(rig.run_until(4_000, is_idle), "{seed}");
        let (off_mm, deepest_mm) = off_line(&rig);
        assert!(is_aborted || deepest_mm == DEPTH_MM, "{seed}");
        worst_mm = worst_mm.max(off_mm);
        assert!(rig.worst_ratio() <= INSIDE, "{seed}: {}", rig.worst_ratio());
    }
    println!("{worst_mm:.1e} mm from the line at most");
    // Rounding of a position of 4320° alone is 1.6e-15 mm of the pitch, that of 15 mm 0.9e-15.
    assert!(worst_mm < 2e-14, "{worst_mm}");
}

/// What an operator does with a tap that is held in its hole: back along the same line.
#[test]
fn a_tap_goes_back_out_of_its_hole_along_its_line() {
    let mut rig = Rig::new(Config::new(limits(), 4_000_000));
    rig.feed.extend(program());
    let is_deep = |s: &Setpoint| s.position[2] < -6.0;
    assert!(rig.run_until(4_000, is_deep));
    rig.command(Command::Hold);
    assert!(rig.run_until(500, |s| s.state() == Ok(MachineState::Held)));
    rig.command(Command::Reverse);
    rig.command(Command::Resume);
    assert!(rig.run_until(4_000, |s| s.position[2] == 0.0));
    let last = rig.setpoints.last().unwrap();
    assert_eq!(last.position[5], 0.0);
    let (off_mm, deepest_mm) = off_line(&rig);
    assert!(off_mm < 2e-14, "{off_mm}");
    assert!((6.0..10.0).contains(&deepest_mm), "{deepest_mm}");
    assert!(rig.worst_ratio() <= INSIDE, "{}", rig.worst_ratio());
}
