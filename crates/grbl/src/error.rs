//! The error numbers of grbl, as senders know them.

use crate::words::Word;

/// Why a line is refused: the number that senders know.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ErrorNumber(pub(crate) u8);

impl ErrorNumber {
    /// A word whose number is missing or malformed.
    pub(crate) const NUMBER: Self = Self(2);
    /// A `$` line that is not known, or not allowed.
    pub(crate) const STATEMENT: Self = Self(3);
    /// A number that may not be negative.
    pub(crate) const NEGATIVE: Self = Self(4);
    /// There is no home to be found.
    pub(crate) const NO_HOMING: Self = Self(5);
    /// Not in this state.
    pub(crate) const NOT_IDLE: Self = Self(8);
    /// The machine is locked: alarm, or it is moved by hand.
    pub(crate) const LOCKED: Self = Self(9);
    /// The line is too long.
    pub(crate) const TOO_LONG: Self = Self(11);
    /// A jog beyond the travel.
    pub(crate) const JOG_TRAVEL: Self = Self(15);
    /// A jog that is not understood.
    pub(crate) const JOG: Self = Self(16);
    /// A feedrate is missing.
    pub(crate) const NO_FEED: Self = Self(22);
    /// Axis words are missing.
    pub(crate) const NO_AXES: Self = Self(26);

    /// G43.1 without a length.
    pub(crate) const NO_LENGTH: Self = Self(37);
    /// What is not supported.
    pub(crate) const UNSUPPORTED: Self = Self(20);

    /// That of a line which the reader of programs has refused, by the name of its diagnostic and the words of the line.
    pub(crate) fn of_refusal(name: &str, words: &[Word]) -> Self {
        let has = |code: f64| {
            let is_it = |word: &Word| word.letter == 'G' && word.value == Some(code);
            words.iter().any(is_it)
        };
        let is_negative = |word: &Word| {
            matches!(word.letter, 'F' | 'N' | 'P' | 'S' | 'T')
                && word.value.is_some_and(|value| value < 0.0)
        };
        match name {
            "bad-feed" | "number-out-of-range" | "invalid-value"
                if words.iter().any(is_negative) =>
            {
                Self::NEGATIVE
            }
            "invalid-value" if has(10.0) => Self(29),
            "missing-word" if [92.0, 38.2, 38.3, 38.4, 38.5].into_iter().any(has) => Self::NO_AXES,
            name => Self::of_diagnostic(name),
        }
    }

    /// Likewise, by the name alone.
    fn of_diagnostic(name: &str) -> Self {
        Self(match name {
            "bad-character" | "non-ascii-character" | "nul-byte" | "stray-percent" => 1,
            "malformed-number" | "missing-number" | "expression" | "arithmetic" => 2,
            "line-too-long" | "endless-line" => 11,
            "modal-group-conflict" => 21,
            "missing-feed" | "bad-feed" => 22,
            "not-an-integer" => 23,
            "axis-words-conflict" => 24,
            "duplicate-word" => 25,
            "number-out-of-range" | "invalid-value" => 27,
            "missing-word" => 28,
            "no-motion-mode" => 31,
            "machine-coordinates" => 30,
            "soft-limit"
            | "arc-radius-mismatch"
            | "arc-zero-radius"
            | "arc-full-circle-with-radius" => 33,
            "arc-radius-too-small" => 34,
            "arc-without-center" => 35,
            "unused-word" | "arc-offset-outside-plane" => 36,
            _ => 20,
        })
    }
}
