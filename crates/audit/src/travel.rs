//! The check of travel: whether every axis stays inside, at samples and between them.
//!
//! At a frame an axis may be beyond an end by rounding alone: whoever plays the motion refuses more.
//! Between two of them that report velocity and acceleration, the motion is the polynomial of degree
//! five through both; that is what is played where time runs slower. It is off a motion whose jerk is J
//! at most by a small share of J·T³: a motion that is inside may be seen so much beyond, and one that is
//! seen further beyond is not inside.

use crate::sample::Seen;
use crate::settings::AuditSettings;
use crate::violation::{ViolationKind, ViolationList};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Travel;

/// What a polynomial between two samples may swing over an end, as a share of J·T³: the integral of
/// Peano's kernel, half-way between them, where it is largest.
const SWING_R: f64 = 1.0 / 161.0;
/// Places between two samples that are looked at, near an end.
const PLACES: u32 = 24;

/// State of the check.
#[derive(Debug)]
pub(crate) struct TravelAudit {
    axes: Vec<Span>,
    period_t: f64,
    /// The last sample: its tick, and what it reported.
    last: Option<(u64, AxisVector, Option<[AxisVector; 2]>)>,
    /// How far an axis was beyond an end at most, mm or degrees.
    pub(crate) most: f64,
    pub(crate) violations: ViolationList,
}

/// An axis that has an end of travel.
#[derive(Debug, Clone, Copy)]
struct Span {
    axis: Axis,
    low: f64,
    high: f64,
    /// What it may swing over between samples.
    swing: f64,
}

impl TravelAudit {
    pub(crate) fn new(settings: &AuditSettings) -> Self {
        let Travel { lowest, highest } = &settings.limits.travel;
        let t = settings.period_t;
        let axes = Axis::ALL.into_iter().map(|axis| {
            let i = axis.index();
            Span {
                axis,
                low: lowest[i],
                high: highest[i],
                swing: SWING_R * settings.limits.jerk[i] * t * t * t + Travel::ROUNDING,
            }
        });
        Self {
            axes: axes
                .filter(|span| span.low.is_finite() || span.high.is_finite())
                .collect(),
            period_t: t,
            last: None,
            most: 0.0,
            violations: ViolationList::default(),
        }
    }

    pub(crate) fn sample(&mut self, sample: &Seen<'_>) {
        if self.axes.is_empty() {
            return;
        }
        let reported = sample.reported.map(|[v, a]| [*v, *a]);
        let now = (sample.tick, *sample.position, reported);
        let last = self.last.replace(now);
        let (tick, line) = (sample.tick, sample.line);
        let mut found = None;
        for span in &self.axes {
            let i = span.axis.index();
            let at = sample.position[i];
            let most = if sample.is_between_frames {
                span.swing
            } else {
                Travel::ROUNDING
            };
            let here = (span.beyond(at) > most).then_some(at);
            let beyond = here.or_else(|| {
                let (before_tick, from, Some([v0, a0])) = last? else {
                    return None;
                };
                let [v1, a1] = reported?;
                let follows = before_tick.checked_add(1) == Some(tick);
                let swings = [[from[i], v0[i], a0[i]], [at, v1[i], a1[i]]];
                span.swung_to(&swings, self.period_t).filter(|_| follows)
            });
            if let Some(position) = beyond {
                found = found.or(Some((span.axis, position, span.end_next_to(position))));
                self.most = self.most.max(span.beyond(position));
            }
        }
        if let Some((axis, position, end)) = found {
            let kind = ViolationKind::Travel {
                axis,
                position,
                end,
            };
            self.violations.push(tick, line, kind);
        }
    }
}

impl Span {
    fn end_next_to(&self, position: f64) -> f64 {
        position.max(self.low).min(self.high)
    }

    fn beyond(&self, position: f64) -> f64 {
        (position - self.end_next_to(position)).abs()
    }

    /// Where the polynomial between two samples is furthest beyond an end, if it is. Each sample is
    /// position, velocity, acceleration.
    fn swung_to(&self, [from, to]: &[[f64; 3]; 2], t: f64) -> Option<f64> {
        // The polynomial lies between the extremes of these.
        let points = [
            from[0] + from[1] * t / 5.0,
            from[0] + from[1] * t * 0.4 + from[2] * t * t / 20.0,
            to[0] - to[1] * t * 0.4 + to[2] * t * t / 20.0,
            to[0] - to[1] * t / 5.0,
        ];
        if points.iter().all(|point| self.beyond(*point) <= self.swing) {
            return None;
        }
        let places = (1..PLACES).map(|k| between(from, to, t, f64::from(k) / f64::from(PLACES)));
        let furthest = places.max_by(|a, b| self.beyond(*a).total_cmp(&self.beyond(*b)))?;
        (self.beyond(furthest) > self.swing).then_some(furthest)
    }
}

/// The polynomial of degree five through two states, at a part of the period between them: the first
/// state played on, and what the second one differs from that.
fn between(from: &[f64; 3], to: &[f64; 3], t: f64, u: f64) -> f64 {
    let [p, v, a] = *from;
    let (v, a) = (v * t, a * t * t);
    // How far position, velocity and acceleration at the end are off those of constant acceleration.
    let off = [
        to[0] - (p + v + 0.5 * a),
        to[1] * t - (v + a),
        to[2] * t * t - a,
    ];
    let cubic = 10.0 * off[0] - 4.0 * off[1] + 0.5 * off[2];
    let quartic = -15.0 * off[0] + 7.0 * off[1] - off[2];
    let quintic = 6.0 * off[0] - 3.0 * off[1] + 0.5 * off[2];
    p + u * (v + u * (0.5 * a + u * (cubic + u * (quartic + u * quintic))))
}

#[cfg(test)]
mod tests {
    use super::{SWING_R, between};

    /// The kernel: what the polynomial is off (t − s)²/2 behind s, whose third derivative is an impulse.
    #[test]
    fn a_motion_is_off_its_samples_by_the_integral_of_the_kernel() {
        let integral = |t: f64| {
            let places = (0..4000).map(|k| (f64::from(k) + 0.5) / 4000.0);
            let off = places.map(|s: f64| {
                let end = [0.5 * (1.0 - s).powi(2), 1.0 - s, 1.0];
                let motion = 0.5 * (t - s).max(0.0).powi(2);
                (motion - between(&[0.0; 3], &end, 1.0, t)).abs()
            });
            off.sum::<f64>() / 4000.0
        };
        let most = (1..40).map(|k| integral(f64::from(k) / 40.0));
        let most = most.fold(0.0, f64::max);
        assert!((0.99 * SWING_R..=SWING_R).contains(&most), "{most}");
    }

    #[test]
    fn a_polynomial_of_degree_five_is_found_again() {
        let at = |t: f64| {
            [
                1.0 + t - 2.0 * t.powi(2) + 3.0 * t.powi(3) - t.powi(4) + 0.5 * t.powi(5),
                1.0 - 4.0 * t + 9.0 * t.powi(2) - 4.0 * t.powi(3) + 2.5 * t.powi(4),
                -4.0 + 18.0 * t - 12.0 * t.powi(2) + 10.0 * t.powi(3),
            ]
        };
        let t = 0.7;
        for k in 0..=10 {
            let u = f64::from(k) / 10.0;
            let found = between(&at(0.0), &at(t), t, u);
            assert!((found - at(u * t)[0]).abs() < 1e-12, "{u}: {found}");
        }
    }
}
