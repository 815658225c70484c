//! Tests of machines whose joints are weaker than their axes: speeds, accelerations and jerks are
//! kept where the joints can follow, so that nothing of the motion has to be refused. Minutes, for
//! more programs:
//!
//! ```text
//! GLIDEPATH_JOINTS=100 cargo test --release -p glidepath-planner --test it joints
//! ```

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests")]

use glidepath_gcode::Options;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{
    Elbow, FiveAxis, FiveBar, Hexapod, JointLimit, JointLimits, JointVector, Kinematics as _,
    LimitedMechanism, LinearDelta, Mechanism, Rotaries, RotaryDelta, Scara, Tilt,
};
use glidepath_planner::{Output, Pipeline, ProgramSource};
use glidepath_program::{Effort, Limits, Override, PathBounds, Settings, Smoothing, Travel};
use proptest::prelude::*;

const PERIOD_T: f64 = 0.004;
/// What differences of positions of hundreds of mm or degrees lose, in shares of a limit.
const ROUNDING: f64 = 1e-9;

/// A mechanism, the travel of its axes, and what its axes would do if joints let them.
struct Machine {
    mechanism: Mechanism,
    travel: Vec<(Axis, f64, f64)>,
    limits: Limits,
    joint: JointLimit,
}

fn limits(linear: [f64; 3], rotary: [f64; 3]) -> Limits {
    let all = |k: usize| {
        AxisVector::from_fn(|i, _| match i {
            0..3 => linear[k],
            3..6 => rotary[k],
            _ => Limits::UNLIMITED,
        })
    };
    Limits {
        velocity: all(0),
        acceleration: all(1),
        jerk: all(2),
        path: PathBounds::NONE,
        travel: Travel::unlimited(),
    }
}

fn joint(velocity: f64, acceleration: f64, jerk: f64) -> JointLimit {
    JointLimit {
        velocity,
        acceleration,
        jerk,
        ..JointLimit::NONE
    }
}

fn xyz(half: f64, (low, high): (f64, f64)) -> Vec<(Axis, f64, f64)> {
    vec![
        (Axis::X, -half, half),
        (Axis::Y, -half, half),
        (Axis::Z, low, high),
    ]
}

fn five_bar() -> Machine {
    Machine {
        mechanism: Mechanism::FiveBar(FiveBar::new(
            200.0,
            250.0,
            350.0,
            &[Axis::X, Axis::Y, Axis::Z],
        )),
        travel: vec![
            (Axis::X, -100.0, 100.0),
            (Axis::Y, 300.0, 480.0),
            (Axis::Z, -50.0, 50.0),
        ],
        limits: limits([300.0, 3000.0, 60_000.0], [1.0; 3]),
        joint: joint(90.0, 1000.0, 25_000.0),
    }
}

fn machines() -> Vec<Machine> {
    let turned = |half: f64| [Axis::A, Axis::B, Axis::C].map(|axis| (axis, -half, half));
    let mut hexapod = xyz(60.0, (460.0, 540.0));
    hexapod.extend(turned(10.0));
    let mut five = xyz(60.0, (-50.0, 50.0));
    five.extend([(Axis::A, -40.0, 40.0), (Axis::C, -180.0, 180.0)]);
    let scara = vec![
        (Axis::X, 250.0, 400.0),
        (Axis::Y, -150.0, 150.0),
        (Axis::Z, 0.0, 150.0),
        (Axis::C, -90.0, 90.0),
    ];
    vec![
        Machine {
            mechanism: Mechanism::Hexapod(Hexapod::paired(400.0, 150.0, 15.0)),
            travel: hexapod,
            limits: limits([150.0, 1500.0, 30_000.0], [20.0, 200.0, 4_000.0]),
            joint: joint(50.0, 900.0, 15_000.0),
        },
        Machine {
            mechanism: Mechanism::LinearDelta(LinearDelta::new(
                250.0,
                130.0,
                [90.0, 210.0, 330.0],
                &[Axis::X, Axis::Y, Axis::Z],
            )),
            travel: xyz(50.0, (0.0, 100.0)),
            limits: limits([300.0, 3000.0, 60_000.0], [1.0; 3]),
            joint: joint(120.0, 2000.0, 50_000.0),
        },
        Machine {
            mechanism: Mechanism::RotaryDelta(RotaryDelta {
                base_radius_mm: 90.0,
                platform_radius_mm: 40.0,
                upper_arm_mm: 120.0,
                forearm_mm: 260.0,
                arm_deg: [90.0, 210.0, 330.0],
            }),
            travel: xyz(60.0, (-270.0, -210.0)),
            limits: limits([300.0, 3000.0, 60_000.0], [1.0; 3]),
            joint: joint(80.0, 1000.0, 25_000.0),
        },
        Machine {
            mechanism: Mechanism::Scara(Scara {
                upper_arm_mm: 340.0,
                forearm_mm: 250.0,
                tool_mm: 50.0,
                height_mm: 200.0,
                elbow: Elbow::Negative,
            }),
            travel: scara,
            limits: limits([300.0, 3000.0, 60_000.0], [120.0, 1200.0, 24_000.0]),
            joint: joint(90.0, 1000.0, 25_000.0),
        },
        five_bar(),
        Machine {
            mechanism: Mechanism::FiveAxis(FiveAxis {
                rotaries: Rotaries::TableTable {
                    tilt_point: [0.0, 0.0, 30.0].into(),
                    rotary_point: [0.0, 0.0, 0.0].into(),
                },
                tilt: Tilt::A,
                tilt_reversed: false,
                rotary_reversed: false,
                tool_mm: 80.0,
            }),
            travel: five,
            limits: limits([150.0, 1500.0, 30_000.0], [60.0, 600.0, 12_000.0]),
            joint: joint(100.0, 1500.0, 30_000.0),
        },
    ]
}

