//! Tests of every mechanism against formulas that are not its own, at ten thousand poses each, with every branch: both
//! elbows, both ways round, standing and hanging. Inverses are held against closed forms of another kind, forwards
//! against such, or against a solver by Newton on those. Five-bar linkages have theirs in `five_bar.rs`.

#![allow(clippy::unwrap_used, clippy::cast_precision_loss, reason = "a test")]

use crate::support::*;
use glidepath_geometry::Axis;
use glidepath_kinematics::*;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

const POSES: u32 = 10_000;

/// The place of a number in a box, evenly filled: X Y Z A B C.
fn place(number: u32, middle: [f64; 6], half: [f64; 6]) -> [f64; 6] {
    let unit = halton_place::<6>(number);
    core::array::from_fn(|i| middle[i] + half[i] * (2.0 * unit[i] - 1.0))
}

/// The place with some joints by Newton's method, the derivatives by differences.
fn solved<const N: usize>(
    joints: &[f64],
    start: [f64; N],
    inverse: &dyn Fn(&[f64; N]) -> Vec<f64>,
) -> [f64; N] {
    let mut place = start;
    for _ in 0..30 {
        let at = inverse(&place);
        let off = DVector::from_iterator(
            at.len(),
            at.iter().zip(joints).map(|(q, wanted)| q - wanted),
        );
        let mut rows = DMatrix::zeros(at.len(), N);
        for column in 0..N {
            let moved = |by: f64| {
                let mut moved = place;
                moved[column] += by;
                inverse(&moved)
            };
            let (above, below) = (moved(1e-5), moved(-1e-5));
            for row in 0..at.len() {
                rows[(row, column)] = (above[row] - below[row]) / 2e-5;
            }
        }
        // Of more joints than coordinates, those that fit best.
        let normal = rows.tr_mul(&rows);
        let step = normal.lu().solve(&rows.tr_mul(&off)).unwrap();
        for (coordinate, part) in place.iter_mut().zip(step.iter()) {
            *coordinate -= part;
        }
        if step.amax() < 1e-11 {
            break;
        }
    }
    place
}

/// The largest differences of a mechanism from other formulas: of joints, and of places.
#[derive(Debug, Default)]
struct Most {
    joint: f64,
    place: f64,
}

impl Most {
    fn joints(&mut self, found: &JointVector, others: &[f64]) {
        for (joint, other) in found.iter().zip(others) {
            self.joint = self.joint.max((joint - other).abs());
        }
    }

    /// What a mechanism makes of its joints, another formula, and the place they were made of.
    fn places(&mut self, found: &[f64], other: &[f64], truth: &[f64]) {
        for ((found, other), truth) in found.iter().zip(other).zip(truth) {
            self.place = self.place.max((found - other).abs());
            self.place = self.place.max((found - truth).abs());
        }
    }

    fn below(&self, joint: f64, place: f64, name: &str) {
        assert!(self.joint < joint && self.place < place, "{name}: {self:?}");
        assert!(
            self.joint.is_finite() && self.place > 0.0,
            "{name}: {self:?}"
        );
    }
}

#[test]
fn core_xy_is_its_matrix_and_the_inverse_of_that() {
    let machine = CoreXy::new(&[Axis::X, Axis::Y, Axis::Z]);
    let matrix = Matrix3::new(1.0, 1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 1.0);
    let back = matrix.try_inverse().unwrap();
    for number in 1..=POSES {
        let at = place(number, [0.0; 6], [300.0; 6]);
        let tip = Vector3::new(at[0], at[1], at[2]);
        let joints = machine.inverse(&axes(&at[..3])).unwrap();
        let other = matrix * tip;
        assert!((joints.fixed_rows::<3>(0) - other).amax() < 1e-12);
        let found = machine.forward(&joints, &axes(&[])).unwrap();
        assert!((found.fixed_rows::<3>(0) - back * other).amax() < 1e-12);
    }
}

