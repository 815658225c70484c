//! Tests of feed and dwells.

use crate::{PERIOD, audit, kinds, point, polygon, sample, settings, walk};
use glidepath_audit::{Audit, AuditReport, ViolationKind};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind, Limits, PathMode, Rate};

fn at_speed(program: &[Item], v: f64) -> AuditReport {
    let mut audit = Audit::new(&settings(Limits::UNLIMITED));
    for item in program {
        audit.program(item);
    }
    let ticks = (10.0 / v / PERIOD).ceil();
    let mut k = 0.0;
    let mut tick = 0;
    while k <= ticks {
        audit.sample(&sample(tick, point((k * v * PERIOD).min(10.0), 0.0)));
        k += 1.0;
        tick += 1;
    }
    audit.finish()
}

#[test]
fn too_fast_for_the_feed_is_found() {
    let mut program = polygon(&[point(0.0, 0.0), point(5.0, 0.0), point(10.0, 0.0)]);
    assert!(at_speed(&program, 50.0).is_clean());
    for item in &mut program {
        if let ItemKind::Move { rate, .. } = &mut item.kind {
            *rate = Rate::Feed(50.0);
        }
    }
    let at_feed = at_speed(&program, 50.0);
    assert!(at_feed.is_clean() && (at_feed.max_feed_ratio.ratio - 1.0).abs() < 1e-9);
    let above = at_speed(&program, 50.2);
    assert!(
        above
            .violations
            .iter()
            .all(|v| matches!(v.kind, ViolationKind::Feed { .. }))
    );
    assert!(!above.is_clean() && (above.max_feed_ratio.ratio - 1.004).abs() < 1e-9);
    // A slower second half: only that is at fault.
    if let ItemKind::Move { rate, .. } = &mut program[1].kind {
        *rate = Rate::Feed(25.0);
    }
    let half = at_speed(&program, 50.0);
    assert_eq!(half.violation_count, 24, "{:?}", half.violations);
}

#[test]
fn an_override_scales_the_feed() {
    let mut program = polygon(&[point(0.0, 0.0), point(10.0, 0.0)]);
    if let ItemKind::Move { rate, .. } = &mut program[0].kind {
        *rate = Rate::Feed(50.0);
    }
    for (factor, clean) in [(1.0, false), (1.2, true)] {
        let mut audit = Audit::new(&settings(Limits::UNLIMITED)).with_override(factor);
        audit.program(&program[0]);
        for (tick, position) in (0..).zip(walk(&[point(0.0, 0.0), point(10.0, 0.0)], 0.24)) {
            audit.sample(&sample(tick, position));
        }
        assert_eq!(audit.finish().is_clean(), clean);
    }
    // Raised on the way, behind what it allows.
    for (raised_at, clean) in [(0, true), (20, false)] {
        let mut audit = Audit::new(&settings(Limits::UNLIMITED));
        audit.program(&program[0]);
        for (tick, position) in (0..).zip(walk(&[point(0.0, 0.0), point(10.0, 0.0)], 0.24)) {
            if tick == raised_at {
                audit.raise_override(1.2);
            }
            audit.sample(&sample(tick, position));
        }
        assert_eq!(audit.finish().is_clean(), clean, "{raised_at}");
    }
}

/// Samples lost on the way are a gap, not a motion at a multiple of the feed.
#[test]
fn a_gap_is_not_too_fast() {
    let mut program = polygon(&[point(0.0, 0.0), point(10.0, 0.0)]);
    if let ItemKind::Move { rate, .. } = &mut program[0].kind {
        *rate = Rate::Feed(50.0);
    }
    let mut audit = Audit::new(&settings(Limits::UNLIMITED));
    audit.program(&program[0]);
    for (tick, position) in (0..).zip(walk(&[point(0.0, 0.0), point(10.0, 0.0)], 0.2)) {
        if !(20..23).contains(&tick) {
            audit.sample(&sample(tick, position));
        }
    }
    assert_eq!(kinds(&audit.finish()), [ViolationKind::Gap { after: 19 }]);
}

#[test]
fn a_dwell_cut_short_is_found() {
    let path = [point(0.0, 0.0), point(5.0, 0.0), point(5.0, 5.0)];
    let dwell = |dwell_t| Item {
        block: 0,
        line: 1,
        kind: ItemKind::Dwell(dwell_t),
    };
    // 25 periods in the middle, 10 at the end.
    let mut motion = walk(&path[..2], 0.1);
    motion.extend([path[1]; 25]);
    motion.extend(&walk(&path[1..], 0.1)[1..]);
    motion.extend([path[2]; 10]);
    for (middle_t, end_t, missing) in [
        (0.1, 0.04, vec![]),
        (0.12, 0.04, vec![0.02]),
        (0.1, 0.05, vec![0.01]),
        (0.2, 0.2, vec![0.1, 0.16]),
    ] {
        let mut program = polygon(&path);
        program.insert(1, dwell(middle_t));
        program.push(dwell(0.5 * end_t));
        program.push(dwell(0.5 * end_t));
        let found: Vec<_> = kinds(&audit(&program, &motion))
            .into_iter()
            .map(|kind| match kind {
                ViolationKind::Dwell { missing_t } => (missing_t * 1e6).round() / 1e6,
                other => unreachable!("{other:?}"),
            })
            .collect();
        assert_eq!(found, missing);
    }
}

