//! Tests of the offset alone: whatever input and path do, it keeps to its share of the limits and to its range.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test: numbers are small, and bits are compared on purpose"
)]

use super::*;
use crate::testing::{Numbers, random_cases};
use bytemuck::Zeroable as _;
use glidepath_link::EventRecord;

const PERIOD_T: f64 = 0.004;

fn settings(control: SuperpositionControl) -> Superposition {
    Superposition {
        axis: Axis::Z,
        velocity: 25.0,
        acceleration: 250.0,
        jerk: 5000.0,
        range: [-3.0, 5.0],
        input: 0,
        control,
        target: 120.0,
        gain: -0.5,
        dead_band: 0.2,
        switch: Some(2),
        enable: None,
        freeze_below: 0.9,
        freeze_for_t: 0.1,
        returns: true,
    }
}

const AT_FEED: PathMotion = PathMotion {
    goes_on: true,
    is_probing: false,
    feed_r: 1.0,
};

fn switched(on: bool) -> Setpoint {
    let mut setpoint = Setpoint::zeroed();
    setpoint.tell(EventRecord::new(Event::DigitalOutput { number: 2, on }, 0));
    setpoint
}

/// An axis that is switched on.
fn on(control: SuperpositionControl) -> SuperposedAxis {
    let mut axis = SuperposedAxis::new(settings(control), &SoftLimits::none(), PERIOD_T);
    axis.hear(&switched(true));
    axis
}

/// Ticks with one demand; the offset after each.
fn run(axis: &mut SuperposedAxis, path: PathMotion, value: f64, ticks: usize) -> Vec<f64> {
    let setpoint = Setpoint::zeroed();
    let demand = SuperpositionDemand::Value(value);
    let step = |_| axis.step(&setpoint, path, demand).x;
    (0..ticks).map(step).collect()
}

/// The largest share of velocity, acceleration and jerk by differences, from rest at 0 on.
fn shares(offsets: &[f64], settings: &Superposition) -> [f64; 3] {
    let t = PERIOD_T;
    let limits = [
        settings.velocity * t,
        settings.acceleration * t * t,
        settings.jerk * t * t * t,
    ];
    let mut rows = [0.0; 3].to_vec();
    rows.extend(offsets);
    let mut most = [0.0_f64; 3];
    for most in most.iter_mut().zip(limits) {
        let differences: Vec<f64> = rows.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let largest = differences
            .iter()
            .fold(0.0_f64, |most, d| most.max(d.abs()));
        *most.0 = largest / most.1;
        rows = differences;
    }
    most
}

#[test]
fn any_input_keeps_the_offset_inside_its_share_and_its_range() {
    for seed in 0..u64::from(random_cases(1000)) {
        let mut numbers = Numbers::new(seed);
        let control = if seed % 2 == 0 {
            SuperpositionControl::Velocity
        } else {
            SuperpositionControl::Offset
        };
        let mut axis = on(control);
        let mut offsets = Vec::new();
        let (mut value, mut path, mut flags) = (120.0, AT_FEED, 0);
        for _ in 0..600 {
            // Steps, noise, slopes; the path slows down, stops, becomes rapid or a thread.
            match (numbers.unit() * 40.0).floor() {
                0.0 => value = 120.0 + 200.0 * (numbers.unit() - 0.5),
                1.0 => path.feed_r = numbers.unit(),
                2.0 => path = AT_FEED,
                3.0 => path.goes_on = numbers.unit() < 0.5,
                4.0 => {
                    let all = [0, FrameFlags::RAPID.0, FrameFlags::SYNC.0];
                    flags = all[(numbers.unit() * 3.0) as usize];
                }
                5.0 => axis.hear(&switched(numbers.unit() < 0.7)),
                _ => value += numbers.unit() - 0.5,
            }
            let mut setpoint = Setpoint::zeroed();
            setpoint.flags = flags;
            let demand = if numbers.unit() < 0.02 {
                SuperpositionDemand::Silent
            } else {
                SuperpositionDemand::Value(value)
            };
            offsets.push(axis.step(&setpoint, path, demand).x);
        }
        let settings = settings(control);
        let used = shares(&offsets, &settings);
        assert!(
            used.iter().all(|r| *r <= 1.0 + 1e-9),
            "seed {seed}: {used:?}"
        );
        let [low, high] = settings.range;
        let is_inside = offsets
            .iter()
            .all(|x| (low - 1e-9..=high + 1e-9).contains(x));
        assert!(is_inside, "seed {seed}");
    }
}

#[test]
fn a_velocity_ends_at_the_end_of_the_range_and_an_offset_at_its_value() {
    let mut axis = on(SuperpositionControl::Velocity);
    // Below the target: up, as the gain is negative.
    let offsets = run(&mut axis, AT_FEED, 118.0, 500);
    // Behind the start, a tenth of a millimetre a tick is 25 mm/s; here it is .9 mm/s.
    let way = offsets[200] - offsets[199];
    assert!((way - 0.9 * PERIOD_T).abs() < 1e-9, "{way}");
    run(&mut axis, AT_FEED, 80.0, 500);
    assert_eq!(axis.now(), Motion::at(5.0));
    run(&mut axis, AT_FEED, 120.1, 500);
    assert_eq!(axis.now(), Motion::at(5.0), "inside the dead band");
    let mut axis = on(SuperpositionControl::Offset);
    run(&mut axis, AT_FEED, 121.2, 500);
    // A volt beyond the dead band.
    assert!((axis.now().x + 0.5).abs() < 1e-12 && axis.is_at_rest());
    run(&mut axis, AT_FEED, 60.0, 500);
    assert_eq!(axis.now(), Motion::at(5.0));
}

