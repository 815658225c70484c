//! Tests of compensated joints: their drives keep their own limits, and the carriage is where it is to be.

use super::*;
use crate::testing::{audit, integrate};
use glidepath_kinematics::{CompensationPoint, JOINTS, JointCompensation, JointLimit, JointVector};
use glidepath_program::Limits;

/// What the drives of the mill can do.
fn drive() -> JointLimit {
    let limits = mill();
    JointLimit {
        velocity: limits.velocity[0],
        acceleration: limits.acceleration[0],
        jerk: limits.jerk[0],
        ..JointLimit::NONE
    }
}

/// What is added to a place by a screw of the test: another formula than that of the code.
fn error_mm(q: f64) -> f64 {
    0.006 * (q / 31.0).sin() + 0.002 * (q / 11.0).cos()
}

/// Its table, and play.
pub(super) fn screw(backlash: f64) -> &'static JointCompensation {
    let points: Vec<_> = (-60..=60)
        .map(|k| {
            let position = 10.0 * f64::from(k);
            let added = error_mm(position);
            CompensationPoint {
                position,
                up: added,
                down: added,
            }
        })
        .collect();
    Box::leak(Box::new(
        JointCompensation::new(&points, backlash, &drive()).unwrap(),
    ))
}

/// A mill all of whose axes have such screws, and what plans for it keep to.
fn machine(backlash: f64, period_ns: u64) -> Config {
    let made = screw(backlash);
    let left = made.left();
    let limits = Limits::uniform(left.velocity, left.acceleration, left.jerk);
    let mut compensation = [None; JOINTS];
    compensation[..3].fill(Some(made));
    Config {
        compensation,
        ..Config::new(limits, period_ns)
    }
}

/// The largest part of the drives' own limits that the differences of what they were told take.
pub(super) fn worst_of_drives(rig: &Rig) -> f64 {
    let limits = mill();
    let told: Vec<AxisVector> = rig
        .setpoints
        .iter()
        .map(|setpoint| AxisVector::from(setpoint.joint_position))
        .collect();
    let rest = std::iter::repeat_n(told[0], 3);
    let all: Vec<AxisVector> = rest.chain(told.iter().copied()).collect();
    audit(&all, &limits, rig.config.period_t())
        .into_iter()
        .fold(0.0, f64::max)
}

fn random_run(seed: u64, backlash: f64, period_ns: u64) -> Rig {
    random_run_of(machine(backlash, period_ns), seed)
}

/// A random program on a machine, and an operator who interferes with it.
pub(super) fn random_run_of(machine: Config, seed: u64) -> Rig {
    let mut rig = Rig::new(machine);
    let period_ns = rig.config.period_ns;
    let period_t = rig.config.period_t();
    let limits = rig.config.limits;
    let frames = plan(seed, 3, 1_500, &limits, period_t, AxisVector::zeros());
    rig.feed = records(&frames, 1, period_ns).into();
    let mut numbers = Numbers::new(seed);
    for _ in 0..8 {
        rig.run(40 + numbers.whole(0, 120) as usize);
        match numbers.whole(0, 3) {
            0 => rig.command(Command::Hold),
            1 => rig.command(Command::FeedOverride(numbers.unit())),
            _ => {}
        }
        rig.run(numbers.whole(0, 60) as usize);
        rig.command(Command::Resume);
        rig.command(Command::FeedOverride(1.0));
    }
    assert!(rig.run_until(20_000, is_idle));
    rig.run(200);
    rig
}

#[test]
fn drives_keep_their_limits_whatever_the_motion_and_the_operator_do() {
    for (seed, backlash, period_ns) in (0..u64::from(random_cases(4))).flat_map(|seed| {
        [1_000_000, 2_000_000, 4_000_000]
            .into_iter()
            .flat_map(move |period_ns| [0.0, 0.01, 0.2].map(|backlash| (seed, backlash, period_ns)))
    }) {
        let rig = random_run(seed, backlash, period_ns);
        let worst = worst_of_drives(&rig);
        assert!(
            worst <= INSIDE,
            "seed {seed}, {backlash} mm, {period_ns} ns: {worst}"
        );
        assert!(rig.worst_ratio() <= INSIDE);
        // What people see are positions of the program.
        let last = rig.setpoints.last().unwrap();
        assert_ne!(last.joint_position[0], last.position[0]);
    }
}

/// A nut on a screw, and a carriage that the nut pushes: it has play, and moves only when it is pushed.
pub(super) struct Carriage {
    pub(super) x: f64,
    pub(super) backlash: f64,
}

impl Carriage {
    /// Where it is when the motor is at m: the nut is where error and place give m, found by halving.
    pub(super) fn pushed(&mut self, m: f64) -> f64 {
        let (mut low, mut high) = (m - 1.0, m + 1.0);
        for _ in 0..80 {
            let middle = low.midpoint(high);
            if middle + error_mm(middle) < m {
                low = middle;
            } else {
                high = middle;
            }
        }
        let nut = low.midpoint(high);
        let half = self.backlash / 2.0;
        self.x = self.x.clamp(nut - half, nut + half);
        self.x
    }
}

