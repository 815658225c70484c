//! `[probe]`: where a probe is connected.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::probe::ProbeConfig;
use crate::config::raw::RawProbe;
use glidepath_interpolator::ProbeInput;

impl Judge {
    pub(super) fn probe(&mut self, raw: RawProbe, expects_feedback: bool) -> Option<ProbeConfig> {
        let high = self.choice(
            "probe.contact",
            raw.contact,
            &[("high", true), ("low", false)],
        );
        let range = Range {
            min: 0.01,
            max: 100.0,
            unit: "mm",
            help: "what the probe gives way, less what is to be in reserve",
        };
        let overtravel_mm = self.number_or("probe.overtravel", &raw.overtravel, &range, 2.0);
        let protects = raw.protect.is_some_and(|protect| protect.into_inner());
        let input = raw.input?;
        let help = "the bit of the feedback's digital inputs";
        let number = self.whole("probe.input", &input, (0, 63), help)?;
        if !expects_feedback {
            self.diagnostics.push(ConfigDiagnostic {
                key: "probe.input".to_owned(),
                message: "a probe is configured, and nobody sends its input".to_owned(),
                help: Some("set feedback.source = \"drives\"".to_owned()),
                span: Some(input.span()),
            });
        }
        Some(ProbeConfig {
            input: ProbeInput {
                number,
                high,
                protects,
            },
            overtravel_mm,
        })
    }
}
