//! The source of an analog input: the servo stack that sends it, and what it said last.
//!
//! It is the first stack that sends something other than zero, as stacks without the input send zero. If nothing new
//! comes from it, another such stack takes its place.

use glidepath_link::Feedback;

/// Follows an analog input.
#[derive(Debug)]
pub(super) struct AnalogSource {
    input: u8,
    stale_ns: u64,
    /// The stack that sends the input, and its last sample.
    sample: Option<Sample>,
}

#[derive(Debug, Clone, Copy)]
struct Sample {
    boot_id: u64,
    sample_ns: u64,
    value: f64,
}

impl AnalogSource {
    pub(super) const fn new(input: u8, stale_ns: u64) -> Self {
        Self {
            input,
            stale_ns,
            sample: None,
        }
    }

    /// Looks at what a stack sends.
    pub(super) fn look(&mut self, feedback: &Feedback) {
        let value = feedback.analog_in.get(usize::from(self.input));
        let value = value.copied().unwrap_or(0.0);
        let is_stale =
            |sample: Sample| feedback.sample_ns.saturating_sub(sample.sample_ns) > self.stale_ns;
        let is_its = match self.sample {
            Some(sample) if sample.boot_id == feedback.boot_id => true,
            sample => value != 0.0 && sample.is_none_or(is_stale),
        };
        if is_its {
            self.sample = Some(Sample {
                boot_id: feedback.boot_id,
                sample_ns: feedback.sample_ns,
                value,
            });
        }
    }

    /// What it says now; `None` if nobody says anything new.
    pub(super) fn value(&self, now_ns: u64) -> Option<f64> {
        self.sample
            .filter(|sample| now_ns.saturating_sub(sample.sample_ns) <= self.stale_ns)
            .map(|sample| sample.value)
    }
}
