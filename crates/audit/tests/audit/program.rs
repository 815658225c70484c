//! Tests of what a program asks for besides lines: exact stops, tolerances of its own, feed.

use crate::{audit, item, kinds, point, polygon, walk};
use glidepath_audit::ViolationKind;
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Event, Item, ItemKind, PathMode};

fn with_mode(mut program: Vec<Item>, index: usize, new_mode: PathMode) -> Vec<Item> {
    if let ItemKind::Move { mode, .. } = &mut program[index].kind {
        *mode = new_mode;
    }
    program
}

#[test]
fn a_smoothed_corner_misses_an_exact_stop() {
    let corner = [point(0.0, 0.0), point(5.0, 0.0), point(5.0, 5.0)];
    let cut = [corner[0], point(4.99, 0.0), point(5.0, 0.01), corner[2]];
    let (exact, smoothed) = (walk(&corner, 0.1), walk(&cut, 0.1));
    let stop = with_mode(polygon(&corner), 0, PathMode::ExactStop);
    assert!(audit(&stop, &exact).is_clean());
    let report = audit(&stop, &smoothed);
    let [ViolationKind::ExactStop { deviation_mm }] = kinds(&report)[..] else {
        unreachable!("{:?}", report.violations)
    };
    assert!(
        (deviation_mm - 0.01 * 0.5_f64.sqrt()).abs() < 1e-6,
        "{deviation_mm}"
    );
    assert!(audit(&polygon(&corner), &smoothed).is_clean());
    // Exact-path mode allows what the chord of two samples on the path cuts off, no more.
    let path = with_mode(polygon(&corner), 0, PathMode::ExactPath);
    assert!(audit(&path, &smoothed).is_clean());
    assert!(!audit(&path, &walk(&cut, 0.002)).is_clean());
    // A dwell and an M code ask for an exact stop.
    for kind in [ItemKind::Dwell(0.0), ItemKind::Event(Event::MCode(8))] {
        let mut program = polygon(&corner);
        program.insert(
            1,
            Item {
                block: 0,
                line: 1,
                kind,
            },
        );
        assert!(audit(&program, &exact).is_clean());
        assert!(!audit(&program, &smoothed).is_clean());
    }
    let mut program = polygon(&corner);
    program.insert(
        1,
        Item {
            block: 0,
            line: 1,
            kind: ItemKind::Event(Event::SpindleSpeed(100.0)),
        },
    );
    assert!(audit(&program, &smoothed).is_clean());
}

#[test]
fn the_start_and_the_end_must_be_met() {
    let path = [point(0.0, 0.0), point(5.0, 0.0)];
    for (from, to, count) in [
        (0.0, 5.0, 0),
        (0.001, 5.0, 1),
        (0.0, 4.999, 1),
        (0.001, 5.001, 2),
    ] {
        let report = audit(
            &polygon(&path),
            &walk(&[point(from, 0.0), point(to, 0.0)], 0.2),
        );
        assert_eq!(kinds(&report).len(), count, "{:?}", kinds(&report));
        assert!(
            kinds(&report).iter().all(|kind| matches!(
                kind, ViolationKind::ExactStop { deviation_mm } if (deviation_mm - 0.001).abs() < 1e-6
            )),
            "{:?}", kinds(&report)
        );
        assert!(report.is_complete);
    }
}

#[test]
fn the_tolerance_of_the_program_counts_where_it_holds() {
    let corners = [
        point(0.0, 0.0),
        point(5.0, 0.0),
        point(5.0, 5.0),
        point(0.0, 5.0),
    ];
    let loose = PathMode::Continuous {
        tolerance_mm: Some(0.5),
    };
    let program = with_mode(polygon(&corners), 0, loose);
    let cut = |corner: usize| -> Vec<AxisVector> {
        let towards =
            |other: usize| corners[corner] + (corners[other] - corners[corner]).normalize() * 0.4;
        let mut path = corners.to_vec();
        path.splice(corner..=corner, [towards(corner - 1), towards(corner + 1)]);
        walk(&path, 0.1)
    };
    assert!(audit(&program, &cut(1)).is_clean());
    let report = audit(&program, &cut(2));
    let [ViolationKind::Deviation { deviation_mm }] = kinds(&report)[..] else {
        unreachable!("{:?}", report.violations)
    };
    assert!(
        (deviation_mm - 0.4 * 0.5_f64.sqrt()).abs() < 1e-6,
        "{deviation_mm}"
    );
}

