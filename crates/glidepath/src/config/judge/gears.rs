//! The gears of `[spindle]`, as programs choose them.

use super::spindle::SpindleSurroundings;
use super::values::{Judge, Range};
use crate::config::raw::RawSpindle;
use glidepath_gcode::{GearSpeeds, Gears};
use toml::Spanned;

const MOST: Range = Range {
    min: 1.0,
    max: 1e6,
    unit: "rev/min",
    help: "the highest speed of the spindle in each of its gears, M41 first",
};
const LEAST: Range = Range {
    min: 0.0,
    max: 1e6,
    unit: "rev/min",
    help: "the lowest speed of the spindle in each of its gears, M41 first",
};

impl Judge {
    /// The gears of the spindle: none where `gear_max` is left out.
    pub(super) fn gears(&mut self, raw: &RawSpindle, of: &SpindleSurroundings<'_>) -> Gears {
        let most = self.speeds("spindle.gear_max", raw.gear_max.as_ref(), &MOST);
        let least = self.speeds("spindle.gear_min", raw.gear_min.as_ref(), &LEAST);
        let choices = [("words", false), ("speed", true)];
        let choice = &raw.gear_choice;
        let span = choice.as_ref().map(Spanned::span);
        let is_by_speed = self.choice("spindle.gear_choice", choice.clone(), &choices);
        let Some(list) = raw.gear_max.as_ref().filter(|_| !most.is_empty()) else {
            let left = raw.gear_min.as_ref().map(Spanned::span);
            if let Some(span) = left.or(span.filter(|_| is_by_speed)) {
                self.spindle_finding(
                    "gear_max",
                    span,
                    "the spindle has no gears, whose speeds or choice are said here",
                    "give gear_max the highest speed of each gear, or leave this out",
                );
            }
            return Gears::default();
        };
        if let Some(lowest) = raw.gear_min.as_ref().filter(|_| least.len() != most.len()) {
            let message = format!(
                "gear_min has {} speeds, and gear_max {}",
                least.len(),
                most.len()
            );
            let help = "give both a speed for each gear, in the order of M41 to M45";
            self.spindle_finding("gear_min", lowest.span(), &message, help);
        }
        let least = least.into_iter().map(Some).chain(core::iter::repeat(None));
        let speeds: Vec<GearSpeeds> = most
            .into_iter()
            .zip(least)
            .map(|(most, least)| GearSpeeds {
                least: least.unwrap_or(0.0),
                most,
            })
            .collect();
        if let Some(nth) = speeds.iter().position(|speeds| speeds.least >= speeds.most) {
            let GearSpeeds { least, most } = speeds[nth];
            let message = format!(
                "the lowest speed of gear {}, {least} rev/min, is not below its highest, {most}",
                nth + 1
            );
            let span = raw
                .gear_min
                .as_ref()
                .map_or_else(|| list.span(), Spanned::span);
            self.spindle_finding("gear_min", span, &message, LEAST.help);
        }
        self.gears_beside(raw, list, of);
        let count = speeds.len();
        Gears::new(speeds, is_by_speed).unwrap_or_else(|| {
            let message = format!("gear_max has {count} gears");
            let help = format!("give {} at most: there are words for no more", Gears::MOST);
            self.spindle_finding("gear_max", list.span(), &message, &help);
            Gears::default()
        })
    }

    /// What does not go with gears, and what they need beside them.
    fn gears_beside(
        &mut self,
        raw: &RawSpindle,
        list: &Spanned<Vec<f64>>,
        of: &SpindleSurroundings<'_>,
    ) {
        let is_axis = raw.axis.as_ref().filter(|axis| axis.get_ref() != "none");
        if let Some(axis) = is_axis {
            self.spindle_finding(
                "axis",
                axis.span(),
                "the servo of an axis turns the spindle always by the same ratio, and it has gears",
                "leave axis or gear_max out",
            );
        }
        let words = (41..).take(list.get_ref().len());
        let missing = words.into_iter().find(|word| !of.is_awaited(*word));
        if let Some(word) = missing.filter(|_| of.has_drives) {
            self.spindle_finding(
                "gear_max",
                list.span(),
                &format!("nobody says when the gear of M{word} is in, and the program goes on before it is"),
                &format!(
                    "add a table [m_codes.M{word}] with done = \"spindle-in-gear\" or what else says so, and without at"
                ),
            );
        }
    }

    /// A speed for each gear.
    fn speeds(&mut self, key: &str, list: Option<&Spanned<Vec<f64>>>, range: &Range) -> Vec<f64> {
        let Some(list) = list else {
            return Vec::new();
        };
        let each = |speed: &f64| self.number(key, &Spanned::new(list.span(), *speed), range);
        list.get_ref().iter().map(each).collect()
    }
}
