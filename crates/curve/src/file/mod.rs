//! Curve files: a space curve given by formulas, as TOML.
//!
//! ```toml
//! kind = "parametric"
//! x = "20*(1 + cos(t))"       # mm; angles in radians
//! y = "20*sin(t)"
//! z = "40*sin(t/2)"
//! from = 0                    # t at the start and at the end: numbers, or formulas without variables
//! to = "4*pi"
//! feed = 3000.0               # mm/min; may be left out where the machine has a default
//! ```
//!
//! ```toml
//! kind = "implicit"
//! f = "x^2 + y^2 + z^2 - 1600"   # two surfaces, both zero on the curve
//! g = "(x - 20)^2 + y^2 - 400"
//! start = [20.0, 20.0, 28.2843]  # a point of the curve, within 0.01 mm
//! direction = [-1.0, 0.0, 0.0]   # which way to go from there, roughly
//! end = "closed"                 # or a point [x, y, z], or the length along the curve, mm
//! ```
//!
//! In both kinds, optional: `name`; `tolerance`, mm, everything included; `chord`, the longest
//! chord, mm; `laps` of a closed curve.

mod curve_file;
mod diagnostic;
mod judge;
mod raw;

pub use curve_file::{CurveFile, Shape, ShapeKey};
pub use diagnostic::FileDiagnostic;

use crate::serde_words::in_words;
use raw::Raw;

/// Keys of curve files, of formulas or of NURBS, which are words of no program.
const KEYS: [&str; 18] = [
    "kind",
    "name",
    "feed",
    "tolerance",
    "chord",
    "laps",
    "from",
    "to",
    "start",
    "direction",
    "end",
    "degree",
    "control_points",
    "weights",
    "knots",
    "units",
    "source",
    "status",
];

impl CurveFile {
    /// True if a text begins as that of a curve file, of formulas or of a NURBS: behind comments and
    /// empty lines stands JSON, or a key of such a file with a value.
    #[must_use]
    pub fn begins(text: &str) -> bool {
        let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
        let mut lines = lines.filter(|line| !(line.is_empty() || line.starts_with('#')));
        lines.next().is_some_and(|line| {
            let key = line.split('=').next().unwrap_or_default().trim();
            let has_value = line.len() > key.len();
            line.starts_with('{') || (has_value && KEYS.contains(&key))
        })
    }

    /// Reads the text of a curve file.
    ///
    /// # Errors
    /// All diagnostics, at least one.
    pub fn parse(text: &str) -> Result<Self, Vec<FileDiagnostic>> {
        let raw: Raw = toml::from_str(text).map_err(|error| {
            vec![FileDiagnostic {
                message: in_words(error.message().lines().next().unwrap_or_default()),
                help: "a curve file is TOML with the keys of its kind".to_owned(),
                at: error.span().unwrap_or(0..0),
            }]
        })?;
        judge::judge(raw)
    }
}
