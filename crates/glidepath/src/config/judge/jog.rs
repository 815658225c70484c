//! `[jog]`: how the machine is moved by hand.

use super::values::{Judge, Range};
use crate::config::raw::{RawAxis, RawJog};
use crate::config::settings::JogConfig;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Limits;
use toml::Spanned;

/// What every speed of a jog may be.
const fn speed(unit: &'static str, help: &'static str) -> Range {
    Range {
        min: 1e-3,
        max: 1e5,
        unit,
        help,
    }
}

impl Judge {
    pub(super) fn jog<'r>(
        &mut self,
        raw: RawJog,
        axes: impl Iterator<Item = (Axis, &'r RawAxis)>,
    ) -> JogConfig {
        let any = |help| speed("mm/s or °/s", help);
        let range = any("top speed of a jog, of every axis that gives none of its own");
        let velocity = self.number_or("jog.velocity", &raw.velocity, &range, 50.0);
        let range = any("top speed of a jog where the machine does not know where it is");
        let unhomed = self.number_or("jog.unhomed_velocity", &raw.unhomed_velocity, &range, 10.0);
        let range = speed("mm/s", "top speed of the way back to the path");
        let return_v = self.number_or("jog.return_velocity", &raw.return_velocity, &range, 50.0);
        let dead_man = raw.dead_man_ms.as_ref().map_or(Some(150), |value| {
            let help = "ms without a sign of life after which a jog stops";
            self.whole("jog.dead_man_ms", value, (50, 1_000), help)
        });
        let range = Range {
            min: 0.0,
            max: 1e3,
            unit: "mm",
            help: "how far the tool axis goes up behind an abort",
        };
        let lift = self.number_or("jog.lift", &raw.lift, &range, 0.0);
        JogConfig {
            velocity: self.jog_velocities(velocity, axes),
            unhomed_velocity: unhomed,
            return_velocity: return_v,
            increments: self.increments(raw.increments),
            // A value that does not fit was found already: the configuration is refused.
            dead_man_ms: dead_man.unwrap_or(150),
            lift,
            tool_axis: self.named_axis("jog.tool_axis", raw.tool_axis, Axis::Z),
        }
    }

    /// The speed of each axis: its own, or that of all.
    fn jog_velocities<'r>(
        &mut self,
        of_all: f64,
        axes: impl Iterator<Item = (Axis, &'r RawAxis)>,
    ) -> AxisVector {
        let mut velocity = AxisVector::repeat(Limits::UNLIMITED);
        for (axis, raw) in axes {
            let unit = if axis.is_rotary() { "°/s" } else { "mm/s" };
            let range = speed(unit, "top speed of a jog of this axis");
            let key = format!("axis.{axis}.jog_velocity");
            let own = self.number_or(&key, &raw.jog_velocity, &range, of_all);
            if let Some(slot) = velocity.get_mut(axis.index()) {
                *slot = own;
            }
        }
        velocity
    }

    fn increments(&mut self, raw: Option<Spanned<Vec<f64>>>) -> Vec<f64> {
        let range = Range {
            min: 1e-4,
            max: 1e3,
            unit: "mm or °",
            help: "the steps that jogging by keys offers",
        };
        let Some(raw) = raw else {
            return vec![0.01, 0.1, 1.0, 10.0];
        };
        let span = raw.span();
        raw.into_inner()
            .into_iter()
            .map(|step| self.number("jog.increments", &Spanned::new(span.clone(), step), &range))
            .collect()
    }
}
