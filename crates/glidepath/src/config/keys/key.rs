//! The description of a key of the configuration: what it takes, and what holds without it.

use core::fmt::Write as _;
use serde::Serialize;

/// The values that a key takes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Takes {
    /// A number in a range, both ends included.
    Number {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Its unit; empty for a ratio.
        unit: &'static str,
    },
    /// Three of them.
    ThreeNumbers {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Their unit.
        unit: &'static str,
    },
    /// A list of numbers, each in a range, both ends included.
    Numbers {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Their unit.
        unit: &'static str,
    },
    /// A whole number in a range, both ends included.
    Whole {
        /// Smallest value.
        min: i64,
        /// Largest value.
        max: i64,
        /// Its unit; empty for a count.
        unit: &'static str,
    },
    /// One of several names.
    Choice {
        /// The names.
        of: &'static [&'static str],
    },
    /// true or false.
    Flag,
    /// Text.
    Text {
        /// What it may be.
        rule: &'static str,
    },
    /// A list of texts.
    Texts {
        /// What each may be.
        rule: &'static str,
    },
}

/// The value that holds where a key is left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LeftOut {
    /// The file is refused.
    Refused,
    /// This value, as it is written in TOML.
    Value(&'static str),
    /// What the words say.
    Means(&'static str),
}

/// One key.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Key {
    /// Its dotted name. `axis.X` stands for each axis, `joint.J0` for each joint.
    pub name: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// What holds without it.
    pub left_out: LeftOut,
    /// What it means.
    pub meaning: &'static str,
}

pub(super) const fn number(min: f64, max: f64, unit: &'static str) -> Takes {
    Takes::Number { min, max, unit }
}

pub(super) const fn key(
    name: &'static str,
    takes: Takes,
    left_out: LeftOut,
    meaning: &'static str,
) -> Key {
    Key {
        name,
        takes,
        left_out,
        meaning,
    }
}

impl Takes {
    /// The unit, empty if there is none.
    #[must_use]
    pub const fn unit(&self) -> &'static str {
        match self {
            Self::Number { unit, .. }
            | Self::ThreeNumbers { unit, .. }
            | Self::Numbers { unit, .. }
            | Self::Whole { unit, .. } => unit,
            Self::Choice { .. } | Self::Flag | Self::Text { .. } | Self::Texts { .. } => "",
        }
    }

    /// What it takes, in words.
    #[must_use]
    pub fn words(&self) -> String {
        let with_unit = |mut words: String| {
            if !self.unit().is_empty() {
                let _ = write!(words, " {}", self.unit());
            }
            words
        };
        match self {
            Self::Number { min, max, .. } => with_unit(format!("{min} to {max}")),
            Self::ThreeNumbers { min, max, .. } => {
                with_unit(format!("three numbers, each {min} to {max}"))
            }
            Self::Numbers { min, max, .. } => {
                with_unit(format!("a list of numbers, each {min} to {max}"))
            }
            Self::Whole { min, max, .. } => with_unit(format!("a whole number, {min} to {max}")),
            Self::Choice { of } => {
                let names: Vec<String> = of.iter().map(|name| format!("\"{name}\"")).collect();
                names.join(" or ")
            }
            Self::Flag => "true or false".to_owned(),
            Self::Text { rule } => (*rule).to_owned(),
            Self::Texts { rule } => format!("a list, each {rule}"),
        }
    }
}

impl LeftOut {
    /// What holds without the key, in words.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Refused => "has to be given".to_owned(),
            Self::Value(value) => format!("default {value}"),
            Self::Means(words) => format!("left out: {words}"),
        }
    }
}