#[test]
fn linear_deltas_of_both_orders() {
    for towers in [[90.0, 210.0, 330.0], [210.0, 330.0, 90.0]] {
        let machine = LinearDelta::new(269.0, 130.25, towers, &[Axis::X, Axis::Y, Axis::Z]);
        // The height over the place is the other side of a right triangle, by the product of hypotenuse ± side.
        let inverse = |at: &[f64; 3]| -> Vec<f64> {
            let height = |degrees: f64| {
                let (x, y) = (degrees.to_radians().cos(), degrees.to_radians().sin());
                let across = (at[0] - 130.25 * x).hypot(at[1] - 130.25 * y);
                at[2] + ((269.0 - across) * (269.0 + across)).sqrt()
            };
            towers.map(height).to_vec()
        };
        let mut most = Most::default();
        for number in 1..=POSES {
            let at = place(
                number,
                [0., 0., 50., 0., 0., 0.],
                [80., 80., 100., 0., 0., 0.],
            );
            let at = [at[0], at[1], at[2]];
            let joints = machine.inverse(&axes(&at)).unwrap();
            let other = inverse(&at);
            most.joints(&joints, &other);
            let found = machine.forward(&joints, &axes(&[])).unwrap();
            let start = [at[0] + 3.0, at[1] - 2.0, at[2] - 4.0];
            most.places(
                &found.as_slice()[..3],
                &solved(&other, start, &inverse),
                &at,
            );
        }
        most.below(1e-11, 1e-10, "linear delta");
    }
}

#[test]
fn rotary_deltas_with_arms_in_any_order() {
    for arms in [[90.0, 210.0, 330.0], [0.0, 240.0, 120.0]] {
        let machine = RotaryDelta {
            arm_deg: arms,
            ..rotary_delta()
        };
        // In the plane of an arm the knee is where two circles cross: that of the upper arm, and one about the platform's
        // joint, whose radius is what is left of the forearm there. Of both it is the one further out.
        let inverse = |at: &[f64; 3]| -> Vec<f64> {
            let angle = |degrees: f64| {
                let (x, y) = (degrees.to_radians().cos(), degrees.to_radians().sin());
                let (out, aside) = (at[0] * x + at[1] * y - 50.0, at[1] * x - at[0] * y);
                let apart = out.hypot(at[2]);
                let (u, v) = (out / apart, at[2] / apart);
                let left = 260.0 * 260.0 - aside * aside;
                let along = (apart * apart + 120.0 * 120.0 - left) / (2.0 * apart);
                let across = ((120.0 - along) * (120.0 + along)).sqrt();
                let knees = [across, -across].map(|a| [along * u - a * v, along * v + a * u]);
                let [one, other] = knees;
                let knee = if one[0] > other[0] { one } else { other };
                (-knee[1]).atan2(knee[0]).to_degrees()
            };
            arms.map(angle).to_vec()
        };
        let mut most = Most::default();
        for number in 1..=POSES {
            let at = place(
                number,
                [0., 0., -230., 0., 0., 0.],
                [60., 60., 40., 0., 0., 0.],
            );
            let at = [at[0], at[1], at[2]];
            let joints = machine.inverse(&axes(&at)).unwrap();
            let other = inverse(&at);
            most.joints(&joints, &other);
            let found = machine.forward(&joints, &axes(&[])).unwrap();
            let start = [at[0] + 3.0, at[1] - 2.0, at[2] - 4.0];
            most.places(
                &found.as_slice()[..3],
                &solved(&other, start, &inverse),
                &at,
            );
        }
        most.below(1e-10, 1e-9, "rotary delta");
    }
}

