//! Tool tables: lengths and diameters by tool number.
//!
//! The file format is that of LinuxCNC (`.tbl`): one line a tool, words as in a program, a comment
//! behind `;`. E, which LinuxCNC does not know, gives a tool another edge in a line of its own.
//!
//! ```text
//! T1 P1 Z51.2 D6.0 ;end mill
//! T2 P2 X-3.1 Z40 D0.8 I95 J155 Q2 ;turning tool
//! T2 E2 X-6.1 Z40 D0.8 Q3 ;its other side
//! ```
//!
//! | word | meaning |
//! |---|---|
//! | T | tool number |
//! | E | edge, which D of SINUMERIK chooses; 1, or none: the first one, which is the tool of the other languages |
//! | P | pocket |
//! | X Y Z A B C U V W | length offsets, mm and degrees |
//! | D | diameter, mm; negative: the tool is on the other side of the path |
//! | I J | front and back angle of a turning tool, degrees; read and not used |
//! | Q | orientation of a turning tool, 0 to 9 |

use std::collections::BTreeMap;

use glidepath_geometry::AxisVector;
use serde::{Deserialize, Serialize};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::diagnostic::{Diagnostic, MAX_DIAGNOSTICS};
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::cursor::Cursor;
use crate::syntax::letters::AXIS_LETTERS;

/// Largest tool number.
pub(crate) const MAX_TOOL: u32 = 999_999;
/// Most tools of a table, and most edges beyond the first ones.
pub const MAX_TOOLS: usize = 10_000;
/// Largest number of an edge, which is that of D of SINUMERIK (MD 18105).
pub(crate) const MAX_EDGE: u32 = 32_000;

/// A tool.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Tool {
    /// Length offsets: what is added to program coordinates while they are in force; mm, degrees.
    pub offset: AxisVector,
    /// Diameter, mm. Negative: as if the tool were on the other side of the path.
    pub diameter_mm: f64,
    /// Where the tip of a turning tool is, seen from the centre of its radius: 1 to 8 in LinuxCNC's
    /// numbering; 0 and 9: at the centre.
    pub orientation: u8,
}

/// Longest name of a tool, bytes; a longer comment is none.
const MAX_NAME: usize = 64;

/// Tools by number.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ToolTable {
    tools: BTreeMap<u32, Tool>,
    /// The edges of each tool beyond its first one, by their numbers.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    edges: BTreeMap<u32, BTreeMap<u32, Tool>>,
    /// Names of tools, in capitals, as the comments of their lines have them; `None`: of several.
    #[serde(default)]
    names: BTreeMap<String, Option<u32>>,
}

