//! The S-curve driven along a curve with sharp tips: speeds capped by its curvature, stations at
//! the critical points of the cap, as in Gu, Zhou, Lin et al. Totals are compared with those of an
//! independent implementation; the caps come from an evaluation of the NURBS made only for this.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use glidepath_motion::scurve::{PathLimits, Profile, reachable_speed};
use serde_json::Value;

const FEED_V: f64 = 100.0;
const CHORD_MM: f64 = 0.001;
/// Length of the curve by adaptive quadrature, mm.
const LENGTH_MM: f64 = 382.859_558_301_290;

struct Nurbs {
    degree: usize,
    knots: Vec<f64>,
    /// (w·x, w·y, w) of every control point.
    points: Vec<[f64; 3]>,
}

impl Nurbs {
    fn read() -> Self {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../tests/data/method/butterfly.json"
        );
        let text = std::fs::read_to_string(path).expect("curve file");
        let curve: Value = serde_json::from_str(&text).expect("JSON");
        let numbers = |value: &Value| -> Vec<f64> {
            value
                .as_array()
                .expect("array")
                .iter()
                .map(|x| x.as_f64().expect("number"))
                .collect()
        };
        let weights = numbers(&curve["weights"]);
        let points = curve["control_points"]
            .as_array()
            .expect("points")
            .iter()
            .zip(&weights)
            .map(|(point, w)| {
                let xy = numbers(point);
                [xy[0] * w, xy[1] * w, *w]
            })
            .collect();
        Self {
            degree: 3,
            knots: numbers(&curve["knots"]),
            points,
        }
    }

    /// The homogeneous curve's derivative, a B-spline of one degree less.
    fn derivative(&self) -> Self {
        let p = self.degree;
        let points = (0..self.points.len() - 1)
            .map(|i| {
                let factor = p as f64 / (self.knots[i + p + 1] - self.knots[i + 1]);
                [0, 1, 2].map(|k| factor * (self.points[i + 1][k] - self.points[i][k]))
            })
            .collect();
        let knots = self.knots[1..self.knots.len() - 1].to_vec();
        Self {
            degree: p - 1,
            knots,
            points,
        }
    }

    /// De Boor's algorithm.
    fn at(&self, u: f64) -> [f64; 3] {
        let p = self.degree;
        let last = self.points.len() - 1;
        let span = self.knots[p + 1..=last].partition_point(|&knot| knot <= u) + p;
        let mut d: Vec<[f64; 3]> = (0..=p).map(|j| self.points[j + span - p]).collect();
        for r in 1..=p {
            for j in (r..=p).rev() {
                let i = j + span - p;
                let alpha = (u - self.knots[i]) / (self.knots[i + p + 1 - r] - self.knots[i]);
                d[j] = [0, 1, 2].map(|k| (1.0 - alpha) * d[j - 1][k] + alpha * d[j][k]);
            }
        }
        d[p]
    }
}

/// Cap of the speed along the curve.
struct Cap {
    s: Vec<f64>,
    v: Vec<f64>,
    radius_mm: Vec<f64>,
}

