//! The machine as a sender sees it: its state, and what it has to be told of changes.

use std::time::Duration;

use super::{Latch, Session};
use crate::jogging::Jogged;
use crate::state::State;
use crate::{Act, Alarm, Doing, MachineView};

/// How long a sender that asks for reports may be silent while it jogs.
const JOG_SILENCE: Duration = Duration::from_secs(1);
/// Reports after which a sender is one that asks for them.
const ASKS: u32 = 3;

impl Session {
    /// What the machine does, as senders know it.
    pub(super) fn state(&self) -> State {
        if self.is_asleep {
            return State::Sleep;
        }
        if self.is_locked() {
            return State::Alarm;
        }
        let doing = self.machine.doing;
        if doing == Doing::Homing {
            return State::Home;
        }
        if self.is_checking {
            return State::Check;
        }
        if self.jogging.is_active() || doing == Doing::Jogging {
            return State::Jog;
        }
        let is_at_rest = !doing.is_moving() && doing != Doing::Preparing;
        match self.latch {
            Latch::Hold => return State::Hold { is_at_rest },
            Latch::Door => return State::Door { is_at_rest },
            Latch::Free => {}
        }
        match doing {
            Doing::Holding => State::Hold { is_at_rest: false },
            Doing::Held | Doing::ProgramStop | Doing::AwaitingTool => {
                State::Hold { is_at_rest: true }
            }
            // What was read last may not have begun.
            Doing::Idle | Doing::NotHomed if !self.has_lines() => State::Idle,
            // A motion begins with a setpoint at rest, and lines that were read are planned a moment later.
            Doing::Waiting if !self.stream.has_unread() && self.ahead_t <= 0.0 => State::Idle,
            _ => State::Run,
        }
    }

    /// Nothing is executed before it is unlocked.
    pub(super) fn is_locked(&self) -> bool {
        let is_fit = match self.machine.doing {
            Doing::Unknown | Doing::Off | Doing::Faulted => false,
            Doing::NotHomed => self.is_unlocked,
            _ => true,
        };
        self.alarm.is_some() || !is_fit
    }

    /// What senders have to know of what has changed.
    pub(super) fn tell_of_changes(&mut self, before: &MachineView) {
        let (was, is) = (before.doing, self.machine.doing);
        if !self.machine.message.is_empty() && self.machine.message != before.message {
            let message = self.machine.message.clone();
            self.message(&message);
        }
        if matches!(is, Doing::Idle | Doing::Running) {
            self.is_unlocked = false;
        }
        let is_lost = matches!(is, Doing::Faulted | Doing::Off | Doing::Unknown) && was != is;
        let was_fit = !matches!(was, Doing::Faulted | Doing::Off | Doing::Unknown);
        if is_lost && (was_fit || is == Doing::Faulted) && !self.is_asleep {
            let (alarm, why) = self.machine.fault.clone().unwrap_or_else(|| {
                let why = "the machine has no power, or its interpolator is gone";
                (Alarm::Stopped, why.to_owned())
            });
            self.jogging.forget();
            self.say(&format!("ALARM:{}", alarm.number()));
            self.message(&why);
        }
    }

    pub(super) fn look_at_jogs(&mut self, now: Duration) {
        let asks = self.reports >= ASKS;
        let is_silent = now.saturating_sub(self.heard_at) >= JOG_SILENCE;
        if asks && is_silent && self.jogging.is_active() && self.jogging.has_room() {
            self.message("The sender is silent: the jog ends");
            self.cancel_jogs();
        }
        let look = (self.machine.doing, &self.machine.position);
        let jogged = self.jogging.look(look, now, &mut self.acts);
        if jogged == Jogged::NotDone {
            self.message("The jog ended before its end");
        }
    }

    pub(super) fn cancel_jogs(&mut self) -> bool {
        let was_active = self.jogging.cancel();
        if was_active {
            // What was not handed over does not begin.
            self.acts.retain(|act| !matches!(act, Act::Jog { .. }));
            self.acts.push(Act::LetGo);
        }
        was_active
    }
}
