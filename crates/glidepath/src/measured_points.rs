//! The CSV file of measured points: where joints said they were, and where the tool was found.
//!
//! The first line names the columns, in any order, parted by commas, semicolons or tabs: `J0`, `J1` … for every
//! joint of the mechanism, mm or degrees, and those of `X`, `Y`, `Z`, `A`, `B`, `C` that were measured. Each further
//! line is a point. An empty cell below X to C is a coordinate that was not measured at this point. Empty lines and
//! such that begin with `#` are left out.

use crate::text_diagnostic::TextDiagnostic;
use core::ops::Range;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{JOINTS, JointVector, MeasuredPoint};

/// Largest file of points, bytes.
pub const MOST_BYTES: u64 = 4 << 20;
/// Most diagnostics that are listed.
const MOST_ROWS: usize = 20;
/// Largest number in a cell, mm or degrees.
const MOST: f64 = 1e6;

/// Points with the lines they stand in, from 1.
#[derive(Debug, Clone, PartialEq)]
pub struct PointsFile {
    /// The points.
    pub points: Vec<MeasuredPoint>,
    /// The line of each.
    pub lines: Vec<usize>,
    /// Where the text of each stands.
    spans: Vec<Range<usize>>,
}

impl PointsFile {
    /// A diagnostic of a point, from 0.
    #[must_use]
    pub fn diagnostic(
        &self,
        (name, text): (&str, &str),
        point: usize,
        message: String,
        help: &str,
    ) -> TextDiagnostic {
        let span = self.spans.get(point).cloned().unwrap_or_default();
        *TextDiagnostic::new(name, text, span, message, help)
    }
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Joint(usize),
    Measured(Axis),
}

/// A cell: where it stands without the blanks around it.
type Cell = Range<usize>;

/// What points are read for.
#[derive(Debug, Clone)]
pub struct PointsOf {
    /// How many joints have a column each.
    pub joints: usize,
    /// The machine's axes.
    pub axes: Vec<Axis>,
    /// Where the tool is about where a coordinate was not measured.
    pub home: AxisVector,
}

/// Reads the text of a file; `name` is the file's, for diagnostics.
///
/// # Errors
/// All that is to be mended, in the order of the text, and how many more there are.
pub fn parse(
    name: &str,
    text: &str,
    of: &PointsOf,
) -> Result<PointsFile, (Vec<TextDiagnostic>, u64)> {
    let mut reader = Reader {
        name,
        text,
        found: Vec::new(),
        more: 0,
    };
    let mut file = PointsFile {
        points: Vec::new(),
        lines: Vec::new(),
        spans: Vec::new(),
    };
    let mut header: Option<(char, Vec<Column>)> = None;
    let mut start = 0;
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let span = start..start + line.trim_end().len();
        start += line.len();
        let content = line.trim();
        if content.is_empty() || content.starts_with('#') {
            continue;
        }
        let Some((separator, columns)) = &header else {
            let separator = separator_of(content);
            match reader.columns(&span, separator, of) {
                Some(columns) => header = Some((separator, columns)),
                // Rows mean nothing below a header that is not understood.
                None => return Err((reader.found, reader.more)),
            }
            continue;
        };
        if let Some(point) = reader.point(&span, (*separator, columns), &of.home) {
            file.points.push(point);
            file.lines.push(number + 1);
            file.spans.push(span);
        }
    }
    if header.is_none() {
        let message = "there are no points".to_owned();
        reader.tell(
            0..0,
            message,
            "begin with a line that names the columns: J0,J1,J2,X,Y,Z",
        );
    }
    if reader.found.is_empty() {
        Ok(file)
    } else {
        Err((reader.found, reader.more))
    }
}

fn separator_of(header: &str) -> char {
    [';', '\t', ',']
        .into_iter()
        .find(|separator| header.contains(*separator))
        .unwrap_or(',')
}

struct Reader<'a> {
    name: &'a str,
    text: &'a str,
    found: Vec<TextDiagnostic>,
    more: u64,
}

