//! The raw file: its keys as they are written, before any value is judged.

use serde::Deserialize;
use toml::Spanned;

/// A key that may be left out, with its bytes in the text.
pub(super) type Key<T> = Option<Spanned<T>>;

/// The file as it is written, before any value is judged.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Raw {
    pub(super) kind: Spanned<String>,
    pub(super) name: Option<String>,
    pub(super) feed: Key<f64>,
    pub(super) tolerance: Key<f64>,
    pub(super) chord: Key<f64>,
    pub(super) laps: Key<i64>,
    pub(super) x: Key<String>,
    pub(super) y: Key<String>,
    pub(super) z: Key<String>,
    pub(super) from: Key<Number>,
    pub(super) to: Key<Number>,
    pub(super) f: Key<String>,
    pub(super) g: Key<String>,
    pub(super) start: Key<[f64; 3]>,
    pub(super) direction: Key<[f64; 3]>,
    pub(super) end: Key<RawEnd>,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Number {
    Value(f64),
    Formula(String),
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum RawEnd {
    Word(String),
    Point([f64; 3]),
    Length(f64),
}
