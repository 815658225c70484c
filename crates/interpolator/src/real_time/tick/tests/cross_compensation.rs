//! Tests of a machine whose axes are neither square nor straight, with play and uneven screws besides.

use super::compensation::{Carriage, random_run_of, screw, worst_of_drives};
use super::*;
use glidepath_geometry::Axis;
use glidepath_kinematics::{
    AxisList, CrossCompensation, CrossTable, JOINTS, JointLimit, Mechanism, Trivial,
};
use glidepath_program::Limits;

const AXES_HERE: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];
const BACKLASH: f64 = 0.05;
/// The travel that tables are judged for, mm.
const TRAVEL: f64 = 600.0;

/// What is added to each axis where the machine's carriages are: formulas, and not the tables of the code.
fn added([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        0.08e-3 * y + 0.004 * (z / 50.0).sin(),
        0.003 * (x / 80.0).sin(),
        0.010 * (x / 60.0).cos() - 0.006 * (y / 45.0).sin(),
    ]
}

/// The tables of that, every 10 mm.
fn tables() -> Vec<CrossTable> {
    let pairs = [(0, 1), (0, 2), (1, 0), (2, 0), (2, 1)];
    let of = |(corrected, along): (usize, usize)| {
        let value = |place: f64| {
            let mut at = [0.0; 3];
            at[along] = place;
            // What the third axis adds where it is at zero is in the table of that axis.
            let zero = if (corrected, along) == (2, 1) {
                added([0.0; 3])[2]
            } else {
                0.0
            };
            added(at)[corrected] - zero
        };
        let places = (-60..=60).map(|k| 10.0 * f64::from(k));
        CrossTable {
            corrected: AXES_HERE[corrected],
            along: AXES_HERE[along],
            points: places.map(|place| (place, value(place))).collect(),
        }
    };
    pairs.map(of).to_vec()
}

/// A mill with these tables and with screws, and what plans for it keep to.
fn machine(period_ns: u64) -> Config {
    let screw = screw(BACKLASH);
    let limit = JointLimit {
        min_position: -TRAVEL,
        max_position: TRAVEL,
        ..*screw.left()
    };
    let cross = CrossCompensation::new(&tables(), &AXES_HERE.map(|axis| (axis, limit))).unwrap();
    let mut limits = Limits::uniform(limit.velocity, limit.acceleration, limit.jerk);
    for axis in AXES_HERE {
        let (left, axis) = (cross.left(axis).unwrap(), axis.index());
        limits.velocity[axis] = left.velocity;
        limits.acceleration[axis] = left.acceleration;
        limits.jerk[axis] = left.jerk;
    }
    let mut compensation = [None; JOINTS];
    compensation[..3].fill(Some(screw));
    Config {
        mechanism: Mechanism::Trivial(Trivial {
            cross: Some(Box::leak(Box::new(cross))),
            ..Trivial::new(AxisList::new(&Axis::ALL))
        }),
        compensation,
        ..Config::new(limits, period_ns)
    }
}

/// Where the tool of this machine is when its carriages are at places: the error model turned round.
fn tool(carriages: [f64; 3]) -> [f64; 3] {
    let mut at = carriages;
    for _ in 0..50 {
        let added = added(at);
        at = [0, 1, 2].map(|axis| carriages[axis] - added[axis]);
    }
    at
}

#[test]
fn drives_keep_their_limits_with_all_compensations_whatever_happens() {
    for seed in 0..u64::from(random_cases(3)) {
        for period_ns in [1_000_000, 2_000_000, 4_000_000] {
            let rig = random_run_of(machine(period_ns), seed);
            let worst = worst_of_drives(&rig);
            assert!(worst <= INSIDE, "seed {seed}, {period_ns} ns: {worst}");
            assert!(rig.worst_ratio() <= INSIDE);
        }
    }
}

#[test]
fn at_rest_the_tool_is_where_the_program_says_on_a_machine_that_is_neither_square_nor_straight() {
    let mut without = 0.0_f64;
    for seed in 0..u64::from(random_cases(4)) {
        let rig = random_run_of(machine(4_000_000), seed);
        let first = rig.setpoints[0];
        let mut carriages = [0, 1, 2].map(|axis| Carriage {
            x: first.joint_position[axis],
            backlash: BACKLASH,
        });
        let (mut still, mut has_moved) = (0, [0.0_f64; 3]);
        for pair in rig.setpoints.windows(2) {
            let [before, now] = pair else { unreachable!() };
            still = if before.joint_position == now.joint_position {
                still + 1
            } else {
                0
            };
            let pushed = [0, 1, 2].map(|axis| carriages[axis].pushed(now.joint_position[axis]));
            let place = [0, 1, 2].map(|axis| now.position[axis]);
            let uncorrected = tool(place);
            let tool = tool(pushed);
            for axis in 0..3 {
                let way = place[axis] - first.position[axis];
                has_moved[axis] = has_moved[axis].max(way.abs());
            }
            // Before its first motion nobody knows on which side of its play an axis is, and in a hold just before it
            // turns round it may be on the next one already.
            if is_idle(now) && still > 3 && has_moved.iter().all(|way| *way > 0.01) {
                for axis in 0..3 {
                    let off = tool[axis] - place[axis];
                    assert!(off.abs() < 0.001, "seed {seed}, axis {axis}: {off} mm");
                    without = without.max((uncorrected[axis] - place[axis]).abs());
                }
            }
        }
    }
    assert!(without > 0.010, "the test proves nothing: {without}");
}
