//! What is driven next: from meeting to meeting the faster way.

use super::meeting::Meeting;
use super::state::{LATE, PATH, Race, TUBE};
use crate::stretches::joint::{Joint, SEAM, signed};
use crate::stretches::runner::Runner;
use std::ops::Range;

/// Motion by which both ways are looked at further at once, s.
pub(super) const STEP_T: f64 = 0.2;
/// Motion that is looked at before something is driven of it, s: who sends moves through a pipe
/// waits for the motion as long.
const MOST_T: f64 = 0.75;
/// Periods that must be gained in one section by leaving the tube, and by going back to it: mostly the
/// tube is ahead again a corner later, and what it gains in a section is far less than a period.
const WORTH: [i64; 2] = [8, 0];
/// Time between the places at which a joint is tried to begin, s.
const TRIED_T: f64 = 0.024;

/// What is to be driven in a section.
enum Choice {
    Stay,
    Leave,
    /// What follows may tell.
    Wait,
}

impl Race {
    /// Decides what is driven next. False if the program is not known far enough.
    pub(super) fn look(&mut self) -> bool {
        if self.is_decided {
            return self.go_on_alone();
        }
        let most = self.periods(MOST_T);
        let count = (self.looked + self.periods(STEP_T)).min(most);
        for way in [TUBE, PATH] {
            let end = self.begins[way] + count;
            if !self.ways[way].plan_to(end, &self.program, &self.log) {
                return way == PATH && self.is_path_late(count) && self.pass_unmet(count);
            }
        }
        if self.ways.iter().any(|way| way.failure().is_some()) {
            self.give_up();
        } else if self.meet(count, count == most) {
            self.looked = 0;
        } else if self.ways.iter().all(Runner::is_over) {
            self.end();
        } else if count < most {
            self.looked = count;
        } else {
            return self.pass_unmet(count);
        }
        true
    }

    /// The way that is left: more of it.
    fn go_on_alone(&mut self) -> bool {
        let driven = &mut self.ways[self.on];
        let is_known = driven.plan_to(driven.first() + 1, &self.program, &self.log);
        self.release = driven.end();
        is_known
    }

    /// One way leads nowhere.
    fn give_up(&mut self) {
        self.is_decided = true;
        if self.ways[self.on].failure().is_some()
            && let Some(leave) = self.leave.take()
        {
            self.cross(leave);
        }
        self.release = self.ways[self.on].end();
    }

    /// Looks for a meeting among so many frames of the section. True if there is one up to which it
    /// is known what to drive; if no more frames are looked at, the tube is left where it would be
    /// too late at every one.
    fn meet(&mut self, count: usize, is_last: bool) -> bool {
        let known = [TUBE, PATH].map(|way| {
            let begin = self.begins[way];
            begin + SEAM..(begin + count).min(self.ways[way].end())
        });
        let mut waiting = None;
        for from in known[TUBE].clone().step_by(self.periods(TRIED_T)) {
            let Some(meeting) = self.meeting([TUBE, PATH], from, &known) else {
                continue;
            };
            match self.choose(&meeting) {
                Choice::Wait => waiting = waiting.or(Some(meeting)),
                choice => {
                    self.go_to(meeting, &choice, &known);
                    return true;
                }
            }
        }
        if let Some(meeting) = waiting.filter(|_| is_last) {
            self.go_to(meeting, &Choice::Leave, &known);
            return true;
        }
        false
    }

    /// What to drive up to a meeting at which the tube can be left.
    fn choose(&self, meeting: &Meeting) -> Choice {
        let back = meeting.joint.shift();
        let leave = self.leave.as_ref().map(Joint::shift);
        #[expect(clippy::cast_precision_loss, reason = "exact for any stretch")]
        let passed = |way: usize, shift: i64| meeting.passed_by(way) + shift as f64;
        #[expect(clippy::cast_precision_loss, reason = "a few")]
        let worth = WORTH[self.on] as f64;
        let here = passed(self.on, self.shift);
        let there = leave.map(|leave| passed(1 - self.on, self.shift + leave));
        let gains = there.is_some_and(|there| there + worth <= here);
        if self.on == TUBE {
            match leave {
                Some(_) if gains => Choice::Leave,
                Some(_) if back + self.shift > self.late => Choice::Wait,
                _ => Choice::Stay,
            }
        } else {
            let late = leave.map_or(i64::MAX, |leave| back + leave + self.shift);
            if gains && late <= LATE.max(self.shift) {
                Choice::Leave
            } else {
                Choice::Stay
            }
        }
    }

    /// Gives out the way that is chosen up to where it can be left at a meeting.
    fn go_to(&mut self, meeting: Meeting, choice: &Choice, known: &[Range<usize>; 2]) {
        if matches!(choice, Choice::Leave)
            && let Some(leave) = self.leave.take()
        {
            self.cross(leave);
        }
        let Meeting { passed, joint } = meeting;
        if self.on == TUBE {
            self.late = LATE.max(joint.shift() + self.shift);
            self.begin_section([joint.from + 1, joint.to], Some(joint));
            return;
        }
        self.late = LATE.max(self.shift);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the number of a frame"
        )]
        let passed = passed as usize;
        let back = (self.begins[PATH] < passed.saturating_sub(SEAM))
            .then(|| self.meeting([PATH, TUBE], passed, known))
            .flatten();
        match back {
            Some(Meeting { joint, .. }) => {
                self.begin_section([joint.to, joint.from + 1], Some(joint));
            }
            None => self.begin_section([joint.from + 1, passed + 1], None),
        }
    }

    pub(super) fn begin_section(&mut self, begins: [usize; 2], leave: Option<Joint>) {
        self.ways[1 - self.on].pass_to(begins[1 - self.on]);
        self.release = begins[self.on];
        self.begins = begins;
        self.leave = leave;
        self.looked = 0;
    }

    /// Leaves the way that is driven, whose frames before the joint have been given out.
    pub(super) fn cross(&mut self, mut joint: Joint) {
        for frame in &mut joint.frames {
            frame.path_s += self.shift_s;
        }
        self.shift += joint.shift();
        self.shift_s += joint.shift_s;
        self.on = 1 - self.on;
        self.ways[self.on].pass_to(joint.to);
        self.joint = joint.frames.into();
    }

    /// Both ways are known to the end of the stretch: the faster one is driven there.
    fn end(&mut self) {
        self.is_decided = true;
        let (on, other) = (self.on, 1 - self.on);
        let here = signed(self.ways[on].end()) + self.shift;
        if let Some(leave) = self.leave.take() {
            let there = signed(self.ways[other].end()) + self.shift + leave.shift();
            let is_late = on == TUBE && here > signed(self.ways[PATH].end()) + self.late;
            if there + WORTH[on] <= here || (is_late && there < here) {
                self.cross(leave);
            }
        }
        self.release = self.ways[self.on].end();
    }
}