/// The verdict on a motion along two chords with feeds of 1 mm/s and 50 mm/s, in this order or the
/// other.
fn is_clean_past_a_vertex(chords: [&[AxisVector]; 2], feeds_v: [f64; 2]) -> bool {
    let mut program = polygon(&[point(0.0, 0.0), point(1.0, 0.0), point(1.0, 1.0)]);
    for (item, feed_v) in program.iter_mut().zip(feeds_v) {
        if let ItemKind::Move { rate, .. } = &mut item.kind {
            *rate = Rate::Feed(feed_v);
        }
    }
    let mut audit = Audit::new(&settings(Limits::UNLIMITED));
    for item in &program {
        audit.program(item);
    }
    for (tick, position) in (0..).zip(chords.concat()) {
        audit.sample(&sample(tick, position));
    }
    audit.finish().is_clean()
}

/// Next to a vertex the motion may be on the chord behind it, with its feed; farther away it may
/// not.
#[test]
fn within_tolerance_of_a_vertex_the_next_feed_holds() {
    let fast = walk(&[point(1.0, 0.0), point(1.0, 1.0)], 0.1);
    for (hurried_x, is_clean) in [(0.995, true), (0.97, false)] {
        // The last step of the slow chord at five times its feed.
        let mut slow = walk(&[point(0.0, 0.0), point(hurried_x - 0.02, 0.0)], 0.004);
        slow.push(point(hurried_x, 0.0));
        let found = is_clean_past_a_vertex([&slow, &fast], [1.0, 50.0]);
        assert_eq!(found, is_clean, "{hurried_x}");
    }
}

/// A period that begins next to a vertex may be one of the chord before it.
#[test]
fn within_tolerance_of_a_vertex_the_last_feed_holds() {
    let fast = walk(&[point(0.0, 0.0), point(1.0, 0.0)], 0.1);
    for (hurried_y, is_clean) in [(0.015, true), (0.03, false)] {
        // One step of the slow chord at five times its feed, out of the tolerance of the fast one.
        let mut slow = walk(&[point(1.0, 0.0), point(1.0, hurried_y)], 0.0039);
        slow.extend(walk(
            &[point(1.0, hurried_y + 0.02), point(1.0, 1.0)],
            0.0039,
        ));
        let found = is_clean_past_a_vertex([&fast, &slow[1..]], [50.0, 1.0]);
        assert_eq!(found, is_clean, "{hurried_y}");
    }
}

/// A move of a tenth of a millimetre a period, with items before and behind it.
fn with_rests(before: &[Item], behind: &[Item]) -> AuditReport {
    let mut audit = Audit::new(&settings(Limits::UNLIMITED));
    let moves = polygon(&[point(0.0, 0.0), point(1.0, 0.0)]);
    for item in before.iter().chain(&moves).chain(behind) {
        audit.program(item);
    }
    // It stands before and behind for longer than the program says: somebody has waited.
    let way = (0..200_u32).map(|k| f64::from(k.clamp(95, 105) - 95) * 0.1);
    for (tick, x) in (0..).zip(way) {
        audit.sample(&sample(tick, point(x, 0.0)));
    }
    audit.finish()
}

#[test]
fn the_program_takes_as_long_as_its_motion_and_all_its_dwells() {
    let dwell = |seconds| Item {
        block: 0,
        line: 1,
        kind: ItemKind::Dwell(seconds),
    };
    let moving_t = 10.0 * PERIOD;
    for (before, behind) in [(0.0, 0.0), (0.2, 0.0), (0.0, 0.1), (0.2, 0.1)] {
        let report = with_rests(
            &[dwell(before)],
            &[dwell(0.5 * behind), dwell(0.5 * behind)],
        );
        let wanted = moving_t + before + behind;
        assert!((report.cycle_time_s - wanted).abs() < 1e-12, "{report:?}");
    }
}

