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
    /// A device was given the encoder of the spindle.
    has_encoder: bool,
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
        let of = |is_output| free(windows, is_output);
        if let Some(counter) = Counter::of(windows) {
            self.encoder(text, counter);
        }
        self.list(text, "inputs", of(false).filter(is_bit));
        self.list(text, "analog_inputs", of(false).filter(is_number));
        self.list(text, "outputs", of(true).filter(is_bit));
        self.list(text, "analog_outputs", of(true).filter(is_number));
        if of(true).next().is_some()
            && let Some(watchdog) = watchdog
        {
            let _ = writeln!(text, "# {}", told(watchdog));
        }
    }

    /// What a counter would be as the encoder of the spindle. How many counts a revolution has nobody tells.
    fn encoder(&mut self, text: &mut String, counter: Counter) {
        let index = match counter {
            Counter::WithIndex => "",
            Counter::Alone => ", index = false",
        };
        let line = format!("encoder = {{ counts_per_rev = 0{index} }}");
        let _ = if core::mem::replace(&mut self.has_encoder, true) {
            writeln!(
                text,
                "# # {line}     # or that one, not both: a machine has one"
            )
        } else {
            writeln!(
                text,
                "# {line}     # if it is on the spindle: four times its lines"
            )
        };
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

/// The counter of an encoder, as EL5101 and EL5151 have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Counter {
    /// It keeps what it is at the index.
    WithIndex,
    /// It only counts.
    Alone,
}

impl Counter {
    fn of(windows: &[Window]) -> Option<Self> {
        let bits = |is_output, index, sub| {
            let windows = windows.iter().filter(|w| w.is_output == is_output);
            let mut entries = windows.flat_map(|window| &window.entries);
            let found = entries.find(|entry| (entry.index, entry.sub) == (index, sub));
            found.map(|entry| entry.bits)
        };
        let counter = bits(false, 0x6000, 0x11).filter(|bits| matches!(bits, 16 | 32))?;
        let is_kept = bits(false, 0x6000, 0x12) == Some(counter);
        let is_armed = bits(true, 0x7000, 0x01) == Some(1);
        let is_set = bits(true, 0x7000, 0x03) == Some(1);
        if is_kept && is_armed && bits(false, 0x6000, 0x01) == Some(1) {
            return Some(Self::WithIndex);
        }
        // An analog input has its value there, too, and nothing beside it that leads a counter.
        (is_kept || is_armed || is_set).then_some(Self::Alone)
    }
}

/// Whether an entry is one by which the counter is told and led.
const fn is_of_counter(entry: &Entry) -> bool {
    matches!(entry.index, 0x6000 | 0x7000)
}

/// The entries of a device, of its outputs or of its inputs, that lead and tell no counter.
fn free(windows: &[Window], is_output: bool) -> impl Iterator<Item = Entry> {
    let has_counter = Counter::of(windows).is_some();
    let windows = windows.iter().filter(move |w| w.is_output == is_output);
    let entries = windows.flat_map(|window| window.entries.iter().copied());
    entries.filter(move |entry| !(has_counter && is_of_counter(entry)))
}

/// Whether a device has a digital input.
pub(super) fn has_input(windows: &[Window]) -> bool {
    free(windows, false).any(|entry| is_bit(&entry) && entry.index != 0)
}

const fn is_bit(entry: &Entry) -> bool {
    entry.bits == 1
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
