//! What the motion depends on, and what it does not; changes of rates.

use super::*;
use crate::in_tube::period::State;
use crate::in_tube::verify::BetweenPeriods;
use glidepath_audit::{Violation, ViolationKind};

/// Pushes as late as possible.
fn plan_lazily(case: &Case) -> Vec<Period> {
    let mut planner = case.planner();
    let mut periods = Vec::new();
    for reference in case.references() {
        while let Some(period) = planner.next_period() {
            periods.push(period);
        }
        planner.push(reference);
    }
    while let Some(period) = planner.next_period() {
        periods.push(period);
    }
    planner.finish();
    periods.extend(core::iter::from_fn(|| planner.next_period()));
    periods
}

proptest! {
    #![proptest_config(cases(3))]
    #[test]
    fn it_does_not_matter_how_pushes_and_periods_are_interleaved(seed: u64, is_light: bool) {
        let case = random_case(seed, is_light);
        assert_eq!(case.plan(), plan_lazily(&case));
    }
}

/// Plans with another feed after some periods.
fn plan_with_change(case: &Case, after: usize, factor: f64) -> Vec<Period> {
    let mut planner = case.planner();
    for reference in case.references() {
        planner.push(reference);
    }
    planner.finish();
    let mut periods: Vec<_> = (0..after).map_while(|_| planner.next_period()).collect();
    planner.set_rates(|_| PieceRate::by_feed(factor * case.feed_v));
    periods.extend(core::iter::from_fn(|| planner.next_period()));
    assert!(planner.is_over());
    periods
}

#[test]
fn a_change_of_rates_is_followed_within_the_limits() {
    let mut case = Case::mill(square());
    case.feed_v = 40.0;
    let plain = case.plan().len();
    for (after, factor) in [(0, 0.5), (40, 0.5), (41, 2.0), (200, 0.1), (300, 1.5)] {
        let periods = plan_with_change(&case, after, factor);
        let allowed = Case {
            feed_v: case.feed_v * factor.max(1.0),
            ..case.clone()
        };
        assert_clean(&allowed, &periods);
        assert_eq!(
            periods.len() > plain,
            factor < 1.0,
            "after {after}: {factor}"
        );
        // From some time after the change on, the new feed holds.
        let slow = periods.iter().skip(after + 60);
        let fastest_v = slow.fold(0.0_f64, |most, p| most.max(p.path_v));
        assert!(
            fastest_v <= 1.001 * factor * case.feed_v,
            "after {after}: {factor}: {fastest_v}"
        );
    }
}

#[test]
fn progress_never_falls_and_tags_never_go_back() {
    let case = random_case(11, false);
    let periods = case.plan();
    for pair in periods.windows(2) {
        assert!(pair[1].path_s >= pair[0].path_s && pair[1].tag >= pair[0].tag);
    }
    assert!(periods.iter().rev().skip(1).all(|p| !p.rest_at_end));
}

#[test]
fn feeds_may_differ_from_piece_to_piece() {
    let case = Case::mill(square());
    let mut planner = case.planner();
    let feeds = [100.0, 5.0, 50.0, 20.0];
    for (mut reference, feed_v) in case.references().into_iter().zip(feeds) {
        reference.rate = PieceRate::by_feed(feed_v);
        planner.push(reference);
    }
    planner.finish();
    let mut last = AxisVector::zeros();
    while let Some(period) = planner.next_period() {
        let speed_v = (period.position - last).norm() / case.period_t;
        let near = |tag: u64| feeds[tag.min(3) as usize];
        let allowed = near(period.tag).max(near(period.tag.saturating_sub(1)));
        assert!(speed_v <= 1.001 * allowed, "{speed_v} on {}", period.tag);
        last = period.position;
    }
    assert!(planner.is_over());
}

/// Where the motion is between periods, as the interpolator has it: with the quintic through both
/// states.
fn shifted(periods: &[Period], start: AxisVector, period_t: f64, shift: f64) -> Vec<Period> {
    let mut from = State::rest(start);
    let mut shifted = Vec::new();
    for period in periods {
        let to = State::from(period);
        let bend = BetweenPeriods {
            from: &from,
            to: &to,
            period_t,
        };
        shifted.push(Period {
            rest_at_end: false,
            position: bend.at(shift),
            ..*period
        });
        from = to;
    }
    shifted.extend(periods.last());
    shifted
}

fn assert_within_tolerance_between(case: &Case, shifts: &[f64]) {
    let periods = case.plan();
    for &shift in shifts {
        let shifted = shifted(&periods, case.points[0], case.period_t, shift);
        let report = case.audit(&shifted);
        let is_off = |v: &Violation| matches!(v.kind, ViolationKind::Deviation { .. });
        let off: Vec<_> = report.violations.iter().filter(|v| is_off(v)).collect();
        assert!(off.is_empty(), "{shift}: {off:?}");
    }
}

proptest! {
    #![proptest_config(cases(4))]
    #[test]
    fn the_tolerance_holds_wherever_periods_end(
        seed: u64,
        is_light: bool,
        shift in 0.0..1.0_f64,
    ) {
        let case = random_case(seed, is_light);
        assert_within_tolerance_between(&case, &[shift, 0.15, 0.3, 0.5, 0.7, 0.85]);
    }
}

/// Corners at which the motion turns back within a period.
#[test]
fn chords_that_begin_anywhere_come_near_a_corner_at_which_the_motion_turns_back() {
    let shifts: Vec<_> = (1..20).map(|k| f64::from(k) / 20.0).collect();
    for seed in [14_984_056_615_460_928_924, 3_644_188_963_254_533_769] {
        assert_within_tolerance_between(&random_case(seed, true), &shifts);
    }
}
