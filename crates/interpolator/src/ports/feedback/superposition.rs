//! The input of the superposition: what the real-time thread is told of it.

use super::analog_source::AnalogSource;
use crate::shared::config::superposition::Superposition;
use crate::shared::message::superposition_demand::SuperpositionDemand;
use glidepath_link::Feedback;

/// Follows the inputs of a superposition.
#[derive(Debug)]
pub(super) struct SuperpositionWatch {
    settings: Option<Superposition>,
    source: AnalogSource,
}

impl SuperpositionWatch {
    pub(super) fn new(settings: Option<Superposition>, stale_ns: u64) -> Self {
        Self {
            settings,
            source: AnalogSource::new(settings.map_or(0, |it| it.input), stale_ns),
        }
    }

    /// Looks at what a stack sends.
    pub(super) fn look(&mut self, feedback: &Feedback) {
        if self.settings.is_some() {
            self.source.look(feedback);
        }
    }

    /// What is asked for now; `digital_in` are the inputs of all stacks together.
    pub(super) fn demand(&self, digital_in: u64, now_ns: u64) -> SuperpositionDemand {
        let Some(settings) = self.settings else {
            return SuperpositionDemand::Silent;
        };
        let is_barred = settings
            .enable
            .is_some_and(|(number, high)| (digital_in >> (number & 63) & 1 == 1) != high);
        match self.source.value(now_ns).filter(|value| value.is_finite()) {
            None => SuperpositionDemand::Silent,
            Some(_) if is_barred => SuperpositionDemand::Barred,
            Some(value) => SuperpositionDemand::Value(value),
        }
    }
}
