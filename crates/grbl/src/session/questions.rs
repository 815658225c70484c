//! What senders ask: settings, parameters, modes, version.

use super::awaited::Waiting;
use super::{MOST_UNSENT, Session};
use crate::line::{Wanted, wanted};
use crate::numbers::Units;
use crate::report::BLOCKS;
use crate::state::State;
use crate::{Doing, Spindle};

impl Session {
    /// Tells what questions ask that wait behind lines which wait for somebody: a hold, M0, a tool, a search for home.
    /// Their `ok` comes in its order.
    pub(super) fn tell_questions(&mut self) {
        let is_held = matches!(self.state(), State::Hold { .. } | State::Door { .. });
        if !is_held && !matches!(self.waiting, Waiting::Home { .. }) {
            return;
        }
        for index in 0..self.lines.len() {
            if self.out.len() >= MOST_UNSENT {
                return;
            }
            let Some(line) = self.lines.get_mut(index).filter(|line| !line.is_told) else {
                continue;
            };
            let wanted = wanted(&line.text);
            line.is_told = wanted.is_question();
            self.tell(&wanted);
        }
    }

    /// The answer to a question, without its `ok`.
    pub(super) fn tell(&mut self, wanted: &Wanted) {
        let lines = match wanted {
            Wanted::Modes => vec![format!("[GC:{}]", self.modes())],
            Wanted::Help => {
                vec!["[HLP:$$ $# $G $I $N $x=val $J=line $SLP $C $X $H ~ ! ? ctrl-x]".to_owned()]
            }
            Wanted::BuildInfo => vec![
                format!("[VER:1.1h.20190825:Glidepath {}]", self.settings.version),
                format!("[OPT:VNMHZ,{BLOCKS},{}]", self.settings.rx_bytes),
            ],
            Wanted::StartupLines => vec!["$N0=".to_owned(), "$N1=".to_owned()],
            Wanted::Parameters => self.facts.lines(self.units, &self.settings.axes),
            Wanted::Settings => {
                let is_inch = self.units == Units::Inch;
                self.settings.lines(self.mask, is_inch)
            }
            _ => return,
        };
        for line in &lines {
            self.say(line);
        }
    }

    /// The modes in force. Where nothing is executed, spindle and coolant are what the machine says: an abort, a fault or
    /// somebody else may have stopped them since.
    pub(super) fn modes(&self) -> String {
        if self.stream.is_open() || self.machine.doing == Doing::Unknown {
            return self.facts.modes.clone();
        }
        let spindle = match self.machine.spindle {
            Spindle::Off => "M5",
            Spindle::Clockwise => "M3",
            Spindle::Counterclockwise => "M4",
        };
        let coolant = match (self.machine.mist, self.machine.flood) {
            (false, false) => "M9",
            (true, false) => "M7",
            (false, true) => "M8",
            (true, true) => "M7 M8",
        };
        let words = self.facts.modes.split(' ').filter_map(|word| match word {
            "M3" | "M4" | "M5" => Some(spindle),
            // The second word of two coolants.
            "M8" if self.facts.modes.contains("M7 M8") => None,
            "M7" | "M8" | "M9" => Some(coolant),
            word => Some(word),
        });
        words.collect::<Vec<_>>().join(" ")
    }
}
