//! Tests of tremor: what is planted is found, and motion that the program asks for is none.

use crate::{PERIOD, TOLERANCE, item, point, sample};
use core::f64::consts::TAU;
use glidepath_audit::tremor::SETTLING_T;
use glidepath_audit::{Audit, AuditReport, AuditSettings, ViolationKind};
use glidepath_geometry::{Arc, Axis, AxisVector, Plane, Segment};
use glidepath_program::{Item, ItemKind, Limits, Rate};

pub(crate) const FEED_V: f64 = 50.0;
/// From rest to the feed, s.
const RAMP_T: f64 = 0.25;
const MICROMETRE: f64 = 1e-3;

/// A move at the feed.
pub(crate) fn at_feed(line: u32, segment: Segment) -> Item {
    let mut item = item(line, segment);
    if let ItemKind::Move { rate, .. } = &mut item.kind {
        *rate = Rate::Feed(FEED_V);
    }
    item
}

/// How far one is after a time, from rest to rest, mm.
pub(crate) fn distance(time_t: f64, length_mm: f64) -> f64 {
    let ramp = |u: f64| FEED_V * RAMP_T * u.powi(4) * (2.5 - 3.0 * u + u * u);
    let end_t = length_mm / FEED_V + RAMP_T;
    let done = |t: f64| {
        if t < RAMP_T {
            ramp(t.max(0.0) / RAMP_T)
        } else {
            FEED_V * (t - 0.5 * RAMP_T)
        }
    };
    if time_t < 0.5 * end_t {
        done(time_t)
    } else {
        length_mm - done(end_t - time_t)
    }
}

pub(crate) fn settings(limits: Limits) -> AuditSettings {
    AuditSettings {
        limits,
        period_t: PERIOD,
        tolerance_mm: TOLERANCE,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    }
}

/// Of a milling machine.
pub(crate) fn mill() -> Limits {
    Limits::uniform(200.0, 2000.0, 40_000.0)
}

/// So high that corners may be sharp.
fn loose() -> Limits {
    Limits::uniform(1e4, 1e7, 1e10)
}

/// Audits a motion: where it is at a tick and a path position.
fn audit(
    limits: Limits,
    program: &[Item],
    length_mm: f64,
    at: impl Fn(u32, f64) -> AxisVector,
) -> (AuditReport, Vec<ViolationKind>) {
    let mut audit = Audit::new(&settings(limits));
    for item in program {
        audit.program(item);
    }
    let mut tick = 0;
    loop {
        let time_t = f64::from(tick) * PERIOD;
        let s = distance(time_t, length_mm);
        audit.sample(&sample(tick.into(), at(tick, s)));
        if time_t > length_mm / FEED_V + RAMP_T {
            break;
        }
        tick += 1;
    }
    let report = audit.finish();
    assert!(report.is_complete, "{:?}", report.violations);
    let kinds = report.tremors.iter().map(|tremor| tremor.kind).collect();
    (report, kinds)
}

/// A line of 100 mm along X at Z −3.1, and a motion beside it in Y, with Z moved by something.
fn line(off: impl Fn(u32, f64) -> [f64; 3]) -> (AuditReport, Vec<ViolationKind>) {
    let place = |s: f64| {
        let mut at = point(s, 0.7);
        at[2] = -3.1;
        at
    };
    let program = [at_feed(1, Segment::line(place(0.0), place(100.0)))];
    audit(mill(), &program, 100.0, |tick, s| {
        let [x, y, z] = off(tick, s);
        let mut at = place(s);
        (at[0], at[1], at[2]) = (at[0] + x, at[1] + y, at[2] + z);
        at
    })
}

fn wave(tick: u32, wave_t: f64) -> f64 {
    (TAU * f64::from(tick) * PERIOD / wave_t).sin()
}