#[test]
fn it_stands_while_the_path_does_not_go_on_at_its_feed() {
    let slow = PathMotion {
        feed_r: 0.89,
        ..AT_FEED
    };
    let held = PathMotion {
        goes_on: false,
        ..AT_FEED
    };
    let probing = PathMotion {
        is_probing: true,
        ..AT_FEED
    };
    for (path, behind) in [(slow, 25), (held, 0), (probing, 0)] {
        let mut axis = on(SuperpositionControl::Velocity);
        run(&mut axis, AT_FEED, 100.0, 40);
        let stops = run(&mut axis, path, 100.0, 100);
        assert_eq!(axis.state().0, SuperpositionState::Frozen);
        // A quarter of a second is more than enough to come to rest.
        assert!(axis.is_at_rest());
        assert_eq!(stops[63], stops[99]);
        let on_again = run(&mut axis, AT_FEED, 100.0, 60);
        let first = on_again.iter().position(|x| *x != stops[99]).unwrap();
        assert!((behind..=behind + 1).contains(&first), "{first}");
    }
    for demand in [SuperpositionDemand::Silent, SuperpositionDemand::Barred] {
        let mut axis = on(SuperpositionControl::Velocity);
        run(&mut axis, AT_FEED, 100.0, 40);
        for _ in 0..100 {
            axis.step(&Setpoint::zeroed(), AT_FEED, demand);
        }
        assert!(axis.is_at_rest() && axis.now().x > 0.1);
    }
}

#[test]
fn switched_off_it_returns_or_keeps_its_offset() {
    let mut axis = on(SuperpositionControl::Velocity);
    run(&mut axis, AT_FEED, 100.0, 100);
    axis.hear(&switched(false));
    let slow = PathMotion {
        feed_r: 0.2,
        ..AT_FEED
    };
    let back = run(&mut axis, slow, 100.0, 300);
    assert_eq!(axis.now(), Motion::at(0.0));
    assert_eq!(axis.state().0, SuperpositionState::Off);
    assert!(back.windows(2).skip(20).all(|pair| pair[1] <= pair[0]));
    let mut axis = on(SuperpositionControl::Velocity);
    axis.settings.returns = false;
    run(&mut axis, AT_FEED, 100.0, 100);
    axis.hear(&switched(false));
    run(&mut axis, AT_FEED, 100.0, 300);
    assert!(axis.is_at_rest() && axis.now().x > 1.0);
    // Every program begins with it off.
    let mut axis = on(SuperpositionControl::Velocity);
    axis.begin_program();
    run(&mut axis, AT_FEED, 100.0, 100);
    assert_eq!(axis.now(), Motion::at(0.0));
}

#[test]
fn what_keeps_it_still_is_told() {
    let reason = |change: &dyn Fn(&mut SuperposedAxis, &mut Setpoint, &mut PathMotion)| {
        let mut axis = on(SuperpositionControl::Velocity);
        run(&mut axis, AT_FEED, 100.0, 100);
        let (mut setpoint, mut path) = (Setpoint::zeroed(), AT_FEED);
        change(&mut axis, &mut setpoint, &mut path);
        axis.step(&setpoint, path, SuperpositionDemand::Value(100.0));
        axis.state()
    };
    let frozen = |why| (SuperpositionState::Frozen, why);
    assert_eq!(
        reason(&|_, _, _| ()),
        (SuperpositionState::Follows, FreezeReason::None)
    );
    assert_eq!(
        reason(&|_, _, path| path.goes_on = false),
        frozen(FreezeReason::NotOnward)
    );
    assert_eq!(
        reason(&|_, _, path| path.is_probing = true),
        frozen(FreezeReason::Probing)
    );
    assert_eq!(
        reason(&|_, setpoint, _| setpoint.flags = FrameFlags::SYNC.0),
        frozen(FreezeReason::FollowsSpindle)
    );
    assert_eq!(
        reason(&|_, setpoint, _| setpoint.flags = FrameFlags::RAPID.0),
        frozen(FreezeReason::Rapid)
    );
    assert_eq!(
        reason(&|_, _, path| path.feed_r = 0.5),
        frozen(FreezeReason::Slow)
    );
    assert_eq!(
        reason(&|axis, _, _| {
            axis.settings.returns = false;
            axis.hear(&switched(false));
        }),
        frozen(FreezeReason::SwitchedOff)
    );
    let mut axis = on(SuperpositionControl::Velocity);
    axis.step(&Setpoint::zeroed(), AT_FEED, SuperpositionDemand::Barred);
    assert_eq!(axis.state(), frozen(FreezeReason::NotEnabled));
    axis.step(&Setpoint::zeroed(), AT_FEED, SuperpositionDemand::Silent);
    assert_eq!(
        axis.state(),
        (SuperpositionState::Silent, FreezeReason::None)
    );
}
