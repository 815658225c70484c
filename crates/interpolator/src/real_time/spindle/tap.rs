//! A tap: into a hole along one axis and out of it again, by the angle of the spindle.
//!
//! ```text
//!   x │          ╱╲        way into the hole, mm
//!     │  depth  ╱  ╲       there the spindle is told to turn back, and goes on for a little
//!     │        ╱    ╲
//!     │_______╱      ╲___  out as in, with the spindle, up to where it was caught up with
//!     └────────────────── t
//! ```
//!
//! Nothing of it is planned: where it turns back is known only when it has. The axis is brought to
//! the speed of the spindle, and from there on it is where the angle says, whichever way the
//! spindle turns, until it comes back to the same place. It ends where it began, to the bit.
//!
//! The motion has a constant jerk in each period, inside the limits, and can always be stopped
//! without exceeding one. Once the spindle is told to turn back it can always be stopped, too, before
//! it has gone on for longer than it may: a spindle that does not turn back in time leaves the tap in
//! its hole, but not in what is below.

use super::seen::SpindleSeen;
use crate::shared::tracker::{Bounds, Motion, Profile, Target, Tracker};
use glidepath_geometry::AxisVector;
use glidepath_link::FaultCause;
use glidepath_program::Limits;

/// What of the limits is used, so that rounding does not exceed them.
const SHARE: f64 = 0.999;
/// How far the axis may be from where the spindle is, in revolutions.
const FARTHEST: f64 = 0.1;
/// A spindle slower than this stands, rev/s.
const STANDING: f64 = 0.05;
/// How long the spindle may take to turn back, s.
const PATIENCE_T: f64 = 10.0;
/// The part of its speed below which it is taken to be blocked, before it is told to turn back.
const SLOWEST: f64 = 0.5;
/// How the jerk answers what position, velocity and acceleration are off, in powers of the period:
/// three equal poles at one half.
const ANSWER: [f64; 3] = [0.125, 0.625, 7.0 / 6.0];

/// A hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hole {
    /// Index of the axis.
    pub(crate) axis: usize,
    /// 1 if it leads to higher positions, −1 if to lower ones.
    pub(crate) side: f64,
    /// Way of a revolution, mm, > 0.
    pub(crate) pitch_mm: f64,
    /// Where the spindle is told to turn back, mm, > 0.
    pub(crate) depth_mm: f64,
    /// How far it goes on from there at most, mm, > 0.
    pub(crate) overtravel_mm: f64,
}

/// Where a tap is.
#[derive(Debug, Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "there is one of them")]
enum Stage {
    /// It catches up with the spindle.
    RunIn(Tracker),
    /// It goes with the spindle. At the angle 0 it would be at the offset.
    With { offset_mm: f64, clear_mm: f64 },
    /// It comes to rest: where it began, or wherever it can.
    Out(Tracker),
}

/// A tap under way.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tap {
    hole: Hole,
    /// Where the axes stand while there is none.
    base: AxisVector,
    is_stopping: bool,
    bounds: Bounds,
    period_t: f64,
    /// 1 if the spindle turned forwards when it began, −1 if backwards.
    direction: f64,
    /// Its speed then, rev/s.
    speed: f64,
    stage: Stage,
    motion: Motion,
    /// How deep it may be, mm, once the spindle was told to turn back.
    deepest_mm: Option<f64>,
    waited_t: f64,
}

/// The outcome of a tick of a tap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TapStep {
    /// Into the hole.
    pub(crate) motion: Motion,
    /// The way that the spindle is told to turn now: 1 forwards, −1 backwards, 0 not at all.
    pub(crate) turns: Option<f64>,
    /// It is back where it began.
    pub(crate) is_done: bool,
}

impl Tap {
    /// A tap behind a spindle of a speed, rev/s.
    pub(crate) fn new(
        hole: &Hole,
        speed: f64,
        base: AxisVector,
        limits: &Limits,
        period_t: f64,
    ) -> Self {
        let of = |limit: &AxisVector| limit.get(hole.axis).copied().unwrap_or(0.0) * SHARE;
        let bounds = Bounds {
            v: of(&limits.velocity),
            a: of(&limits.acceleration),
            j: of(&limits.jerk),
        };
        let mut tracker = Tracker::new(Motion::default());
        tracker.aim(Target::Speed(speed.abs() * hole.pitch_mm), bounds);
        Self {
            hole: *hole,
            base,
            is_stopping: false,
            bounds,
            period_t,
            direction: 1.0_f64.copysign(speed),
            speed: speed.abs(),
            stage: Stage::RunIn(tracker),
            motion: Motion::default(),
            deepest_mm: None,
            waited_t: 0.0,
        }
    }

    /// Whether a spindle of that speed, rev/s, turns at all.
    pub(crate) fn turns(speed: f64) -> bool {
        speed.abs() > STANDING
    }

    pub(crate) const fn hole(&self) -> &Hole {
        &self.hole
    }

    pub(crate) const fn base(&self) -> &AxisVector {
        &self.base
    }

    /// Whether it comes to rest wherever it can.
    pub(crate) const fn is_stopping(&self) -> bool {
        self.is_stopping
    }