/// Something only in the middle of a path, coming and going over 6 mm.
fn between(from_mm: f64, to_mm: f64, s: f64, value: f64) -> f64 {
    let u = ((s - from_mm).min(to_mm - s) / 6.0).clamp(0.0, 1.0);
    value * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u)
}

/// Something only between 30 and 70 mm of the line.
fn inside(s: f64, value: f64) -> f64 {
    between(30.0, 70.0, s, value)
}

#[test]
fn a_straight_cut_is_calm() {
    let (report, found) = line(|_, _| [0.0; 3]);
    assert!(
        report.is_clean() && report.tremor_count == 0,
        "{report:#?} {found:?}"
    );
}

#[test]
fn an_axis_that_wanders_by_a_micrometre_is_found() {
    // So slowly that its jerk is no matter: 0.4 s to and fro.
    let swing = |tick, s| [0.0, 0.0, inside(s, MICROMETRE * wave(tick, 0.4))];
    let (report, found) = line(swing);
    assert!(report.is_clean(), "no violation: {:?}", report.violations);
    let most_mm = found.iter().fold(0.0, |most: f64, kind| match kind {
        ViolationKind::NotStill {
            axis: Axis::Z,
            off_mm,
        } => most.max(*off_mm),
        other => panic!("{other:?}"),
    });
    assert!((most_mm / MICROMETRE - 1.0).abs() < 0.01, "{most_mm}");
    // 40 mm at 50 mm/s are 200 periods; where the wave passes zero the axis is where it should be.
    assert!(
        (190..=200).contains(&report.tremor_count),
        "{}",
        report.tremor_count
    );
}

#[test]
fn an_offset_that_stays_is_found_and_rounding_is_not() {
    // Over two millimetres, so that there is no jerk to speak of: half of it is told from 31 to 69 mm.
    let there = |s: f64| (0.5 * (s - 30.0).min(70.0 - s)).clamp(0.0, 1.0);
    let (report, _) = line(|_, s| [0.0, 2e-5 * there(s), 0.0]);
    assert!((188..=192).contains(&report.tremor_count), "{report:?}");
    let (report, _) = line(|_, s| [0.0, 5e-6 * there(s), 0.0]);
    assert_eq!(report.tremor_count, 0);
}

#[test]
fn jerk_that_swings_in_a_cruise_is_found() {
    // 0.05 s to and fro along the path; jerk A·ω³ against a hundredth of 40 000.
    for (jerk_j, is_found) in [(380.0, false), (420.0, true)] {
        let omega = TAU / 0.05;
        let amplitude_mm = jerk_j / (omega * omega * omega);
        // Differences of third order see a little less than the derivative.
        let half: f64 = 0.5 * omega * PERIOD;
        let amplitude_mm = amplitude_mm * (half / half.sin()).powi(3);
        let (report, found) =
            line(|tick, s| [inside(s, amplitude_mm * wave(tick, 0.05)), 0.0, 0.0]);
        let is_unsteady = |kind: &ViolationKind| {
            matches!(
                kind,
                ViolationKind::Unsteady { axis: Axis::X, over_j, allowed_j }
                    if (over_j / jerk_j - 1.0).abs() < 0.5 && (allowed_j - 400.0).abs() < 1e-6
            )
        };
        // Where the swing begins and ends abruptly there is more jerk either way.
        let steady = report
            .tremors
            .iter()
            .filter(|tremor| (220..300).contains(&tremor.tick) && is_unsteady(&tremor.kind));
        assert_eq!(steady.count() > 0, is_found, "{jerk_j}: {found:?}");
        assert!(report.is_clean());
    }
}

