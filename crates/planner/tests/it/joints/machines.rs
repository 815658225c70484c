//! Machines of every mechanism, with joints that can do less than their programs ask for.

use core::f64::consts::TAU;
use glidepath_audit::JointBounds;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{
    CoreXy, Elbow, FiveAxis, FiveBar, Guards, Hexapod, JointLimit, JointLimits, Kinematics as _,
    LimitedMechanism, LinearDelta, Mechanism, Rotaries, RotaryDelta, Scara, SkewedTilt, Tilt,
    TranslationalHexapod,
};

/// A mechanism, the travel of its axes, and what its joints can do.
pub(crate) struct Machine {
    pub(crate) name: &'static str,
    pub(crate) mechanism: Mechanism,
    pub(crate) travel: Vec<(Axis, f64, f64)>,
    /// J0 first.
    pub(crate) joints: Vec<JointBounds>,
    pub(crate) home: AxisVector,
}

impl Machine {
    /// With every joint alike; the home is the middle of the travel.
    fn new(
        (name, mechanism): (&'static str, Mechanism),
        travel: Vec<(Axis, f64, f64)>,
        rates: [f64; 3],
    ) -> Self {
        let mut home = AxisVector::zeros();
        for (axis, low, high) in &travel {
            home[axis.index()] = 0.5 * (low + high);
        }
        let joint = JointBounds {
            range: [f64::NEG_INFINITY, f64::INFINITY],
            rates,
        };
        Self {
            name,
            mechanism,
            travel,
            joints: vec![joint; mechanism.joints()],
            home,
        }
    }

    /// With other rates of the joints from one on.
    fn with_rates(mut self, from: usize, rates: [f64; 3]) -> Self {
        for joint in &mut self.joints[from..] {
            joint.rates = rates;
        }
        self
    }

    /// With ranges of the joints, J0 first.
    fn with_ranges(mut self, ranges: &[[f64; 2]]) -> Self {
        for (joint, range) in self.joints.iter_mut().zip(ranges) {
            joint.range = *range;
        }
        self
    }

    /// The mechanism and the limits of its joints, as the planner is told of them.
    pub(crate) fn limited(&self) -> LimitedMechanism {
        let mut limits = JointLimits::NONE;
        for (limit, joint) in limits.0.iter_mut().zip(&self.joints) {
            let [velocity, acceleration, jerk] = joint.rates;
            *limit = JointLimit {
                min_position: joint.range[0],
                max_position: joint.range[1],
                velocity,
                acceleration,
                jerk,
            };
        }
        LimitedMechanism {
            mechanism: self.mechanism,
            limits,
        }
    }

    /// Whether it may stand at a place: inside the travel, the ranges of the joints and what the mechanism admits.
    pub(crate) fn may_stand(&self, place: &AxisVector) -> bool {
        let is_inside =
            |(axis, low, high): &(Axis, f64, f64)| (*low..=*high).contains(&place[axis.index()]);
        let Ok(joints) = self.mechanism.admitted(place) else {
            return false;
        };
        self.travel.iter().all(is_inside)
            && self
                .joints
                .iter()
                .zip(joints.iter())
                .all(|(joint, at)| (joint.range[0]..=joint.range[1]).contains(at))
    }

    /// Whether it may go a way that is given from 0 to 1, of so many mm or degrees.
    pub(crate) fn may_go(&self, length: f64, way: impl Fn(f64) -> AxisVector) -> bool {
        const STEP: f64 = 0.5;
        let steps = (length / STEP).ceil().clamp(2.0, TAU * 1000.0);
        let mut step = 1.0;
        while step <= steps {
            if !self.may_stand(&way(step / steps)) {
                return false;
            }
            step += 1.0;
        }
        true
    }
}

fn ends(travel: &[(Axis, [f64; 2])]) -> Vec<(Axis, f64, f64)> {
    let each = travel
        .iter()
        .map(|(axis, [low, high])| (*axis, *low, *high));
    each.collect()
}

fn xyz(half: f64, z: [f64; 2]) -> Vec<(Axis, f64, f64)> {
    ends(&[
        (Axis::X, [-half, half]),
        (Axis::Y, [-half, half]),
        (Axis::Z, z),
    ])
}

const LIFT: [f64; 3] = [300.0, 3000.0, 60_000.0];
const LINEAR: [f64; 3] = [400.0, 4000.0, 80_000.0];
const ROTARY: [f64; 3] = [120.0, 1200.0, 24_000.0];

/// A machine of each mechanism, and of each build of five axes.
pub(crate) fn machines() -> Vec<Machine> {
    let mut machines = vec![
        Machine::new(
            (
                "corexy",
                Mechanism::CoreXy(CoreXy::new(&[Axis::X, Axis::Y, Axis::Z])),
            ),
            ends(&[
                (Axis::X, [0.0, 200.0]),
                (Axis::Y, [0.0, 200.0]),
                (Axis::Z, [0.0, 60.0]),
            ]),
            LIFT,
        )
        .with_rates(2, [50.0, 500.0, 10_000.0]),
    ];
    machines.extend(deltas());
    machines.extend(arms());
    machines.extend(struts());
    machines.extend(five_axes());
    machines
}

fn deltas() -> [Machine; 2] {
    let linear = LinearDelta::new(
        269.0,
        130.25,
        [90.0, 210.0, 330.0],
        &[Axis::X, Axis::Y, Axis::Z],
    );
    let rotary = RotaryDelta {
        base_radius_mm: 90.0,
        platform_radius_mm: 40.0,
        upper_arm_mm: 120.0,
        forearm_mm: 260.0,
        arm_deg: [90.0, 210.0, 330.0],
    };
    [
        // At its corners one rod is nearly flat.
        Machine::new(
            ("linear delta", Mechanism::LinearDelta(linear)),
            xyz(135.0, [0.0, 100.0]),
            LINEAR,
        ),
        Machine::new(
            ("rotary delta", Mechanism::RotaryDelta(rotary)),
            xyz(160.0, [-320.0, -180.0]),
            LINEAR,
        )
        .with_ranges(&[[-60.0, 85.0]; 3]),
    ]
}

fn arms() -> [Machine; 3] {
    let scara = |elbow, tool_mm| {
        Mechanism::Scara(Scara {
            upper_arm_mm: 340.0,
            forearm_mm: 250.0,
            tool_mm,
            height_mm: 200.0,
            elbow,
        })
    };
    let front = ends(&[
        (Axis::X, [90.0, 580.0]),
        (Axis::Y, [-300.0, 300.0]),
        (Axis::Z, [0.0, 150.0]),
        (Axis::C, [-180.0, 180.0]),
    ]);
    let arm = |name, mechanism| {
        Machine::new((name, mechanism), front.clone(), LIFT)
            .with_rates(3, [700.0, 8000.0, 200_000.0])
            .with_ranges(&[
                [-130.0, 130.0],
                [-150.0, 150.0],
                [0.0, 200.0],
                [-360.0, 360.0],
            ])
    };
    let five_bar = FiveBar::new(200.0, 250.0, 350.0, &[Axis::X, Axis::Y, Axis::Z]);
    [
        arm("scara", scara(Elbow::Positive, 0.0)),
        arm("scara with a tool aside", scara(Elbow::Negative, 50.0)),
        // At Y 591.6 both arms are stretched.
        Machine::new(
            ("five-bar", Mechanism::FiveBar(five_bar)),
            ends(&[
                (Axis::X, [-120.0, 120.0]),
                (Axis::Y, [250.0, 591.6]),
                (Axis::Z, [-50.0, 50.0]),
            ]),
            LIFT,
        )
        .with_rates(2, [100.0, 1000.0, 20_000.0]),
    ]
}

fn struts() -> [Machine; 2] {
    let mut hexapod = Hexapod::paired(400.0, 150.0, 15.0);
    hexapod.guards = Guards {
        max_base_angle_deg: 50.0,
        max_platform_angle_deg: 60.0,
        min_strut_distance_mm: 60.0,
    };
    let translational = TranslationalHexapod {
        radius_difference_mm: 250.0,
        base_z_mm: 0.0,
    };
    let mut six = xyz(120.0, [420.0, 580.0]);
    six.extend(ends(&[
        (Axis::A, [-15.0, 15.0]),
        (Axis::B, [-15.0, 15.0]),
        (Axis::C, [-30.0, 30.0]),
    ]));
    [
        Machine::new(
            ("hexapod", Mechanism::Hexapod(hexapod)),
            six,
            [120.0, 1500.0, 40_000.0],
        )
        .with_ranges(&[[430.0, 720.0]; 6]),
        Machine::new(
            ("6-UPU", Mechanism::Translational(translational)),
            xyz(150.0, [120.0, 560.0]),
            [200.0, 2000.0, 50_000.0],
        ),
    ]
}

/// B at 45° between y and z.
fn nutating() -> Tilt {
    let skewed = SkewedTilt::new(Axis::B, &[0.0, 1.0, 1.0].into());
    skewed.map_or(Tilt::B, Tilt::Skewed)
}

fn five_axes() -> [Machine; 5] {
    let machine = |name, rotaries, tilt, reversed, tool_mm| {
        let five_axis = FiveAxis {
            rotaries,
            tilt,
            tilt_reversed: reversed,
            rotary_reversed: reversed,
            tool_mm,
        };
        let mut travel = xyz(60.0, [-60.0, 60.0]);
        travel.extend(ends(&[
            (five_axis.tilt_axis(), [-100.0, 100.0]),
            (Axis::C, [-360.0, 360.0]),
        ]));
        let linear = [500.0, 5000.0, 100_000.0];
        Machine::new((name, Mechanism::FiveAxis(five_axis)), travel, linear).with_rates(3, ROTARY)
    };
    let tables = |tilt_point: [f64; 3], rotary_point: [f64; 3]| Rotaries::TableTable {
        tilt_point: tilt_point.into(),
        rotary_point: rotary_point.into(),
    };
    let heads = Rotaries::HeadHead {
        rotary_to_tilt: [10.0, -20.0, 30.0].into(),
        tilt_to_spindle: [0.0, 15.0, 0.0].into(),
    };
    let both = Rotaries::TableHead {
        rotary_point: [5.0, -10.0, 0.0].into(),
    };
    [
        machine(
            "table-table",
            tables([0.0, 0.0, -50.0], [0.0; 3]),
            Tilt::A,
            false,
            0.0,
        ),
        machine(
            "table-table, offset",
            tables([0.0, 10.0, 30.0], [20.0, -5.0, 0.0]),
            Tilt::B,
            true,
            80.0,
        ),
        machine("head-head", heads, Tilt::A, true, 150.0),
        machine("table-head", both, Tilt::B, false, 150.0),
        machine("table-head, skewed", both, nutating(), false, 150.0),
    ]
}