/// A program of random moves inside the travel, some of them short, some rapid.
fn program(machine: &Machine, places: &[([f64; 6], u8)]) -> String {
    let mut text = String::from("G21 G90 G64\nF9000\n");
    let mut last = vec![0.5; machine.travel.len()];
    for (unit, kind) in places {
        let word = ["G1", "G1", "G1", "G0"][usize::from(kind % 4)];
        // Half of the moves are short.
        let reach = if kind % 8 < 4 { 1.0 } else { 0.05 };
        text.push_str(word);
        for (k, (axis, low, high)) in machine.travel.iter().enumerate() {
            last[k] += reach * (unit[k] - last[k]);
            text.push_str(&format!(" {axis}{:.4}", low + (high - low) * last[k]));
        }
        text.push('\n');
    }
    text
}

/// What is used of velocity, acceleration and jerk of the joints, 1 for all of it, by differences
/// of their positions.
struct Used<'a> {
    machine: &'a Machine,
    last: [JointVector; 3],
    most: [f64; 3],
}

impl<'a> Used<'a> {
    fn new(machine: &'a Machine, start: &AxisVector) -> Self {
        Self {
            machine,
            last: [machine.mechanism.inverse(start).unwrap(); 3],
            most: [0.0; 3],
        }
    }

    fn add(&mut self, position: &AxisVector) {
        let now = self.machine.mechanism.inverse(position).unwrap();
        let [a, b, c] = self.last;
        let differences = [now - a, now - a * 2.0 + b, now - a * 3.0 + b * 3.0 - c];
        let JointLimit {
            velocity,
            acceleration,
            jerk,
            ..
        } = self.machine.joint;
        let mut unit = 1.0;
        for (k, limit) in [velocity, acceleration, jerk].into_iter().enumerate() {
            unit /= PERIOD_T;
            self.most[k] = self.most[k].max(differences[k].amax() * unit / limit);
        }
        self.last = [now, a, b];
    }
}

/// Plans a program, with another override from some frame on; what is used of the joints' limits.
fn used(machine: &Machine, effort: Effort, text: &str, feed_r: f64) -> [f64; 3] {
    let joints = JointLimits([machine.joint; 9]);
    let settings = Settings {
        limits: machine.limits,
        tolerance_mm: 0.02,
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: PERIOD_T,
        effort,
    };
    let caps = LimitedMechanism {
        mechanism: machine.mechanism,
        limits: joints,
    };
    let mut start = AxisVector::zeros();
    for (axis, low, high) in &machine.travel {
        start[axis.index()] = 0.5 * (low + high);
    }
    let options = Options {
        start,
        ..Options::default()
    };
    let source = ProgramSource::new(text.as_bytes(), options);
    let mut pipeline = Pipeline::new(source, settings, start).with_joints(Some(caps));
    let mut used = Used::new(machine, &start);
    let mut frames = 0;
    loop {
        match pipeline.advance().unwrap() {
            Output::Frame(frame) => {
                frames += 1;
                if frames == 100 {
                    let rapid_r = 1.0;
                    pipeline.follow_override(Override { feed_r, rapid_r });
                }
                used.add(&frame.position);
            }
            Output::End => return used.most,
            Output::Item(_) | Output::Pending => {}
        }
    }
}

fn cases() -> Option<u32> {
    std::env::var("GLIDEPATH_JOINTS").ok()?.parse().ok()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases().unwrap_or(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn joints_keep_their_limits_whatever_the_program(
        places in prop::collection::vec((prop::array::uniform6(0.0..1.0_f64), 0..8_u8), 4..9),
        faster in any::<bool>(),
    ) {
        let feed_r = if faster { 1.8 } else { 0.4 };
        for machine in machines() {
            let text = program(&machine, &places);
            for effort in [Effort::Fast, Effort::Optimal] {
                let most = used(&machine, effort, &text, feed_r);
                prop_assert!(most.iter().all(|r| *r <= 1.0 + ROUNDING), "{effort:?}, {most:?}:\n{text}");
            }
        }
    }
}
