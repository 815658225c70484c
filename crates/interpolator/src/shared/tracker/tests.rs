//! Tests of trackers against another implementation, against finite differences, and solved anew at
//! random.

use super::*;
use crate::testing::random_cases;
use proptest::prelude::*;
use rsruckig::prelude::{
    ControlInterface, InputParameter, Ruckig, RuckigResult, ThrowErrorHandler, Trajectory,
};

const PERIOD_T: f64 = 0.004;
/// What an audit of differences allows, and what rounding does to differences of positions of up to
/// a metre, mm.
const ALLOWANCE: f64 = 1e-6;
const ROUNDING: f64 = 2e-12;

/// How long the other implementation takes.
fn reference_t(start: Motion, target: Target, bounds: &Bounds) -> Option<f64> {
    let mut otg = Ruckig::<1, ThrowErrorHandler>::new(None, PERIOD_T);
    let mut input = InputParameter::<1>::new(None);
    input.current_position[0] = start.x;
    input.current_velocity[0] = start.v;
    input.current_acceleration[0] = start.a;
    match target {
        Target::Rest(place) => input.target_position[0] = place,
        Target::Speed(v) => {
            input.control_interface = ControlInterface::Velocity;
            input.target_velocity[0] = v;
        }
    }
    input.max_velocity[0] = bounds.v;
    input.max_acceleration[0] = bounds.a;
    input.max_jerk[0] = bounds.j;
    let mut trajectory = Trajectory::<1>::new(None);
    match otg.calculate(&input, &mut trajectory) {
        Ok(RuckigResult::Working | RuckigResult::Finished) => Some(trajectory.get_duration()),
        _ => None,
    }
}

fn solved(start: Motion, target: Target, bounds: Bounds) -> Tracker {
    let mut tracker = Tracker::new(start);
    tracker.aim(target, bounds);
    tracker
}

fn bounds() -> impl Strategy<Value = Bounds> {
    let decades = |low: f64, high: f64| (low..high).prop_map(|e: f64| 10_f64.powf(e));
    (decades(0.0, 2.5), decades(1.0, 4.0), decades(2.0, 6.0)).prop_map(|(v, a, j)| Bounds {
        v,
        a,
        j,
    })
}

/// States up to a multiple of the bounds, and a part of them where nothing moves or accelerates.
fn state(most: f64) -> impl Strategy<Value = (f64, f64)> {
    let part = move || prop_oneof![1 => Just(0.0), 4 => -most..most];
    (part(), part())
}

/// States from which the velocity can be kept, as a motion of the same bounds passes them.
fn inside(bounds: &Bounds, (v, a): (f64, f64)) -> (f64, f64) {
    let (v, a) = (v * bounds.v, a * bounds.a);
    let left = (bounds.v - v * a.signum()).max(0.0);
    (
        v,
        a.signum() * a.abs().min(0.99 * (2.0 * bounds.j * left).sqrt()),
    )
}

