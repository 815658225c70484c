//! The conversion of a measured screw: a table of positions and what was measured there, to `[compensation.J0]`.
//!
//! The input is LinuxCNC's compensation file (`COMP_FILE`: nominal, forward, reverse), or the columns of a laser or a
//! gauge, apart by semicolons, commas, or spaces and tabs. Lines that begin with `#` or `;`, and words above the table, are none
//! of it; every row has as many columns as the first.

use crate::draft::float;
use crate::ini::ReadError;
use std::fmt::Write as _;

/// What the second and third column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScrewValues {
    /// Where the carriage was when it was told to be at the first column: LinuxCNC's `COMP_FILE_TYPE = 0`.
    Measured,
    /// How far beyond the first column it was.
    Errors,
    /// What is to be added to the first column: LinuxCNC's `COMP_FILE_TYPE = 1`.
    Trims,
}

/// Measured values that are further than this from their positions are none, in the unit of the file.
const FARTHEST: f64 = 10.0;

/// The table of a joint, in TOML, from that of a measurement in units of so many mm (or degrees).
///
/// # Errors
/// A line that is no row of the table.
pub fn from_screw(
    text: &str,
    joint: usize,
    values: ScrewValues,
    mm_per_unit: f64,
) -> Result<String, ReadError> {
    let mut rows: Vec<[f64; 3]> = Vec::new();
    let mut columns = None;
    for (line, number) in text.trim_start_matches('\u{feff}').lines().zip(1_usize..) {
        let line = line.trim();
        if line.is_empty() || line.starts_with(['#', ';']) || is_heading(line, &rows) {
            continue;
        }
        let at = |reason| ReadError {
            place: format!("line {number}"),
            reason,
        };
        let (row, count) = row(line, values).map_err(at)?;
        if *columns.get_or_insert(count) != count {
            let reason = "another number of columns than the rows before: give every row its value down, or none";
            return Err(at(reason.to_owned()));
        }
        rows.push(row.map(|value| value * mm_per_unit));
    }
    let is_two_way = columns == Some(3);
    if rows.len() < 2 {
        return Err(ReadError {
            place: "the file".to_owned(),
            reason: format!("{} rows with numbers: a table has two at least", rows.len()),
        });
    }
    rows.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let column = |k: usize| {
        let values: Vec<String> = rows.iter().map(|row| rounded(row[k])).collect();
        values.join(", ")
    };
    let mut toml = format!("[compensation.J{joint}]\n");
    // Writing to a String does not fail.
    let _ = writeln!(toml, "positions = [{}]", column(0));
    let _ = writeln!(toml, "corrections = [{}]", column(1));
    if is_two_way {
        let _ = writeln!(toml, "corrections_down = [{}]", column(2));
    }
    Ok(toml)
}

/// A tenth of a nanometre is enough, and reads better than sixteen digits.
fn rounded(value: f64) -> String {
    let value = (value * 1e7).round() / 1e7;
    // No sign of nothing.
    float(value + 0.0)
}

/// A line of words above the table.
fn is_heading(line: &str, rows: &[[f64; 3]]) -> bool {
    let mut words = line.split(|c: char| c.is_whitespace() || c == ',' || c == ';');
    rows.is_empty()
        && line.starts_with(char::is_alphabetic)
        && !words.any(|word| word.parse::<f64>().is_ok())
}

/// The fields of a row: apart by semicolons, else by commas, else by spaces and tabs.
fn fields(line: &str) -> Vec<&str> {
    let between = [';', ','].into_iter().find(|sign| line.contains(*sign));
    match between {
        Some(sign) => line.split(sign).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

/// A number as it is written, which `003` is not: that is what a decimal comma leaves.
fn number(word: &str) -> Result<f64, String> {
    if word.is_empty() {
        return Err("a field is empty".to_owned());
    }
    let digits = word.trim_start_matches(['+', '-']).as_bytes();
    let is_rest = matches!(digits, [b'0', next, ..] if next.is_ascii_digit());
    if word.contains(',') || is_rest {
        return Err(format!(
            "`{word}` is no number; a decimal sign is a point here"
        ));
    }
    let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("`{word}` is no number"))
}

/// Position and corrections up and down, and how many columns there are.
fn row(line: &str, values: ScrewValues) -> Result<([f64; 3], usize), String> {
    let fields = fields(line);
    let numbers: Result<Vec<f64>, String> = fields.iter().map(|word| number(word)).collect();
    let numbers = numbers?;
    let (at, up, down) = match *numbers {
        [at, up] => (at, up, None),
        [at, up, down] => (at, up, Some(down)),
        _ => {
            return Err(format!(
                "{} columns; a row is a position and one or two values",
                numbers.len()
            ));
        }
    };
    let correction = |value: f64| match values {
        ScrewValues::Measured => at - value,
        ScrewValues::Errors => -value,
        ScrewValues::Trims => value,
    };
    let [up, down] = [correction(up), correction(down.unwrap_or(up))];
    let far = [up, down].into_iter().find(|value| value.abs() > FARTHEST);
    if let Some(far) = far {
        return Err(format!(
            "a correction of {far} at {at}: other values than were said? (measured positions, errors or trims)"
        ));
    }
    Ok(([at, up, down], fields.len()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;

    #[test]
    fn the_file_of_linuxcnc_is_a_table() {
        // nominal, forward, reverse, as its documentation has it.
        let text = "# X of the mill\n0.0 0.0 -0.0015\n100 100.003 100.001\n50, 49.998, 49.9965\n";
        let toml = from_screw(text, 0, ScrewValues::Measured, 1.0).unwrap();
        assert_eq!(
            toml,
            "[compensation.J0]\npositions = [0.0, 50.0, 100.0]\n\
             corrections = [0.0, 0.002, -0.003]\ncorrections_down = [0.0015, 0.0035, -0.001]\n"
        );
    }

    #[test]
    fn errors_trims_and_inches_mean_what_they_say() {
        let text = "position,error\n-1 0.0002\n1 -0.0001\n";
        let toml = from_screw(text, 2, ScrewValues::Errors, 25.4).unwrap();
        assert_eq!(
            toml,
            "[compensation.J2]\npositions = [-25.4, 25.4]\ncorrections = [-0.00508, 0.00254]\n"
        );
        let toml = from_screw(text, 2, ScrewValues::Trims, 25.4).unwrap();
        assert!(toml.contains("corrections = [0.00508, -0.00254]"), "{toml}");
    }

    #[test]
    fn what_is_no_table_is_told_by_its_line() {
        let of = |text: &str| from_screw(text, 0, ScrewValues::Errors, 1.0).unwrap_err();
        assert_eq!(of("0 0\n1 x\n").to_string(), "line 2: `x` is no number");
        assert!(of("0 0 0 0\n").to_string().contains("4 columns"));
        assert!(of("0 0\n").to_string().contains("two at least"));
        for (text, words) in [
            ("O 0.001\n0 0\n1 0\n", "`O` is no number"),
            ("0 0 0.01\n100 0.003\n", "another number of columns"),
            ("0;0,003\n100;0,004\n", "a decimal sign is a point"),
            ("0,003\n100,004\n", "a decimal sign is a point"),
            ("100,000 0.003\n", "no number"),
            ("0,,0.001\n", "a field is empty"),
        ] {
            let told = of(text).to_string();
            assert!(told.contains(words), "{text}: {told}");
        }
        assert!(from_screw("\u{feff}0,0\n1,0\n", 0, ScrewValues::Errors, 1.0).is_ok());
        // Measured positions given as errors.
        assert!(
            of("0 0\n100 100.003\n")
                .to_string()
                .contains("other values")
        );
    }
}