/// A side has the larger of the tolerances at its two corners.
#[test]
fn a_side_after_a_loose_corner_is_loose() {
    let corners = [
        point(0.0, 0.0),
        point(5.0, 0.0),
        point(5.0, 5.0),
        point(0.0, 5.0),
    ];
    let beside = [
        corners[0],
        corners[1],
        point(4.7, 1.0),
        point(4.7, 2.0),
        point(5.0, 3.0),
    ];
    let motion = walk(&[&beside[..], &corners[2..]].concat(), 0.1);
    let loose = PathMode::Continuous {
        tolerance_mm: Some(0.5),
    };
    for (index, clean) in [(0, true), (1, true), (2, false)] {
        let report = audit(&with_mode(polygon(&corners), index, loose), &motion);
        assert_eq!(report.is_clean(), clean, "{index}: {:?}", report.violations);
    }
}

#[test]
fn two_missed_stops_are_two() {
    let corners = [(0.0, 0.0), (5.0, 0.0), (5.0, 0.05), (10.0, 0.05)].map(|(x, y)| point(x, y));
    let cut = [
        corners[0],
        point(4.99, 0.0),
        point(5.0, 0.01),
        point(5.0, 0.046),
    ];
    let cut = [&cut[..], &[point(5.004, 0.05), corners[3]]].concat();
    let mut program = with_mode(polygon(&corners), 0, PathMode::ExactStop);
    program = with_mode(program, 1, PathMode::ExactStop);
    let missed: Vec<_> = kinds(&audit(&program, &walk(&cut, 0.01)))
        .into_iter()
        .map(|kind| match kind {
            ViolationKind::ExactStop { deviation_mm } => (deviation_mm * 1e5).round() / 1e5,
            other => unreachable!("{other:?}"),
        })
        .collect();
    assert_eq!(missed, [0.00707, 0.00283]);
}

#[test]
fn two_bulges_are_two() {
    let path = [point(0.0, 0.0), point(10.0, 0.0)];
    let mut motion = walk(&path, 0.02);
    motion[100] += point(0.0, 0.05);
    motion[103] += point(0.0, 0.03);
    let bulges: Vec<_> = audit(&polygon(&path), &motion)
        .violations
        .into_iter()
        .map(|violation| match violation.kind {
            ViolationKind::Deviation { deviation_mm } => {
                (violation.tick, (deviation_mm * 1e5).round())
            }
            other => unreachable!("{other:?}"),
        })
        .collect();
    assert_eq!(bulges, [(100, 5000.0), (103, 3000.0)]);
}

#[test]
fn detours_below_the_tolerance_are_no_fault() {
    // A zigzag of 0.01 back and forth, run straight, at several speeds.
    let mut zigzag = vec![point(0.0, 0.0)];
    for k in 0..40_u32 {
        let x = 0.02 * f64::from(k);
        zigzag.extend([point(x + 0.03, 0.004), point(x + 0.02, -0.004)]);
    }
    zigzag.push(point(2.0, 0.0));
    for step in [0.3, 0.01, 1e-4] {
        let report = audit(
            &polygon(&zigzag),
            &walk(&[point(0.0, 0.0), point(2.0, 0.0)], step),
        );
        assert!(
            report.is_clean() && report.is_complete,
            "{step}: {:?}",
            report.violations
        );
        assert!(
            report.max_deviation_mm < 0.0075,
            "{step}: {}",
            report.max_deviation_mm
        );
    }
}

/// The program goes back by less than two tolerances, the motion does not: half of it is enough if
/// the matching hurries on in time, however slow the motion.
#[test]
fn a_step_back_is_matched_in_time() {
    let back = [(0.0, 0.0), (1.03, 0.0), (1.0, 0.0), (2.0, 0.0)].map(|(x, y)| point(x, y));
    for step in [0.3, 0.01, 1e-3, 1e-4] {
        let report = audit(&polygon(&back), &walk(&[back[0], back[3]], step));
        assert!(
            report.is_clean() && report.is_complete,
            "{step}: {:?}",
            report.violations
        );
        // A level found by rising is searched again after two percent.
        let excess = report.max_deviation_mm / 0.015 - 1.0;
        assert!(
            (-1e-4..0.021).contains(&excess),
            "{step}: {}",
            report.max_deviation_mm
        );
    }
}

