//! What real-time characters do.

use std::time::Duration;

use super::{Latch, Session};
use crate::line::{Wanted, wanted};
use crate::real_time::RealTime;
use crate::state::State;
use crate::{Act, Doing};

impl Session {
    pub(super) fn take_real_time(&mut self, real_time: RealTime, now: Duration) {
        match real_time {
            RealTime::Report | RealTime::FullReport => {
                self.reports = self.reports.saturating_add(1);
                self.say_report(real_time == RealTime::FullReport);
            }
            RealTime::Hold => self.hold(Latch::Hold),
            RealTime::Door => {
                self.hold(Latch::Door);
                self.message("Check Door");
            }
            RealTime::Resume | RealTime::ToolChanged => self.resume(),
            RealTime::Reset => self.begin_reset(true, now),
            RealTime::Stop => self.begin_reset(false, now),
            RealTime::JogCancel => self.cancel_jogs_and_lines(),
            RealTime::Feed(change) => self.overrides.change_feed(change, now, &mut self.acts),
            RealTime::Rapid(percent) => self.overrides.set_rapid(percent, now, &mut self.acts),
            RealTime::Spindle(change) => {
                let range = self.settings.spindle_override;
                self.overrides
                    .change_spindle(change, range, now, &mut self.acts);
            }
            RealTime::NotByHand => self.tell_of_spindle(),
            RealTime::Modes => {
                let modes = format!("[GC:{}]", self.modes());
                self.say(&modes);
            }
            RealTime::SingleBlock => self.acts.push(Act::ToggleSingleBlock),
        }
    }

    fn tell_of_spindle(&mut self) {
        if !core::mem::replace(&mut self.spindle_was_told, true) {
            self.message("Spindle and coolant follow the lines: they are not switched by hand");
        }
    }

    fn hold(&mut self, latch: Latch) {
        if self.looks_for_home() {
            // Joints between their switches have no path to be held on. Who wants them to stand is obeyed.
            self.message("A search for home cannot be held: it ends");
            self.end_home();
            return;
        }
        match self.state() {
            State::Alarm | State::Sleep | State::Check | State::Home => {}
            State::Jog => {
                self.cancel_jogs_and_lines();
            }
            _ => {
                if !self.machine.doing.is_free() || self.stream.is_open() {
                    self.acts.push(Act::Hold);
                }
                self.latch = latch;
                // CNCjs sends its reset only if it is shown a hold within half a second, and asks every quarter.
                self.say_report(false);
            }
        }
    }

    /// Goes on, if it is at rest.
    fn resume(&mut self) {
        if !self.state().is_held() {
            return;
        }
        match self.machine.doing {
            Doing::Held | Doing::ProgramStop | Doing::Waiting if self.machine.is_away => {
                self.message("The machine goes back to its path first: resume once more then");
                self.acts.push(Act::Return);
                return;
            }
            Doing::Held | Doing::ProgramStop => self.acts.push(Act::Resume),
            Doing::AwaitingTool | Doing::Awaiting if self.latch == Latch::Free => {
                self.acts.push(Act::Acknowledge);
            }
            _ => {}
        }
        self.latch = Latch::Free;
        self.ask_anew();
    }

    /// Ends jogs. Those that have come and have not begun are answered, and not done.
    fn cancel_jogs_and_lines(&mut self) {
        if self.cancel_jogs() {
            while self.given == 0
                && let Some(line) = self.lines.front()
                && matches!(wanted(&line.text), Wanted::Jog(_))
            {
                self.answer_ok();
            }
        }
    }
}