#[test]
fn at_rest_the_carriage_is_where_the_program_says_with_play_and_an_uneven_screw() {
    let (mut worst, mut uncompensated) = (0.0_f64, 0.0_f64);
    for seed in 0..4 {
        let backlash = 0.05;
        let rig = random_run(seed, backlash, 4_000_000);
        let mut carriages = [0, 1, 2].map(|axis| Carriage {
            x: rig.setpoints[0].position[axis],
            backlash,
        });
        let mut naive = [0, 1, 2].map(|axis| Carriage {
            x: rig.setpoints[0].position[axis],
            backlash,
        });
        let mut still = 0;
        let mut has_moved = [0.0_f64; 3];
        for pair in rig.setpoints.windows(2) {
            let [before, now] = pair else { unreachable!() };
            still = if before.joint_position == now.joint_position {
                still + 1
            } else {
                0
            };
            for axis in 0..3 {
                let way = now.position[axis] - rig.setpoints[0].position[axis];
                has_moved[axis] = has_moved[axis].max(way.abs());
                let x = carriages[axis].pushed(now.joint_position[axis]);
                let other = naive[axis].pushed(now.position[axis]);
                // Before its first motion nobody knows on which side of its play an axis is.
                if still > 3 && has_moved[axis] > 0.01 {
                    worst = worst.max((x - now.position[axis]).abs());
                    uncompensated = uncompensated.max((other - now.position[axis]).abs());
                }
            }
        }
    }
    // A spline through points 10 mm apart is .05 µm beside this screw; the turn is seen after 1 µm.
    assert!(worst < 0.001, "{worst} mm");
    assert!(
        uncompensated > 0.025,
        "the test proves nothing: {uncompensated}"
    );
}

#[test]
fn a_table_of_zeros_changes_no_bit() {
    let zero = [-100.0, 0.0, 100.0].map(|position| CompensationPoint {
        position,
        up: 0.0,
        down: 0.0,
    });
    let none = JointCompensation::new(&zero, 0.0, &drive()).unwrap();
    let none: &'static JointCompensation = Box::leak(Box::new(none));
    let (mut plain, frames) = rig(3, 3, 800);
    let mut compensation = [None; JOINTS];
    compensation[..3].fill(Some(none));
    let mut other = Rig::new(Config {
        compensation,
        ..plain.config
    });
    other.feed = frames.into();
    for rig in [&mut plain, &mut other] {
        rig.run(300);
        rig.command(Command::Hold);
        rig.run(200);
        rig.command(Command::Resume);
        rig.run(1_000);
    }
    let bits = |rig: &Rig| -> Vec<[u64; 9]> {
        let told = rig.setpoints.iter();
        told.map(|s| s.joint_position.map(f64::to_bits)).collect()
    };
    assert_eq!(bits(&plain), bits(&other));
}

#[test]
fn velocities_and_accelerations_of_drives_are_those_of_their_positions() {
    let rig = random_run(9, 0.02, 1_000_000);
    for window in rig.setpoints.windows(3).skip(5) {
        let [a, b, c] = [0, 1, 2].map(|k| JointVector::from(window[k].joint_position));
        let rate = (c - a) / 0.002 - JointVector::from(window[1].joint_velocity);
        assert!(rate.amax() < 0.02, "{rate:?}");
        let second = (a - b * 2.0 + c) / 1e-6;
        let beyond = second - JointVector::from(window[1].joint_acceleration);
        assert!(beyond.amax() < 40.0, "{beyond:?}");
    }
}

/// Frames of circles about the middle, from rest to rest: 50 mm/s on a radius of 10 mm.
fn circles() -> Vec<SetpointFrame> {
    let (ramp, cruise) = (40, 700);
    let jerk = 50.0 / (f64::from(ramp) * 0.004).powi(2);
    let stretch = |sign: f64, count: usize| vec![sign * jerk; count];
    let mut jerks = vec![Vec::new(); 9];
    jerks[0] = [
        stretch(1.0, ramp as usize),
        stretch(-1.0, ramp as usize),
        stretch(0.0, cruise),
        stretch(-1.0, ramp as usize),
        stretch(1.0, ramp as usize),
    ]
    .concat();
    let along = integrate(&jerks, 0.004, AxisVector::zeros());
    let radius = 10.0;
    let mut frames = along.clone();
    for (frame, along) in frames.iter_mut().zip(&along) {
        let [s, v, a] = [along.position[0], along.velocity[0], along.acceleration[0]];
        let (sin, cos) = (s / radius).sin_cos();
        let rate = v * v / radius;
        (frame.position[0], frame.position[1]) = (radius * cos - radius, radius * sin);
        (frame.velocity[0], frame.velocity[1]) = (-v * sin, v * cos);
        (frame.acceleration[0], frame.acceleration[1]) =
            (-a * sin - rate * cos, a * cos - rate * sin);
    }
    records(&frames, 1, 4_000_000)
}

#[test]
fn play_is_taken_up_about_where_a_joint_turns_round() {
    let backlash = 0.05;
    let mut rig = Rig::new(machine(backlash, 4_000_000));
    rig.feed = circles().into();
    assert!(rig.run_until(3_000, |s| s.sequence > 100) && rig.run_until(3_000, is_idle));
    let mut carriage = Carriage { x: 0.0, backlash };
    let mut worst = 0.0_f64;
    for setpoint in &rig.setpoints {
        let x = carriage.pushed(setpoint.joint_position[1]);
        if setpoint.sequence > 200 {
            worst = worst.max((x - setpoint.position[1]).abs());
        }
    }
    // Begun at the turn it would be 41 µm, not taken up at all 50 µm.
    assert!(worst < 0.022, "{worst} mm");
    assert!(worst > 0.005, "too good to be true: {worst} mm");
}
