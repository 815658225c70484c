//! Where no joint is found for long: the way that is driven goes on as it is.

use super::deciding::STEP_T;
use super::state::{PATH, Race, TUBE};
use crate::stretches::joint::signed;
use crate::stretches::runner::Runner;

/// Moves that are waited for, s at their rates, so that the way along the path is known as far as the
/// tube: it is settled late along dense chords.
const MOST_AHEAD_T: f64 = 1.0;

impl Race {
    /// True if the tube is driven, so many frames of it are known, and the way along the path is not,
    /// though much more of the program is.
    pub(super) fn is_path_late(&self, count: usize) -> bool {
        let tube = &self.ways[TUBE];
        let last = tube.frame((self.begins[TUBE] + count).min(tube.end()) - 1);
        let known_t = last.map(|frame| self.program.known_t(frame.block));
        self.on == TUBE && known_t > Some(MOST_AHEAD_T)
    }

    /// Goes on where no joint is found in so many frames. False if the program is not known far
    /// enough.
    pub(super) fn pass_unmet(&mut self, count: usize) -> bool {
        let on = if self.leave.is_some() && self.on == TUBE && self.is_behind(count) {
            PATH
        } else {
            self.on
        };
        let (driven, other) = (&self.ways[on], 1 - on);
        if on == self.on && driven.is_over() {
            // The other way is far behind.
            self.is_decided = true;
            self.release = driven.end();
            return true;
        }
        let end = (self.begins[on] + count).min(driven.end());
        let block = driven.frame(end - 1).map_or(0, |frame| frame.block);
        let is_there = |runner: &Runner| {
            let last = runner
                .end()
                .checked_sub(1)
                .and_then(|last| runner.frame(last));
            runner.is_over() || last.is_some_and(|frame| frame.block >= block)
        };
        while !is_there(&self.ways[other]) {
            let further = self.ways[other].end() + self.periods(STEP_T);
            if !self.ways[other].plan_to(further, &self.program, &self.log) {
                if other == PATH && self.is_path_late(count) {
                    break;
                }
                return false;
            }
        }
        if on != self.on
            && let Some(leave) = self.leave.take()
        {
            self.cross(leave);
        }
        let of_other = self.begins[other]..self.ways[other].end();
        let is_past = |&number: &usize| {
            let frame = self.ways[other].frame(number);
            frame.is_some_and(|frame| frame.block >= block)
        };
        let mut begins = [end; 2];
        begins[other] = of_other.clone().find(is_past).unwrap_or(of_other.end);
        self.begin_section(begins, None);
        true
    }

    /// True if the way along the path, taken up where the section begins, is further in the program
    /// than the tube by the time that so many frames of that are driven.
    fn is_behind(&self, count: usize) -> bool {
        let Some(leave) = &self.leave else {
            return false;
        };
        let [tube, path] = &self.ways;
        let last = (self.begins[TUBE] + count).min(tube.end()) - 1;
        let there = usize::try_from(signed(last) - leave.shift()).unwrap_or(0);
        let there = there.min(path.end() - 1);
        match (tube.place(last), path.place(there)) {
            (Some(tube), Some(path)) => path.at_s > tube.at_s,
            _ => match (tube.frame(last), path.frame(there)) {
                (Some(tube), Some(path)) => path.block > tube.block,
                _ => false,
            },
        }
    }
}
