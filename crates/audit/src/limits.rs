//! The check of the axes' limits by finite differences, of the consistency of reports and of gaps,
//! and the times of motion.

use crate::sample::Seen;
use crate::settings::AuditSettings;
use crate::violation::{Inconsistency, ViolationKind, ViolationList, Worst};
use glidepath_geometry::{AXES, Axis, AxisVector, LINEAR_XYZ};
use glidepath_program::Limits;

/// A limit counts as kept up to this factor.
const SLACK: f64 = 1.0 + 1e-6;

/// State of the check.
///
/// Most samples are neither a new largest of anything nor anywhere near a limit. That is told
/// without a division: per axis and order a threshold for the bare difference is kept, the smaller
/// of the largest so far and the limit. Only where a difference is above its threshold is
/// everything computed.
#[derive(Debug)]
pub(crate) struct LimitAudit {
    limits: Limits,
    period_t: f64,
    /// The last positions, newest first; only the first `known` count.
    recent: [AxisVector; 4],
    known: usize,
    previous: Option<Previous>,
    /// Another axis than X, Y, Z has moved, or was reported to.
    others_move: bool,
    /// Leading axes that count at this sample.
    axes: usize,
    /// Largest |p| so far, for the rounding of differences.
    magnitude: f64,
    /// Up to these, differences of first to third order tell nothing new, mm.
    thresholds: [AxisVector; 3],
    /// Up to these, differences are inside the limits, mm.
    limit_thresholds: [AxisVector; 3],
    /// What a period with the full jerk makes of position, velocity and acceleration.
    by_jerk: [AxisVector; 3],
    pub(crate) samples: u64,
    pub(crate) worst: [Worst; 3],
    pub(crate) maxima: [AxisVector; 3],
    pub(crate) first_motion_tick: Option<u64>,
    pub(crate) last_motion_tick: u64,
    pub(crate) violations: ViolationList,
}

/// The last sample, but for its position.
#[derive(Debug, Clone, Copy)]
struct Previous {
    tick: u64,
    line: u32,
    reported: Option<[AxisVector; 2]>,
}

impl LimitAudit {
    pub(crate) fn new(settings: &AuditSettings) -> Self {
        let (limits, t) = (settings.limits, settings.period_t);
        // A little below what counts as broken: rounding must not hide anything.
        let kept = 0.5 * (1.0 + SLACK);
        let limit_thresholds = [
            limits.velocity * (kept * t),
            limits.acceleration * (kept * t * t),
            limits.jerk * (kept * t * t * t),
        ];
        let jerk = limits.jerk * SLACK;
        Self {
            limits,
            period_t: t,
            recent: [AxisVector::zeros(); 4],
            known: 0,
            previous: None,
            others_move: false,
            axes: AXES,
            magnitude: 0.0,
            thresholds: [AxisVector::zeros(); 3],
            limit_thresholds,
            by_jerk: [jerk * t * t * t / 6.0, jerk * t * t / 2.0, jerk * t],
            samples: 0,
            worst: [Worst::default(); 3],
            maxima: [AxisVector::zeros(); 3],
            first_motion_tick: None,
            last_motion_tick: 0,
            violations: ViolationList::default(),
        }
    }

    pub(crate) fn sample(&mut self, sample: &Seen<'_>) {
        self.samples += 1;
        if self.previous.is_none() {
            // At rest before the first sample.
            self.recent = [*sample.position; 4];
            self.known = 3;
        }
        self.look_at_axes(sample);
        if !sample
            .position
            .iter()
            .take(self.axes)
            .all(|p| p.is_finite())
        {
            self.violations
                .push(sample.tick, sample.line, ViolationKind::NotFinite);
            return;
        }
        match self.previous {
            None => {}
            Some(Previous { tick, .. }) if tick.checked_add(1) == Some(sample.tick) => {
                self.consistency(sample);
            }
            Some(Previous { tick, .. }) => {
                let kind = ViolationKind::Gap { after: tick };
                self.violations.push(sample.tick, sample.line, kind);
                // Differences across the gap would mean nothing.
                self.known = 0;
            }
        }
        if let Some(previous) = &self.previous {
            let [last, ..] = &self.recent;
            if (0..self.axes).any(|i| sample.position[i] - last[i] != 0.0) {
                self.first_motion_tick.get_or_insert(previous.tick);
                self.last_motion_tick = sample.tick;
            }
        }
        self.push(sample.position, sample.tick, sample.line);
        self.previous = Some(Previous {
            tick: sample.tick,
            line: sample.line,
            reported: sample.reported.map(|[v, a]| [*v, *a]),
        });
    }

    /// X, Y, Z count from the second sample on, and all axes as soon as another one moves or is
    /// reported to.
    fn look_at_axes(&mut self, sample: &Seen<'_>) {
        let [last, ..] = &self.recent;
        let mut differing = 0;
        for i in LINEAR_XYZ.end..AXES {
            differing |= sample.position[i].to_bits() ^ last[i].to_bits();
        }
        if let Some([velocity, acceleration]) = &sample.reported {
            for i in LINEAR_XYZ.end..AXES {
                // But for the sign of a zero.
                differing |= (velocity[i].to_bits() | acceleration[i].to_bits()) << 1;
            }
        }
        self.others_move |= differing != 0;
        self.axes = if self.others_move || self.previous.is_none() {
            AXES
        } else {
            LINEAR_XYZ.end
        };
    }

    /// At rest after the last sample.
    pub(crate) fn finish(&mut self) {
        if let Some(last) = self.previous {
            let [position, ..] = self.recent;
            for k in 1..=3 {
                self.push(&position, last.tick.saturating_add(k), last.line);
            }
        }
    }

