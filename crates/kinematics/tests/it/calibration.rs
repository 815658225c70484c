//! Tests of calibration: points that are made by formulas of the tests' own, with noise, give the dimensions
//! back within what the noise allows; what they do not tell is named.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::cast_precision_loss,
    clippy::float_cmp,
    reason = "a test; what is kept is kept to the bit"
)]

use crate::support::*;
use glidepath_geometry::Axis;
use glidepath_kinematics::*;
use nalgebra::Vector3;

/// Noise that is about normal, the same every time.
struct Noise(u64);

impl Noise {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Standard deviation 1.
    fn next(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

fn settings() -> CalibrationSettings {
    CalibrationSettings {
        accuracy: MeasuringAccuracy {
            position_mm: 0.01,
            angle_deg: 0.005,
        },
        most_deviation: 1.0,
        held: Vec::new(),
    }
}

/// A point with a place that was measured as it is.
fn exact(joints: &[f64], place: &[f64]) -> MeasuredPoint {
    MeasuredPoint {
        joints: axes(joints),
        measured: core::array::from_fn(|i| place.get(i).copied()),
        near: axes(place),
    }
}

/// What is measured with the stated accuracy.
fn noisy(mut points: Vec<MeasuredPoint>, noise: &mut Noise) -> Vec<MeasuredPoint> {
    for point in &mut points {
        for (axis, measured) in point.measured.iter_mut().enumerate() {
            let sigma = if axis < 3 { 0.01 } else { 0.005 };
            if let Some(measured) = measured {
                *measured += sigma * noise.next();
            }
        }
    }
    points
}

/// A case: the nominal mechanism, the true values of all its dimensions, and points of the true one.
struct Case {
    nominal: Mechanism,
    truth: Vec<f64>,
    points: Vec<MeasuredPoint>,
}

fn linear_delta_case(noise: &mut Noise) -> Case {
    let (rod, radius, towers) = (270.3, 129.6, [90.4, 209.8, 329.9]);
    let zeros = [0.4, -0.3, 0.25];
    let point = |_| {
        let place = [
            noise.between(-85.0, 85.0),
            noise.between(-85.0, 85.0),
            noise.between(0.0, 120.0),
        ];
        let joint = |i: usize| {
            let angle = f64::to_radians(towers[i]);
            let across = (place[0] - radius * angle.cos()).hypot(place[1] - radius * angle.sin());
            place[2] + (rod - across).mul_add(rod + across, 0.0).sqrt() - zeros[i]
        };
        exact(&[joint(0), joint(1), joint(2)], &place)
    };
    Case {
        nominal: Mechanism::LinearDelta(delta()),
        points: (0..40).map(point).collect(),
        truth: [&[rod, radius][..], &towers, &zeros].concat(),
    }
}

fn rotary_delta_case(noise: &mut Noise) -> Case {
    let (base, platform, upper, fore) = (91.2, 40.0, 119.5, 260.7);
    let (arms, zeros) = ([0.3, 119.8, 240.2], [0.5, -0.4, 0.3]);
    let point = |_| {
        let place = [
            noise.between(-60.0, 60.0),
            noise.between(-60.0, 60.0),
            noise.between(-270.0, -200.0),
        ];
        // |platform joint − knee|² = fore², which is E cos θ + F sin θ = G, by the tangent of half θ.
        let joint = |i: usize| {
            let (s, c) = f64::to_radians(arms[i]).sin_cos();
            let out = place[0] * c + place[1] * s + platform - base;
            let across = place[1] * c - place[0] * s;
            let (e, f) = (2.0 * upper * out, -2.0 * upper * place[2]);
            let g = out * out + across * across + place[2] * place[2] + upper * upper - fore * fore;
            let root = (e * e + f * f - g * g).sqrt();
            let angles = [root, -root].map(|root| 2.0 * (f + root).atan2(g + e));
            let outer = angles
                .into_iter()
                .max_by(|a, b| a.cos().total_cmp(&b.cos()));
            let degrees = outer.unwrap().to_degrees();
            (degrees + 180.0).rem_euclid(360.0) - 180.0 - zeros[i]
        };
        exact(&[joint(0), joint(1), joint(2)], &place)
    };
    Case {
        nominal: Mechanism::RotaryDelta(rotary_delta()),
        points: (0..40).map(point).collect(),
        truth: [&[base, platform, upper, fore][..], &arms, &zeros].concat(),
    }
}

fn hexapod_case(noise: &mut Noise) -> Case {
    let (base, platform, half, base_z) = (401.5, 149.2, 15.3, -1.5);
    let tool = Vector3::new(1.0, -0.8, 61.0);
    let zeros = [0.2, -0.1, 0.3, -0.25, 0.15, -0.3];
    let nominal = Hexapod {
        tool: Vector3::new(0.0, 0.0, 60.0),
        ..Hexapod::paired(400.0, 150.0, 15.0)
    };
    let at = |radius: f64, degrees: f64, z: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        Vector3::new(radius * c, radius * s, z)
    };
    let (on_base, on_platform) = (
        [
            -half,
            half,
            120.0 - half,
            120.0 + half,
            240.0 - half,
            240.0 + half,
        ],
        [
            300.0 + half,
            60.0 - half,
            60.0 + half,
            180.0 - half,
            180.0 + half,
            300.0 - half,
        ],
    );
    let point = |_| {
        let place = [
            noise.between(-90.0, 90.0),
            noise.between(-90.0, 90.0),
            noise.between(480.0, 620.0),
            noise.between(-13.0, 13.0),
            noise.between(-13.0, 13.0),
            noise.between(-25.0, 25.0),
        ];
        let turn = about(2, place[5]) * about(1, place[4]) * about(0, place[3]);
        let centre = Vector3::new(place[0], place[1], place[2]) - turn * tool;
        let joint = |i: usize| {
            let strut =
                centre + turn * at(platform, on_platform[i], 0.0) - at(base, on_base[i], base_z);
            strut.dot(&strut).sqrt() - zeros[i]
        };
        let joints: Vec<f64> = (0..6).map(joint).collect();
        exact(&joints, &place)
    };
    Case {
        nominal: Mechanism::Hexapod(nominal),
        points: (0..40).map(point).collect(),
        truth: [&[base, platform, half, base_z][..], tool.as_slice(), &zeros].concat(),
    }
}

fn translational_case(noise: &mut Noise) -> Case {
    let (difference, base_z, zeros) = (250.9, 0.7, [0.1, -0.2, 0.3, 0.2, -0.1, 0.0]);
    let point = |_| {
        let place = [
            noise.between(-160.0, 160.0),
            noise.between(-160.0, 160.0),
            noise.between(300.0, 700.0),
        ];
        let joint = |k: usize| {
            let angle = f64::to_radians(60.0 * k as f64);
            let flat =
                (place[0] - difference * angle.cos()).hypot(place[1] - difference * angle.sin());
            flat.hypot(place[2] - base_z) - zeros[k]
        };
        let joints: Vec<f64> = (0..6).map(joint).collect();
        exact(&joints, &place)
    };
    Case {
        nominal: Mechanism::Translational(translational()),
        points: (0..40).map(point).collect(),
        truth: [&[difference, base_z][..], &zeros].concat(),
    }
}

/// Tilt A on a table below a table C: turned work w is at a + Rx(θ) (c − a + Rz(γ) (w − c)) + (0, 0, tool).
fn tables_case(noise: &mut Noise) -> Case {
    let (tool, a, c) = (
        80.0,
        Vector3::new(0.0, 0.6, -50.4),
        Vector3::new(0.3, 20.2, 0.0),
    );
    let zeros = [0.2, -0.3, 0.0, 0.05, -0.1];
    let point = |_| {
        let work = Vector3::from_fn(|_, _| noise.between(-60.0, 60.0));
        let (tilt, rotary) = (noise.between(-60.0, 60.0), noise.between(-170.0, 170.0));
        let turned = about(0, tilt) * (c - a + about(2, rotary) * (work - c));
        let at = a + turned + Vector3::new(0.0, 0.0, tool);
        let joints = [at.x, at.y, at.z, tilt, rotary];
        let joints: Vec<f64> = joints.iter().zip(zeros).map(|(q, zero)| q - zero).collect();
        // Angles are not measured: the tip tells them.
        exact(&joints, work.as_slice())
    };
    Case {
        nominal: Mechanism::FiveAxis(table_table(Tilt::A, false)),
        points: (0..40).map(point).collect(),
        truth: [&[tool][..], a.as_slice(), c.as_slice(), &zeros].concat(),
    }
}

/// Tilt B on a head C: the tip is at q less what the head adds to its place at zero.
fn heads_case(noise: &mut Noise) -> Case {
    let (tool, d, e) = (
        249.5,
        Vector3::new(0.4, -0.3, 0.0),
        Vector3::new(0.2, 0.0, 0.0),
    );
    // A head that is tilted further is one whose spindle is further out, on a machine that is shifted.
    let zeros = [0.0, -0.2, 0.1, 0.04, -0.06];
    let point = |_| {
        let tip = Vector3::from_fn(|_, _| noise.between(-200.0, 200.0));
        let (tilt, rotary) = (noise.between(-70.0, 70.0), noise.between(-170.0, 170.0));
        let down = Vector3::new(0.0, 0.0, -tool);
        let arm = about(2, rotary) * (d + about(1, tilt) * (e + down));
        let at = tip - arm + d + e + down;
        let joints = [at.x, at.y, at.z, tilt, rotary];
        let joints: Vec<f64> = joints.iter().zip(zeros).map(|(q, zero)| q - zero).collect();
        exact(&joints, tip.as_slice())
    };
    Case {
        nominal: Mechanism::FiveAxis(head_head(Tilt::B, (false, false))),
        points: (0..40).map(point).collect(),
        truth: [&[tool][..], d.as_slice(), e.as_slice(), &zeros].concat(),
    }
}

type MakeCase = fn(&mut Noise) -> Case;

/// With those of its dimensions that its points leave out: they keep their nominal values, which are the true ones.
const CASES: [(&str, MakeCase, &[&str]); 6] = [
    ("linear delta", linear_delta_case, &[]),
    ("rotary delta", rotary_delta_case, &["platform_radius"]),
    ("hexapod", hexapod_case, &[]),
    ("translational", translational_case, &["zero of J5"]),
    (
        "tables",
        tables_case,
        &["tilt_point[0]", "rotary_point[2]", "zero of J2"],
    ),
    (
        "heads",
        heads_case,
        &[
            "rotary_to_tilt[2]",
            "tilt_to_spindle[1]",
            "tilt_to_spindle[2]",
            "zero of J0",
        ],
    ),
];

/// Struts that are longer and shorter in turn bend the six of a translational hexapod, and hardly move its tip.
fn settings_of(name: &str) -> CalibrationSettings {
    CalibrationSettings {
        held: if name == "translational" {
            vec![7]
        } else {
            Vec::new()
        },
        ..settings()
    }
}

#[test]
fn dimensions_are_found_within_what_the_noise_allows() {
    let mut off = Vec::new();
    for (name, make, left_out) in CASES {
        for seed in 0..8 {
            let mut noise = Noise(seed * 7919 + 17);
            let case = make(&mut noise);
            let points = noisy(case.points, &mut noise);
            let found = calibrate(&case.nominal, &points, &settings_of(name)).unwrap();
            let mut kept: Vec<String> = Vec::new();
            for (dimension, truth) in found.dimensions.iter().zip(&case.truth) {
                let Some(deviation) = dimension.deviation else {
                    assert_eq!(dimension.value, dimension.nominal);
                    kept.push(dimension.name.to_string());
                    continue;
                };
                let error = (dimension.value - truth) / deviation;
                assert!(
                    error.abs() < 4.5,
                    "{name} {}: {error} deviations",
                    dimension.name
                );
                off.push(error);
            }
            assert_eq!(kept, left_out, "{name}");
            let rms = found.after.position_mm.unwrap().rms;
            assert!(
                (0.013..0.021).contains(&rms),
                "{name}: {rms}, of 3 coordinates with .01 each"
            );
            assert!(found.before.position_mm.unwrap().rms > 10.0 * rms);
            assert!(found.spread_r.unwrap() < 1.3);
        }
    }
    // Stated deviations are those of the errors.
    let squares: f64 = off.iter().map(|error| error * error).sum();
    let rms = (squares / off.len() as f64).sqrt();
    assert!((0.85..1.1).contains(&rms), "{rms} over {}", off.len());
}

#[test]
fn what_is_measured_exactly_is_found_exactly() {
    for (name, make, _) in CASES {
        let case = make(&mut Noise(3));
        let found = calibrate(&case.nominal, &case.points, &settings_of(name)).unwrap();
        for (dimension, truth) in found.dimensions.iter().zip(&case.truth) {
            let error = dimension.value - truth;
            assert!(error.abs() < 1e-6, "{name} {}: {error}", dimension.name);
        }
        assert!(found.after.position_mm.unwrap().worst < 1e-7, "{name}");
        // The mechanism and the zeros that are given out are those.
        for point in &case.points {
            let joints = point.joints + found.zeros;
            let at = found.mechanism.forward(&joints, &point.near).unwrap();
            for (axis, measured) in point.measured.iter().enumerate() {
                if let Some(measured) = measured {
                    assert!((at[axis] - measured).abs() < 1e-7, "{name}");
                }
            }
        }
    }
}

#[test]
fn what_cannot_be_told_apart_is_named() {
    let case = rotary_delta_case(&mut Noise(5));
    let names = dimension_names(&case.nominal);
    let found = calibrate(&case.nominal, &case.points, &settings()).unwrap();
    let [sum] = found.untold.as_slice() else {
        panic!("{:?}", found.untold)
    };
    let parts: Vec<(String, f64)> = sum
        .parts
        .iter()
        .map(|part| {
            (
                names[part.place].to_string(),
                (part.factor * 1e4).round() / 1e4,
            )
        })
        .collect();
    let both = [
        ("platform_radius".to_owned(), 1.0),
        ("base_radius".to_owned(), 1.0),
    ];
    assert_eq!(parts, both, "only their difference matters");
    assert!(sum.deviation.is_infinite());

    let case = tables_case(&mut Noise(5));
    let names = dimension_names(&case.nominal);
    let found = calibrate(&case.nominal, &case.points, &settings()).unwrap();
    let with_tool = found
        .untold
        .iter()
        .find(|sum| sum.parts.len() == 2)
        .unwrap();
    let [zero, tool] = with_tool.parts.as_slice() else {
        panic!("{with_tool:?}")
    };
    assert_eq!(names[zero.place].to_string(), "zero of J2");
    assert_eq!(names[tool.place].to_string(), "tool");
    assert!((tool.factor - 1.0).abs() < 1e-4, "both add to the height");
}

#[test]
fn points_in_one_place_tell_little_and_it_is_said() {
    let mut noise = Noise(9);
    let case = linear_delta_case(&mut noise);
    let one = vec![case.points[0]; 12];
    let found = calibrate(&case.nominal, &noisy(one, &mut noise), &settings()).unwrap();
    let kept = found
        .dimensions
        .iter()
        .filter(|d| d.deviation.is_none())
        .count();
    assert_eq!(kept, 5, "three coordinates tell three of eight dimensions");
    assert_eq!(found.untold.len(), 5);
    assert!(found.after.position_mm.unwrap().rms < 0.03);

    // Points in a plane, of which only the height was measured: a bed with a gauge.
    let mut bed = case.points.clone();
    bed.iter_mut().for_each(|point| {
        point.measured[0] = None;
        point.measured[1] = None;
    });
    let found = calibrate(&case.nominal, &noisy(bed, &mut noise), &settings()).unwrap();
    let names = dimension_names(&case.nominal);
    let mut nothing = found
        .untold
        .iter()
        .filter(|sum| sum.deviation.is_infinite());
    let parts = nothing.next().unwrap().parts.iter();
    let parts: Vec<String> = parts
        .map(|part| format!("{:.3} {}", part.factor, names[part.place]))
        .collect();
    let together = [
        "1.000 tower_angles[2]",
        "1.000 tower_angles[0]",
        "1.000 tower_angles[1]",
    ];
    assert_eq!(
        parts, together,
        "no height tells of towers that turn together"
    );
    assert_eq!(nothing.next(), None);
}

#[test]
fn held_dimensions_keep_their_values() {
    let case = linear_delta_case(&mut Noise(11));
    let mut wanted = settings();
    wanted.held = vec![0, 6];
    let found = calibrate(&case.nominal, &case.points, &wanted).unwrap();
    for place in [0, 6] {
        assert_eq!(found.dimensions[place].deviation, None);
        assert_eq!(
            found.dimensions[place].value,
            found.dimensions[place].nominal
        );
    }
    assert!(found.untold.is_empty(), "nobody asked for them");
    assert!(found.dimensions[1].deviation.is_some());
    wanted.held = (0..8).collect();
    let none = calibrate(&case.nominal, &case.points, &wanted);
    assert_eq!(none, Err(CalibrationError::NothingTold));
}

#[test]
fn what_gives_no_dimensions_says_why() {
    let mut noise = Noise(13);
    let case = linear_delta_case(&mut noise);
    let few = calibrate(&case.nominal, &case.points[..2], &settings());
    let too_few = CalibrationError::TooFew {
        numbers: 6,
        dimensions: 8,
    };
    assert_eq!(few, Err(too_few));
    let none = calibrate(&case.nominal, &[], &settings());
    assert!(matches!(
        none,
        Err(CalibrationError::TooFew { numbers: 0, .. })
    ));
    let mut far = case.points.clone();
    far[4].joints[1] += 900.0;
    let unreachable = calibrate(&case.nominal, &far, &settings());
    assert!(matches!(
        unreachable,
        Err(CalibrationError::Unreachable { point: 4, .. })
    ));
    let trivial = Mechanism::Trivial(Trivial::new(AxisList::new(&[Axis::X])));
    assert_eq!(dimension_names(&trivial), []);
    let none = calibrate(&trivial, &case.points, &settings());
    assert_eq!(none, Err(CalibrationError::NoDimensions));
    // As many numbers as dimensions: found, and nothing left to judge them by.
    let mut eight: Vec<MeasuredPoint> = case.points[..3].to_vec();
    eight[2].measured[0] = None;
    let found = calibrate(&case.nominal, &eight, &settings()).unwrap();
    if found.untold.is_empty() {
        assert_eq!(found.spread_r, None);
    }
    assert_eq!(found.numbers, 8);
}