/// A program that jumps is no excuse for a motion that does: the gap has to be run.
#[test]
fn a_jump_in_the_program_is_bridged() {
    let (a, b, c, d) = (
        point(0.0, 0.0),
        point(5.0, 0.0),
        point(5.0, 3.0),
        point(0.0, 3.0),
    );
    let program = [item(1, Segment::line(a, b)), item(2, Segment::line(c, d))];
    assert!(audit(&program, &walk(&[a, b, c, d], 0.2)).is_clean());
    let detour = walk(&[a, b, point(8.0, 1.5), c, d], 0.2);
    assert!(!audit(&program, &detour).is_clean());
}

/// Two passes a hundredth apart, and a crossing: neither may be taken for the other.
#[test]
fn passes_near_each_other_are_told_apart() {
    let passes = [
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 0.01),
        (0.0, 0.01),
        (0.0, 0.02),
        (10.0, 0.02),
    ]
    .map(|(x, y)| point(x, y));
    assert!(audit(&polygon(&passes), &walk(&passes, 0.3)).is_clean());
    let report = audit(&polygon(&passes), &walk(&[passes[0], passes[5]], 0.3));
    assert!(report.max_deviation_mm > 4.9, "{report:?}");
    let crossing = [
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 5.0),
        (5.0, 5.0),
        (5.0, -5.0),
    ]
    .map(|(x, y)| point(x, y));
    assert!(audit(&polygon(&crossing), &walk(&crossing, 0.3)).is_clean());
    let short_cut = [crossing[0], point(5.0, 0.0), crossing[4]];
    assert!(!audit(&polygon(&crossing), &walk(&short_cut, 0.3)).is_clean());
}

#[test]
fn every_group_of_axes_counts_by_itself() {
    for axis in 0..9 {
        let mut end = point(10.0, 0.0);
        end[axis] += 10.0;
        let path = [AxisVector::zeros(), end];
        for (bulge, found) in [(0.0199, false), (0.0202, true)] {
            let mut motion = walk(&path, 0.3);
            // Across the path inside its own group.
            let other = match axis {
                0..3 => 2 - axis / 2,
                3..6 => axis,
                _ => 6 + (axis - 5) % 3,
            };
            motion[20][other] += bulge;
            // A rotary axis by itself can be late without being off: the others hold it in place.
            let report = audit(&polygon(&path), &motion);
            if axis != 2 && !(3..6).contains(&axis) {
                assert_eq!(!report.is_clean(), found, "axis {axis}: {report:?}");
            }
        }
    }
}

#[test]
fn a_motion_without_a_program_is_found() {
    assert!(audit(&[], &[point(1.0, 2.0); 4]).is_clean());
    let report = audit(&[], &walk(&[point(0.0, 0.0), point(1.0, 0.0)], 0.1));
    assert_eq!(kinds(&report), [ViolationKind::Lost]);
    assert_eq!(
        kinds(&audit(&polygon(&[point(0.0, 0.0), point(1.0, 0.0)]), &[])),
        [ViolationKind::Incomplete]
    );
}

/// Passing a slight corner in exact-path mode: the chord between two samples on the path cuts it
/// off, and that is no fault; leaving the path is.
#[test]
fn exact_path_mode_allows_the_chord_and_no_more() {
    for turn in [0.02_f64, 0.3] {
        let corner = [
            point(0.0, 0.0),
            point(5.0, 0.0),
            point(5.0 + turn.cos(), turn.sin()),
        ];
        let program = with_mode(polygon(&corner), 0, PathMode::ExactPath);
        let mut motion = walk(&corner, 0.1);
        let at = motion.iter().position(|p| *p == corner[1]);
        let Some(at) = at else {
            unreachable!("the walk has the corner")
        };
        // Samples before and after the corner but none on it: 0.05 to 0.1 mm around it.
        motion[at] = corner[1] - (corner[1] - corner[0]).normalize() * 0.003;
        assert!(audit(&program, &motion).is_clean(), "{turn}");
        // The same off the path by more than the chord explains, but within tolerance.
        motion[at] = corner[1] + point(-0.003, 0.005);
        let report = audit(&program, &motion);
        assert!(matches!(kinds(&report)[..], [ViolationKind::ExactStop { .. }]) || turn > 0.1);
        assert!(audit(&polygon(&corner), &motion).is_clean());
    }
}
