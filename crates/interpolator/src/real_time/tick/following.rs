//! The part of a tick behind the spindle: program time goes on with its angle in a pass of a
//! thread, and an axis goes with it into a hole that is tapped.
//!
//! Overrides and a hold wait until the pass has come to its end, and so does an abort: a tool that
//! stops in a thread cuts a groove. From a hole, an abort leads out. A fault does not wait.

use super::state::Interpolator;
use crate::real_time::jog::AxesMotion;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::rate::{BESIDE_FULL, Situation};
use crate::real_time::spindle::{Follow, Hole, Lead, LeadOutcome, SpindleSeen, Tap};
use glidepath_geometry::AxisVector;
use glidepath_link::{EventRecord, FaultCause, Setpoint, SpindleFlags};
use glidepath_program::{Event, FrameFlags};
use glidepath_realtime::Wake;

/// The part of what program time is off that a tick takes back, where it may.
const TAKEN_BACK: f64 = 0.5;
/// What is taken back is to be got rid of again before it is too much: the part of the most change
/// that is counted on for that.
const COUNTED_ON: f64 = 0.5;
/// Parts of the wanted change of the rate that are tried.
const PARTS: [f64; 4] = [1.0, 0.5, 0.2, 0.05];

impl Interpolator<'_> {
    /// Follows the spindle, and writes the setpoint. Returns whether it does; if not, it waits for
    /// the spindle, or has lost it.
    #[inline(never)]
    pub(super) fn follow_spindle(&mut self, due: &Wake, setpoint: &mut Setpoint) -> bool {
        let applies_ns = due.scheduled_ns + self.drives.period_ns();
        let seen = self.spindle_seen(applies_ns);
        if self.tap.is_some() {
            self.go_on_tapping(&seen, due.tick, applies_ns, setpoint);
            return true;
        }
        let follows = if self.pass.is_following() {
            self.go_on_with_pass(&seen, due, applies_ns)
        } else {
            match self.awaited_event() {
                Some(Event::Synchronise { pitch_mm, phase }) => {
                    self.begin_pass(&seen, (pitch_mm, phase), applies_ns)
                }
                Some(Event::Tap {
                    axis,
                    pitch_mm,
                    depth_um,
                }) => {
                    let hole = Hole {
                        axis: axis as usize,
                        side: 1.0_f64.copysign(pitch_mm),
                        pitch_mm: pitch_mm.abs(),
                        depth_mm: f64::from(depth_um) * 1e-3,
                        overtravel_mm: self.tap_overtravel * pitch_mm.abs(),
                    };
                    if self.begin_tapping(&hole, &seen, applies_ns) {
                        self.go_on_tapping(&seen, due.tick, applies_ns, setpoint);
                        return true;
                    }
                    false
                }
                _ => {
                    self.pass.end();
                    false
                }
            }
        };
        if follows {
            self.write_moving(due.tick, setpoint);
        }
        follows
    }

    /// The event that the motion stands at.
    fn awaited_event(&self) -> Option<Event> {
        let (frame, _) = self.track.m_code_wait()?;
        frame.event().ok().flatten()
    }

    fn go_on_with_pass(&mut self, seen: &SpindleSeen, due: &Wake, applies_ns: u64) -> bool {
        if self.requests.fault().is_some() {
            self.pass.end();
            return false;
        }
        match self.pass.follow(seen, due.scheduled_ns, applies_ns) {
            Ok(follow) => self.go_with_spindle(&follow, due.tick),
            Err(cause) => {
                self.lose_pass(cause);
                false
            }
        }
    }

    /// What is seen of the spindle. What was said before it heard of the event is not about that.
    fn spindle_seen(&mut self, applies_ns: u64) -> SpindleSeen {
        if self.drives.are_simulated() {
            let period_t = self.track.period_t();
            return self.simulated_spindle.turn(period_t, applies_ns);
        }
        let seen = self.drives.seen();
        let awaited = self.wait.awaited();
        let has_heard = awaited.is_none_or(|awaited| seen.played >= awaited.told_by);
        SpindleSeen {
            turn: seen.turn,
            at_speed: has_heard && seen.spindle.contains(SpindleFlags::AT_SPEED),
        }
    }

    /// Tells a spindle that is simulated what happens, and what stops with the motion.
    pub(super) fn tell_spindle(&mut self, setpoint: &Setpoint) {
        for event in setpoint.events().iter().flat_map(EventRecord::event) {
            self.simulated_spindle.hear(event);
            self.stops.hear(event);
        }
    }

    fn lose_pass(&mut self, cause: FaultCause) {
        self.pass.end();
        self.fail(cause);
    }

    /// Begins the pass that the motion stands at, if the spindle has come to the angle for that.
    fn begin_pass(
        &mut self,
        seen: &SpindleSeen,
        (pitch_mm, phase): (f64, u32),
        applies_ns: u64,
    ) -> bool {
        if self.pass.lead().is_none() {
            let sequence = self.rate.now().time.sequence;
            match Lead::find(&self.track, sequence, pitch_mm) {
                LeadOutcome::Found(lead) => self.pass.keep_lead(lead),
                LeadOutcome::Open => {}
                LeadOutcome::None => self.lose_pass(FaultCause::ThreadLost),
            }
        }
        if self.is_kept() || self.queue_level.is_short() {
            return false;
        }
        let period_ns = self.drives.period_ns();
        let Some((follow, begun)) = self.pass.begins(seen, phase, applies_ns, period_ns) else {
            return false;
        };
        if !self.set_out(&follow) {
            return false;
        }
        self.pass.begin(begun);
        self.wait.end();
        true
    }

    /// Whether the operator, or a fault, keeps it from beginning.
    fn is_kept(&self) -> bool {
        self.requests.holds(false) || self.requests.is_stopping()
    }

    /// Sets out with the spindle, if there is a stop to keep in reserve.
    fn set_out(&mut self, follow: &Follow) -> bool {
        self.track.pass_m_code_wait();
        if self.track.barrier().is_some_and(|at| at <= follow.start) {
            self.track.unbar();
        }
        let situation = Situation {
            track: &self.track,
            published: self.output.published(),
            allowed: self.output.allowed(),
            stop_frames: self.queue_level.stop_frames(),
            is_fully_supplied: self.queue_level.is_fully_supplied(),
            block_end: None,
        };
        let time = ProgramTime::at(follow.start).after(follow.elapsed);
        let sets_out = self.rate.set_out_at(time, follow.step, &situation);
        if !sets_out {
            self.track
                .take_m_code_wait_back(self.rate.now().time.sequence);
        }
        sets_out
    }

    /// Goes on as far as the spindle has turned, or as near to that as the limits let.
    fn go_with_spindle(&mut self, follow: &Follow, tick: u64) -> bool {
        let now = self.rate.now();
        #[allow(clippy::cast_precision_loss, reason = "frames of a pass")]
        let elapsed = (now.time.sequence - follow.start) as f64 + now.time.fraction;
        // Where it is to be before this tick's step.
        let off = follow.elapsed - follow.step - elapsed;
        if follow.is_lost(elapsed + follow.step) {
            self.lose_pass(FaultCause::ThreadLost);
            return false;
        }
        let situation = Situation {
            track: &self.track,
            published: self.output.published(),
            allowed: self.output.allowed(),
            stop_frames: self.queue_level.stop_frames(),
            is_fully_supplied: self.queue_level.is_fully_supplied(),
            block_end: None,
        };
        let most = self.rate.most_change(&situation);
        let back = (TAKEN_BACK * off.abs()).min((COUNTED_ON * most * off.abs()).sqrt());
        let wanted = (follow.step + back.copysign(off)).clamp(0.0, BESIDE_FULL);
        let change = (wanted - now.rate).clamp(-most, most);
        for part in PARTS {
            if self
                .rate
                .change_at_once(now.rate + part * change, &situation)
            {
                break;
            }
        }
        self.advance_in_pass(tick);
        true
    }

    /// Advances program time by a tick, not past the end of the pass.
    fn advance_in_pass(&mut self, tick: u64) {
        let end = self.track.rest_behind(self.rate.now().time);
        self.advance_program_time(tick);
        if self.rate.has_taken_reserve() {
            self.lose_pass(FaultCause::ThreadLost);
            return;
        }
        let Some(end) = end.filter(|end| self.rate.now().time.sequence >= *end) else {
            return;
        };
        self.rate.rest_at(ProgramTime::at(end), 0.0);
        self.pass.end();
        let goes_on = self.track.frame(end + 1);
        if goes_on.is_some_and(|frame| frame.has(FrameFlags::SYNC)) {
            self.fail(FaultCause::ThreadLost);
        }
    }

    /// Whether an axis is in a hole, and on its way: an epoch does not end there.
    #[cold]
    #[inline(never)]
    pub(super) fn is_tapping(&self) -> bool {
        self.tap.as_ref().is_some_and(|tap| !tap.is_stopping())
    }

    /// Begins to tap where the motion stands, if the spindle turns as it is to.
    fn begin_tapping(&mut self, hole: &Hole, seen: &SpindleSeen, applies_ns: u64) -> bool {
        let (_, speed) = seen.turn.at(applies_ns);
        let is_ready = seen.is_ready(applies_ns, self.drives.period_ns());
        if self.is_kept() || !is_ready || !Tap::turns(speed) {
            return false;
        }
        let base = self.output.published().position();
        self.tap = Some(Tap::new(
            hole,
            speed,
            base,
            &self.limits,
            self.track.period_t(),
        ));
        self.wait.end();
        true
    }

    /// A tick of a tap: the axes are where the plan rests, but for the one that goes into the hole.
    fn go_on_tapping(
        &mut self,
        seen: &SpindleSeen,
        tick: u64,
        applies_ns: u64,
        setpoint: &mut Setpoint,
    ) {
        let Some(mut tap) = self.tap else { return };
        // Without a planner it can still come out; what else has failed may be what it goes by.
        let fault = self.requests.fault().map(|fault| fault.cause);
        let stops = fault.is_some_and(|cause| cause != FaultCause::PlannerLost);
        let period_ns = self.drives.period_ns();
        let stepped = if stops && !tap.is_stopping() {
            Ok(tap.stop())
        } else if seen.is_known(applies_ns, period_ns) || tap.is_stopping() {
            tap.step(seen, applies_ns, self.requests.is_stopping())
        } else {
            Err(FaultCause::SpindleAngle)
        };
        let step = stepped.unwrap_or_else(|cause| {
            self.fail(cause);
            tap.stop()
        });
        self.tap = Some(tap);
        let along = |x: f64| {
            let mut vector = AxisVector::zeros();
            if let Some(axis) = vector.get_mut(tap.hole().axis) {
                *axis = tap.hole().side * x;
            }
            vector
        };
        let away = along(step.motion.x);
        let motion = AxesMotion {
            position: tap.base() + away,
            velocity: along(step.motion.v),
            acceleration: along(step.motion.a),
        };
        let (output, passed) = (&mut self.output, &self.passed);
        let written = output.write_by_hand(self.epoch, passed, &motion, &away, setpoint);
        self.judge(written, tick);
        if let Some(turns) = step.turns {
            let code = match turns {
                turns if turns > 0.0 => 3,
                turns if turns < 0.0 => 4,
                _ => 5,
            };
            let period_ns = u32::try_from(period_ns).unwrap_or(u32::MAX);
            let _has_room = setpoint.tell(EventRecord::new(Event::MCode(code), period_ns));
            self.tell_spindle(setpoint);
        }
        // Where it stopped for a fault, it stays until the epoch has ended.
        if step.is_done && !tap.is_stopping() {
            self.tap = None;
            self.pass.end();
            self.track.pass_m_code_wait();
            // What was ordered in the hole counts from here on. The plan rests, so the rate changes at once: by a
            // ramp the next block would be begun.
            self.rate.rest_at(self.rate.now().time, self.goal());
        }
    }
}
