//! The reader of a `$J=` line.

use crate::error::ErrorNumber;
use crate::numbers::{INCH_MM, is_linear};
use crate::{AXES, LETTERS};

/// The content of a jog line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct JogLine {
    /// Where each axis that is named goes: mm or degrees.
    axes: [Option<f64>; AXES],
    is_incremental: bool,
    in_machine: bool,
    /// mm/s.
    pub(crate) feed_v: f64,
}

impl JogLine {
    /// Reads what stands behind `$J=`: capitals without spaces. `modes` are those in force.
    pub(crate) fn read(text: &str, modes: &str) -> Result<Self, (ErrorNumber, &'static str)> {
        let mut axes = [None; AXES];
        let is_in_force = |mode: &str| modes.split(' ').any(|word| word == mode);
        let mut is_inch = is_in_force("G20");
        let mut is_incremental = is_in_force("G91");
        let mut in_machine = false;
        let mut feed = None;
        let mut rest = text;
        while let Some(letter) = rest.chars().next() {
            let behind = rest.get(letter.len_utf8()..).unwrap_or_default();
            let length = behind
                .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+')))
                .unwrap_or(behind.len());
            let (number, next) = behind.split_at(length);
            let value: f64 = number
                .parse()
                .ok()
                .filter(|value: &f64| value.is_finite())
                .ok_or((ErrorNumber::NUMBER, "a word of the jog has no number"))?;
            match (letter, number) {
                ('G', "20") => is_inch = true,
                ('G', "21") => is_inch = false,
                ('G', "90") => is_incremental = false,
                ('G', "91") => is_incremental = true,
                ('G', "53") => in_machine = true,
                ('F', _) => feed = Some(value),
                ('N', _) => {}
                _ => {
                    let index = LETTERS.iter().position(|it| *it == letter);
                    let slot = index.and_then(|index| axes.get_mut(index));
                    let slot = slot.ok_or((
                        ErrorNumber::JOG,
                        "a jog has axes, F, N, and G20, G21, G90, G91, G53 alone",
                    ))?;
                    *slot = Some(value);
                }
            }
            rest = next;
        }
        let scale = if is_inch { INCH_MM } else { 1.0 };
        for (axis, slot) in axes.iter_mut().enumerate() {
            *slot = slot.map(|value| {
                if is_linear(axis) {
                    value * scale
                } else {
                    value
                }
            });
        }
        if axes.iter().all(Option::is_none) {
            return Err((ErrorNumber::NO_AXES, "a jog needs an axis"));
        }
        match feed {
            Some(feed) if feed < 0.0 => Err((ErrorNumber::NEGATIVE, "F is below 0")),
            Some(feed) if feed > 0.0 => Ok(Self {
                axes,
                is_incremental: is_incremental && !in_machine,
                in_machine,
                feed_v: feed * scale / 60.0,
            }),
            _ => Err((ErrorNumber::NO_FEED, "a jog needs its own F, above 0")),
        }
    }

    /// Where it goes from `from`, both in machine coordinates, with the zero of programs at `zero`.
    pub(crate) fn target(&self, from: &[f64; AXES], zero: &[f64; AXES]) -> [f64; AXES] {
        let mut target = *from;
        let places = target.iter_mut().zip(&self.axes).zip(zero);
        for ((place, word), zero) in places {
            match word {
                Some(by) if self.is_incremental => *place += by,
                Some(at) if self.in_machine => *place = *at,
                Some(at) => *place = at + zero,
                None => {}
            }
        }
        target
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_jog_may_say() {
        let number = |text| JogLine::read(text, "G21 G90").unwrap_err().0.0;
        assert_eq!(number("G91G0X1F1000"), 16);
        assert_eq!(number("G91X1"), 22);
        assert_eq!(number("G91X1F0"), 22);
        assert_eq!(number("G91X1F-100"), 4);
        assert_eq!(number("F100"), 26);
        assert_eq!(number("XF100"), 2);
        assert_eq!(number("X1M3F100"), 16);
        assert_eq!(number("Ä1F100"), 16);
    }

    #[test]
    fn a_jog_goes_by_or_to_in_any_units_and_changes_none() {
        let from = [10.0; AXES];
        let mut zero = [0.0; AXES];
        zero[0] = 2.0;
        let target = |text, modes| {
            let jog = JogLine::read(text, modes).unwrap();
            let target = jog.target(&from, &zero);
            #[allow(
                clippy::cast_possible_truncation,
                reason = "a few tenths of a millimetre"
            )]
            let tenths = [target[0], target[3]].map(|place| (place * 10.0).round() as i32);
            tenths
        };
        assert_eq!(target("G91X1F60", "G21 G90"), [110, 100]);
        assert_eq!(target("X1F60", "G21 G90"), [30, 100]);
        assert_eq!(target("X1F60", "G21 G91"), [110, 100]);
        assert_eq!(target("G53X1F60", "G21 G91"), [10, 100]);
        assert_eq!(target("G20G91X1A1F1", "G21 G90"), [354, 110]);
        let jog = JogLine::read("G20G91X1F60", "G21 G90").unwrap();
        assert!((jog.feed_v - 25.4).abs() < 1e-12);
    }
}
