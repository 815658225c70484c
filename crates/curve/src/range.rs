//! The ranges of numbers in curve files: the same as those of a configuration.

/// From the least to the largest, both allowed.
pub(crate) struct Range {
    least: f64,
    most: f64,
    unit: &'static str,
}

/// A feed below moves a micrometre a minute; one above crosses the longest travel in six
/// milliseconds.
pub(crate) const FEED_MM_MIN: Range = Range {
    least: 1e-3,
    most: 1e7,
    unit: "mm/min",
};
/// Below is the rounding of a metre, above is no curve.
pub(crate) const TOLERANCE_MM: Range = Range {
    least: 1e-5,
    most: 10.0,
    unit: "mm",
};
/// A longer chord leaves no curve, a shorter one is none of a machine's steps.
pub(crate) const CHORD_MM: Range = Range {
    least: 1e-4,
    most: 1e3,
    unit: "mm",
};

impl Range {
    /// What is wrong with a value, and how to mend it.
    pub(crate) fn refusal(&self, key: &str, value: f64) -> Option<(String, String)> {
        let Self { least, most, unit } = self;
        // Not a number is in no range.
        (!(*least..=*most).contains(&value)).then(|| {
            (
                format!("{key} = {value} {unit} is out of range"),
                format!("give {least} to {most} {unit}"),
            )
        })
    }
}
