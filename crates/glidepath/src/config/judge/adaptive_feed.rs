//! `[adaptive_feed]`: an analog input that slows programs down.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::RawAdaptiveFeed;
use glidepath_interpolator::AdaptiveFeed;

impl Judge {
    pub(super) fn adaptive_feed(
        &mut self,
        raw: RawAdaptiveFeed,
        expects_feedback: bool,
    ) -> Option<AdaptiveFeed> {
        let range = Range {
            min: -1e6,
            max: 1e6,
            unit: "",
            help: "in the unit in which the drives' feedback has it",
        };
        let at_zero = self.number_or("adaptive_feed.at_zero", &raw.at_zero, &range, 0.0);
        let at_full = self.number_or("adaptive_feed.at_full", &raw.at_full, &range, 1.0);
        let input = raw.input?;
        let mut refuse = |message: &str, help: &str| {
            self.diagnostics.push(ConfigDiagnostic {
                key: "adaptive_feed.input".to_owned(),
                message: message.to_owned(),
                help: Some(help.to_owned()),
                span: Some(input.span()),
            });
        };
        if !expects_feedback {
            refuse(
                "an adaptive feed is configured, and nobody sends its input",
                "set feedback.source = \"drives\"",
            );
        }
        if (at_full - at_zero).abs() < 1e-9 {
            refuse(
                "the adaptive feed stands and runs at the same value of its input",
                "give at_zero and at_full different values",
            );
        }
        let help = "the number of the feedback's analog input";
        let number = self.whole("adaptive_feed.input", &input, (0, 7), help)?;
        Some(AdaptiveFeed {
            input: number,
            at_zero,
            at_full,
            always: raw.always.is_some_and(|always| always.into_inner()),
            backwards: raw.backwards.is_some_and(|back| back.into_inner()),
        })
    }
}
