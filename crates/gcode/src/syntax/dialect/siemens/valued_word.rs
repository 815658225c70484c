//! Words whose values are written in a way of their own: polar coordinates, tools by their names,
//! tolerances.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::statement::name_at;
use crate::syntax::dialect::siemens::system_index::Index;
use crate::syntax::dialect::siemens::writer::Writer;
use crate::syntax::named_word::Named;
use crate::syntax::word_check::missing;

impl Writer<'_> {
    /// `AP=30`, `AP=AC(30)`, `AP=IC(30)`, which is added to the last one; RP likewise.
    pub(super) fn polar_value(&mut self, start: usize, name: &[u8]) -> Outcome<()> {
        let letter = Named::of_name(name).map_or(b'Q', Named::letter);
        self.input.at = start + name.len();
        self.input.eat(b'=');
        self.input.next_visible();
        let way = self.input.name_ahead();
        let last = match way.as_slice() {
            b"IC" => self.names.scope.system_value(name, &[]).unwrap_or(0.0),
            b"AC" => 0.0,
            _ => return self.value_of(start, name.len(), &[b',', letter], 0.0),
        };
        let span = SourceSpan::new(self.input.at, self.input.at + way.len());
        self.input.at += way.len();
        let arguments = self.input.arguments()?;
        let [Some(value)] = arguments.as_slice() else {
            return Err(missing(span, "AC or IC", "( )", "one value in parentheses"));
        };
        self.put(start, &[b',', letter, b'['], last + value);
        Ok(())
    }

    /// True if a text stands behind the `=` of a letter.
    pub(super) fn is_text_assigned(&self) -> bool {
        let rest = self.input.text.get(self.input.at + 1..).unwrap_or_default();
        let behind = rest.trim_ascii_start().strip_prefix(b"=");
        behind.is_some_and(|behind| {
            let value = behind.trim_ascii_start();
            let name = name_at(value, 0).to_ascii_uppercase();
            value.starts_with(b"\"") || self.names.variables.text(&name).is_some()
        })
    }

    /// `T="NAME"`: the tool of that name in the tool table.
    pub(super) fn tool_by_name(&mut self, start: usize) -> Outcome<()> {
        self.input.at = start + 1;
        self.input.eat(b'=');
        self.input.next_visible();
        let open = self.input.at;
        let name = String::from_utf8_lossy(&self.input.text_value()?).into_owned();
        let span = SourceSpan::new(open, self.input.at);
        let Some(number) = self.names.scope.tool_named(&name) else {
            let message = format!("the tool table has no tool \"{name}\", or several");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::UnknownTool, span, message)
                    .because("the name of a tool stands in its line of the tool table, behind `;`")
                    .help(format!(
                        "write `;{name}` behind its words there, or its number here"
                    )),
            );
        };
        self.out.push(format!("T{number} ").as_bytes(), start);
        Ok(())
    }

    /// `SPOS[1]=90`.
    pub(super) fn spindle_angle(&mut self, start: usize) -> Outcome<()> {
        self.input.at = start + b"SPOS".len();
        let index = self.input.system_index()?;
        let span = SourceSpan::new(start, self.input.at);
        if index != [Index::Value(1.0)] || !self.input.eat(b'=') {
            return Err(other_spindle("SPOS", span));
        }
        let value = self.input.value()?;
        self.put(start, &[b',', Named::SpindleAngle.letter(), b'['], value);
        Ok(())
    }

    /// `SETMS`, `SETMS(1)`: the spindle that there is.
    pub(super) fn master_spindle(&mut self, start: usize, length: usize) -> Outcome<()> {
        self.input.at = start + length;
        let is_first = match self.input.next_visible() {
            Some(b'(') => matches!(self.input.arguments()?.as_slice(), [] | [Some(1.0) | None]),
            _ => true,
        };
        if is_first {
            return Ok(());
        }
        Err(other_spindle(
            "SETMS",
            SourceSpan::new(start, self.input.at),
        ))
    }

    /// `FGROUP(X,Y,Z)`, `FGROUP()`: the axes that F counts for, where they are those that it counts for
    /// anyway.
    pub(super) fn feed_group(&mut self, start: usize, length: usize) -> Outcome<()> {
        self.input.at = start + length;
        let mut axes = Vec::new();
        if !self.input.eat(b'(') {
            let span = SourceSpan::new(start, start + length);
            return Err(missing(span, "FGROUP", "( )", "the axes that F counts for"));
        }
        let mut is_known = true;
        while is_known && !self.input.eat(b')') {
            self.input.next_visible();
            let name = self.input.name_ahead();
            self.input.at += name.len();
            let ends = matches!(self.input.next_visible(), Some(b',' | b')'));
            is_known =
                matches!(name.as_slice(), b"X" | b"Y" | b"Z") && ends && !axes.contains(&name);
            axes.push(name);
            self.input.eat(b',');
        }
        let is_lathe = self.names.scope.system_value(b"LATHE", &[]) == Some(1.0);
        let all = if is_lathe { 2 } else { 3 };
        if is_known && (axes.is_empty() || axes.len() == all) {
            return Ok(());
        }
        let span = SourceSpan::new(start, self.input.at);
        let message = "FGROUP of other axes than X, Y and Z is not supported";
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("F is the feed of X, Y and Z together")
                .help("remove it, and write the feeds that these moves have for X, Y and Z"),
        )
    }

    /// `CTOL=tolerance`, alone or beside G641 and the like; below zero it is the configured one.
    pub(super) fn contour_tolerance(&mut self, start: usize, length: usize) -> Outcome<()> {
        let has_mode = self.has_code(64) || (641..=645).any(|number| self.has_code(number));
        self.input.at = start + length;
        self.input.eat(b'=');
        let value = self.input.value()?;
        if !has_mode {
            self.out.push(b"G64 ", start);
        }
        if value >= 0.0 {
            self.put(start, b"P[", value);
        }
        Ok(())
    }

    /// `CYCLE832(tolerance, …)`.
    pub(super) fn tolerance_cycle(&mut self, start: usize, length: usize) -> Outcome<()> {
        self.input.at = start + length;
        let span = SourceSpan::new(start, start + length);
        self.out.push(b"G64 ", start);
        if !self.input.eat(b'(') {
            return Err(missing(span, "CYCLE832", "( )", "the tolerance"));
        }
        if !matches!(self.input.next_visible(), Some(b')' | b',')) {
            let value = self.input.value()?;
            self.put(start, b"P[", value);
        }
        // The other arguments choose between roughing and finishing: the tolerance decides here.
        while let Some(byte) = self.input.peek(0) {
            self.input.at += 1;
            if byte == b')' {
                return Ok(());
            }
        }
        Err(BlockDiagnostic::new(
            DiagnosticCode::Expression,
            span,
            "the parenthesis is not closed",
        )
        .help("add `)`"))
    }
}

#[cold]
fn other_spindle(word: &str, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("{word} of another spindle than the first");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("the machine has one spindle")
        .help("remove it, or write 1 for the spindle")
}
