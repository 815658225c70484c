//! Adaptive feed: an analog input that slows the program down, as far as to a hold.
//!
//! The factor follows the input in steps, or the search for a ramp would never come to rest. Where
//! the machine is configured for that, it goes on below zero: back along the path. If nothing new comes of the
//! input, the factor is zero.

use super::analog_source::AnalogSource;
use crate::shared::config::feedback::AdaptiveFeed;
use crate::shared::message::TickReport;
use glidepath_link::{Feedback, MotionMode};
use glidepath_program::{CodeWord, Event};

/// Least change of the factor, but for those to 0 and 1.
const STEP: f64 = 0.02;

/// The code that switches it, in LinuxCNC's language.
const SWITCH: u32 = 52;

/// Follows the input.
#[derive(Debug)]
pub(super) struct AdaptiveWatch {
    settings: Option<AdaptiveFeed>,
    source: AnalogSource,
    is_on: bool,
    /// The P word of the code that comes next.
    word: Option<f64>,
    /// What the input says, in steps.
    factor: f64,
    /// What was told last.
    told: f64,
}

impl AdaptiveWatch {
    pub(super) fn new(settings: Option<AdaptiveFeed>, stale_ns: u64) -> Self {
        Self {
            settings,
            source: AnalogSource::new(settings.map_or(0, |it| it.input), stale_ns),
            is_on: settings.is_some_and(|settings| settings.always),
            word: None,
            factor: 0.0,
            told: 1.0,
        }
    }

    /// Takes note of a setpoint: its event may be the switch.
    pub(super) fn note(&mut self, report: &TickReport) {
        let setpoint = &report.setpoint;
        let Some(settings) = self.settings else {
            return;
        };
        // Both are at rest.
        match setpoint.event() {
            Ok(Some(Event::CodeWord {
                word: CodeWord::P,
                value,
            })) => self.word = Some(value),
            Ok(Some(Event::MCode(code))) => {
                let on = self.word.take() != Some(0.0);
                if code == SWITCH {
                    self.is_on = on || settings.always;
                }
            }
            _ => {}
        }
    }

    /// Looks at what a stack sends.
    pub(super) fn look(&mut self, feedback: &Feedback) {
        if self.settings.is_some() {
            self.source.look(feedback);
        }
    }

    /// The factor as it was told last.
    pub(super) const fn told(&self) -> f64 {
        self.told
    }

    /// The factor of the rate of program time now, -1 to 1.
    pub(super) fn factor(&mut self, now_ns: u64) -> f64 {
        self.told = match self.settings {
            Some(settings) if self.is_on => self.follow(settings, now_ns),
            _ => 1.0,
        };
        self.told
    }

    fn follow(&mut self, settings: AdaptiveFeed, now_ns: u64) -> f64 {
        let wanted = self.source.value(now_ns).map_or(0.0, |value| {
            let part = (value - settings.at_zero) / (settings.at_full - settings.at_zero);
            let least = if settings.backwards { -1.0 } else { 0.0 };
            // Neither is a number that is none a speed.
            if part > least {
                part.min(1.0)
            } else if part.is_nan() {
                0.0
            } else {
                least
            }
        });
        let is_end = wanted.abs() >= 1.0 || wanted.abs() <= 0.0;
        if is_end || (wanted - self.factor).abs() >= STEP {
            self.factor = wanted;
        }
        self.factor
    }
}

/// What moves the axes, if the input turns a program round.
pub(super) fn turned_round(mode: u32) -> u32 {
    match MotionMode::from_code(mode) {
        Some(MotionMode::Program) => MotionMode::Backwards.code(),
        Some(MotionMode::Backwards) => MotionMode::Program.code(),
        Some(MotionMode::None | MotionMode::Jog | MotionMode::Homing | MotionMode::Return)
        | None => mode,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;

    const MS: u64 = 1_000_000;

    fn watch(always: bool) -> AdaptiveWatch {
        let settings = AdaptiveFeed {
            input: 2,
            at_zero: 1.0,
            at_full: 5.0,
            always,
            backwards: false,
        };
        AdaptiveWatch::new(Some(settings), 12 * MS)
    }

    fn says(watch: &mut AdaptiveWatch, boot_id: u64, ms: u64, value: f64) {
        let mut feedback = Feedback {
            boot_id,
            sample_ns: ms * MS,
            ..Feedback::zeroed()
        };
        feedback.analog_in[2] = value;
        watch.look(&feedback);
    }

    fn factor_of(value: f64) -> f64 {
        let mut watch = watch(true);
        says(&mut watch, 1, 100, value);
        watch.factor(101 * MS)
    }

    #[test]
    fn the_input_is_a_factor_and_silence_a_hold() {
        let near = |value: f64, wanted: f64| {
            let factor = factor_of(value);
            assert!((factor - wanted).abs() < 1e-12, "{value}: {factor}");
        };
        near(5.0, 1.0);
        near(9.0, 1.0);
        near(3.0, 0.5);
        near(1.0, 0.0);
        near(-4.0, 0.0);
        near(f64::NAN, 0.0);
        let mut watch = watch(true);
        assert!(watch.factor(0) <= 0.0, "nobody said anything");
        says(&mut watch, 1, 100, 3.0);
        assert!(watch.factor(112 * MS) > 0.4);
        assert!(watch.factor(113 * MS) <= 0.0, "stale");
        // A stack without the input does not speak for it, even if it is heard first.
        let mut other = self::watch(true);
        says(&mut other, 1, 100, 0.0);
        says(&mut other, 2, 101, 3.0);
        says(&mut other, 1, 102, 0.0);
        assert!((other.factor(103 * MS) - 0.5).abs() < 1e-12);
        // Another one with the input does when the first is gone.
        says(&mut watch, 1, 120, 3.0);
        says(&mut watch, 2, 121, 5.0);
        assert!((watch.factor(122 * MS) - 0.5).abs() < 1e-12);
        says(&mut watch, 2, 140, 5.0);
        assert!(watch.factor(141 * MS) >= 1.0);
    }

    #[test]
    fn below_zero_the_motion_goes_back_where_that_is_wanted() {
        let mut watch = watch(true);
        watch.settings.as_mut().unwrap().backwards = true;
        for (ms, value, wanted) in [
            (100, 3.0, 0.5),
            (110, 0.0, -0.25),
            (120, 1.02, 0.005),
            (130, -9.0, -1.0),
            (140, f64::NAN, 0.0),
        ] {
            says(&mut watch, 1, ms, value);
            let factor = watch.factor((ms + 1) * MS);
            assert!((factor - wanted).abs() < 1e-12, "{value}: {factor}");
        }
        assert!(watch.factor(200 * MS).abs() <= 0.0, "stale");
    }

    #[test]
    fn small_changes_are_none() {
        let mut watch = watch(true);
        let mut steps = 0;
        let mut before = 2.0;
        for ms in 100..1100 {
            #[allow(clippy::cast_precision_loss, reason = "small")]
            let noise = 0.03 * ((ms * 7919 % 100) as f64 / 100.0 - 0.5);
            says(&mut watch, 1, ms, 3.0 + noise);
            let factor = watch.factor(ms * MS);
            steps += u32::from((factor - before).abs() > 0.0);
            before = factor;
        }
        assert_eq!(steps, 1, "noise of less than a hundredth");
    }
}
