//! Assignments to the variables of a program: numbers, texts, and elements of arrays.

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::text_variables::TextAssignment;
use crate::syntax::dialect::siemens::variables::{Declared, Kind};
use crate::syntax::dialect::siemens::writer::Writer;
use crate::syntax::expression::scope::Parameter;
use crate::syntax::word_check::missing;

impl Writer<'_> {
    /// An assignment to a variable, whose `=` comes next.
    pub(super) fn assignment(
        &mut self,
        start: usize,
        kind: Kind,
        parameter: Parameter,
    ) -> Outcome<()> {
        self.input.eat(b'=');
        let value = kind.of(self.input.value()?);
        let name = match &parameter {
            Parameter::Numbered(number) => format!("#{number}=["),
            Parameter::Named(name) => format!("#<{name}>=["),
        };
        self.input.assigned.push((parameter, value));
        self.put(start, name.as_bytes(), value);
        Ok(())
    }

    /// `NAME="A"<<R1`, a variable of DEF STRING.
    pub(super) fn text_assignment(&mut self, start: usize) -> Outcome<()> {
        let Some((name, element)) = self.input.text_place()? else {
            return Ok(());
        };
        let span = SourceSpan::new(start, self.input.at);
        if !self.input.eat(b'=') {
            return Err(missing(span, "a text", "=", "what it is to be"));
        }
        let value = self.input.text_value()?;
        let span = SourceSpan::new(start, self.input.at);
        self.names.variables.check_text(&name, &value, span)?;
        let assignment = TextAssignment {
            name,
            element,
            value,
        };
        self.input.assigned_texts.push(assignment);
        Ok(())
    }

    /// `NAME=SET(…)` and `NAME=REP(…)`: one assignment for each element.
    pub(super) fn fill(&mut self, start: usize, array: &Declared, first: usize) -> Outcome<()> {
        let values = self.input.filling(array.count() - first)?;
        for (index, value) in values.into_iter().enumerate() {
            let parameter = array.element(first + index);
            if let Parameter::Named(name) = &parameter {
                let head = format!("#<{name}>=[");
                self.put(start, head.as_bytes(), array.kind.of(value));
            }
            self.input.assigned.push((parameter, array.kind.of(value)));
        }
        Ok(())
    }
}
