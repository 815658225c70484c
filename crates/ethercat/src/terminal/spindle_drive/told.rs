//! What is told of a spindle on a drive: its speed, and whether it is what it is to be.

use super::super::gearbox::Gearbox;
use super::{Phase, SETTLED_NS, SpindleDrive};
use glidepath_link::{Feedback, SpindleFlags};

impl SpindleDrive {
    /// Since when it turns as fast as it is to, or stands.
    pub(super) fn judge_speed(&mut self, now_ns: u64, is_reachable: bool) {
        let near_rpm = if self.wanted_rpm == 0.0 {
            self.settings().still_rpm()
        } else {
            self.settings().near_rpm(self.wanted_rpm)
        };
        let is_led = (self.told_rpm - self.wanted_rpm).abs() <= 0.0 && is_reachable;
        let is_near = match self.phase {
            Phase::Orienting(_) => self.is_at_angle(),
            _ => (self.actual_rpm - self.wanted_rpm).abs() <= near_rpm,
        };
        if is_led && is_near && self.is_present {
            self.near_ns.get_or_insert(now_ns);
        } else {
            self.near_ns = None;
        }
    }

    /// Whether it is near to that for a while.
    pub(super) fn has_settled(&self) -> bool {
        let near_ns = self.near_ns;
        near_ns.is_some_and(|since| self.last_ns >= since + SETTLED_NS)
    }

    /// Adds what is known of it.
    pub(in super::super) fn tell(&self, feedback: &mut Feedback) {
        if !self.is_present {
            feedback.spindle_flags |= SpindleFlags::FAULT.0;
            return;
        }
        feedback.spindle_v = self.actual_rpm / 60.0;
        feedback.spindle_load = self.load_r;
        let is_settled = self.has_settled() && !self.is_due;
        let stands = self.wanted_rpm == 0.0;
        let mut set = |flag: SpindleFlags, is: bool| {
            feedback.spindle_flags |= if is { flag.0 } else { 0 };
        };
        set(SpindleFlags::SPEED, true);
        set(SpindleFlags::LOAD, self.settings().tells_load);
        set(
            SpindleFlags::AT_SPEED,
            is_settled && !stands && self.phase == Phase::Turning,
        );
        set(SpindleFlags::STOPPED, is_settled && stands);
        let is_held = matches!(self.phase, Phase::Orienting(Some(_)));
        set(
            SpindleFlags::ORIENTED,
            is_settled && is_held && self.angle.is_some(),
        );
        let is_in_gear = self.gearbox.as_ref().is_some_and(Gearbox::is_in);
        set(SpindleFlags::IN_GEAR, is_in_gear && !self.is_due);
        set(SpindleFlags::FAULT, self.failed.is_some());
    }
}