    /// The first tick of a stop, wherever it is: something is wrong. The spindle is to stop, too.
    pub(crate) fn stop(&mut self) -> TapStep {
        let mut tracker = Tracker::new(self.motion);
        tracker.aim(Target::Speed(0.0), self.bounds);
        self.motion = tracker.advance(self.period_t);
        (self.stage, self.is_stopping) = (Stage::Out(tracker), true);
        TapStep {
            motion: self.motion,
            turns: Some(0.0),
            is_done: false,
        }
    }

    /// A tick, whose setpoint applies at `at_ns`. `leaves`: it is to come out, wherever it is.
    ///
    /// # Errors
    /// The spindle cannot be followed any more.
    pub(crate) fn step(
        &mut self,
        seen: &SpindleSeen,
        at_ns: u64,
        leaves: bool,
    ) -> Result<TapStep, FaultCause> {
        let mut turns = None;
        let mut is_done = false;
        match &mut self.stage {
            Stage::RunIn(tracker) => {
                self.motion = tracker.advance(self.period_t);
                if tracker.has_arrived() {
                    let (angle, _) = seen.turn.at(at_ns);
                    let way_mm = self.direction * angle * self.hole.pitch_mm;
                    self.stage = Stage::With {
                        offset_mm: self.motion.x - way_mm,
                        clear_mm: self.motion.x,
                    };
                }
            }
            Stage::With {
                offset_mm,
                clear_mm,
            } => {
                let (offset_mm, clear_mm) = (*offset_mm, *clear_mm);
                self.go_with(seen, at_ns, offset_mm)?;
                if self.deepest_mm.is_none() && (leaves || self.motion.x >= self.hole.depth_mm) {
                    let from_mm = self.motion.x.min(self.hole.depth_mm);
                    self.deepest_mm = Some(from_mm + self.hole.overtravel_mm);
                    turns = Some(-self.direction);
                }
                let is_back = self.deepest_mm.is_some() && self.motion.v < 0.0;
                if is_back && self.motion.x <= clear_mm {
                    let mut tracker = Tracker::new(self.motion);
                    tracker.aim(Target::Rest(0.0), self.bounds);
                    self.stage = Stage::Out(tracker);
                }
            }
            Stage::Out(tracker) => {
                self.motion = tracker.advance(self.period_t);
                is_done = tracker.has_arrived();
                if is_done {
                    (self.motion.v, self.motion.a) = (0.0, 0.0);
                    turns = (!self.is_stopping).then_some(self.direction);
                }
            }
        }
        Ok(TapStep {
            motion: self.motion,
            turns,
            is_done,
        })
    }

    /// A period with the jerk that brings the axis to where the spindle is.
    fn go_with(
        &mut self,
        seen: &SpindleSeen,
        at_ns: u64,
        offset_mm: f64,
    ) -> Result<(), FaultCause> {
        let (angle, speed) = seen.turn.at(at_ns);
        let acceleration = seen.turn.acceleration;
        let per_turn = self.direction * self.hole.pitch_mm;
        let t = self.period_t;
        // Where it is to be at the end of the period, and how far what it has would bring it.
        let wanted = Motion {
            x: offset_mm + per_turn * angle,
            v: per_turn * speed,
            a: per_turn * acceleration,
        };
        if self.deepest_mm.is_none() && self.direction * speed < SLOWEST * self.speed {
            return Err(FaultCause::SpindleSpeed);
        }
        self.waited_t += if self.deepest_mm.is_some() { t } else { 0.0 };
        if self.waited_t > PATIENCE_T && wanted.v >= 0.0 {
            return Err(FaultCause::SpindleSpeed);
        }
        let before = Motion {
            x: wanted.x - t * (wanted.v - 0.5 * t * wanted.a),
            v: wanted.v - t * wanted.a,
            a: wanted.a,
        };
        let [of_x, of_v, of_a] = ANSWER;
        let off = of_x * (before.x - self.motion.x)
            + of_v * t * (before.v - self.motion.v)
            + of_a * t * t * (before.a - self.motion.a);
        let jerk = self.allowed_jerk(off / t.powi(3));
        // What is refused is not gone: the stop sets out from where the axis is.
        let next = self.motion.after(t, jerk);
        if (next.x - wanted.x).abs() > FARTHEST * self.hole.pitch_mm {
            return Err(FaultCause::ThreadLost);
        }
        let (_, rests_mm) = Profile::to_stop(next, &self.bounds).extent();
        if self
            .deepest_mm
            .is_some_and(|deepest_mm| rests_mm > deepest_mm)
        {
            return Err(FaultCause::TapOvertravel);
        }
        self.motion = next;
        Ok(())
    }

    /// The jerk nearest to a wanted one with which acceleration and velocity stay inside their
    /// limits, also when the axis is stopped behind the period.
    fn allowed_jerk(&self, wanted: f64) -> f64 {
        let Bounds { v, a, j } = self.bounds;
        let t = self.period_t;
        let by_a = |jerk: f64| jerk.clamp((-a - self.motion.a) / t, (a - self.motion.a) / t);
        let jerk = by_a(wanted.clamp(-j, j)).clamp(-j, j);
        let end = self.motion.after(t, jerk);
        let released = end.v + end.a * end.a.abs() / (2.0 * j);
        if released.abs() <= v {
            return jerk;
        }
        // Back to no acceleration, which does not raise the speed above what it comes to anyway.
        by_a((-self.motion.a / t).clamp(-j, j))
    }
}
