//! What lines, and resets, wait for.

use std::time::Duration;

use super::awaited::{Reset, Waiting};
use super::{Latch, Session};
use crate::error::ErrorNumber;
use crate::{Act, Alarm, Doing};

/// How long drives may take to have power.
const POWER_PATIENCE: Duration = Duration::from_secs(3);
/// How long a search for home may take to begin.
const HOMING_PATIENCE: Duration = Duration::from_secs(1);
/// How long the machine may take to come to rest.
const REST_PATIENCE: Duration = Duration::from_secs(10);
/// Why a search for home has found none that its sender has ended.
const ENDED: &str = "the search for home was ended: begin it again";

impl Session {
    /// Ends all that goes on. What came before is not answered; what comes behind waits until the machine
    /// rests.
    pub(super) fn begin_reset(&mut self, has_welcome: bool, now: Duration) {
        self.lines.clear();
        self.given = 0;
        self.intake.drop_open_line();
        self.cancel_jogs();
        self.stream.cancel();
        let is_off = matches!(
            self.machine.doing,
            Doing::Off | Doing::Faulted | Doing::Unknown
        );
        if self.looks_for_home() {
            self.end_home();
        } else if !is_off {
            // At rest, too: it stops spindle and coolant.
            self.abort();
        }
        (self.waiting, self.latch) = (Waiting::Nothing, Latch::Free);
        self.is_checking = false;
        self.overrides.reset(now, &mut self.acts);
        let has_welcome = has_welcome || self.reset.is_some_and(|reset| reset.has_welcome);
        self.reset = Some(Reset {
            since: now,
            has_welcome,
            resets_modes: false,
        });
        self.look_at_reset(now);
    }

    /// Looks whether the machine has heard of it and rests, and whether modes and offsets are reset then.
    pub(super) fn look_at_reset(&mut self, now: Duration) {
        let Some(reset) = &mut self.reset else {
            return;
        };
        let is_late = now.saturating_sub(reset.since) >= REST_PATIENCE;
        let rests = self.aborts == 0
            && self.machine.doing.is_free()
            && !self.stream.is_open()
            && !self.jogging.is_active();
        if !rests && !is_late {
            return;
        }
        if rests && reset.has_welcome && !is_late {
            if !core::mem::replace(&mut reset.resets_modes, true) {
                self.stream.reset();
            }
            if self.stream.is_resetting() {
                return;
            }
        }
        let reset = *reset;
        self.reset = None;
        self.ask_anew();
        if core::mem::take(&mut self.is_asleep) {
            self.alarm = Some(Alarm::Stopped);
        }
        if !rests {
            self.alarm = Some(Alarm::Stopped);
            self.message("the machine does not come to rest");
        }
        if reset.has_welcome {
            self.welcome();
        }
    }

    /// Looks whether what the oldest line waits for has come.
    pub(super) fn look_at_waiting(&mut self, now: Duration) {
        let doing = self.machine.doing;
        match self.waiting {
            Waiting::Nothing | Waiting::Judgement => {}
            Waiting::Unlocking { since } => {
                let is_off = matches!(doing, Doing::Off | Doing::Faulted | Doing::Unknown);
                if !is_off {
                    self.waiting = Waiting::Nothing;
                    self.answer_ok();
                } else if now.saturating_sub(since) >= POWER_PATIENCE {
                    self.waiting = Waiting::Nothing;
                    let why = self.machine.fault.clone().map(|(_, why)| why);
                    let why = why.unwrap_or_else(|| "the drives did not get power".to_owned());
                    self.message(&why);
                    self.answer_ok();
                }
            }
            Waiting::Home {
                since,
                has_begun,
                is_ended,
            } => {
                let is_homing = doing == Doing::Homing;
                if is_homing && !has_begun {
                    self.waiting = Waiting::Home {
                        since,
                        has_begun: true,
                        is_ended,
                    };
                }
                let is_late = now.saturating_sub(since) >= HOMING_PATIENCE;
                if is_homing || !(has_begun || is_late) {
                    return;
                }
                self.waiting = Waiting::Nothing;
                match doing {
                    Doing::Idle => {
                        self.alarm = None;
                        self.answer_ok();
                    }
                    _ if is_ended => self.fail_home(Alarm::HomingEnded, ENDED),
                    // Some joints are at home, and others have not been asked to be.
                    Doing::NotHomed if has_begun => {
                        self.is_unlocked = true;
                        self.answer_ok();
                    }
                    _ => {
                        let why = self.machine.fault.clone().map(|(_, why)| why);
                        let why = why.unwrap_or_else(|| "no home was found".to_owned());
                        self.fail_home(Alarm::Homing, &why);
                    }
                }
            }
        }
    }

    fn fail_home(&mut self, alarm: Alarm, why: &str) {
        self.alarm = Some(alarm);
        self.say(&format!("ALARM:{}", alarm.number()));
        self.answer_error(ErrorNumber::LOCKED, why);
    }

    /// Whether a search for home is under way, or asked for.
    pub(super) fn looks_for_home(&self) -> bool {
        matches!(self.waiting, Waiting::Home { .. }) || self.machine.doing == Doing::Homing
    }

    /// Ends a search for home, also one that was asked for just now.
    pub(super) fn end_home(&mut self) {
        self.acts.retain(|act| !matches!(act, Act::Home(_)));
        self.abort();
        if let Waiting::Home { is_ended, .. } = &mut self.waiting {
            *is_ended = true;
        }
    }
}
