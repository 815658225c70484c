//! Tool tables: lengths and diameters by tool number.
//!
//! The file format is that of LinuxCNC (`.tbl`): one line a tool, words as in a program, a comment
//! behind `;`.
//!
//! ```text
//! T1 P1 Z51.2 D6.0 ;end mill
//! T2 P2 X-3.1 Z40 D0.8 I95 J155 Q2 ;turning tool
//! ```
//!
//! | word | meaning |
//! |---|---|
//! | T | tool number |
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
/// Most tools of a table.
pub const MAX_TOOLS: usize = 10_000;

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
            names: BTreeMap::new(),
        }
    }

    /// Reads a table.
    ///
    /// # Errors
    /// Every line that is not well formed, and tools that are in the table twice.
    pub fn parse(text: &[u8]) -> Result<Self, Vec<Diagnostic>> {
        let mut table = Self::new();
        let mut diagnostics = Vec::new();
        let mut number = 0_u32;
        for line in text.split(|byte| *byte == b'\n') {
            number = number.saturating_add(1);
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            if let Err(fault) = table.add_line(line) {
                diagnostics.push(fault.at(number, line));
            }
            if diagnostics.len() >= MAX_DIAGNOSTICS {
                break;
            }
        }
        if diagnostics.is_empty() {
            Ok(table)
        } else {
            Err(diagnostics)
        }
    }

    /// The tool of that number.
    #[must_use]
    pub fn get(&self, number: u32) -> Option<&Tool> {
        self.tools.get(&number)
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

    /// Adds a tool or replaces it.
    pub fn set(&mut self, number: u32, tool: Tool) {
        self.tools.insert(number, tool);
    }

    /// All tools, in the order of their numbers.
    pub fn tools(&self) -> impl Iterator<Item = (u32, &Tool)> {
        self.tools.iter().map(|(number, tool)| (*number, tool))
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

    fn add_line(&mut self, text: &[u8]) -> Outcome<()> {
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
                None => Ok(()),
                Some(span) => Err(BlockDiagnostic::new(
                    DiagnosticCode::ToolTable,
                    span,
                    "a tool without a number",
                )
                .because("T says which tool the line is about")
                .help("add a T word")),
            };
        };
        if self.tools.contains_key(&number) {
            let message = format!("a second line about tool {number}");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::ToolTable, span, message)
                    .because("it is not clear which of them holds")
                    .help("remove one of them"),
            );
        }
        if self.tools.len() >= MAX_TOOLS {
            let message = format!("more than {MAX_TOOLS} tools");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::ToolTable, span, message)
                    .because("the size of a tool table is bounded"),
            );
        }
        self.tools.insert(number, line.tool);
        let comment = text.iter().position(|byte| *byte == b';');
        let comment = comment
            .and_then(|at| text.get(at + 1..))
            .unwrap_or_default();
        self.name(number, &String::from_utf8_lossy(comment));
        Ok(())
    }
}

/// What a line says so far.
#[derive(Debug, Default)]
struct ToolLine {
    number: Option<(u32, SourceSpan)>,
    first: Option<SourceSpan>,
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
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::ToolTable, span, message)
                        .because("its words are T P X Y Z A B C U V W D I J Q")
                        .help("remove it, or put it behind `;`"),
                );
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
    Err(
        BlockDiagnostic::new(DiagnosticCode::ToolTable, span, message)
            .because("tools, pockets and orientations are numbered"),
    )
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
}
