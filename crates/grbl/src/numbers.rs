//! The numbers and units of reports, as senders read them.

use crate::AXES;

/// Millimetres of an inch.
pub(crate) const INCH_MM: f64 = 25.4;

/// The units in which lengths are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Units {
    #[default]
    Millimetre,
    Inch,
}

impl Units {
    /// A length, or an angle where the axis is rotary.
    pub(crate) fn place(self, value: f64, is_linear: bool) -> String {
        match self {
            Self::Inch if is_linear => plain(value / INCH_MM, 4),
            Self::Inch => plain(value, 4),
            Self::Millimetre => plain(value, 3),
        }
    }

    /// A vector, by these axes.
    pub(crate) fn vector(self, value: &[f64; AXES], axes: &[usize]) -> String {
        let of = |axis: &usize| {
            let value = value.get(*axis).copied().unwrap_or_default();
            self.place(value, is_linear(*axis))
        };
        let all: Vec<String> = axes.iter().map(of).collect();
        all.join(",")
    }

    /// A feed in units a minute, of mm/s.
    pub(crate) fn feed(self, feed_v: f64) -> String {
        match self {
            Self::Millimetre => plain(feed_v * 60.0, 0),
            Self::Inch => plain(feed_v * 60.0 / INCH_MM, 0),
        }
    }
}

/// A B C are rotary.
pub(crate) const fn is_linear(axis: usize) -> bool {
    !matches!(axis, 3..=5)
}

/// A number with so many decimals, and never `-0`.
pub(crate) fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
    match text.strip_prefix('-') {
        Some(rest) if is_zero => rest.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_minus_nothing() {
        assert_eq!(plain(-0.000_4, 3), "0.000");
        assert_eq!(plain(-0.000_6, 3), "-0.001");
        assert_eq!(plain(-0.4, 0), "0");
    }

    #[test]
    fn angles_are_no_lengths() {
        let mut at = [0.0; AXES];
        (at[0], at[3]) = (25.4, 25.4);
        assert_eq!(Units::Inch.vector(&at, &[0, 3]), "1.0000,25.4000");
        assert_eq!(Units::Millimetre.vector(&at, &[0, 3]), "25.400,25.400");
    }
}