/// The excess of a motion over its bounds, by differences on the grid: 0 if it has none.
fn excess(positions: &[f64], bounds: &Bounds, t: f64) -> f64 {
    let first: Vec<f64> = positions.windows(2).map(|w| w[1] - w[0]).collect();
    let second: Vec<f64> = first.windows(2).map(|w| w[1] - w[0]).collect();
    let third: Vec<f64> = second.windows(2).map(|w| w[1] - w[0]).collect();
    [
        (first, bounds.v * t),
        (second, bounds.a * t * t),
        (third, bounds.j * t * t * t),
    ]
    .iter()
    .flat_map(|(differences, most)| {
        differences
            .iter()
            .map(move |d| (d.abs() - most * (1.0 + ALLOWANCE) - ROUNDING) / most)
    })
    .fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(2_000)))]

    #[test]
    fn rest_is_reached_as_soon_as_another_implementation_finds_possible(
        bounds in bounds(), from in state(0.999), way in -3.0..3.0_f64, scale in -3.0..3.0_f64,
    ) {
        let (v, a) = inside(&bounds, from);
        let start = Motion { x: 1.0, v, a };
        let place = 1.0 + way * 10_f64.powf(scale);
        let tracker = solved(start, Target::Rest(place), bounds);
        let taken_t = tracker.profile.duration_t();
        let Some(reference_t) = reference_t(start, Target::Rest(place), &bounds) else {
            return Ok(());
        };
        // It rounds times to about 1e-12 and its roots to about 1e-8 of the way.
        let allowed = 1e-9 + 1e-6 * reference_t;
        prop_assert!((taken_t - reference_t).abs() <= allowed,
            "{taken_t} s instead of {reference_t} s from {start:?} to {place} in {bounds:?}");
    }

    #[test]
    fn a_velocity_is_reached_as_soon_as_another_implementation_finds_possible(
        bounds in bounds(), from in state(2.0), to in -1.0..=1.0_f64,
    ) {
        let start = Motion { x: 0.0, v: from.0 * bounds.v, a: from.1 * bounds.a };
        let target = Target::Speed(to * bounds.v);
        let taken_t = solved(start, target, bounds).profile.duration_t();
        if let Some(reference_t) = reference_t(start, target, &bounds) {
            prop_assert!((taken_t - reference_t).abs() <= 1e-9 + 1e-6 * reference_t,
                "{taken_t} s instead of {reference_t} s from {start:?} to {target:?}");
        }
    }

    /// From any state, also outside: it ends where it should, without a step in the motion, and what
    /// is outside comes back and stays inside.
    #[test]
    fn from_any_state_it_ends_at_the_target(
        bounds in bounds(), from in state(3.0), way in -3.0..3.0_f64, scale in -6.0..3.0_f64,
    ) {
        let start = Motion { x: -0.5, v: from.0 * bounds.v, a: from.1 * bounds.a };
        let place = way * 10_f64.powf(scale);
        let profile = solved(start, Target::Rest(place), bounds).profile;
        let end = profile.at(profile.duration_t());
        prop_assert_eq!(end, Motion::at(place));
        // Just before its end it is as near to it as its last phase leaves it.
        let (steps, mut before) = (4_000, start);
        let t = profile.duration_t() / f64::from(steps);
        let size = 1.0 + place.abs() + start.v.abs() * profile.duration_t();
        for k in 1..=steps {
            let now = profile.at(f64::from(k) * t);
            let most_a = bounds.a.max(before.a.abs()) + bounds.j * t;
            let bound_a = bounds.a.max(start.a.abs()) * (1.0 + 1e-9);
            prop_assert!(now.a.abs() <= bound_a);
            prop_assert!((now.a - before.a).abs() <= bounds.j * t * (1.0 + 1e-6) + 1e-9 * most_a);
            prop_assert!((now.v - before.v).abs() <= most_a * t * (1.0 + 1e-6) + 1e-9 * bounds.v);
            let most_v = before.v.abs().max(now.v.abs()) + most_a * t;
            prop_assert!((now.x - before.x).abs() <= most_v * t + 1e-12 * size);
            before = now;
        }
    }

    /// On the grid, with targets and limits that change at any tick, by the differences of what is
    /// published. The limits of the machine stand; those of the tracker are at most these.
    #[test]
    fn solved_anew_on_the_grid_it_stays_inside_the_limits(
        machine in bounds(),
        changes in prop::collection::vec(
            (1_usize..60, prop::bool::ANY, -1.0..1.0_f64, 0.05..=1.0_f64), 1..30),
    ) {
        let mut tracker = Tracker::new(Motion::at(0.0));
        let mut positions = vec![0.0; 4];
        for (ticks, is_place, to, speed) in changes {
            let bounds = machine.with_speed(machine.v * speed);
            let target = if is_place {
                Target::Rest(to * 300.0)
            } else {
                Target::Speed(to * bounds.v)
            };
            tracker.aim(target, bounds);
            positions.extend((0..ticks).map(|_| tracker.advance(PERIOD_T).x));
        }
        tracker.aim(Target::Speed(0.0), machine);
        while !tracker.has_arrived() && positions.len() < 100_000 {
            positions.push(tracker.advance(PERIOD_T).x);
        }
        positions.extend((0..4).map(|_| tracker.advance(PERIOD_T).x));
        let excess = excess(&positions, &machine, PERIOD_T);
        prop_assert!(excess <= 0.0, "{excess} above a limit of {machine:?}");
    }

    /// A target that is set again at every tick, as a wheel does, is reached at the same time.
    #[test]
    fn solved_at_every_tick_it_is_the_same_motion(
        bounds in bounds(), from in state(0.9), way in -100.0..100.0_f64,
    ) {
        let (v, a) = inside(&bounds, from);
        let start = Motion { x: 0.0, v, a };
        let once = solved(start, Target::Rest(way), bounds);
        let (mut tracker, mut ticks) = (once, 0_u32);
        while !tracker.has_arrived() && ticks < 3_000 {
            let now = tracker.advance(PERIOD_T);
            ticks += 1;
            let planned = once.profile.at(f64::from(ticks) * PERIOD_T);
            let size = 1.0 + way.abs() + bounds.v;
            prop_assert!((now.x - planned.x).abs() <= 1e-8 * size, "{now:?} {planned:?}");
            tracker = solved(now, Target::Rest(way), bounds);
        }
    }

    /// The extent of a stop is that of its points.
    #[test]
    fn a_stop_goes_no_further_than_its_extent(bounds in bounds(), from in state(2.0)) {
        let start = Motion { x: 0.0, v: from.0 * bounds.v, a: from.1 * bounds.a };
        let stop = Profile::to_stop(start, &bounds);
        let (low, high) = stop.extent();
        let points = (0..=1_000).map(|k| stop.at(stop.duration_t() * f64::from(k) / 1e3).x);
        let (least, most) = points.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        let rounding = 1e-12 + 4.0 * f64::EPSILON * low.abs().max(high.abs());
        let size = 1e-5 * (high - low) + rounding;
        prop_assert!(low <= least + rounding && low >= least - size, "{low} {least}");
        prop_assert!(high >= most - rounding && high <= most + size, "{high} {most}");
    }
}

