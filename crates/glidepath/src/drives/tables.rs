//! First tables for devices that are no drives: comments, with every input and output that they tell.

use core::fmt::Write as _;
use glidepath_ethercat::{
    ANALOG_INPUTS, At, DIGITAL_INPUTS, Device, Entry, OutputWatchdog, Window,
};

/// Outputs of programs of each kind.
const OUTPUTS: usize = 64;

/// Numbers that were given out.
#[derive(Debug, Default)]
struct Numbers {
    digital: usize,
    analog: usize,
}

impl Numbers {
    /// The next one of a kind, if there is one.
    fn next(&mut self, is_digital: bool, most: (usize, usize)) -> Option<usize> {
        let (next, most) = if is_digital {
            (&mut self.digital, most.0)
        } else {
            (&mut self.analog, most.1)
        };
        let number = *next;
        *next += 1;
        (number < most).then_some(number)
    }
}

/// The writer of these tables.
#[derive(Debug, Default)]
pub(super) struct Tables {
    inputs: Numbers,
    outputs: Numbers,
}

impl Tables {
    /// Adds the table of a device.
    pub(super) fn write(
        &mut self,
        text: &mut String,
        device: &Device,
        windows: &[Window],
        watchdog: Option<OutputWatchdog>,
    ) {
        let id = device.identity;
        let _ = write!(
            text,
            "\n# [[device]]                    # {}\n# position = {}\n# vendor = {:#x}\n# product = {:#x}\n",
            device.name, device.position, id.vendor, id.product
        );
        if device.alias != 0 {
            let _ = writeln!(text, "# alias = {}", device.alias);
        }
        let of = |is_output| {
            let windows = windows.iter().filter(move |w| w.is_output == is_output);
            windows.flat_map(|window| window.entries.iter().copied())
        };
        self.list(text, "inputs", of(false).filter(|entry| entry.bits == 1));
        self.list(text, "analog_inputs", of(false).filter(is_number));
        self.list(text, "outputs", of(true).filter(|entry| entry.bits == 1));
        self.list(text, "analog_outputs", of(true).filter(is_number));
        if of(true).next().is_some()
            && let Some(watchdog) = watchdog
        {
            let _ = writeln!(text, "# {}", told(watchdog));
        }
    }

    fn list(&mut self, text: &mut String, key: &str, entries: impl Iterator<Item = Entry>) {
        let mut lines = String::new();
        for entry in entries.filter(|entry| entry.index != 0) {
            let at = At::Object {
                index: entry.index,
                sub: entry.sub,
            };
            let is_digital = entry.bits == 1;
            let number = if key.ends_with("inputs") {
                self.inputs
                    .next(is_digital, (DIGITAL_INPUTS, ANALOG_INPUTS))
            } else {
                self.outputs.next(is_digital, (OUTPUTS, OUTPUTS))
            };
            let Some(number) = number else {
                let _ = writeln!(
                    lines,
                    "#     # \"{at}\" and more: all numbers are given out"
                );
                break;
            };
            let most = (1_u64 << (entry.bits - 1)) - 1;
            let _ = match key {
                "inputs" => writeln!(lines, "#     {{ at = \"{at}\", number = {number} }},"),
                "outputs" => writeln!(
                    lines,
                    "#     {{ at = \"{at}\", from = \"output {number}\" }},"
                ),
                "analog_inputs" => writeln!(
                    lines,
                    "#     {{ at = \"{at}\", number = {number}, scale = 1.0 }},     # its unit a count"
                ),
                _ => writeln!(
                    lines,
                    "#     {{ at = \"{at}\", from = \"analog {number}\", full = 10.0, counts = {most} }},"
                ),
            };
        }
        if !lines.is_empty() {
            let _ = write!(text, "# {key} = [\n{lines}# ]\n");
        }
    }
}

fn is_number(entry: &Entry) -> bool {
    matches!(entry.bits, 8 | 16 | 32)
}

/// What a device says of the watchdog of its outputs.
fn told(watchdog: OutputWatchdog) -> String {
    let OutputWatchdog {
        time_ns,
        has_expired,
        count,
    } = watchdog;
    #[allow(clippy::cast_precision_loss, reason = "a report")]
    let time_ms = time_ns as f64 / 1e6;
    let state = if has_expired {
        "expired"
    } else {
        "not expired"
    };
    format!(
        "Its outputs fall {time_ms} ms after the last frame (0x0420; watchdog_ms is written at the start); \
         {state} (0x0440), {count} times so far"
    )
}