    /// Seconds from the first to the last motion.
    pub(crate) fn motion_time_s(&self) -> f64 {
        let ticks = self
            .first_motion_tick
            .map_or(0, |first| self.last_motion_tick - first);
        #[expect(
            clippy::cast_precision_loss,
            reason = "exact for two million years of ticks"
        )]
        let ticks = ticks as f64;
        ticks * self.period_t
    }

    pub(crate) fn last_position(&self) -> AxisVector {
        let [last, ..] = self.recent;
        self.previous.map_or_else(AxisVector::zeros, |_| last)
    }

    fn push(&mut self, position: &AxisVector, tick: u64, line: u32) {
        let [p1, p2, p3, _] = self.recent;
        self.recent = [*position, p1, p2, p3];
        self.known = (self.known + 1).min(4);
        let [first, second, third] = &self.thresholds;
        let mut is_new = self.known < 4;
        for i in 0..self.axes {
            self.magnitude = self.magnitude.max(position[i].abs());
            let [d1, d2, d3] = differences([position[i], p1[i], p2[i], p3[i]]);
            is_new |= (d1 > first[i]) | (d2 > second[i]) | (d3 > third[i]);
        }
        if is_new {
            for order in 0..3.min(self.known.saturating_sub(1)) {
                self.check(order, tick, line);
            }
        }
    }

    /// Judges the differences of order `order` + 1.
    fn check(&mut self, order: usize, tick: u64, line: u32) {
        let t = self.period_t;
        let allowed = [
            &self.limits.velocity,
            &self.limits.acceleration,
            &self.limits.jerk,
        ];
        let limit = allowed[order];
        // Each position is rounded to half a unit in its last place.
        let weights = [2.0, 4.0, 8.0];
        let divisors = [t, t * t, t * t * t];
        let rounding = weights[order] * 0.5 * f64::EPSILON * self.magnitude / divisors[order];
        for axis in Axis::ALL.into_iter().take(self.axes) {
            let i = axis.index();
            let difference = differences(self.recent.map(|position| position[i]))[order];
            let size = difference / divisors[order];
            if size > self.maxima[order][i] {
                self.maxima[order][i] = size;
                self.thresholds[order][i] = difference.min(self.limit_thresholds[order][i]);
            }
            let ratio = size / limit[i];
            if ratio > self.worst[order].ratio {
                self.worst[order] = Worst {
                    ratio,
                    axis: Some(axis),
                    tick,
                    line,
                };
            }
            if size > limit[i] * SLACK + rounding {
                let kind = match order {
                    0 => ViolationKind::Velocity { axis, ratio },
                    1 => ViolationKind::Acceleration { axis, ratio },
                    _ => ViolationKind::Jerk { axis, ratio },
                };
                self.violations.push(tick, line, kind);
            }
        }
    }

    /// With jerk of at most J, a period's motion differs from that with none by at most J·T³/6 in
    /// position, J·T²/2 in velocity, J·T in acceleration.
    fn consistency(&mut self, sample: &Seen<'_>) {
        let Some(before) = self.previous.as_ref().and_then(|p| p.reported.as_ref()) else {
            return;
        };
        let Some(after) = sample.reported else {
            return;
        };
        let steps = Steps {
            positions: [&self.recent[0], sample.position],
            before,
            after,
            period_t: self.period_t,
        };
        let t = self.period_t;
        let [position, velocity, acceleration] = &self.by_jerk;
        // Without an allowance for rounding, which hardly ever is needed. Not a number does not
        // fit.
        let mut fits = true;
        for i in 0..self.axes {
            let [p, v, a] = steps.of(i);
            fits &= (p <= position[i]) & (v <= velocity[i]) & (a <= acceleration[i]);
        }
        if fits {
            return;
        }
        for axis in Axis::ALL.into_iter().take(self.axes) {
            let i = axis.index();
            let rounding = 4.0 * f64::EPSILON * (self.magnitude + before[0][i].abs() * t);
            let [p, v, a] = steps.of(i);
            let checks = [
                (p <= position[i] + rounding, Inconsistency::Position),
                (v <= velocity[i] + rounding / t, Inconsistency::Velocity),
                (
                    a <= acceleration[i] + rounding / (t * t),
                    Inconsistency::Acceleration,
                ),
            ];
            for (_, what) in checks.into_iter().filter(|(fits, _)| !fits) {
                let kind = ViolationKind::Inconsistent { axis, what };
                self.violations.push(sample.tick, sample.line, kind);
            }
        }
    }
}

/// Two samples one after the other, with what was reported of velocity and acceleration.
struct Steps<'a> {
    positions: [&'a AxisVector; 2],
    before: &'a [AxisVector; 2],
    after: [&'a AxisVector; 2],
    period_t: f64,
}

impl Steps<'_> {
    /// What position, velocity and acceleration of an axis change beyond a motion without jerk.
    #[inline]
    fn of(&self, i: usize) -> [f64; 3] {
        let (t, [from, to]) = (self.period_t, self.positions);
        let ([v0, a0], [v1, a1]) = (self.before, self.after);
        [
            (to[i] - from[i] - v0[i] * t - a0[i] * (0.5 * t * t)).abs(),
            (v1[i] - v0[i] - a0[i] * t).abs(),
            (a1[i] - a0[i]).abs(),
        ]
    }
}

/// Sizes of the differences of first to third order of an axis, newest position first.
#[inline]
fn differences([p0, p1, p2, p3]: [f64; 4]) -> [f64; 3] {
    [
        (p0 - p1).abs(),
        (p0 - 2.0 * p1 + p2).abs(),
        (p0 - 3.0 * p1 + 3.0 * p2 - p3).abs(),
    ]
}

const _: () = assert!(AXES == Axis::ALL.len());
