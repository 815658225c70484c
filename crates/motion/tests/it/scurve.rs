//! The S-curve against published vectors, brute force, and its own definition.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use glidepath_motion::scurve::{
    PathLimits, Profile, SpeedChange, ramp_length, reachable_speed, slowing_horizon,
};
use proptest::prelude::*;
use serde_json::Value;

fn vectors() -> Value {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/method/scurve_vectors.json"
    );
    serde_json::from_str(&std::fs::read_to_string(path).expect("vector file")).expect("JSON")
}

fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} missing in {value}"))
}

fn limits(value: &Value) -> PathLimits {
    PathLimits {
        accel_a: number(value, "A"),
        jerk_j: number(value, "J"),
    }
}

fn close(actual: f64, expected: f64, tolerance: f64) -> bool {
    (actual - expected).abs() <= tolerance * expected.abs().max(1.0)
}

#[test]
fn profiles_match_the_vectors() {
    let vectors = vectors();
    let cases = vectors["plan7"].as_array().expect("plan7");
    assert!(cases.len() > 5, "too few vectors");
    for case in cases {
        let profile = Profile::new(
            number(case, "v0"),
            number(case, "v1"),
            number(case, "L"),
            number(case, "V"),
            limits(case),
        );
        let Some(profile) = profile else {
            assert_ne!(case["status"], "ok", "feasible case refused: {case}");
            continue;
        };
        assert_eq!(case["status"], "ok", "infeasible case accepted: {case}");
        assert!(
            close(profile.duration_t(), number(case, "T"), 1e-9),
            "duration of {case}"
        );
        assert!(
            close(profile.peak_v(), number(case, "v_peak"), 1e-9),
            "peak of {case}"
        );
        let durations = case["t"].as_array().expect("t");
        for (actual, expected) in profile.phase_durations_t().into_iter().zip(durations) {
            assert!(
                close(actual, expected.as_f64().expect("t"), 1e-9),
                "phases of {case}"
            );
        }
        for sample in case["samples"].as_array().expect("samples") {
            let value = |i: usize| sample[i].as_f64().expect("sample");
            let state = profile.at(value(0));
            assert!(
                close(state.position_s, value(1), 1e-9),
                "position in {case}"
            );
            assert!(close(state.speed_v, value(2), 1e-9), "speed in {case}");
            // The acceleration in the vectors is itself a difference of larger numbers.
            assert!(
                (state.accel_a - value(3)).abs() <= 1e-9 * number(case, "A"),
                "accel: {case}"
            );
        }
    }
}

#[test]
fn reach_matches_the_vectors_and_inverts_the_ramp_length() {
    let vectors = vectors();
    for case in vectors["reach"].as_array().expect("reach") {
        let reached_v = reachable_speed(number(case, "v0"), number(case, "L"), limits(case));
        assert!(
            close(reached_v, number(case, "v1"), 1e-9),
            "{case}: {reached_v}"
        );
        let back_s = ramp_length(number(case, "v0"), reached_v, limits(case));
        assert!(
            close(back_s, number(case, "L"), 1e-9),
            "round trip of {case}: {back_s}"
        );
    }
}

#[test]
fn speed_changes_match_the_vectors() {
    let vectors = vectors();
    for case in vectors["vel_change"].as_array().expect("vel_change") {
        let change = SpeedChange::new(
            (number(case, "v0"), number(case, "a0")),
            (number(case, "v1"), number(case, "a1")),
            limits(case),
        );
        for i in 0..3 {
            let expected_t = case["t"][i].as_f64().expect("t");
            assert!(
                close(change.durations_t[i], expected_t, 1e-9),
                "{case}: {change:?}"
            );
            assert!(
                close(change.jerks_j[i], case["j"][i].as_f64().expect("j"), 1e-9),
                "{case}"
            );
        }
        assert!(
            close(change.length_s, number(case, "distance"), 1e-9),
            "{case}: {change:?}"
        );
    }
}

#[test]
fn reach_is_not_monotone_in_the_starting_speed() {
    let limits = PathLimits {
        accel_a: 1000.0,
        jerk_j: 20_000.0,
    };
    let reach = |v| reachable_speed(v, 1.0, limits);
    assert!((reach(0.0) - 27.144).abs() < 1e-3, "{}", reach(0.0));
    assert!((reach(8.55) - 25.650).abs() < 1e-3, "{}", reach(8.55));
    assert!((reach(15.0) - 26.57).abs() < 5e-3, "{}", reach(15.0));
}

#[test]
fn a_stop_can_need_less_room_than_slowing_down_partly() {
    let limits = PathLimits {
        accel_a: 1000.0,
        jerk_j: 20_000.0,
    };
    let ratio = ramp_length(30.0, 10.0, limits) / ramp_length(30.0, 0.0, limits);
    assert!((ratio - 1.0887).abs() < 1e-4, "{ratio}");
}