impl Cap {
    fn new(limits: PathLimits, period_t: f64) -> Self {
        let curve = Nurbs::read();
        let first = curve.derivative();
        let second = first.derivative();
        let mut breaks = curve.knots.clone();
        breaks.dedup();
        let per_span = 4000_u32;
        let (mut s, mut v, mut radii_mm) = (vec![], vec![], vec![]);
        let mut length_s = 0.0;
        let speed_and_radius = |u: f64| {
            let (a, a1, a2) = (curve.at(u), first.at(u), second.at(u));
            let c = [a[0] / a[2], a[1] / a[2]];
            let c1 = [0, 1].map(|k| (a1[k] - a1[2] * c[k]) / a[2]);
            let c2 = [0, 1].map(|k| (a2[k] - 2.0 * a1[2] * c1[k] - a2[2] * c[k]) / a[2]);
            let speed = c1[0].hypot(c1[1]);
            (speed, speed.powi(3) / (c1[0] * c2[1] - c1[1] * c2[0]).abs())
        };
        for pair in breaks.windows(2) {
            let step = (pair[1] - pair[0]) / f64::from(per_span);
            for i in 0..per_span {
                // Inside the span, so that the curvature is that of this side of a knot.
                let u = pair[0] + step * (f64::from(i) + 0.5);
                let (speed, radius_mm) = speed_and_radius(u);
                let chord_v = if radius_mm >= CHORD_MM {
                    2.0 / period_t * (2.0 * radius_mm * CHORD_MM - CHORD_MM * CHORD_MM).sqrt()
                } else {
                    2.0 * radius_mm / period_t
                };
                let normal_v = (limits.accel_a * radius_mm).sqrt();
                let jerk_v = (limits.jerk_j * radius_mm * radius_mm).cbrt();
                s.push(length_s + 0.5 * step * speed);
                v.push(FEED_V.min(chord_v).min(normal_v).min(jerk_v));
                radii_mm.push(radius_mm);
                length_s += step * speed;
            }
        }
        assert!(
            (length_s / LENGTH_MM - 1.0).abs() < 1e-6,
            "length {length_s}"
        );
        Self {
            s,
            v,
            radius_mm: radii_mm,
        }
    }

    /// The critical points, where the curvature is greatest around, with the cap there; rest at
    /// both ends.
    fn stations(&self) -> Vec<(f64, f64)> {
        let mut stations = vec![(0.0, 0.0)];
        for (i, around) in self.radius_mm.windows(3).enumerate() {
            if around[1] < around[0] && around[1] <= around[2] {
                stations.push((self.s[i + 1], self.v[i + 1]));
            }
        }
        stations.push((LENGTH_MM, 0.0));
        assert_eq!(stations.len(), 39, "the butterfly has 37 curvature maxima");
        stations
    }

    /// The shortest time if acceleration alone were limited: no jerk-limited motion is faster.
    fn bound_t(&self, accel_a: f64) -> f64 {
        let n = self.v.len();
        let mut square_v2: Vec<f64> = self.v.iter().map(|v| v * v).collect();
        square_v2[0] = square_v2[0].min(2.0 * accel_a * self.s[0]);
        for i in 1..n {
            let reach_v2 = square_v2[i - 1] + 2.0 * accel_a * (self.s[i] - self.s[i - 1]);
            square_v2[i] = square_v2[i].min(reach_v2);
        }
        square_v2[n - 1] = square_v2[n - 1].min(2.0 * accel_a * (LENGTH_MM - self.s[n - 1]));
        for i in (0..n - 1).rev() {
            let reach_v2 = square_v2[i + 1] + 2.0 * accel_a * (self.s[i + 1] - self.s[i]);
            square_v2[i] = square_v2[i].min(reach_v2);
        }
        let between: f64 = (1..n)
            .map(|i| {
                2.0 * (self.s[i] - self.s[i - 1]) / (square_v2[i].sqrt() + square_v2[i - 1].sqrt())
            })
            .sum();
        let ends = 2.0 * self.s[0] / square_v2[0].sqrt()
            + 2.0 * (LENGTH_MM - self.s[n - 1]) / square_v2[n - 1].sqrt();
        between + ends
    }
}

/// S-curves between the stations, zero acceleration at each: backward pass, then forward.
fn drive(stations: &[(f64, f64)], limits: PathLimits) -> Vec<(f64, Profile)> {
    let mut v: Vec<f64> = stations.iter().map(|station| station.1).collect();
    let length_s = |i: usize| stations[i + 1].0 - stations[i].0;
    for i in (0..v.len() - 1).rev() {
        v[i] = v[i].min(reachable_speed(v[i + 1], length_s(i), limits));
    }
    for i in 0..v.len() - 1 {
        v[i + 1] = v[i + 1].min(reachable_speed(v[i], length_s(i), limits));
    }
    (0..v.len() - 1)
        .map(|i| {
            let profile = Profile::new(v[i], v[i + 1], length_s(i), FEED_V, limits);
            (stations[i].0, profile.expect("reachable both ways"))
        })
        .collect()
}

