//! The result of a conversion: the configuration, and a verdict on every key.

use serde::Serialize;

/// The verdict on a key of the input.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct KeyVerdict {
    /// The key, as the other control writes it.
    pub key: String,
    /// Where it stands: a line, with its file if it is not the first one.
    pub place: String,
    /// Its value there.
    pub value: String,
    /// What became of it, or why nothing did.
    pub note: String,
}

/// A key of ours that the input does not say.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Asked {
    /// The key.
    pub key: String,
    /// Why it has to be written, and what to think of.
    pub why: String,
}

/// A configuration of another control as ours.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Conversion {
    /// The configuration, with comments, and the lists behind it.
    pub configuration: String,
    /// Keys that mean the same here.
    pub converted: Vec<KeyVerdict>,
    /// Keys that mean something else here.
    pub changed: Vec<KeyVerdict>,
    /// Keys that nothing here corresponds to.
    pub no_counterpart: Vec<KeyVerdict>,
    /// Keys of ours that have to be written before the configuration loads.
    pub asked: Vec<Asked>,
}