#[test]
fn slowing_horizon_is_the_longest_ramp_by_brute_force() {
    for (accel_a, jerk_j) in [(1000.0, 20_000.0), (2000.0, 40_000.0), (10_000.0, 1e6)] {
        let limits = PathLimits { accel_a, jerk_j };
        for feed_v in [
            1.0, 10.0, 40.0, 60.0, 74.0, 76.0, 90.0, 100.0, 149.0, 151.0, 400.0,
        ] {
            let longest_s = (0..=200_000)
                .map(|i| ramp_length(feed_v, feed_v * f64::from(i) / 200_000.0, limits))
                .fold(0.0, f64::max);
            let horizon_s = slowing_horizon(feed_v, limits);
            assert!(
                close(horizon_s / longest_s, 1.0, 1e-6),
                "{feed_v} {limits:?}: {horizon_s} against {longest_s}"
            );
        }
    }
}

fn any_limits() -> impl Strategy<Value = PathLimits> {
    (2.0..4.5_f64, 3.0..7.0_f64).prop_map(|(a, j)| PathLimits {
        accel_a: 10_f64.powf(a),
        jerk_j: 10_f64.powf(j),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_profile_ends_where_it_should(
        limits in any_limits(), entry_v in 0.0..150.0_f64, share in 0.0..1.0_f64,
        log_length in -4.0..3.0_f64, headroom_v in 0.0..200.0_f64, slowing in any::<bool>(),
    ) {
        let length_s = 10_f64.powf(log_length);
        let reached_v = reachable_speed(entry_v, length_s, limits);
        let exit_v = entry_v + share * (reached_v - entry_v);
        let (entry_v, exit_v) = if slowing { (exit_v, entry_v) } else { (entry_v, exit_v) };
        let top_v = entry_v.max(exit_v) + headroom_v;
        let profile = Profile::new(entry_v, exit_v, length_s, top_v, limits).expect("feasible");
        // Just before the end the state is still evaluated from the phases.
        let almost_t = profile.duration_t() * (1.0 - 1e-15);
        let end = profile.at(almost_t);
        prop_assert!(close(end.position_s / length_s, 1.0, 1e-9), "{end:?} {length_s}");
        prop_assert!((end.speed_v - exit_v).abs() <= 1e-9 * top_v.max(1.0), "{end:?} {exit_v}");
        prop_assert!(end.accel_a.abs() <= 1e-6 * limits.accel_a, "{end:?}");
        prop_assert!(profile.peak_v() <= top_v, "{}", profile.peak_v());
        for i in 0..=200 {
            let state = profile.at(profile.duration_t() * f64::from(i) / 200.0);
            prop_assert!(state.speed_v <= profile.peak_v() * (1.0 + 1e-12) + 1e-12);
            prop_assert!(state.accel_a.abs() <= limits.accel_a * (1.0 + 1e-12));
            prop_assert!(state.speed_v >= entry_v.min(exit_v) - 1e-9);
        }
    }

    #[test]
    fn the_greatest_speed_of_an_interval_is_found(
        limits in any_limits(), entry_v in 0.0..50.0_f64, from in 0.0..1.0_f64, to in 0.0..1.0_f64,
    ) {
        let length_s = 5.0;
        let Some(profile) = Profile::new(entry_v, 0.0, length_s, 80.0, limits) else {
            return Ok(());
        };
        let (from_s, to_s) = (from.min(to) * length_s, from.max(to) * length_s);
        let sampled_v = (0..=2000)
            .map(|i| profile.at(profile.duration_t() * f64::from(i) / 2000.0))
            .filter(|state| (from_s..=to_s).contains(&state.position_s))
            .map(|state| state.speed_v)
            .fold(0.0, f64::max);
        let found_v = profile.greatest_speed_between(from_s, to_s);
        prop_assert!(found_v >= sampled_v - 1e-7, "{found_v} {sampled_v}");
        let near = profile.duration_t() / 2000.0 * limits.accel_a;
        prop_assert!(sampled_v == 0.0 || found_v <= sampled_v + near + 1e-7);
    }

    #[test]
    fn a_speed_change_ends_in_the_wanted_state(
        limits in any_limits(), from_v in -50.0..150.0_f64, to_v in -50.0..150.0_f64,
        from_share in -1.0..1.0_f64, to_share in -1.0..1.0_f64,
    ) {
        let (from_a, to_a) = (from_share * limits.accel_a, to_share * limits.accel_a);
        let change = SpeedChange::new((from_v, from_a), (to_v, to_a), limits);
        let (mut v, mut a) = (from_v, from_a);
        for (t, j) in change.durations_t.into_iter().zip(change.jerks_j) {
            prop_assert!(t >= -1e-12, "{change:?}");
            v += t * (a + 0.5 * t * j);
            a += t * j;
            prop_assert!(a.abs() <= limits.accel_a * (1.0 + 1e-9), "{change:?}");
        }
        let scale_v = from_v.abs() + to_v.abs() + limits.accel_a.powi(2) / limits.jerk_j;
        prop_assert!((v - to_v).abs() <= 1e-9 * scale_v, "{v} {to_v}");
        prop_assert!((a - to_a).abs() <= 1e-9 * limits.accel_a, "{a} {to_a}");
    }
}