/// The elbow is where two circles cross, on the side that is asked for.
#[test]
fn scaras_with_both_elbows() {
    for (elbow, side) in [(Elbow::Positive, 1.0), (Elbow::Negative, -1.0)] {
        let machine = scara(elbow);
        let (a, b, tool) = (340.0, 250.0, 50.0_f64);
        let mut most = Most::default();
        for number in 1..=POSES {
            let at = place(
                number,
                [350., 0., 100., 0., 0., 0.],
                [100., 150., 90., 0., 0., 80.],
            );
            let given = [at[0], at[1], at[2], 0.0, 0.0, at[5]];
            let joints = machine.inverse(&axes(&given)).unwrap();
            let heading = at[5].to_radians();
            let (x, y) = (at[0] - tool * heading.cos(), at[1] - tool * heading.sin());
            // Along the line from shoulder to wrist, and across.
            let reach = x.hypot(y);
            let along = (reach * reach + a * a - b * b) / (2.0 * reach);
            let across = (a * a - along * along).sqrt();
            let [u, v] = [x / reach, y / reach];
            // J1 > 0 has the elbow on the right of that line.
            let elbow_at = [along * u + side * across * v, along * v - side * across * u];
            let shoulder = elbow_at[1].atan2(elbow_at[0]).to_degrees();
            let fore = (y - elbow_at[1]).atan2(x - elbow_at[0]).to_degrees();
            let bend = (fore - shoulder + 180.0).rem_euclid(360.0) - 180.0;
            assert!(bend * side > 0.0);
            most.joints(
                &joints,
                &[shoulder, bend, 490.0 - at[2], at[5] - shoulder - bend],
            );
            let found = machine.forward(&joints, &axes(&[])).unwrap();
            // Turns one after the other, of the arm's pieces from the last to the first.
            let mut point = [tool, 0.0];
            for (angle, before) in [(joints[3], b), (joints[1], a), (joints[0], 0.0)] {
                let (sin, cos) = angle.to_radians().sin_cos();
                point = [
                    cos * point[0] - sin * point[1] + before,
                    sin * point[0] + cos * point[1],
                ];
            }
            let place = [found[0], found[1], found[2], found[5]];
            let other = [
                point[0],
                point[1],
                490.0 - joints[2],
                joints[0] + joints[1] + joints[3],
            ];
            most.places(&place, &other, &[at[0], at[1], at[2], at[5]]);
        }
        most.below(1e-9, 1e-10, "SCARA");
    }
}

/// A tilt with its matrix by elementary turns, and the index of its angle in a place.
type TiltCase = (Tilt, usize, fn(f64) -> Matrix3<f64>);

/// Right-handed about the direction that turns about y by `lean` and then about z by `heading` make of z.
fn about_leaning(lean: f64, heading: f64, degrees: f64) -> Matrix3<f64> {
    let to = about(2, heading) * about(1, lean);
    to * about(2, degrees) * to.transpose()
}

/// A and B, and skewed ones: at 45° in front of and behind z, level, and at any angle.
fn tilts() -> [TiltCase; 6] {
    let any = [1.0, 0.3, -0.5];
    [
        (Tilt::A, 3, |degrees| about(0, degrees)),
        (Tilt::B, 4, |degrees| about(1, degrees)),
        (skewed(Axis::B, [0.0, 1.0, 1.0]), 4, |degrees| {
            about_leaning(45.0, 90.0, degrees)
        }),
        (skewed(Axis::B, [0.0, 3.0, -3.0]), 4, |degrees| {
            about_leaning(135.0, 90.0, degrees)
        }),
        (skewed(Axis::A, [2.0, 2.0, 0.0]), 3, |degrees| {
            about_leaning(90.0, 45.0, degrees)
        }),
        (skewed(Axis::A, any), 3, |degrees| {
            let lean = 1.0_f64.hypot(0.3).atan2(-0.5).to_degrees();
            about_leaning(lean, 0.3_f64.atan2(1.0).to_degrees(), degrees)
        }),
    ]
}

