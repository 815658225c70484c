//! What a tick does in a pass of a thread: program time goes on with the angle of the spindle.
//!
//! Overrides and a hold wait until the pass has come to its end, and so does an abort: a tool that
//! stops in a thread cuts a groove. A fault does not wait.

use super::state::Interpolator;
use crate::program_time::ProgramTime;
use crate::rate::Situation;
use crate::spindle::{Follow, Lead, LeadOutcome, SpindleSeen};
use glidepath_link::{FaultCause, SpindleFlags};
use glidepath_program::{Event, FrameFlags};
use glidepath_realtime::Wake;

/// The highest rate: see [`crate::rate::beside_full`].
const MOST_RATE: f64 = 0.998;
/// The part of what program time is off that a tick takes back, where it may.
const TAKEN_BACK: f64 = 0.5;
/// What is taken back is to be got rid of again before it is too much: the part of the most change
/// that is counted on for that.
const COUNTED_ON: f64 = 0.5;
/// Parts of the wanted change of the rate that are tried.
const PARTS: [f64; 4] = [1.0, 0.5, 0.2, 0.05];

impl Interpolator<'_> {
    /// Lets program time follow the spindle. Returns whether it does; if not, it waits for it, or
    /// the pass was lost.
    #[cold]
    #[inline(never)]
    pub(super) fn follow_spindle(&mut self, due: &Wake) -> bool {
        let applies_ns = due.scheduled_ns + self.drives.period_ns();
        let seen = self.spindle_seen();
        if !self.pass.is_following() {
            return self.begin_pass(&seen, applies_ns);
        }
        if self.requests.fault().is_some() {
            self.pass.end();
            return false;
        }
        match self.pass.follow(&seen, due.scheduled_ns, applies_ns) {
            Ok(follow) => self.go_with_spindle(&follow, due.tick),
            Err(cause) => {
                self.lose_pass(cause);
                false
            }
        }
    }

    /// What is seen of the spindle. What was said before it heard of the event is not about that.
    fn spindle_seen(&mut self) -> SpindleSeen {
        if self.drives.are_simulated() {
            let turned_ns = self.pass.turn(self.drives.period_ns());
            return SpindleSeen::Simulated { turned_ns };
        }
        let seen = self.drives.seen();
        let awaited = self.wait.awaited();
        let has_heard = awaited.is_none_or(|awaited| seen.played >= awaited.told_by);
        SpindleSeen::Real {
            turn: seen.turn,
            at_speed: has_heard && seen.spindle.contains(SpindleFlags::AT_SPEED),
        }
    }

    fn lose_pass(&mut self, cause: FaultCause) {
        self.pass.end();
        self.fail(cause);
    }

    /// Begins the pass that the motion stands at, if the spindle has come to the angle for that.
    fn begin_pass(&mut self, seen: &SpindleSeen, applies_ns: u64) -> bool {
        let Some((frame, _)) = self.track.gate() else {
            self.pass.end();
            return false;
        };
        let (event, sequence) = (frame.event(), frame.sequence);
        let Ok(Some(Event::Synchronise { pitch_mm, phase })) = event else {
            self.pass.end();
            return false;
        };
        if self.pass.lead().is_none() {
            match Lead::find(&self.track, sequence, pitch_mm) {
                LeadOutcome::Found(lead) => self.pass.keep_lead(lead),
                LeadOutcome::Open => {}
                LeadOutcome::None => self.lose_pass(FaultCause::ThreadLost),
            }
        }
        let is_kept = self.requests.holds(false) || self.requests.is_stopping();
        if is_kept || self.supply.is_short() {
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

    /// Sets out with the spindle, if there is a stop to keep in reserve.
    fn set_out(&mut self, follow: &Follow) -> bool {
        self.track.pass_gate();
        if self.track.barrier().is_some_and(|at| at <= follow.start) {
            self.track.unbar();
        }
        let situation = Situation {
            track: &self.track,
            published: self.output.published(),
            allowed: self.output.allowed(),
            reach: self.supply.reach(),
            is_fully_supplied: self.supply.is_fully_supplied(),
            block_end: None,
        };
        let time = ProgramTime::at(follow.start).after(follow.elapsed);
        let sets_out = self.rate.set_out_at(time, follow.step, &situation);
        if !sets_out {
            self.track.take_gate_back(self.rate.now().time.sequence);
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
            reach: self.supply.reach(),
            is_fully_supplied: self.supply.is_fully_supplied(),
            block_end: None,
        };
        let most = self.rate.most_change(&situation);
        let back = (TAKEN_BACK * off.abs()).min((COUNTED_ON * most * off.abs()).sqrt());
        let wanted = (follow.step + back.copysign(off)).clamp(0.0, MOST_RATE);
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
}
