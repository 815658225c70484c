//! The values of `[path]` on the command line, judged like those of a file.

use super::path::{EFFORTS, TOLERANCE};
use super::values::Judge;
use glidepath_link::TOLERANCE_RATIOS;
use glidepath_program::Effort;
use toml::Spanned;

/// `path.effort` by its name.
///
/// # Errors
/// How to mend it.
pub fn effort(name: &str) -> Result<Effort, String> {
    let mut judge = Judge {
        diagnostics: Vec::new(),
    };
    let name = Spanned::new(0..0, name.to_owned());
    let effort = judge.choice("path.effort", Some(name), &EFFORTS);
    found_right(effort, judge)
}

/// `path.tolerance`, mm, as it is written.
///
/// # Errors
/// How to mend it.
pub fn tolerance(text: &str) -> Result<f64, String> {
    let number: f64 = text
        .parse()
        .map_err(|_| "give a number of mm, such as 0.02".to_owned())?;
    let mut judge = Judge {
        diagnostics: Vec::new(),
    };
    let tolerance = judge.number("path.tolerance", &Spanned::new(0..0, number), &TOLERANCE);
    found_right(tolerance, judge)
}

/// How many times its tolerance a program may use, as it is written.
///
/// # Errors
/// How to mend it.
pub fn tolerance_ratio(text: &str) -> Result<f64, String> {
    let ratio = text.parse().ok();
    ratio
        .filter(|ratio| TOLERANCE_RATIOS.contains(ratio))
        .ok_or_else(|| "give a number from 0.1 to 10, such as 2 for twice the tolerance".to_owned())
}

/// The value, unless something is wrong with it.
fn found_right<T>(value: T, judge: Judge) -> Result<T, String> {
    match judge.diagnostics.into_iter().next() {
        None => Ok(value),
        Some(diagnostic) => Err(diagnostic.help.unwrap_or(diagnostic.message)),
    }
}