/// Every layout, tilt and sign: linear joints by products of matrices, places by their transposes, and both ways to
/// stand along a direction.
#[test]
fn five_axis_machines_of_every_layout_and_sign() {
    let (a, c) = (
        Vector3::new(3.0, -4.0, -50.0),
        Vector3::new(5.0, 20.0, -7.0),
    );
    let layouts = [
        Rotaries::TableTable {
            tilt_point: a,
            rotary_point: c,
        },
        Rotaries::HeadHead {
            rotary_to_tilt: a,
            tilt_to_spindle: c,
        },
        Rotaries::TableHead { rotary_point: c },
    ];
    let up = Vector3::new(0.0, 0.0, 80.0);
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    for (tilt, index, tilt_by) in tilts() {
        for (rotaries, (t, r)) in layouts
            .iter()
            .flat_map(|layout| signs.map(|sign| (*layout, sign)))
        {
            let machine = FiveAxis {
                rotaries,
                tilt,
                tilt_reversed: t < 0.0,
                rotary_reversed: r < 0.0,
                tool_mm: 80.0,
            };
            let mut most = Most::default();
            for number in 1..=POSES {
                let mut at = place(number, [0.0; 6], [300., 300., 200., 175., 175., 400.]);
                at[7 - index] = 0.0;
                let tilt_deg = at[index];
                let (turn_t, turn_r) = (tilt_by(t * tilt_deg), about(2, r * at[5]));
                let tip = Vector3::new(at[0], at[1], at[2]);
                let joints = machine.inverse(&axes(&at)).unwrap();
                let linear = Vector3::new(joints[0], joints[1], joints[2]);
                let (other, back, tool) = match rotaries {
                    Rotaries::TableTable { .. } => (
                        a + turn_t * (c - a + turn_r * (tip - c)) + up,
                        c + turn_r.transpose() * (turn_t.transpose() * (linear - up - a) - (c - a)),
                        turn_r.transpose() * turn_t.transpose() * Vector3::z(),
                    ),
                    Rotaries::HeadHead { .. } => {
                        let added = turn_r * (a + turn_t * (c - up)) - (a + c - up);
                        (tip - added, linear + added, turn_r * turn_t * Vector3::z())
                    }
                    Rotaries::TableHead { .. } => {
                        let added = turn_t * up - up;
                        (
                            c + turn_r * (tip - c) + added,
                            c + turn_r.transpose() * (linear - added - c),
                            turn_r.transpose() * turn_t * Vector3::z(),
                        )
                    }
                };
                most.joints(&joints, &[other.x, other.y, other.z, tilt_deg, at[5]]);
                let found = machine.forward(&joints, &axes(&[])).unwrap();
                most.places(&found.as_slice()[..3], back.as_slice(), tip.as_slice());
                stands_both_ways(&machine, &tool, (tilt_deg, at[5]));
            }
            most.below(1e-9, 1e-9, "five axes");
        }
    }
}

/// Both branches of a direction are along it, and one of them is where the machine stood.
fn stands_both_ways(machine: &FiveAxis, tool: &Vector3<f64>, stood: (f64, f64)) {
    assert!((machine.tool_axis(stood.0, stood.1) - tool).norm() < 1e-12);
    let both = machine.branches_deg(tool, stood.1).unwrap();
    let far = |(tilt, rotary): (f64, f64)| (tilt - stood.0).abs().max((rotary - stood.1).abs());
    for (tilt, rotary) in both {
        assert!(
            (machine.tool_axis(tilt, rotary) - tool).norm() < 1e-9,
            "{tilt} {rotary}"
        );
        assert!(
            (rotary - stood.1).abs() <= 180.0 + 1e-9,
            "C is the nearest one"
        );
    }
    let pole = tool.x.hypot(tool.y);
    // At the pole the angle of C is worth nothing, and near it little.
    let nearest = far(both[0]).min(far(both[1]));
    assert!(nearest * pole < 1e-6, "{both:?} {stood:?}");
    assert!(
        (both[0].0 + both[1].0).abs() < 1e-9,
        "tilted to either side"
    );
}

