//! The outputs of a device, and what each obeys.

use super::Devices;
use crate::config::Range;
use crate::drives::raw_device::{RawAnalogOutput, RawOutput};
use crate::drives::words::{QUANTITIES, SIGNALS, quantity, signal};
use glidepath_ethercat::{AnalogOutput, At, DigitalOutput, TerminalSettings};
use toml::Spanned;

const FULL: Range = Range {
    min: 1e-9,
    max: 1e9,
    unit: "units",
    help: "the value at full counts: the speed of the spindle at 10 V",
};
/// As far as `full` goes.
const REST: Range = Range {
    min: -1e9,
    max: 1e9,
    unit: "units",
    help: "the value while nobody is to be obeyed, no more than full either way",
};

impl Devices<'_> {
    /// All outputs of a device, no two of which are at the same place.
    pub(super) fn outputs(
        &mut self,
        terminal: &mut TerminalSettings,
        digital: Vec<Spanned<RawOutput>>,
        analog: &[RawAnalogOutput],
    ) {
        let mut places = Vec::new();
        for raw in digital {
            let span = raw.span();
            if let Some(output) = self.output(raw) {
                places.push((output.at, span));
                terminal.outputs.push(output);
            }
        }
        for raw in analog {
            if let Some(output) = self.analog_output(raw) {
                places.push((output.at, raw.at.span()));
                terminal.analog_outputs.push(output);
            }
        }
        for (at, span) in &places {
            self.note(terminal.position, Some((*at, true)), span.clone());
        }
        for (nth, (at, span)) in places.iter().enumerate() {
            if places[..nth].iter().any(|(other, _)| other == at) {
                let message = format!("two outputs are at {at}");
                let help = "an output obeys one thing";
                self.tell("device.outputs", message, help, span.clone());
            }
        }
    }

    /// What an output obeys.
    fn from<T>(
        &mut self,
        key: &str,
        text: &Spanned<String>,
        (find, known): (fn(&str) -> Option<T>, &str),
    ) -> Option<T> {
        let found = find(text.as_ref());
        if found.is_none() {
            let message = format!("{key} = \"{}\" is not known", text.as_ref());
            self.tell(key, message, known, text.span());
        }
        found
    }

    fn output(&mut self, raw: Spanned<RawOutput>) -> Option<DigitalOutput> {
        let (span, key) = (raw.span(), "device.outputs");
        let raw = raw.into_inner();
        let at = self.at(key, (raw.at.as_ref(), raw.bit.as_ref()), span);
        let from = self.from("device.outputs.from", &raw.from, (signal, SIGNALS));
        Some(DigitalOutput {
            at: at?,
            from: from?,
            is_inverted: raw.invert,
            rest: raw.rest.unwrap_or(raw.invert),
        })
    }

    fn analog_output(&mut self, raw: &RawAnalogOutput) -> Option<AnalogOutput> {
        let at = self.object("device.analog_outputs.at", &raw.at);
        let key = "device.analog_outputs.from";
        let from = self.from(key, &raw.from, (quantity, QUANTITIES));
        let judge = &mut *self.judge;
        let full = judge.number("device.analog_outputs.full", &raw.full, &FULL);
        let most = Range {
            min: -full,
            max: full,
            ..REST
        };
        let rest = judge.number_or("device.analog_outputs.rest", &raw.rest, &most, 0.0);
        let help = "counts at full: 32767 for 10 V in 16 bits";
        let key = "device.analog_outputs.counts";
        let counts = judge.whole(key, &raw.counts, (1, u32::MAX.into()), help);
        let (index, sub) = at?;
        Some(AnalogOutput {
            at: At::Object { index, sub },
            from: from?,
            full,
            full_counts: counts?,
            rest,
        })
    }
}
