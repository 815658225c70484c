//! Texts: in quotes, variables of DEF STRING, and what `<<` joins.
//!
//! ```text
//! text    = operand { "<<" operand }
//! operand = "…" | NAME | NAME[value] | a value, which is written as digits
//! ```
//!
//! A text begins with quotes, with the name of a variable of texts, or with `<<`.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::text_variables::{MAX_TEXT, TextAssignment};
use crate::syntax::dialect::siemens::variables::{Kind, element_at};
use crate::syntax::word_check::missing;

/// Decimal places of a value in a text.
const DECIMALS: i32 = 10;

/// A value as it stands in a text.
fn digits(value: f64) -> String {
    let scale = 10_f64.powi(DECIMALS);
    let rounded = (value * scale).round() / scale;
    // Values too large for the places have none.
    let rounded = if rounded.is_finite() { rounded } else { value };
    (rounded + 0.0).to_string()
}

impl Evaluator<'_> {
    /// True if a text comes next.
    pub(crate) fn is_text_next(&mut self) -> bool {
        match self.next_visible() {
            Some(b'"') => true,
            Some(b'<') => self.peek(1) == Some(b'<'),
            Some(b'A'..=b'Z' | b'_') => self.names.variables.text(&self.name_ahead()).is_some(),
            _ => false,
        }
    }

    /// A variable of texts, and which element of it; `None` if none comes next.
    pub(super) fn text_place(&mut self) -> Outcome<Option<(Vec<u8>, usize)>> {
        self.next_visible();
        let start = self.at;
        let name = self.name_ahead();
        let Some(variable) = self.names.variables.text(&name) else {
            return Ok(None);
        };
        let sizes = variable.sizes().to_vec();
        self.at += name.len();
        let indices = match self.peek(0) {
            Some(b'[') => self.indices()?,
            _ => Vec::new(),
        };
        if sizes.is_empty() && indices.is_empty() {
            return Ok(Some((name, 0)));
        }
        let element = element_at(&sizes, &indices, SourceSpan::new(start, self.at))?;
        Ok(Some((name, element)))
    }

    /// The text that comes next.
    pub(crate) fn text_value(&mut self) -> Outcome<Vec<u8>> {
        self.next_visible();
        let start = self.at;
        let mut text = Vec::new();
        if !self.eats_join() {
            text = self.text_operand()?;
            if !self.eats_join() {
                return Ok(text);
            }
        }
        loop {
            text.extend(self.text_operand()?);
            if text.len() > MAX_TEXT {
                let span = SourceSpan::new(start, self.at);
                let message = format!("a text of more than {MAX_TEXT} bytes");
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                        .because("the length of texts is bounded")
                        .help("join fewer parts"),
                );
            }
            if !self.eats_join() {
                return Ok(text);
            }
        }
    }

    /// Skips `<<` if it comes next.
    fn eats_join(&mut self) -> bool {
        let found = self.next_visible() == Some(b'<') && self.peek(1) == Some(b'<');
        self.at += if found { 2 } else { 0 };
        found
    }

    fn text_operand(&mut self) -> Outcome<Vec<u8>> {
        if self.next_visible() == Some(b'"') {
            return self.text_in_quotes();
        }
        if let Some((name, element)) = self.text_place()? {
            let is_it = |it: &&TextAssignment| it.name == name && it.element == element;
            if let Some(own) = self.assigned_texts.iter().rev().find(is_it) {
                return Ok(own.value.clone());
            }
            let variable = self.names.variables.text(&name);
            return Ok(variable.map_or_else(Vec::new, |it| it.value(element).to_vec()));
        }
        let declared = self.names.variables.get(&self.name_ahead());
        let is_truth = declared.is_some_and(|it| it.kind == Kind::Truth);
        let value = self.level(1)?;
        Ok(match (is_truth, value == 0.0) {
            (true, true) => b"FALSE".to_vec(),
            (true, false) => b"TRUE".to_vec(),
            _ => digits(value).into_bytes(),
        })
    }

    /// Two texts with a comparison between them; capitals are other letters than small ones.
    pub(super) fn compared_texts(&mut self) -> Outcome<f64> {
        let start = self.at;
        let left = self.text_value()?;
        let Some((compare, length)) = self.comparator() else {
            let span = SourceSpan::new(start, self.at.max(start + 1));
            let message = "a text in the place of a number";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                    .because("a text is no value: it can be compared with another text")
                    .help("write ==, <> or the like and the other text"),
            );
        };
        self.at += length;
        if !self.is_text_next() {
            let span = SourceSpan::new(start, self.at);
            return Err(missing(
                span,
                "the comparison",
                "a text",
                "a text in quotes, or a variable of DEF STRING",
            ));
        }
        let right = self.text_value()?;
        let order = match left.cmp(&right) {
            core::cmp::Ordering::Less => -1.0,
            core::cmp::Ordering::Equal => 0.0,
            core::cmp::Ordering::Greater => 1.0,
        };
        Ok(f64::from(u8::from(compare(order, 0.0))))
    }

    /// `STRLEN(text)`, behind whose name it stands.
    pub(super) fn text_length(&mut self, start: usize) -> Outcome<f64> {
        let is_call = self.eat(b'(') && self.is_text_next();
        let text = if is_call {
            self.text_value()?
        } else {
            Vec::new()
        };
        if !is_call || !self.eat(b')') {
            let span = SourceSpan::new(start, self.at.max(start + 1));
            return Err(missing(span, "STRLEN", "( )", "one text in parentheses"));
        }
        Ok(f64::from(u32::try_from(text.len()).unwrap_or(u32::MAX)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_texts() {
        assert_eq!(digits(5.0), "5");
        assert_eq!(digits(-0.0), "0");
        assert_eq!(digits(0.1 + 0.2), "0.3");
        assert_eq!(digits(-2.5), "-2.5");
    }
}