#[test]
fn hexapods_by_products_of_matrices_and_by_newton() {
    let tool = Vector3::new(10.0, -5.0, 60.0);
    let machine = Hexapod {
        tool,
        ..Hexapod::paired(400.0, 150.0, 15.0)
    };
    let at = |radius: f64, degrees: f64| {
        let angle = degrees.to_radians();
        Vector3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    let base = [-15.0, 15.0, 105.0, 135.0, 225.0, 255.0].map(|degrees| at(400.0, degrees));
    let platform = [315.0, 45.0, 75.0, 165.0, 195.0, 285.0].map(|degrees| at(150.0, degrees));
    let inverse = |at: &[f64; 6]| -> Vec<f64> {
        let turn = about(2, at[5]) * about(1, at[4]) * about(0, at[3]);
        let centre = Vector3::new(at[0], at[1], at[2]) - turn * tool;
        let struts = base.iter().zip(&platform);
        struts
            .map(|(foot, head)| (centre + turn * head - foot).norm())
            .collect()
    };
    let mut most = Most::default();
    for number in 1..=POSES {
        let at = place(
            number,
            [0., 0., 520., 0., 0., 0.],
            [80., 80., 80., 12., 12., 12.],
        );
        let joints = machine.inverse(&axes(&at)).unwrap();
        let other = inverse(&at);
        most.joints(&joints, &other);
        // From the middle of the workspace, as the machine would after a start.
        let found = machine.forward(&joints, &axes(&[0.0, 0.0, 520.0])).unwrap();
        let newton = solved(&other, [0.0, 0.0, 520.0, 0.0, 0.0, 0.0], &inverse);
        most.places(&found.as_slice()[..6], &newton, &at);
    }
    most.below(1e-10, 1e-8, "hexapod");
}

/// Standing and hanging, from a base at zero and from others.
#[test]
fn translational_hexapods_standing_and_hanging() {
    for (base_z, height) in [(0.0, 500.0), (0.0, -420.0), (700.0, -450.0), (-30.0, 480.0)] {
        let machine = TranslationalHexapod {
            radius_difference_mm: 250.0,
            base_z_mm: base_z,
        };
        let mut most = Most::default();
        for number in 1..=POSES {
            let half = [150., 150., 150., 0., 0., 0.];
            let at = place(number, [0., 0., base_z + height, 0., 0., 0.], half);
            let at = [at[0], at[1], at[2]];
            let joints = machine.inverse(&axes(&at)).unwrap();
            let foot = |k: u32| {
                let angle = (60.0 * f64::from(k)).to_radians();
                [250.0 * angle.cos(), 250.0 * angle.sin()]
            };
            let length = |k: u32| {
                let [x, y] = foot(k);
                (at[0] - x).hypot(at[1] - y).hypot(at[2] - base_z)
            };
            let other: Vec<f64> = (0..6).map(length).collect();
            most.joints(&joints, &other);
            // Three struts hold the centre: differences of squares are linear in x and y.
            let square = |k: usize| joints[k] * joints[k];
            let [p, q, r] = [foot(0), foot(2), foot(4)];
            let rows = [(p, q, square(2) - square(0)), (p, r, square(4) - square(0))];
            let [(a, b, e), (c, d, f)] =
                rows.map(|(one, two, gap)| (2.0 * (one[0] - two[0]), 2.0 * (one[1] - two[1]), gap));
            let det = a * d - b * c;
            let (x, y) = ((e * d - b * f) / det, (a * f - e * c) / det);
            let up = (square(0) - (x - p[0]).powi(2) - (y - p[1]).powi(2)).sqrt();
            let z = base_z + up.copysign(height);
            let near = axes(&[0.0, 0.0, base_z + height]);
            let found = machine.forward(&joints, &near).unwrap();
            most.places(&found.as_slice()[..3], &[x, y, z], &at);
            assert!(machine.closure_mm(&joints) < 1e-10);
        }
        most.below(1e-10, 1e-9, "translational hexapod");
    }
}