#[test]
fn the_tolerance_told_is_that_of_the_moves_and_degrees_are_no_millimetres() {
    let mut program = polygon(&[point(0.0, 0.0), point(5.0, 0.0), point(10.0, 0.0)]);
    let turned = {
        let mut turned = point(10.0, 0.0);
        turned[3] = 90.0;
        turned
    };
    let turn = Segment::line(point(10.0, 0.0), turned);
    program.push(crate::item(3, turn));
    let told = |tolerances: [Option<f64>; 3]| {
        let mut program = program.clone();
        for (item, given) in program.iter_mut().zip(tolerances) {
            if let ItemKind::Move { mode, .. } = &mut item.kind {
                *mode = PathMode::Continuous {
                    tolerance_mm: given,
                };
            }
        }
        let report = audit(&program, &walk(&[point(0.0, 0.0), point(10.0, 0.0)], 0.1));
        assert!((report.path_length_mm - 10.0).abs() < 1e-12, "{report:?}");
        assert!((report.turn_length_deg - 90.0).abs() < 1e-12, "{report:?}");
        [report.least_tolerance_mm, report.tolerance_mm].map(f64::to_bits)
    };
    let are = |tolerances: [f64; 2]| tolerances.map(f64::to_bits);
    assert_eq!(told([Some(0.005); 3]), are([0.005; 2]));
    assert_eq!(
        told([None, Some(0.005), Some(0.01)]),
        are([0.005, crate::TOLERANCE])
    );
    assert_eq!(
        told([Some(0.1), Some(0.005), Some(0.01)]),
        are([0.005, 0.1])
    );
    assert_eq!(told([None; 3]), are([crate::TOLERANCE; 2]));
}

/// A rapid along X, and a cut at 50 mm/s, straight on or along Y, each within 5 mm.
fn rapid_and_cut(corner: AxisVector, end: AxisVector, is_cut_first: bool) -> [Item; 2] {
    let mode = PathMode::Continuous {
        tolerance_mm: Some(5.0),
    };
    let rates = [Rate::Rapid, Rate::Feed(50.0)];
    let item = |k: usize, from, to| Item {
        block: 0,
        line: 1,
        kind: ItemKind::Move {
            segment: Segment::line(from, to),
            rate: rates[(k + usize::from(is_cut_first)) % 2],
            mode,
        },
    };
    [item(0, AxisVector::zeros(), corner), item(1, corner, end)]
}

/// However wide the tolerance is: a rapid that runs on into a cut breaks the tool.
#[test]
fn a_rapid_ends_where_it_is_programmed_to_end() {
    let corner = point(40.0, 0.0);
    for end in [point(80.0, 0.0), point(40.0, 40.0)] {
        let program = rapid_and_cut(corner, end, false);
        let away = (end - corner).normalize();
        // At 100 mm/s so far into the cut, and on at 50 mm/s.
        for (beyond_mm, clean) in [(0.0, true), (0.08, true), (1.0, false), (3.0, false)] {
            let slow_at = corner + away * beyond_mm;
            let mut motion = walk(&[AxisVector::zeros(), corner, slow_at], 0.4);
            motion.extend(&walk(&[slow_at, end], 0.2)[1..]);
            for (name, report) in fed_in_every_way(&program, &motion) {
                assert_eq!(
                    report.is_clean(),
                    clean,
                    "{beyond_mm} mm, {name}: {report:#?}"
                );
                let is_feed = |kind: &ViolationKind| matches!(kind, ViolationKind::Feed { .. });
                assert!(kinds(&report).iter().all(is_feed), "{report:#?}");
            }
        }
    }
}

/// A corner cut short has both feeds where it is as near to the one as to the other.
#[test]
fn a_corner_between_two_rates_changes_the_rate_half_way() {
    let (corner, end) = (point(40.0, 0.0), point(40.0, 40.0));
    let (from, to) = (point(37.0, 0.0), point(40.0, 3.0));
    let middle = (from + to) * 0.5;
    for is_cut_first in [false, true] {
        let program = rapid_and_cut(corner, end, is_cut_first);
        for (moved_mm, clean) in [(-1.5, !is_cut_first), (0.0, true), (1.5, is_cut_first)] {
            let change = middle + (to - from).normalize() * moved_mm;
            let mut steps = [0.4, 0.2];
            if is_cut_first {
                steps.reverse();
            }
            let mut motion = walk(&[AxisVector::zeros(), from, change], steps[0]);
            motion.extend(&walk(&[change, to, end], steps[1])[1..]);
            for (name, report) in fed_in_every_way(&program, &motion) {
                let what = format!("cut first: {is_cut_first}, {moved_mm} mm, {name}");
                assert_eq!(report.is_clean(), clean, "{what}: {report:#?}");
            }
        }
    }
}

/// The verdicts where the program comes before the motion, with it, and behind it.
fn fed_in_every_way(program: &[Item], motion: &[AxisVector]) -> [(&'static str, AuditReport); 3] {
    let verdict = |wait: usize| {
        let mut audit = Audit::new(&settings(Limits::UNLIMITED));
        let mut items = program.iter();
        let mut due = 0;
        for (tick, position) in (0..).zip(motion) {
            if tick == due
                && let Some(item) = items.next()
            {
                audit.program(item);
                due += wait;
            }
            audit.sample(&sample(tick as u64, *position));
        }
        for item in items {
            audit.program(item);
        }
        audit.finish()
    };
    let before = {
        let mut audit = Audit::new(&settings(Limits::UNLIMITED));
        program.iter().for_each(|item| audit.program(item));
        for (tick, position) in (0..).zip(motion) {
            audit.sample(&sample(tick, *position));
        }
        audit.finish()
    };
    let late = motion.len() + 1;
    [
        ("before", before),
        ("with it", verdict(95)),
        ("behind", verdict(late)),
    ]
}