fn total_t(legs: &[(f64, Profile)]) -> f64 {
    legs.iter().map(|(_, profile)| profile.duration_t()).sum()
}

#[test]
fn totals_are_those_of_an_independent_implementation() {
    let slow = PathLimits {
        accel_a: 1000.0,
        jerk_j: 20_000.0,
    };
    let fast = PathLimits {
        accel_a: 2000.0,
        jerk_j: 60_000.0,
    };
    // Limits, period, total in s.
    let table = [
        (slow, 0.001, 5.7457),
        (slow, 0.004, 6.1474),
        (fast, 0.001, 4.6575),
    ];
    for (limits, period_t, expected_t) in table {
        let cap = Cap::new(limits, period_t);
        let actual_t = total_t(&drive(&cap.stations(), limits));
        let bound_t = cap.bound_t(limits.accel_a);
        assert!(
            (actual_t / expected_t - 1.0).abs() < 0.005,
            "{actual_t}, expected {expected_t}"
        );
        assert!(
            actual_t >= bound_t,
            "{actual_t} s beats the bound of {bound_t} s"
        );
    }
}

#[test]
fn the_cap_is_kept_between_the_stations_and_every_difference_is_within_limits() {
    let limits = PathLimits {
        accel_a: 1000.0,
        jerk_j: 20_000.0,
    };
    let period_t = 0.001;
    let cap = Cap::new(limits, period_t);
    let legs = drive(&cap.stations(), limits);

    let fine_t = period_t / 7.0;
    let mut positions_s = vec![0.0; 3];
    let mut first_t = period_t;
    for (from_s, profile) in &legs {
        let mut t = 0.0;
        while t < profile.duration_t() {
            let state = profile.at(t);
            let i = cap
                .s
                .partition_point(|&s| s < from_s + state.position_s)
                .min(cap.s.len() - 1);
            let cap_v = cap.v[i].max(cap.v[i.saturating_sub(1)]);
            assert!(
                state.speed_v <= cap_v * (1.0 + 1e-3),
                "{} over {cap_v}",
                state.speed_v
            );
            t += fine_t;
        }
        let mut tick = 0_u32;
        while first_t + f64::from(tick) * period_t < profile.duration_t() {
            let state = profile.at(first_t + f64::from(tick) * period_t);
            positions_s.push(from_s + state.position_s);
            tick += 1;
        }
        first_t += f64::from(tick) * period_t - profile.duration_t();
    }
    positions_s.extend([LENGTH_MM; 4]);

    for window in positions_s.windows(4) {
        let [d, c, b, a] = [window[0], window[1], window[2], window[3]];
        let velocity_v = (a - b) / period_t;
        let accel_a = (a - 2.0 * b + c) / period_t.powi(2);
        let jerk_j = (a - 3.0 * b + 3.0 * c - d) / period_t.powi(3);
        assert!(velocity_v <= FEED_V * (1.0 + 1e-9), "velocity {velocity_v}");
        assert!(
            accel_a.abs() <= limits.accel_a * (1.0 + 1e-6),
            "acceleration {accel_a}"
        );
        // Differences of positions of 400 mm over (1 ms)³ have a rounding of a few 1e-4 mm/s³.
        assert!(
            jerk_j.abs() <= limits.jerk_j * (1.0 + 1e-6),
            "jerk {jerk_j}"
        );
    }
    let (from_s, last) = legs[legs.len() - 1];
    let end = last.at(last.duration_t());
    assert!(
        (from_s + end.position_s - LENGTH_MM).abs() < 1e-9,
        "ends at {end:?}"
    );
    assert!(
        end.speed_v.abs() < 1e-12 && end.accel_a.abs() < 1e-12,
        "ends with {end:?}"
    );
}
