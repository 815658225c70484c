//! What is published in a tick.

use crate::config::Config;
use crate::message::{Report, Timing};
use crate::tick::Interpolator;
use glidepath_geometry::AXES;
use glidepath_link::{FaultCause, OVERRIDE_MAX, Setpoint, SetpointFrame, SetpointMarks};
use glidepath_realtime::Wake;

/// Counts of this life.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counters {
    number: u64,
    pub(crate) missed_ticks: u64,
    pub(crate) late_ticks: u64,
    pub(crate) reports_lost: u64,
    pub(crate) reserve_stops: u64,
    /// Of the tick before.
    pub(crate) timing: Timing,
    period_ns: u64,
    late_from_ns: u64,
    ticks_per_s: u64,
    missed_allowed: u64,
    second: u64,
    missed_in_second: u64,
}

impl Counters {
    pub(crate) fn new(config: &Config) -> Self {
        Self {
            number: 0,
            missed_ticks: 0,
            late_ticks: 0,
            reports_lost: 0,
            reserve_stops: 0,
            timing: Timing::default(),
            period_ns: config.period_ns,
            // A wake-up is never quite on time: late is what eats a quarter of the period.
            late_from_ns: config.period_ns / 4,
            ticks_per_s: (1_000_000_000 / config.period_ns.max(1)).max(1),
            missed_allowed: config.missed_ticks_allowed.unwrap_or(u64::MAX),
            second: 0,
            missed_in_second: 0,
        }
    }

    /// Counts a wake-up. Returns whether too many ticks were missed in the present second.
    pub(crate) const fn count(&mut self, wake: &Wake) -> bool {
        let second = wake.tick / self.ticks_per_s;
        if second != self.second {
            self.second = second;
            self.missed_in_second = 0;
        }
        self.missed_ticks += wake.missed;
        self.missed_in_second += wake.missed;
        if self.is_late(wake) {
            self.late_ticks += 1;
        }
        wake.missed > 0 && self.missed_in_second > self.missed_allowed
    }

    /// Writes into a report when it was, and how the host kept time so far.
    pub(crate) const fn stamp(&self, report: &mut Report, wake: &Wake) {
        let setpoint = &mut report.setpoint;
        setpoint.tick = wake.tick;
        setpoint.scheduled_ns = wake.scheduled_ns;
        setpoint.apply_ns = wake.scheduled_ns + self.period_ns;
        setpoint.lateness_ns = wake.lateness_ns();
        setpoint.missed_ticks = self.missed_ticks;
        setpoint.marks = 0;
        if self.is_late(wake) {
            setpoint.marks |= SetpointMarks::LATE.0;
        }
        if wake.missed > 0 {
            setpoint.marks |= SetpointMarks::AFTER_MISSED.0;
        }
        report.timing = self.timing;
        report.late_ticks = self.late_ticks;
        report.reports_lost = self.reports_lost;
    }

    const fn is_late(&self, wake: &Wake) -> bool {
        wake.lateness_ns() >= self.late_from_ns
    }
}

impl Interpolator<'_> {
    /// The setpoint at the present program time.
    pub(crate) fn evaluate(&mut self, tick: u64) -> Setpoint {
        let now = self.rate.now();
        let (Some(motion), Some(path), Some(frame)) = (
            self.track.kinematic(now.time),
            self.track.path(now.time),
            self.track.frame(now.time.sequence).copied(),
        ) else {
            // Every committed ramp ends on frames at hand, so this cannot be; if it were, standing
            // still is all that is left.
            self.fail(FaultCause::Output);
            self.rate.rest_at(now.time, 0.0);
            return self.standing();
        };
        let mut setpoint = self.blank(&frame);
        self.check(&motion.position, tick);
        let per_s = self.period_t.recip();
        if now.rate >= 1.0 && now.slope == 0.0 && now.time.fraction <= 0.0 {
            (setpoint.position, setpoint.velocity, setpoint.acceleration) =
                (frame.position, frame.velocity, frame.acceleration);
            setpoint.feed_v = frame.path_v;
        } else {
            let velocity = motion.velocity * (now.rate * per_s);
            let acceleration = (motion.acceleration * (now.rate * now.rate)
                + motion.velocity * now.slope)
                * (per_s * per_s);
            setpoint.position = motion.position.into();
            setpoint.velocity = velocity.into();
            setpoint.acceleration = acceleration.into();
            setpoint.feed_v = path.path_v * now.rate * per_s;
        }
        setpoint.fraction = now.time.fraction;
        setpoint.path_s = path.path_s;
        setpoint.effective_override = (frame.planned_override * now.rate).min(OVERRIDE_MAX);
        if self.announced != Some(frame.sequence) {
            self.announced = Some(frame.sequence);
            (setpoint.event_kind, setpoint.event_value) = (frame.event_kind, frame.event_value);
        }
        setpoint
    }

    /// The setpoint of a machine at rest without an epoch.
    pub(crate) fn standing(&mut self) -> Setpoint {
        let position = *self.published.position();
        self.published = self.published.then(&position);
        let passed = self.passed;
        Setpoint {
            position: position.into(),
            path_s: passed.path_s,
            ..self.blank(&passed)
        }
    }

    /// Everything that does not depend on the motion, without the stamp.
    fn blank(&mut self, frame: &SetpointFrame) -> Setpoint {
        let number = self.counters.number;
        self.counters.number += 1;
        Setpoint {
            boot_id: self.boot_id,
            number,
            // The stamp at the deadline sets these.
            tick: 0,
            scheduled_ns: 0,
            apply_ns: 0,
            lateness_ns: 0,
            missed_ticks: 0,
            marks: 0,
            epoch: self.epoch,
            sequence: frame.sequence,
            fraction: 0.0,
            line: frame.line,
            flags: frame.flags,
            state: self.state.code(),
            event_kind: 0,
            block: frame.block,
            event_value: 0.0,
            path_s: 0.0,
            feed_v: 0.0,
            effective_override: 0.0,
            position: [0.0; AXES],
            velocity: [0.0; AXES],
            acceleration: [0.0; AXES],
            joint_position: [0.0; AXES],
            joint_velocity: [0.0; AXES],
            joint_acceleration: [0.0; AXES],
        }
    }

    /// The setpoint with the state after this tick, and what the ports thread must know.
    pub(crate) fn report(&self, setpoint: Setpoint) -> Report {
        let now = self.rate.now().time.sequence;
        let (feed_override, rapid_override) = self.will.overrides();
        Report {
            setpoint: Setpoint {
                state: self.state.code(),
                ..setpoint
            },
            state: self.state,
            end_of_epoch: self.end_of_epoch,
            fault: self.will.fault().copied(),
            frames_executed: if self.epoch == 0 { 0 } else { now + 1 },
            queue_depth: if self.is_open() {
                self.track.end().saturating_sub(now + 1)
            } else {
                0
            },
            timing: Timing::default(),
            late_ticks: 0,
            reports_lost: 0,
            feed_override,
            rapid_override,
            single_block: self.will.is_single_block(),
            reserve_stops: self.counters.reserve_stops,
        }
    }
}
