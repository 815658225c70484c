//! Lines that begin with `$`.

use std::time::Duration;

use super::Session;
use super::awaited::Waiting;
use crate::error::ErrorNumber;
use crate::jog::JogLine;
use crate::line::Wanted;
use crate::numbers::Units;
use crate::state::State;
use crate::{Act, Doing, LETTERS};

/// How near to the end of travel a place is that is inside, mm or degrees.
const INSIDE_MM: f64 = 1e-6;
/// The largest `$10`: grblHAL has bits above those of grbl, which mean nothing here.
const MOST_MASK: f64 = 65_535.0;

impl Session {
    /// Does what the oldest line wants. Returns whether it was answered.
    pub(super) fn process_statement(&mut self, wanted: Wanted, now: Duration) -> bool {
        let state = self.state();
        if state == State::Run && wanted.is_for_rest() && self.is_settling() {
            // The lines before it may have moved nothing.
            self.stream.close();
            return false;
        }
        let is_quiet = matches!(state, State::Idle | State::Alarm | State::Check);
        match wanted {
            Wanted::Nothing | Wanted::Code => return false,
            Wanted::Refused(number, why) => self.answer_error(number, why),
            Wanted::Help
            | Wanted::Settings
            | Wanted::Parameters
            | Wanted::Modes
            | Wanted::BuildInfo
            | Wanted::StartupLines => {
                self.tell(&wanted);
                self.answer_ok();
            }
            Wanted::Set(number, value) if is_quiet => self.set(number, value),
            Wanted::Unlock => return self.unlock(now),
            Wanted::Check if matches!(state, State::Idle | State::Check) => self.check(),
            Wanted::Sleep if is_quiet => return self.sleep(),
            Wanted::Home(axis) if matches!(state, State::Idle | State::Alarm) => {
                return self.home(axis, now);
            }
            Wanted::Jog(text) if matches!(state, State::Idle | State::Jog) => {
                return self.jog(&text);
            }
            Wanted::Set(..) | Wanted::Check | Wanted::Sleep | Wanted::Home(_) | Wanted::Jog(_) => {
                let why = format!("not while the machine shows {state}");
                self.answer_error(ErrorNumber::NOT_IDLE, &why);
            }
        }
        true
    }

    /// `$10` and `$13` are of the connection; everything else is of the machine.
    fn set(&mut self, number: u32, value: f64) {
        match number {
            10 if (0.0..=MOST_MASK).contains(&value) => {
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "between 0 and 65535"
                )]
                let mask = value as u32;
                self.mask = mask;
                self.answer_ok();
            }
            13 => {
                self.units = if value.abs() < 0.5 {
                    Units::Millimetre
                } else {
                    Units::Inch
                };
                self.reporter.begin_anew();
                self.answer_ok();
            }
            // Senders write settings back that they have read.
            _ if self.is_setting(number, value) => self.answer_ok(),
            _ => {
                let why = "the configuration of the machine sets it, and no sender does";
                self.answer_error(ErrorNumber::STATEMENT, why);
            }
        }
    }

    /// Whether a setting has that value.
    fn is_setting(&self, number: u32, value: f64) -> bool {
        let lines = self.settings.lines(self.mask, self.units == Units::Inch);
        let name = format!("${number}=");
        let mut values = lines.iter().filter_map(|line| line.strip_prefix(&name));
        let is_it = |told: f64| (told - value).abs() < 5e-4;
        values.any(|told| told.parse().is_ok_and(is_it))
    }

    fn unlock(&mut self, now: Duration) -> bool {
        let was_alarm = self.state() == State::Alarm;
        self.alarm = None;
        if !was_alarm {
            self.answer_ok();
            return true;
        }
        self.message("Caution: Unlocked");
        self.is_unlocked = true;
        match self.machine.doing {
            Doing::Faulted => self.acts.extend([Act::Reset, Act::Enable]),
            Doing::Off => self.acts.push(Act::Enable),
            _ => {
                self.answer_ok();
                return true;
            }
        }
        self.waiting = Waiting::Unlocking { since: now };
        false
    }

    fn check(&mut self) {
        if self.is_checking {
            self.is_checking = false;
            self.message("Disabled");
            self.answer_ok();
            self.welcome();
        } else {
            self.is_checking = true;
            self.message("Enabled");
            self.answer_ok();
        }
    }

    fn sleep(&mut self) -> bool {
        if self.ends_stream() {
            return false;
        }
        self.is_asleep = true;
        self.acts.push(Act::Disable);
        self.message("Sleeping");
        self.answer_ok();
        true
    }

    fn home(&mut self, axis: Option<usize>, now: Duration) -> bool {
        if !self.settings.has_homing {
            let why = "no joint of this machine has a way to find its home";
            self.answer_error(ErrorNumber::NO_HOMING, why);
            return true;
        }
        if self.ends_stream() {
            return false;
        }
        if self.machine.doing == Doing::Faulted {
            self.acts.push(Act::Reset);
        }
        if matches!(self.machine.doing, Doing::Off | Doing::Faulted) {
            let why = "the drives have no power: $X gives it to them";
            self.answer_error(ErrorNumber::LOCKED, why);
            return true;
        }
        self.acts.push(Act::Home(axis));
        self.waiting = Waiting::Home {
            since: now,
            has_begun: false,
            is_ended: false,
        };
        false
    }

    fn jog(&mut self, text: &str) -> bool {
        let jog = match JogLine::read(text, &self.facts.modes) {
            Ok(jog) => jog,
            Err((number, why)) => {
                self.answer_error(number, why);
                return true;
            }
        };
        if !self.jogging.has_room() || self.ends_stream() {
            return false;
        }
        let from = self.jogging.end(&self.machine.position);
        let target = jog.target(&from, &self.machine.zero);
        if let Some(why) = self.beyond(&from, &target) {
            self.answer_error(ErrorNumber::JOG_TRAVEL, &why);
            return true;
        }
        self.jogging.add(&from, &target, jog.feed_v);
        self.answer_ok();
        true
    }

    /// Which axis a jog would take beyond its travel.
    fn beyond(&self, from: &[f64; crate::AXES], target: &[f64; crate::AXES]) -> Option<String> {
        let letters = LETTERS.iter().enumerate();
        let axes = letters.zip(from.iter().zip(target));
        let moved = axes.filter(|(_, (from, target))| from.total_cmp(target).is_ne());
        moved
            .map(|((axis, letter), (from, target))| {
                if !self.settings.axes.contains(&axis) {
                    return Some(format!("the machine has no axis {letter}"));
                }
                // One that does not know where it is knows no travel either.
                let is_known = self.machine.doing != Doing::NotHomed;
                let (least, most) = (self.settings.least(axis), self.settings.most(axis));
                // One that stands outside may come inwards.
                let reach = (least.min(*from) - INSIDE_MM)..=(most.max(*from) + INSIDE_MM);
                let is_inside = reach.contains(target);
                (is_known && !is_inside).then(|| {
                    format!("{letter}{target:.3} is beyond the travel of {least} to {most}")
                })
            })
            .find_map(|why| why)
    }

    /// Whether nothing moves, and lines that were read may have nothing move.
    fn is_settling(&self) -> bool {
        let doing = self.machine.doing;
        let rests = matches!(doing, Doing::Idle | Doing::Preparing | Doing::Waiting);
        rests && !self.stream.has_unread()
    }

    /// Ends a job that only waits for more lines. Returns whether there was one.
    fn ends_stream(&mut self) -> bool {
        self.stream.close();
        self.stream.is_open()
    }
}
