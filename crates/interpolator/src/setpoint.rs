//! What is published in a tick.

use crate::config::Config;
use crate::message::{Report, Timing};
use crate::place::Place;
use crate::rate::Advance;
use crate::tick::Interpolator;
use glidepath_geometry::AXES;
use glidepath_link::{FaultCause, OVERRIDE_MAX, Setpoint, SetpointMarks};
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
    /// Writes the setpoint at the present program time.
    pub(crate) fn evaluate(&mut self, tick: u64, setpoint: &mut Setpoint) {
        let now = self.rate.now();
        let place = self.track.frame(now.time.sequence).map(Place::of);
        let (Some(place), Some(())) = (place, self.evaluate_motion(&now, setpoint)) else {
            // Every committed ramp ends on frames at hand, so this cannot be; if it were, standing
            // still is all that is left.
            self.fail(FaultCause::Output);
            self.rate.rest_at(now.time, 0.0);
            self.stand(setpoint);
            return;
        };
        self.check(&setpoint.position.into(), tick);
        self.locate(&place, setpoint);
        setpoint.fraction = now.time.fraction;
        setpoint.effective_override = (place.planned_override * now.rate).min(OVERRIDE_MAX);
        (setpoint.event_kind, setpoint.event_value) = (0, 0.0);
        if self.announced != Some(place.sequence) {
            self.announced = Some(place.sequence);
            if let Some(frame) = self.track.frame(place.sequence) {
                (setpoint.event_kind, setpoint.event_value) = (frame.event_kind, frame.event_value);
            }
        }
    }

    /// Writes where the axes and the path are and how they move. On the grid of the frames, at rate 1,
    /// that is the frame.
    fn evaluate_motion(&self, now: &Advance, setpoint: &mut Setpoint) -> Option<()> {
        let frame = self.track.frame(now.time.sequence)?;
        if now.rate >= 1.0 && now.slope == 0.0 && now.time.fraction <= 0.0 {
            setpoint.position = frame.position;
            setpoint.velocity = frame.velocity;
            setpoint.acceleration = frame.acceleration;
            (setpoint.path_s, setpoint.feed_v) = (frame.path_s, frame.path_v);
            return Some(());
        }
        let motion = self.track.kinematic(now.time)?;
        let path = self.track.path(now.time)?;
        let per_s = self.period_t.recip();
        let velocity = motion.velocity * (now.rate * per_s);
        let acceleration = (motion.acceleration * (now.rate * now.rate)
            + motion.velocity * now.slope)
            * (per_s * per_s);
        setpoint.position = motion.position.into();
        setpoint.velocity = velocity.into();
        setpoint.acceleration = acceleration.into();
        (setpoint.path_s, setpoint.feed_v) = (path.path_s, path.path_v * now.rate * per_s);
        Some(())
    }

    /// Writes the setpoint of a machine at rest without an epoch.
    pub(crate) fn stand(&mut self, setpoint: &mut Setpoint) {
        let position = self.published.position();
        self.published.go_to(&position);
        let passed = self.passed;
        self.locate(&passed, setpoint);
        (setpoint.position, setpoint.path_s) = (position.into(), passed.path_s);
        (setpoint.velocity, setpoint.acceleration) = ([0.0; AXES], [0.0; AXES]);
        (
            setpoint.feed_v,
            setpoint.fraction,
            setpoint.effective_override,
        ) = (0.0, 0.0, 0.0);
        (setpoint.event_kind, setpoint.event_value) = (0, 0.0);
    }

    /// Writes which setpoint it is, and where in the program.
    const fn locate(&mut self, place: &Place, setpoint: &mut Setpoint) {
        setpoint.boot_id = self.boot_id;
        setpoint.number = self.counters.number;
        self.counters.number += 1;
        setpoint.epoch = self.epoch;
        setpoint.sequence = place.sequence;
        setpoint.line = place.line;
        setpoint.block = place.block;
        setpoint.flags = place.flags;
    }

    /// Writes the state after this tick, and what the ports thread must know.
    pub(crate) fn report(&self, report: &mut Report) {
        let now = self.rate.now().time.sequence;
        let (feed_override, rapid_override) = self.will.overrides();
        report.setpoint.state = self.state.code();
        report.state = self.state;
        report.end_of_epoch = self.end_of_epoch;
        report.fault = self.will.fault().copied();
        report.frames_executed = if self.epoch == 0 { 0 } else { now + 1 };
        report.queue_depth = if self.is_open() {
            self.track.end().saturating_sub(now + 1)
        } else {
            0
        };
        (report.feed_override, report.rapid_override) = (feed_override, rapid_override);
        report.single_block = self.will.is_single_block();
        report.reserve_stops = self.counters.reserve_stops;
    }
}
