//! Numbers as SINUMERIK writes them: digits, and what stands in quotes.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::operator::finite;

impl Evaluator<'_> {
    /// `'H1F'` or `'B101'`.
    pub(super) fn bits(&mut self) -> Outcome<f64> {
        let start = self.at;
        let rest = self.text.get(start + 1..).unwrap_or_default();
        let end = rest.iter().position(|byte| *byte == b'\'');
        let inside = rest.get(..end.unwrap_or(0)).unwrap_or_default();
        let base = match inside.first().map(u8::to_ascii_uppercase) {
            Some(b'H') => Some(16),
            Some(b'B') => Some(2),
            _ => None,
        };
        let digits = core::str::from_utf8(inside.get(1..).unwrap_or_default()).ok();
        let value = base
            .zip(digits)
            .and_then(|(base, digits)| u32::from_str_radix(digits, base).ok());
        let length = end.map_or(1, |end| end + 2);
        self.at = start + length;
        value.map(f64::from).ok_or_else(|| {
            let span = SourceSpan::new(start, start + length);
            BlockDiagnostic::new(
                DiagnosticCode::MalformedNumber,
                span,
                "a number in quotes that is none",
            )
            .because("behind H stand the digits of a hexadecimal number, behind B of a binary one")
            .help("write 'H1F' or 'B101'")
        })
    }

    /// Digits, with a point and `EX` and an exponent.
    pub(super) fn number(&mut self) -> Outcome<f64> {
        let start = self.at;
        while matches!(self.peek(0), Some(b'0'..=b'9' | b'.')) {
            self.at += 1;
        }
        let mut text = String::from_utf8_lossy(&self.text[start..self.at]).into_owned();
        if self.peek(0) == Some(b'E') && self.peek(1) == Some(b'X') {
            let signed = usize::from(matches!(self.peek(2), Some(b'+' | b'-')));
            let digits = (2 + signed..)
                .take_while(|ahead| self.peek(*ahead).is_some_and(|b| b.is_ascii_digit()))
                .count();
            let exponent = &self.text[self.at + 2..self.at + 2 + signed + digits];
            text = format!("{text}e{}", String::from_utf8_lossy(exponent));
            self.at += 2 + signed + digits;
        }
        let is_digit = |ahead: usize| self.peek(ahead).is_some_and(|byte| byte.is_ascii_digit());
        let is_signed = matches!(self.peek(1), Some(b'+' | b'-')) && is_digit(2);
        if self.peek(0) == Some(b'E') && (is_digit(1) || is_signed) {
            let span = SourceSpan::new(start, self.at + 1);
            let message = "an exponent behind E";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::MalformedNumber, span, message)
                    .because("a SINUMERIK writes EX between a number and its exponent")
                    .help(format!("write {text}EX and the exponent")),
            );
        }
        let span = SourceSpan::new(start, self.at);
        match text.parse::<f64>() {
            Ok(value) => finite(value, span),
            Err(_) => {
                let shown = String::from_utf8_lossy(&self.text[start..self.at]).into_owned();
                let message = format!("`{shown}` is not a number");
                Err(BlockDiagnostic::new(DiagnosticCode::MalformedNumber, span, message)
                    .because(
                        "a number is digits with at most one decimal point, and EX and an exponent",
                    )
                    .help("write one number"))
            }
        }
    }
}
