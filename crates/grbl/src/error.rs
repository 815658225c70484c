//! The error numbers of grbl, as senders know them.

/// Why a line is refused: the number that senders know.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ErrorNumber(pub(crate) u8);

impl ErrorNumber {
    /// A word whose number is missing or malformed.
    pub(crate) const NUMBER: Self = Self(2);
    /// A `$` line that is not known, or not allowed.
    pub(crate) const STATEMENT: Self = Self(3);
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

    /// That of a line which the reader of programs has refused, by the name of its diagnostic.
    pub(crate) fn of_diagnostic(name: &str) -> Self {
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
            "soft-limit" | "machine-coordinates" | "arc-without-center" | "arc-zero-radius" => 33,
            "arc-radius-mismatch" | "arc-radius-too-small" | "arc-full-circle-with-radius" => 34,
            "unused-word" | "arc-offset-outside-plane" => 36,
            _ => 20,
        })
    }
}
