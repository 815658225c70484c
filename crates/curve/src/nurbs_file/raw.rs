//! The raw file: a curve file as it is written, before any value is judged.

use crate::FileDiagnostic;
use crate::serde_words::in_words;
use core::ops::Range;
use serde::Deserialize;
use serde::de::IgnoredAny;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCurve {
    #[serde(rename = "kind")]
    _kind: Option<Kind>,
    pub(super) name: Option<String>,
    pub(super) feed: Option<f64>,
    pub(super) tolerance: Option<f64>,
    pub(super) degree: u64,
    pub(super) control_points: Vec<Vec<f64>>,
    pub(super) weights: Option<Vec<f64>>,
    pub(super) knots: Vec<f64>,
    pub(super) units: Option<String>,
    #[serde(rename = "source")]
    _source: Option<IgnoredAny>,
    #[serde(rename = "status")]
    _status: Option<IgnoredAny>,
    #[serde(rename = "note")]
    _note: Option<IgnoredAny>,
}

/// The only kind there is in these files.
#[derive(Debug, Deserialize)]
enum Kind {
    #[serde(rename = "nurbs")]
    Nurbs,
}

/// Reads JSON if the text begins with `{`, else TOML.
///
/// # Errors
/// The first thing that is not the format, not a known key, or not of the key's type.
pub(super) fn parse(text: &str) -> Result<RawCurve, Box<FileDiagnostic>> {
    let (message, at) = if text.trim_start().starts_with('{') {
        match serde_json::from_str(text) {
            Ok(raw) => return Ok(raw),
            Err(error) => {
                let at = offset(text, error.line(), error.column());
                let message = error.to_string();
                let what = message.split(" at line ").next().unwrap_or_default();
                (what.to_owned(), at)
            }
        }
    } else {
        match toml::from_str(text) {
            Ok(raw) => return Ok(raw),
            Err(error) => {
                let message = error.message().lines().next().unwrap_or_default();
                (message.to_owned(), error.span().unwrap_or(0..0))
            }
        }
    };
    let help = help(&message);
    let message = in_words(&message);
    Err(Box::new(FileDiagnostic { message, help, at }))
}

/// The known name that looks most like an unknown one, if any does.
fn nearest<'a>(unknown: &str, known: &[&'a str]) -> Option<&'a str> {
    let like = |name: &str| strsim::jaro_winkler(&unknown.to_lowercase(), name);
    let likeness = known.iter().map(|name| (like(name), *name));
    likeness
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// Byte of a line and column, both from 1.
fn offset(text: &str, line: usize, column: usize) -> Range<usize> {
    let lines = text.split_inclusive('\n').take(line.saturating_sub(1));
    let start = lines.map(str::len).sum::<usize>() + column.saturating_sub(1);
    let start = start.min(text.len());
    start..(start + 1).min(text.len())
}

/// serde gives the names between backquotes: first the one that was found, then those it knows.
fn help(message: &str) -> String {
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match names.as_slice() {
        [unknown, known @ ..] if message.starts_with("unknown field") => {
            let list = known.join(", ");
            nearest(unknown, known).map_or_else(
                || format!("the keys of a curve are: {list}"),
                |name| format!("did you mean `{name}`? The keys of a curve are: {list}"),
            )
        }
        [missing, ..] if message.starts_with("missing field") => {
            format!("add `{missing}`: a curve has degree, control_points and knots")
        }
        _ => "a curve file is TOML, or JSON in braces, with degree, control_points and knots"
            .to_owned(),
    }
}
