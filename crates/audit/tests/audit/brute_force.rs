//! The deviation against a discrete Fréchet distance over fine subdivisions.

use crate::{audit_within, polygon, sample, settings};
use glidepath_audit::{Audit, AuditSettings, ViolationKind};
use glidepath_geometry::AxisVector;
use glidepath_program::{ItemKind, Limits, PathMode};
use proptest::prelude::*;

/// Axes that move: two of XYZ, one rotary, one of UVW.
const MOVING: [usize; 4] = [0, 1, 3, 6];

fn place(size: f64) -> impl Strategy<Value = AxisVector> {
    (prop::array::uniform4(-size..size), any::<bool>()).prop_map(|(values, only_xy)| {
        let mut place = AxisVector::zeros();
        for (axis, value) in MOVING.into_iter().zip(values) {
            if axis < 2 || !only_xy {
                place[axis] = value;
            }
        }
        place
    })
}

fn distance(a: &AxisVector, b: &AxisVector) -> f64 {
    let d = a - b;
    [0, 3, 6]
        .map(|first| d.rows(first, 3).norm())
        .into_iter()
        .fold(0.0, f64::max)
}

/// Points on a polygon at most `step` apart.
fn subdivide(points: &[AxisVector], step: f64) -> Vec<AxisVector> {
    let mut all = vec![points[0]];
    for pair in points.windows(2) {
        let parts = (distance(&pair[0], &pair[1]) / step).ceil().max(1.0);
        let mut k = 1.0;
        while k <= parts {
            all.push(pair[0] + (pair[1] - pair[0]) * (k / parts));
            k += 1.0;
        }
    }
    all
}

/// The discrete Fréchet distance; it exceeds that of the polygons by at most the step.
fn frechet(a: &[AxisVector], b: &[AxisVector]) -> f64 {
    let mut previous: Vec<f64> = Vec::new();
    for (i, p) in a.iter().enumerate() {
        let mut now = Vec::with_capacity(b.len());
        for (j, q) in b.iter().enumerate() {
            let mut before = f64::INFINITY;
            if i == 0 && j == 0 {
                before = 0.0;
            }
            if i > 0 {
                before = before.min(previous[j]);
            }
            if j > 0 {
                before = before.min(now[j - 1]);
            }
            if i > 0 && j > 0 {
                before = before.min(previous[j - 1]);
            }
            now.push(before.max(distance(p, q)));
        }
        previous = now;
    }
    previous[previous.len() - 1]
}

/// A program and a motion from its start to its end.
fn pair(size: f64, noise: f64) -> impl Strategy<Value = (Vec<AxisVector>, Vec<AxisVector>)> {
    prop::collection::vec(place(size), 2..8).prop_flat_map(move |program| {
        let count = program.len();
        let motion = (
            prop::collection::vec(place(noise), 0..14),
            prop::collection::vec(0.0..1.0_f64, 14),
            Just(program.clone()),
        );
        motion.prop_map(move |(offsets, mut at, program)| {
            at.sort_by(f64::total_cmp);
            let mut motion = vec![program[0]];
            for (offset, at) in offsets.iter().zip(at) {
                #[expect(clippy::cast_precision_loss, reason = "less than 8")]
                let x = at * (count - 1) as f64;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "less than 8"
                )]
                let side = (x.floor() as usize).min(count - 2);
                let y = x - x.floor();
                motion.push(program[side] * (1.0 - y) + program[side + 1] * y + offset);
            }
            motion.push(program[count - 1]);
            (program, motion)
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_deviation_is_the_frechet_distance((program, motion) in pair(1.0, 0.3)) {
        let step = 0.02;
        let want = frechet(&subdivide(&program, step), &subdivide(&motion, step));
        let report = audit_within(10.0, &polygon(&program), &motion);
        prop_assert!(report.is_clean(), "{:?}", report.violations);
        prop_assert!(report.max_deviation_mm <= want + 2e-5, "{} {want}", report.max_deviation_mm);
        prop_assert!(report.max_deviation_mm >= want - step, "{} {want}", report.max_deviation_mm);
    }

    /// With a tolerance in the way, the verdict is that of the distance, and the number is never
    /// too small.
    #[test]
    fn the_verdict_is_that_of_the_frechet_distance(
        (program, motion) in pair(1.0, 0.2), tolerance in 0.02..0.5_f64,
    ) {
        let step = 0.01;
        let want = frechet(&subdivide(&program, step), &subdivide(&motion, step));
        let report = audit_within(tolerance, &polygon(&program), &motion);
        if want <= tolerance {
            prop_assert!(report.is_clean(), "{want} {:?}", report.violations);
        }
        if want - step > tolerance {
            prop_assert!(!report.is_clean(), "{want} {report:?}");
        }
        let lost = report.violations.iter().any(|v| v.kind == ViolationKind::Lost);
        prop_assert!(!lost && report.is_complete, "{:?}", report.violations);
        prop_assert!(report.max_deviation_mm >= want - step, "{} {want}", report.max_deviation_mm);
    }

    /// However the two streams are interleaved, the verdict is the same.
    #[test]
    fn interleaving_does_not_matter(
        (program, motion) in pair(1.0, 0.05), lead in 1..6_usize, stops in any::<u8>(),
    ) {
        let settings = AuditSettings { tolerance_mm: 0.04, ..settings(Limits::UNLIMITED) };
        let mut items = polygon(&program);
        for (index, item) in items.iter_mut().enumerate() {
            if let ItemKind::Move { mode, .. } = &mut item.kind
                && stops & (1 << index) != 0
            {
                *mode = PathMode::ExactPath;
            }
        }
        let want = audit_within(0.04, &items, &motion);
        let mut audit = Audit::new(&settings);
        let mut fed = 0;
        for (tick, &position) in (0..).zip(&motion) {
            audit.sample(&sample(tick, position));
            for item in items.iter().skip(fed).take(lead - 1) {
                audit.program(item);
            }
            fed += lead - 1;
        }
        for item in items.iter().skip(fed) {
            audit.program(item);
        }
        prop_assert_eq!(audit.finish(), want);
    }
}
