//! `[superposition]`: an input that moves an axis in addition to programs.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::RawSuperposition;
use crate::config::settings::AxisConfig;
use glidepath_geometry::Axis;
use glidepath_interpolator::{Superposition, SuperpositionControl};
use toml::Spanned;

/// Travel that is left for programs at least, mm or degrees.
const LEAST_TRAVEL: f64 = 1.0;

impl Judge {
    /// What moves an axis in addition to programs. The axis gets the limits and the travel that are left for these.
    pub(super) fn superposition(
        &mut self,
        raw: RawSuperposition,
        axes: &mut [AxisConfig],
        (is_axes, expects_feedback): (bool, bool),
    ) -> Option<Superposition> {
        let values = self.superposition_values(&raw);
        let sets = [
            ("velocity", SuperpositionControl::Velocity),
            ("offset", SuperpositionControl::Offset),
        ];
        let control = self.choice("superposition.sets", raw.sets, &sets);
        let by = [("input", false), ("wheel", true)];
        let is_wheel = self.choice("superposition.by", raw.by, &by);
        let levels = [("high", true), ("low", false)];
        let enabled_at = self.choice("superposition.enabled_at", raw.enabled_at, &levels);
        let offs = [("return", true), ("keep", false)];
        let returns = self.choice("superposition.off", raw.off, &offs);
        let mut whole = |name: &str, value: &Option<Spanned<i64>>, help: &str| {
            let key = format!("superposition.{name}");
            self.whole::<u8>(&key, value.as_ref()?, (0, 63), help)
        };
        let switch = whole("switched_by", &raw.switched_by, "the P of M62 to M65");
        let bit = "the bit of the feedback's digital inputs";
        let enabled_by = whole("enabled_by", &raw.enabled_by, bit);
        let span = raw.axis.as_ref()?.span();
        let wanted = self.named_axis("superposition.axis", raw.axis, Axis::X);
        let input = self.superposition_input(raw.input, span.clone(), (is_wheel, expects_feedback));
        if !is_axes {
            let help = "only where joints are axes (kinematics = \"trivial\") is anything added to their motion";
            self.refuse_superposition("the axes of this machine are not its joints", help, span);
            return None;
        }
        let Some(axis) = axes.iter_mut().find(|axis| axis.axis == wanted) else {
            let help = "name an axis that has a table, such as [axis.Z]";
            self.refuse_superposition("the machine has no such axis", help, span);
            return None;
        };
        let [share, lowest, highest, ..] = values;
        let drive = [axis.max_velocity, axis.max_acceleration, axis.max_jerk];
        let [velocity, acceleration, jerk] = drive.map(|limit| limit * share);
        if let Some((min, max)) = &mut axis.travel {
            (*min, *max) = (*min - lowest, *max - highest);
            if *max - *min < LEAST_TRAVEL {
                let help = "choose lowest and highest so that less than the travel is between them";
                self.refuse_superposition("no travel is left for programs", help, span);
                return None;
            }
        }
        let left = 1.0 - share;
        axis.max_velocity *= left;
        axis.max_acceleration *= left;
        axis.max_jerk *= left;
        let [_, _, _, target, gain, dead_band, freeze_below, freeze_for_t] = values;
        Some(Superposition {
            axis: axis.axis,
            velocity,
            acceleration,
            jerk,
            range: [lowest, highest],
            input: input?,
            control: if is_wheel {
                SuperpositionControl::Wheel
            } else {
                control
            },
            target,
            gain,
            dead_band,
            switch: switch.map(u32::from),
            enable: enabled_by.map(|number| (number, enabled_at)),
            freeze_below,
            freeze_for_t,
            returns,
        })
    }

    /// Share, lowest, highest, target, gain, dead band, and what freezes it: part of the feed, and time.
    fn superposition_values(&mut self, raw: &RawSuperposition) -> [f64; 8] {
        let unit = "mm or °";
        let rows = [
            ("share", &raw.share, (0.01, 0.9), "", 0.25),
            ("lowest", &raw.lowest, (-1000.0, 0.0), unit, -5.0),
            ("highest", &raw.highest, (0.0, 1000.0), unit, 5.0),
            ("target", &raw.target, (-1e6, 1e6), "", 0.0),
            ("gain", &raw.gain, (-1e6, 1e6), "", 1.0),
            ("dead_band", &raw.dead_band, (0.0, 1e6), "", 0.0),
            ("freeze_below", &raw.freeze_below, (0.0, 1.0), "", 0.9),
            ("freeze_for", &raw.freeze_for, (0.0, 10.0), "s", 0.1),
        ];
        rows.map(|(name, value, (min, max), unit, default)| {
            let range = Range {
                min,
                max,
                unit,
                help: "the page of superposition in the manual says what it does",
            };
            self.number_or(&format!("superposition.{name}"), value, &range, default)
        })
    }

    /// The analog input, 0 where a wheel moves the axis.
    fn superposition_input(
        &mut self,
        input: Option<Spanned<i64>>,
        span: core::ops::Range<usize>,
        (is_wheel, expects_feedback): (bool, bool),
    ) -> Option<u8> {
        let help = "the number of the feedback's analog input";
        let number = match &input {
            Some(input) => self.whole("superposition.input", input, (0, 7), help),
            None => is_wheel.then_some(0),
        };
        if input.is_none() && !is_wheel {
            self.diagnostics.push(ConfigDiagnostic {
                key: "superposition.input".to_owned(),
                message: "superposition.input is missing: no input moves the axis".to_owned(),
                help: Some("input = 0, for example; or by = \"wheel\" for a handwheel".to_owned()),
                span: Some(span.clone()),
            });
        }
        if !expects_feedback && !is_wheel {
            let help = "set feedback.source = \"drives\"";
            self.refuse_superposition("nobody sends its input", help, span);
        }
        number
    }

    fn refuse_superposition(&mut self, message: &str, help: &str, span: core::ops::Range<usize>) {
        self.diagnostics.push(ConfigDiagnostic {
            key: "superposition.axis".to_owned(),
            message: message.to_owned(),
            help: Some(help.to_owned()),
            span: Some(span),
        });
    }
}
