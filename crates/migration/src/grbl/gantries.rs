//! Axes that two motors move: ganged and auto-squared ones.
//!
//! Both motors have the limits of their axis there. grblHAL has settings of such axes alone; grbl says only that
//! it was built for one.

use super::{Machine, bit};
use crate::inputs::Fate;

/// The offset of the second motor of the first axis; only auto-squared axes have it.
const OFFSET: usize = 170;
/// Which second motors turn the other way round; only machines with ganged axes have it.
const INVERTED: usize = 8;
/// How far the two edges may be apart: as a share of the travel, at least, at most.
const FAILS: core::ops::RangeInclusive<usize> = 347..=349;

impl Machine {
    pub(super) fn gantries(&mut self) {
        let inverted = self.number(INVERTED).map_or(0.0, |(_, mask)| mask);
        for (number, letter) in self.axes.clone() {
            let offset = self.find(OFFSET + number);
            let place = u32::try_from(number).unwrap_or(u32::MAX);
            if offset.is_none() && !bit(inverted, place) {
                continue;
            }
            self.gantries.push(number);
            let why =
                "the axis has two joints: by how much may they differ before the motion stops";
            let table = format!("axis.{letter}");
            self.draft.choose(&table, "gantry_difference", why);
            if let Some(at) = offset {
                let note = format!(
                    "{table}.gantry_difference is asked for; where the second joint has its edge is offset of \
                     its own [home.…]"
                );
                self.inputs.decide(at, Fate::Changed, note);
            }
        }
        let is_built = self.options().is_some_and(|options| options.contains('2'));
        if self.gantries.is_empty() && (is_built || self.find(INVERTED).is_some()) {
            let remark = "an axis has two motors ($8, or 2 in [OPT:…]), and which one is not said: give its table \
                          gantry_difference, by how much its two joints may differ before the motion stops";
            self.draft.remark("machine", remark);
        }
        if let Some(at) = self.find(INVERTED) {
            let note = "the direction of a second motor belongs to the drive";
            self.inputs.decide(at, Fate::NoCounterpart, note);
        }
        for at in FAILS
            .filter_map(|number| self.find(number))
            .collect::<Vec<_>>()
        {
            let note =
                "how far the edges of two joints may be apart is gantry_difference of their axis";
            self.inputs.decide(at, Fate::Changed, note);
        }
    }
}