impl ToolTable {
    /// A table without tools.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            tools: BTreeMap::new(),
            edges: BTreeMap::new(),
            names: BTreeMap::new(),
        }
    }

    /// Reads a table.
    ///
    /// # Errors
    /// Every line that is not well formed, tools and edges that are in the table twice, and edges of tools that
    /// are not in it.
    pub fn parse(text: &[u8]) -> Result<Self, Vec<Diagnostic>> {
        let mut table = Self::new();
        let mut diagnostics = Vec::new();
        let mut edges = Vec::new();
        let mut number = 0_u32;
        for line in text.split(|byte| *byte == b'\n') {
            number = number.saturating_add(1);
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            match table.add_line(line) {
                Ok(edge) => edges.extend(edge.map(|(tool, span)| (tool, span, number, line))),
                Err(fault) => diagnostics.push(fault.at(number, line)),
            }
            if diagnostics.len() >= MAX_DIAGNOSTICS {
                break;
            }
        }
        if diagnostics.is_empty() {
            let alone = edges.iter().filter(|(tool, ..)| table.get(*tool).is_none());
            let diagnostic = |(tool, span, number, line): &(u32, SourceSpan, u32, &[u8])| {
                without_first_edge(*tool, *span).at(*number, line)
            };
            diagnostics.extend(alone.map(diagnostic).take(MAX_DIAGNOSTICS));
        }
        if diagnostics.is_empty() {
            Ok(table)
        } else {
            Err(diagnostics)
        }
    }

    /// The tool of that number: its first edge.
    #[must_use]
    pub fn get(&self, number: u32) -> Option<&Tool> {
        self.tools.get(&number)
    }

    /// An edge of a tool; 1 is the first one.
    #[must_use]
    pub fn edge(&self, number: u32, edge: u32) -> Option<&Tool> {
        if edge == 1 {
            return self.get(number);
        }
        self.edges.get(&number)?.get(&edge)
    }

    /// The number of the tool whose line has that name behind `;`, in capitals or not; `None` also
    /// where several have it.
    #[must_use]
    pub fn named(&self, name: &str) -> Option<u32> {
        let name = name.trim().to_uppercase();
        match self.names.get(&name) {
            Some(entry) => *entry,
            // A tool without a name is called by its number.
            None => name
                .parse()
                .ok()
                .filter(|number: &u32| number.to_string() == name && self.get(*number).is_some()),
        }
    }

    /// Gives a tool a name.
    pub fn name(&mut self, number: u32, name: &str) {
        let name = name.trim().to_uppercase();
        if !name.is_empty() && name.len() <= MAX_NAME {
            let entry = self.names.entry(name).or_insert(Some(number));
            *entry = entry.filter(|known| *known == number);
        }
    }

    /// Adds a tool or replaces its first edge.
    pub fn set(&mut self, number: u32, tool: Tool) {
        self.tools.insert(number, tool);
    }

    /// Adds an edge of a tool or replaces it; 1 is the first one.
    pub fn set_edge(&mut self, number: u32, edge: u32, tool: Tool) {
        if edge == 1 {
            self.set(number, tool);
        } else {
            self.edges.entry(number).or_default().insert(edge, tool);
        }
    }

    /// All tools, in the order of their numbers, with their first edges.
    pub fn tools(&self) -> impl Iterator<Item = (u32, &Tool)> {
        self.tools.iter().map(|(number, tool)| (*number, tool))
    }

    /// All edges: the number of the tool, that of the edge, and the edge.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32, &Tool)> {
        let first = self.tools().map(|(number, tool)| (number, 1, tool));
        first.chain(self.edges.iter().flat_map(|(number, edges)| {
            let of_tool = edges.iter();
            of_tool.map(|(edge, tool)| (*number, *edge, tool))
        }))
    }

    /// Number of tools.
    #[must_use]
    pub fn len(&self) -> usize {
        self.tools.len()
    }

    /// True without tools.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tools.is_empty()
    }

    /// Adds what a line says; gives the tool of an edge beyond the first one, and where it is named.
    fn add_line(&mut self, text: &[u8]) -> Outcome<Option<(u32, SourceSpan)>> {
        let mut line = ToolLine::default();
        let mut cursor = Cursor::new(text);
        while let Some(byte) = cursor.next_visible() {
            match byte.to_ascii_uppercase() {
                b';' => break,
                letter @ b'A'..=b'Z' => line.word(&mut cursor, letter)?,
                _ => return Err(bad_byte(text, cursor.at())),
            }
        }
        let Some((number, span)) = line.number else {
            return match line.first {
                None => Ok(None),
                Some(span) => Err(fault(span, "a tool without a number")
                    .because("T says which tool the line is about")
                    .help("add a T word")),
            };
        };
        let edge = line.edge.unwrap_or(1);
        if self.edge(number, edge).is_some() {
            let message = match edge {
                1 => format!("a second line about tool {number}"),
                edge => format!("a second line about edge {edge} of tool {number}"),
            };
            return Err(fault(span, message)
                .because("it is not clear which of them holds")
                .help("remove one of them, or say by E which edge of the tool it is"));
        }
        let count = match edge {
            1 => self.tools.len(),
            _ => self.edges.values().map(BTreeMap::len).sum(),
        };
        if count >= MAX_TOOLS {
            let message = format!("more than {MAX_TOOLS} tools");
            return Err(fault(span, message).because("the size of a tool table is bounded"));
        }
        self.set_edge(number, edge, line.tool);
        if edge != 1 {
            return Ok(Some((number, span)));
        }
        let comment = text.iter().position(|byte| *byte == b';');
        let comment = comment
            .and_then(|at| text.get(at + 1..))
            .unwrap_or_default();
        self.name(number, &String::from_utf8_lossy(comment));
        Ok(None)
    }
}

fn fault(span: SourceSpan, message: impl Into<String>) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::ToolTable, span, message.into())
}

#[cold]
fn without_first_edge(tool: u32, span: SourceSpan) -> Box<BlockDiagnostic> {
    fault(
        span,
        format!("a further edge of tool {tool}, which has no first one"),
    )
    .because("the line of a tool without E is the tool, and its first edge")
    .help(format!("add a line `T{tool}` with its length and diameter"))
}

/// What a line says so far.
#[derive(Debug, Default)]
struct ToolLine {
    number: Option<(u32, SourceSpan)>,
    first: Option<SourceSpan>,
    edge: Option<u32>,
    tool: Tool,
}