#[test]
fn an_arc_has_the_jerk_that_it_has() {
    let radius_mm = 5.0;
    let start = point(radius_mm, 0.0);
    let arc = Arc {
        start,
        end: start,
        plane: Plane::Xy,
        center: [0.0; 2],
        sweep_rad: 2.0 * TAU,
    };
    let program = [at_feed(1, Segment::Arc(arc))];
    let on = |radius_mm: f64, s: f64| {
        let angle_rad = s / 5.0;
        point(radius_mm * angle_rad.cos(), radius_mm * angle_rad.sin())
    };
    let length_mm = arc.length();
    let (report, found) = audit(mill(), &program, length_mm, |_, s| on(radius_mm, s));
    assert!(report.is_clean() && found.is_empty(), "{report:?}");
    // Nearly as far inside as it may be, at the feed of the program: more jerk, by the path.
    let (report, found) = audit(mill(), &program, length_mm, |_, s| {
        on(radius_mm - between(0.0, length_mm, s, 0.015), s)
    });
    assert!(found.is_empty(), "{report:?}");
    // Swinging across by 5 µm in 0.1 s: a jerk of 1240 off the 5000 of the circle.
    for (swing_mm, is_found) in [(2.0 * MICROMETRE, false), (5.0 * MICROMETRE, true)] {
        let (report, found) = audit(mill(), &program, length_mm, |tick, s| {
            let away_mm = between(16.0, length_mm - 16.0, s, swing_mm);
            on(radius_mm - away_mm * (1.0 + wave(tick, 0.1)), s)
        });
        assert!(report.is_clean(), "{:?}", report.violations);
        let is_unsteady = |kind: &ViolationKind| {
            matches!(kind, ViolationKind::Unsteady { axis: Axis::X, over_j, allowed_j }
                if (880.0..920.0).contains(allowed_j) && (900.0..1500.0).contains(over_j))
        };
        assert_eq!(found.iter().any(is_unsteady), is_found, "{found:?}");
        assert_eq!(report.tremor_count > 0, is_found, "{found:?}");
    }
}

/// 60 mm along X, and on in X and Z; the motion is beside the path in Z by something.
fn before_a_climb(off_mm: impl Fn(f64) -> f64) -> AuditReport {
    let corner = point(60.0, 0.0);
    let mut end = point(100.0, 0.0);
    end[2] = 4.0;
    let program = [
        at_feed(1, Segment::line(point(0.0, 0.0), corner)),
        at_feed(2, Segment::line(corner, end)),
    ];
    let slope = 4.0 / 40.0_f64;
    let length_mm = 60.0 + 40.0_f64.hypot(4.0);
    let (report, _) = audit(loose(), &program, length_mm, |_, s| {
        let mut at = point(s.min(60.0), 0.0);
        if s > 60.0 {
            at[0] += (s - 60.0) / 1.0_f64.hypot(slope);
            at[2] += (s - 60.0) * slope / 1.0_f64.hypot(slope);
        }
        at[2] += off_mm(s);
        at
    });
    assert!(report.is_clean(), "{:?}", report.violations);
    report
}

#[test]
fn a_corner_may_be_rounded() {
    // The settling time is 5 mm here. Before the corner, up to 12 µm and back.
    let bump = |from_mm: f64, s: f64| {
        let u = (s - from_mm) / (60.0 - from_mm);
        if (0.0..1.0).contains(&u) {
            0.012 * (0.5 * TAU * u).sin().powi(4)
        } else {
            0.0
        }
    };
    let margin_mm = FEED_V * SETTLING_T;
    let report = before_a_climb(|s| bump(60.0 - 0.9 * margin_mm, s));
    assert_eq!(report.tremor_count, 0, "{:?}", report.tremors);
    // Earlier than that it may only go away from its coordinate ...
    let report = before_a_climb(|s| {
        if s < 60.0 {
            2e-6 * (s - 30.0).max(0.0).powi(2)
        } else {
            0.0
        }
    });
    assert_eq!(report.tremor_count, 0, "{:?}", report.tremors);
    // ... and not up and down.
    let report = before_a_climb(|s| bump(60.0 - 6.0 * margin_mm, s));
    assert!(report.tremor_count > 50, "{}", report.tremor_count);
    let is_still = |kind| !matches!(kind, ViolationKind::NotStill { axis: Axis::Z, .. });
    assert!(!report.tremors.iter().any(|tremor| is_still(tremor.kind)));
}

