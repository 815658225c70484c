//! `[spindle]`: whether its angle is known, which axis it is, and how it taps.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawSpindle};
use crate::config::settings::MCodeRule;
use crate::config::spindle::SpindleConfig;
use glidepath_gcode::WaitsAt;
use glidepath_geometry::Axis;
use glidepath_interpolator::AnswerSource;
use glidepath_program::TAP_OVERTRAVEL;

/// What of the machine a spindle is judged by.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpindleSurroundings<'a> {
    /// The joints are the axes.
    pub(super) is_axes: bool,
    pub(super) axes: &'a [Axis],
    pub(super) m_codes: &'a [MCodeRule],
    /// There are drives, which take their time.
    pub(super) has_drives: bool,
}

impl SpindleSurroundings<'_> {
    /// Whether the machine waits for a code where it stands.
    pub(super) fn is_awaited(&self, code: u32) -> bool {
        let mut rules = self.m_codes.iter();
        let rule =
            rules.find(|rule| (rule.m_code_wait.first..=rule.m_code_wait.last).contains(&code));
        rule.is_some_and(|rule| {
            rule.m_code_wait.answer != AnswerSource::Nobody && rule.at == WaitsAt::Code
        })
    }
}

/// The least and the highest spindle override, if the file does not say.
const OVERRIDE: [f64; 2] = [0.5, 1.2];
/// The highest one where threads follow the spindle: they are planned for one that turns so much faster.
const OF_THREADS: f64 = 1.1;

impl Judge {
    /// The least and the highest override of the spindle's speed.
    pub(super) fn spindle_override(&mut self, raw: &RawSpindle) -> [f64; 2] {
        let range = |min, max, help| Range {
            min,
            max,
            unit: "",
            help,
        };
        let least = range(0.1, 1.0, "a part of the programmed speed: 0.5 is 50 %");
        let is_followed = raw.encoder.as_ref().is_some_and(|it| *it.get_ref());
        let (most, of_most) = if is_followed {
            let help = "passes of a thread are planned for a spindle that is a tenth faster than programmed \
                        (encoder = true), and would stop with a fault beyond that";
            (range(1.0, OF_THREADS, help), OF_THREADS)
        } else {
            let help = "what the spindle and its tools allow: 1.2 is 120 %";
            (range(1.0, 2.0, help), OVERRIDE[1])
        };
        [
            self.number_or(
                "spindle.override_min",
                &raw.override_min,
                &least,
                OVERRIDE[0],
            ),
            self.number_or("spindle.override_max", &raw.override_max, &most, of_most),
        ]
    }

    /// The spindle, if programs may follow its angle or turn it as an axis.
    pub(super) fn spindle(
        &mut self,
        raw: RawSpindle,
        of: &SpindleSurroundings<'_>,
    ) -> Option<SpindleConfig> {
        let range = Range {
            min: 0.1,
            max: 10_000.0,
            unit: "rev/s²",
            help: "the speed of the spindle, in rev/s, over the time it takes to stop",
        };
        let acceleration = raw
            .acceleration
            .as_ref()
            .map(|value| self.number("spindle.acceleration", value, &range));
        let range = Range {
            min: 0.1,
            max: 100.0,
            unit: "revolutions",
            help: "a little more than the spindle turns until it has stopped, and less than there is \
                   room for below the holes",
        };
        let overtravel = &raw.overtravel;
        let overtravel = self.number_or("spindle.overtravel", overtravel, &range, TAP_OVERTRAVEL);
        let rigid_tapping = raw.rigid_tapping.as_ref().filter(|taps| *taps.get_ref());
        let encoder = raw.encoder.as_ref().filter(|encoder| *encoder.get_ref());
        let axis = self.spindle_axis(raw.axis, of);
        let orientation = raw
            .orientation
            .as_ref()
            .filter(|orients| *orients.get_ref());
        if let Some(orients) = orientation.filter(|_| of.has_drives && !of.is_awaited(19)) {
            self.spindle_finding(
                "orientation",
                orients.span(),
                "nobody says when the spindle stands at its angle, and the program goes on before it does",
                "add a table [m_codes.M19] with done = \"spindle-oriented\" or what else says so, \
                 and without at",
            );
        }
        if let (Some(taps), None, None) = (rigid_tapping, encoder, axis) {
            self.spindle_finding(
                "rigid_tapping",
                taps.span(),
                "a rigid tap follows the spindle, whose angle nobody tells",
                "set spindle.encoder = true, name the axis of the spindle, or leave it out",
            );
        }
        if let Some(encoder) = encoder.filter(|_| !of.is_axes) {
            self.spindle_finding(
                "encoder",
                encoder.span(),
                "threads are cut only where every joint is an axis",
                "leave it out, or set machine.kinematics = \"trivial\"",
            );
        }
        let is_told = encoder.is_some() || axis.is_some() || orientation.is_some();
        is_told.then_some(SpindleConfig {
            encoder: encoder.is_some(),
            orientation: orientation.is_some(),
            axis,
            rigid_tapping: rigid_tapping.is_some(),
            acceleration,
            overtravel,
        })
    }

    /// The axis that the spindle is.
    fn spindle_axis(
        &mut self,
        raw: Optional<String>,
        of: &SpindleSurroundings<'_>,
    ) -> Option<Axis> {
        let span = raw.as_ref()?.span();
        let names = [
            ("none", None),
            ("A", Some(Axis::A)),
            ("B", Some(Axis::B)),
            ("C", Some(Axis::C)),
        ];
        let axis = self.choice("spindle.axis", raw, &names)?;
        if !of.axes.contains(&axis) {
            self.spindle_finding(
                "axis",
                span.clone(),
                &format!("the machine has no axis {axis}"),
                &format!("add a table [axis.{axis}]"),
            );
        }
        if !of.is_axes {
            self.spindle_finding(
                "axis",
                span.clone(),
                "a spindle is an axis only where every joint is one",
                "leave it out, or set machine.kinematics = \"trivial\"",
            );
        }
        if of.has_drives && !of.is_awaited(5) {
            self.spindle_finding(
                "axis",
                span.clone(),
                "nobody says when the spindle stands, and follows its axis",
                "add a table [m_codes.M5] with done = \"spindle-stopped\" or what else says so, \
                 and without at",
            );
        }
        Some(axis)
    }

    pub(super) fn spindle_finding(
        &mut self,
        key: &str,
        span: core::ops::Range<usize>,
        message: &str,
        help: &str,
    ) {
        self.diagnostics.push(ConfigDiagnostic {
            key: format!("spindle.{key}"),
            message: message.to_owned(),
            help: Some(help.to_owned()),
            span: Some(span),
        });
    }
}