impl Reader<'_> {
    fn tell(&mut self, span: Range<usize>, message: String, help: &str) {
        if self.found.len() < MOST_ROWS {
            let diagnostic = TextDiagnostic::new(self.name, self.text, span, message, help);
            self.found.push(*diagnostic);
        } else {
            self.more += 1;
        }
    }

    fn cells(&self, line: &Range<usize>, separator: char) -> Vec<Cell> {
        let mut start = line.start;
        let cells = self.text[line.clone()].split(separator);
        cells
            .map(|cell| {
                let before = cell.len() - cell.trim_start().len();
                let span = start + before..start + before + cell.trim().len();
                start += cell.len() + separator.len_utf8();
                span
            })
            .collect()
    }

    fn columns(
        &mut self,
        line: &Range<usize>,
        separator: char,
        of: &PointsOf,
    ) -> Option<Vec<Column>> {
        let mut columns: Vec<Column> = Vec::new();
        let before = self.found.len();
        for cell in self.cells(line, separator) {
            let name = &self.text[cell.clone()];
            let Some(column) = column(name) else {
                let message = format!("there is no column `{name}`");
                self.tell(cell, message, COLUMNS);
                continue;
            };
            let wrong = match column {
                _ if columns.contains(&column) => Some(format!("there are two columns {name}")),
                Column::Joint(joint) if joint >= of.joints => Some(format!(
                    "no dimension has to do with a joint {name}: those that have are J0 to J{}",
                    of.joints.saturating_sub(1)
                )),
                Column::Measured(axis) if !of.axes.contains(&axis) => {
                    Some(format!("the machine has no axis {name}"))
                }
                _ => None,
            };
            match wrong {
                Some(message) => self.tell(cell, message, "take the column out"),
                None => columns.push(column),
            }
        }
        let missing: Vec<String> = (0..of.joints)
            .filter(|joint| !columns.contains(&Column::Joint(*joint)))
            .map(|joint| format!("J{joint}"))
            .collect();
        if self.found.len() == before && !missing.is_empty() {
            let message = format!("there is no column {}", missing.join(", "));
            self.tell(line.clone(), message, COLUMNS);
        }
        let is_measured = |column: &Column| matches!(column, Column::Measured(_));
        if self.found.len() == before && !columns.iter().any(is_measured) {
            let message = "there is no column of what was measured".to_owned();
            self.tell(line.clone(), message, COLUMNS);
        }
        (self.found.len() == before).then_some(columns)
    }

    fn point(
        &mut self,
        line: &Range<usize>,
        (separator, columns): (char, &[Column]),
        home: &AxisVector,
    ) -> Option<MeasuredPoint> {
        let cells = self.cells(line, separator);
        if cells.len() != columns.len() {
            let message = format!(
                "{} cells, where the header has {}",
                cells.len(),
                columns.len()
            );
            let help = "give every column a cell; one of X to C may be empty. Numbers have a decimal point";
            self.tell(line.clone(), message, help);
            return None;
        }
        let before = self.found.len();
        let more = self.more;
        let mut point = MeasuredPoint {
            joints: JointVector::zeros(),
            measured: [None; 6],
            near: *home,
        };
        for (cell, column) in cells.into_iter().zip(columns) {
            match (column, self.number(cell)) {
                (Column::Joint(joint), Some(Some(value))) => point.joints[*joint] = value,
                (Column::Joint(joint), Some(None)) => {
                    let message = format!("J{joint} has no number");
                    self.tell(line.clone(), message, "say where the joint was");
                }
                (Column::Measured(axis), Some(Some(value))) => {
                    point.measured[axis.index()] = Some(value);
                    point.near[axis.index()] = value;
                }
                (Column::Measured(_), Some(None)) | (_, None) => {}
            }
        }
        if self.found.len() > before || self.more > more {
            return None;
        }
        if point.measured == [None; 6] {
            let message = "nothing was measured at this point".to_owned();
            self.tell(
                line.clone(),
                message,
                "give it a coordinate, or take the row out",
            );
            return None;
        }
        Some(point)
    }

    /// The number of a cell, if it has one; none if what it has is none.
    #[allow(clippy::option_option, reason = "an empty cell is no fault by itself")]
    fn number(&mut self, cell: Cell) -> Option<Option<f64>> {
        let text = &self.text[cell.clone()];
        if text.is_empty() {
            return Some(None);
        }
        match text.parse::<f64>() {
            Ok(value) if value.abs() <= MOST => Some(Some(value)),
            Ok(_) => {
                let message = format!("{text} is out of range");
                self.tell(cell, message, "give mm or degrees, from -1e6 to 1e6");
                None
            }
            Err(_) => {
                let message = format!("`{text}` is no number");
                self.tell(
                    cell,
                    message,
                    "give a number with a decimal point, such as -12.345",
                );
                None
            }
        }
    }
}

const COLUMNS: &str =
    "the columns are J0, J1 … for every joint, and those of X, Y, Z, A, B, C that were measured";

fn column(name: &str) -> Option<Column> {
    let joint = name.strip_prefix(['J', 'j']).and_then(|number| {
        let is_plain = number.len() == 1 && number.as_bytes()[0].is_ascii_digit();
        is_plain.then(|| number.parse::<usize>().ok()).flatten()
    });
    if let Some(joint) = joint {
        return (joint < JOINTS).then_some(Column::Joint(joint));
    }
    let axes = Axis::ALL.into_iter().take(6);
    let mut named = axes.filter(|axis| axis.to_string().eq_ignore_ascii_case(name));
    named.next().map(Column::Measured)
}