#[test]
fn behind_a_rest_nothing_is_left_to_round() {
    // To the corner and to rest there; Z swings shortly before, and behind the rest it climbs.
    let corner = point(20.0, 0.0);
    let mut top = corner;
    top[2] = 10.0;
    let lines = [
        at_feed(1, Segment::line(point(0.0, 0.0), corner)),
        at_feed(2, Segment::line(corner, top)),
    ];
    for (is_swinging, count) in [(false, 0), (true, 10)] {
        let mut audit = Audit::new(&settings(loose()));
        audit.program(&lines[0]);
        audit.program(&Item {
            line: 1,
            block: 0,
            kind: ItemKind::Dwell(0.1),
        });
        audit.program(&lines[1]);
        let mut tick = 0;
        for length_mm in [20.0, 10.0] {
            let mut s = 0.0;
            let mut time_t = 0.0;
            while s < length_mm {
                s = distance(time_t, length_mm);
                let mut at = if length_mm > 15.0 {
                    point(s, 0.0)
                } else {
                    corner
                };
                if length_mm < 15.0 {
                    at[2] = s;
                } else if is_swinging && (16.0..19.0).contains(&s) {
                    at[2] = MICROMETRE * wave(tick, 0.04);
                }
                audit.sample(&sample(tick.into(), at));
                (tick, time_t) = (tick + 1, time_t + PERIOD);
            }
            for _ in 0..40 {
                let at = if length_mm > 15.0 { corner } else { top };
                audit.sample(&sample(tick.into(), at));
                tick += 1;
            }
        }
        let report = audit.finish();
        assert!(report.is_complete && report.is_clean(), "{report:?}");
        let found = report.tremor_count;
        assert!(
            if count == 0 {
                found == 0
            } else {
                found >= count
            },
            "{report:?}"
        );
    }
}

#[test]
fn a_single_step_of_jerk_is_no_tremor() {
    // A sample that is a little ahead makes a jerk of 800, where 400 are allowed.
    let ahead_mm = 800.0 * PERIOD.powi(3) / 3.0;
    for (every, is_found) in [(1000, false), (5, true)] {
        let (report, found) = line(|tick, _| {
            let is_ahead = (230..330).contains(&tick) && tick % every == 250 % every;
            [if is_ahead { ahead_mm } else { 0.0 }, 0.0, 0.0]
        });
        assert!(report.is_clean());
        assert_eq!(report.tremor_count > 0, is_found, "{every}: {found:?}");
    }
}

#[test]
fn a_circle_that_asks_for_all_that_an_axis_can_do_is_not_judged() {
    // 50 mm/s on a radius of 1.5 mm: 1 667 of 2 000 mm/s², and 55 556 of 40 000 mm/s³.
    let radius_mm = 1.5;
    let start = point(radius_mm, 0.0);
    let arc = Arc {
        start,
        end: start,
        plane: Plane::Xy,
        center: [0.0; 2],
        sweep_rad: 6.0 * TAU,
    };
    let program = [at_feed(1, Segment::Arc(arc))];
    let swinging = |limits: Limits| {
        let (report, _) = audit(limits, &program, arc.length(), |tick, s| {
            let angle_rad = s / radius_mm;
            let away_mm = between(10.0, arc.length() - 10.0, s, 5.0 * MICROMETRE);
            let radius_mm = radius_mm - away_mm * (1.0 + wave(tick, 0.04));
            point(radius_mm * angle_rad.cos(), radius_mm * angle_rad.sin())
        });
        report.tremor_count
    };
    assert_eq!(swinging(mill()), 0);
    assert!(swinging(Limits::uniform(200.0, 4000.0, 1e5)) > 0);
}