#[test]
fn the_numbers_of_a_stop_from_a_constant_velocity() {
    // t = 2 sqrt(v / J) and d = v t / 2 while v is below A² / J, else t = v / A + A / J.
    let mill = Bounds {
        v: 200.0,
        a: 2_000.0,
        j: 40_000.0,
    };
    for (v, t, d) in [
        (5.0, 0.022_360_68, 0.055_901_7),
        (50.0, 0.070_710_68, 1.767_767),
        (200.0, 0.15, 15.0),
    ] {
        let stop = Profile::to_stop(Motion { x: 0.0, v, a: 0.0 }, &mill);
        assert!(
            (stop.duration_t() - t).abs() < 1e-8,
            "{}",
            stop.duration_t()
        );
        assert!((stop.end().x - d).abs() < 1e-6, "{}", stop.end().x);
    }
}

#[test]
fn a_tracker_at_its_target_stays_there_to_the_bit() {
    let bounds = Bounds {
        v: 10.0,
        a: 100.0,
        j: 1_000.0,
    };
    let mut tracker = solved(Motion::at(0.1), Target::Rest(0.1), bounds);
    for _ in 0..5 {
        assert_eq!(tracker.advance(PERIOD_T), Motion::at(0.1));
    }
    // Nothing may move: it stays where it is.
    tracker.aim(Target::Rest(7.0), bounds.with_speed(0.0));
    assert_eq!(tracker.advance(1.0), Motion::at(0.1));
}