impl ToolLine {
    fn word(&mut self, cursor: &mut Cursor<'_>, letter: u8) -> Outcome<()> {
        let start = cursor.at();
        cursor.advance();
        let value = cursor.number(start)?;
        let span = SourceSpan::new(start, cursor.end_of_word());
        self.first.get_or_insert(span);
        if let Some(axis) = AXIS_LETTERS.iter().position(|axis| *axis == letter) {
            self.tool.offset[axis] = value;
            return Ok(());
        }
        match letter {
            b'T' => self.number = Some((whole(value, MAX_TOOL, span)?, span)),
            b'D' => self.tool.diameter_mm = value,
            b'E' => {
                let edge = whole(value, MAX_EDGE, span)?;
                if edge == 0 {
                    return Err(fault(span, "E0 is no edge")
                        .because("D0 of a program takes a tool without any edge")
                        .help("count the edges of a tool from 1"));
                }
                self.edge = Some(edge);
            }
            b'Q' => {
                let orientation = whole(value, 9, span)?;
                self.tool.orientation = u8::try_from(orientation).unwrap_or_default();
            }
            b'P' => {
                whole(value, MAX_TOOL, span)?;
            }
            b'I' | b'J' => {}
            _ => {
                let message = format!("a tool table has no {} word", char::from(letter));
                return Err(fault(span, message)
                    .because("its words are T E P X Y Z A B C U V W D I J Q")
                    .help("remove it, or put it behind `;`"));
            }
        }
        Ok(())
    }
}

/// A whole number from 0 to `max`.
fn whole(value: f64, max: u32, span: SourceSpan) -> Outcome<u32> {
    if value.fract() == 0.0 && (0.0..=f64::from(max)).contains(&value) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        return Ok(value as u32);
    }
    let message = format!("{value} is no whole number from 0 to {max}");
    Err(fault(span, message).because("tools, edges, pockets and orientations are numbered"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_words_in_any_order_and_comments() {
        let text = b"; tools\r\nT1 P3 D6 Z51.25 ;mill T9\r\n\r\nz-2 x1 q2 T22 i95 j155 d-.8\n";
        let table = ToolTable::parse(text).expect("a table");
        assert_eq!(table.len(), 2);
        let mill = table.get(1).expect("tool 1");
        assert!((mill.offset[2] - 51.25).abs() < 1e-15 && (mill.diameter_mm - 6.0).abs() < 1e-15);
        let turning = table.get(22).expect("tool 22");
        assert_eq!(turning.orientation, 2);
        assert!((turning.offset[0] - 1.0).abs() < 1e-15 && (turning.offset[2] + 2.0).abs() < 1e-15);
        assert!(table.get(9).is_none());
        assert_eq!(
            (table.named("MILL t9"), table.named("mill")),
            (Some(1), None)
        );
    }

    #[test]
    fn every_bad_line_is_found() {
        let text = b"T1 Z1\nZ5\nT1.5\nT2 Q10\nT3 S5\nT1 D3\nT4 Zx\nT5 (no)\n";
        let diagnostics = ToolTable::parse(text).expect_err("diagnostics");
        let lines: Vec<_> = diagnostics.iter().map(|f| (f.line, f.column)).collect();
        assert_eq!(
            lines,
            [(2, 1), (3, 1), (4, 4), (5, 4), (6, 1), (7, 4), (8, 4)]
        );
    }

    #[test]
    fn an_edge_is_neither_a_tool_nor_a_second_line() {
        let text = b"T2 E2 Z40 D10 ;upper side\nT1 E1 Z5 ;mill\nT2 Z30 D8 ;groover\nT2 E3 Z1\n";
        let table = ToolTable::parse(text).expect("a table");
        assert_eq!(table.len(), 2);
        let edge = |number, edge| table.edge(number, edge).map(|tool| tool.offset[2]);
        assert_eq!(
            [edge(1, 1), edge(2, 1), edge(2, 2), edge(2, 3), edge(1, 2)],
            [Some(5.0), Some(30.0), Some(40.0), Some(1.0), None]
        );
        assert_eq!(table.get(2).map(|tool| tool.diameter_mm), Some(8.0));
        assert_eq!(
            (table.named("groover"), table.named("upper side")),
            (Some(2), None)
        );
        let all: Vec<(u32, u32)> = table.edges().map(|(tool, edge, _)| (tool, edge)).collect();
        assert_eq!(all, [(1, 1), (2, 1), (2, 2), (2, 3)]);
        let written = serde_json::to_string(&table).expect("text");
        assert_eq!(
            serde_json::from_str::<ToolTable>(&written).ok(),
            Some(table)
        );
    }

    #[test]
    fn edges_without_a_tool_twice_or_without_a_number_are_found() {
        let find = |text: &[u8]| -> Vec<(u32, u32)> {
            let diagnostics = ToolTable::parse(text).expect_err("diagnostics");
            diagnostics.iter().map(|f| (f.line, f.column)).collect()
        };
        assert_eq!(find(b"T1 Z1\nZ3 T2 E2\nT3 E2 Z1\n"), [(2, 4), (3, 1)]);
        let twice = b"T1 Z1\nT1 E2 Z1\nT1 E2 Z2\nT1 E1\nT1 E0\nT1 E1.5\nT1 E32001\n";
        assert_eq!(find(twice), [(3, 1), (4, 1), (5, 4), (6, 4), (7, 4)]);
    }
}
