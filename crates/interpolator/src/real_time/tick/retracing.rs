//! The part of a tick while the motion goes back along the path, or onward again.

use super::state::Interpolator;
use crate::real_time::frame_summary::FrameSummary;
use crate::real_time::retrace::mirrored;
use crate::real_time::single_block_stop::SingleBlockStop;
use crate::real_time::stop_requests::Heading;
use glidepath_link::Setpoint;

impl Interpolator<'_> {
    /// Turns if that is wanted, and takes frames that are kept. Returns whether those of the planner
    /// may be taken, too.
    #[cold]
    #[inline(never)]
    pub(super) fn take_kept_frames(&mut self) -> bool {
        if !self.is_open() {
            return true;
        }
        if self.requests.is_to_turn() && self.may_turn() {
            self.turn();
        }
        match self.requests.heading() {
            Heading::Onward => true,
            Heading::OnwardAgain => {
                if self.retrace.go_onward(&mut self.track) {
                    self.requests.go(Heading::Onward);
                }
                false
            }
            Heading::Back => {
                let is_all = self.retrace.go_back(&mut self.track);
                let ahead = self.track.end() - self.rate.now().time.sequence;
                if is_all && self.is_standing() && (ahead <= 1 || self.queue_level.is_at_end()) {
                    self.end_way_back();
                }
                false
            }
            Heading::BackAtEnd => false,
        }
    }

    /// Whether the motion may turn: it stands, and nothing but the program moves the axes, or is
    /// waited for.
    fn may_turn(&self) -> bool {
        let is_free = !self.jog.owns_axes() && !self.wait.is_standing() && !self.pass.is_in_use();
        let probes = self.probing.is_looking() || self.probing.is_tripped();
        is_free && !probes && !self.requests.is_stopping() && self.is_standing()
    }

    fn turn(&mut self) {
        let now = self.rate.now().time;
        let (track, heading) = (&mut self.track, self.requests.heading());
        let (time, heading) = if heading.is_back() {
            let time = self.retrace.turn_onward(track, now);
            (Some(time), Heading::OnwardAgain)
        } else {
            let is_again = heading == Heading::OnwardAgain;
            (self.retrace.turn_back(track, now, is_again), Heading::Back)
        };
        let Some(time) = time else {
            if self.requests.refuse_to_turn() {
                self.statistics.end_way_back(self.passed.line);
            }
            return;
        };
        self.rate.begin_at(time);
        self.single_block_stop = SingleBlockStop::none();
        self.track.hold_at_block_end(None);
        self.queue_level.begin_epoch();
        self.requests.turn(heading);
    }

    /// There is no way back beyond where the motion stands.
    fn end_way_back(&mut self) {
        self.requests.go(Heading::BackAtEnd);
        self.statistics.end_way_back(self.passed.line);
    }

    /// The epoch ends while the motion goes back.
    #[cold]
    #[inline(never)]
    pub(super) fn leave_way_back(&mut self) {
        let now = self.rate.now().time;
        if let Some(frame) = self.retrace.frame_at(now) {
            self.passed = FrameSummary::of(frame);
        }
        if let Some(path) = self.track.path(now) {
            self.passed.path_s = path.path_s;
        }
        self.retrace.leave(&mut self.track);
        self.rate.rest_at(mirrored(now), 0.0);
    }

    /// Corrects in a setpoint where in the program the motion is, if it goes back.
    #[cold]
    #[inline(never)]
    pub(super) fn place_retraced(&self, setpoint: &mut Setpoint) {
        let now = self.rate.now().time;
        if self.requests.heading().is_back()
            && let Some(frame) = self.retrace.frame_at(now)
        {
            setpoint.sequence = frame.sequence;
            (setpoint.line, setpoint.block) = (frame.line, frame.block);
            setpoint.flags = frame.flags;
            setpoint.fraction = mirrored(now).fraction;
        }
    }
}
