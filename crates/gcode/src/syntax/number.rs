//! Numbers in a line.
//!
//! A number is an optional sign, digits, and at most one decimal point, with at least one digit; blanks
//! may stand inside. There are no exponents: E is a word letter.
//!
//! A number of up to 53 bits of digits and 22 decimals is a quotient of two exact
//! doubles, so one division rounds it correctly. Longer ones go through the standard library's parser.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::cursor::{Cursor, MAX_NUMBER};

/// Powers of ten that a double holds exactly.
pub(crate) const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

impl Cursor<'_> {
    /// Reads a number for the word whose letter is at `word`; nothing number-like may follow.
    pub(crate) fn number(&mut self, word: usize) -> Outcome<f64> {
        self.next_visible();
        let start = self.at;
        let value = self.literal(word)?;
        if matches!(self.peek(), Some(b'+' | b'-')) {
            self.refuse_tail(start)?;
        }
        Ok(value)
    }

    /// Reads a number that an operator may follow.
    pub(crate) fn literal(&mut self, word: usize) -> Outcome<f64> {
        let first = self.next_visible();
        let start = self.at;
        let negative = first == Some(b'-');
        if matches!(first, Some(b'-' | b'+')) {
            self.at += 1;
        }
        let (mut mantissa, mut digits, mut decimals) = (0_u64, 0_u32, 0_usize);
        let (mut point, mut end, mut exact) = (false, self.at, true);
        loop {
            match self.next_visible() {
                Some(digit @ b'0'..=b'9') => {
                    if mantissa < 1_000_000_000_000_000_000 {
                        mantissa = mantissa * 10 + u64::from(digit - b'0');
                    } else {
                        exact = false;
                    }
                    digits += 1;
                    decimals += usize::from(point);
                }
                Some(b'.') if !point => point = true,
                _ => break,
            }
            self.at += 1;
            end = self.at;
        }
        if digits == 0 {
            return Err(self.no_number(word, start));
        }
        let exponent =
            self.at == end && !self.has_e_words && matches!(self.peek(), Some(b'e' | b'E'));
        let next = self.peek();
        let is_comma = next == Some(b',') && self.is_decimal_comma();
        if exponent || next == Some(b'.') || is_comma {
            self.refuse_tail(start)?;
        }
        let value = match POWERS.get(decimals) {
            Some(power) if exact && mantissa <= 1 << 53 => to_f64(mantissa) / power,
            _ => self.long_number(start, end),
        };
        if value > MAX_NUMBER {
            let span = SourceSpan::new(start, end);
            return Err(BlockDiagnostic::new(
                DiagnosticCode::NumberOutOfRange,
                span,
                "the number is too large",
            )
            .because(format!("no word takes a value beyond ±{MAX_NUMBER}"))
            .help("check the program that wrote it"));
        }
        Ok(if negative { -value } else { value })
    }

    /// True for the comma that comes next if no letter is behind it: `X1,5`, but not `X20,R5`.
    #[cold]
    fn is_decimal_comma(&self) -> bool {
        let mut behind = *self;
        behind.advance();
        let next = behind.next_visible();
        !self.is_in_list && !next.is_some_and(|byte| byte.is_ascii_alphabetic())
    }

    /// Value of digits that do not fit the short way; the sign is not looked at.
    #[cold]
    fn long_number(&self, start: usize, end: usize) -> f64 {
        let text: String = self
            .text
            .get(start..end)
            .unwrap_or_default()
            .iter()
            .filter(|b| b.is_ascii_digit() || **b == b'.')
            .map(|&b| char::from(b))
            .collect();
        // Digits and one point: it parses, to infinity at worst, and that is refused as too large.
        text.parse().unwrap_or(f64::INFINITY)
    }

    /// Explains why no number starts at `start`.
    #[cold]
    fn no_number(&self, word: usize, start: usize) -> Box<BlockDiagnostic> {
        let letter = self
            .quote(SourceSpan::new(word, word + 1))
            .to_ascii_uppercase();
        let rest = self.text.get(start..).unwrap_or_default();
        let unsigned = match rest {
            [b'+' | b'-', tail @ ..] => tail,
            all => all,
        };
        for name in ["nan", "inf", "ind"] {
            if unsigned
                .get(..3)
                .is_some_and(|t| t.eq_ignore_ascii_case(name.as_bytes()))
            {
                let end = start + rest.len() - unsigned.len() + 3;
                let shown = self.quote(SourceSpan::new(start, end));
                let message = format!("`{shown}` is not a number");
                return BlockDiagnostic::new(
                    DiagnosticCode::MalformedNumber,
                    SourceSpan::new(start, end),
                    message,
                )
                .because("a failed computation in the program that wrote this left it here")
                .help("write the value that was meant");
            }
        }
        if let Some(fault) = self.odd_byte(start, rest) {
            return fault;
        }
        let end = start + usize::from(unsigned.len() < rest.len()) + self.tail_length(unsigned);
        if end > start {
            let span = SourceSpan::new(start, end);
            let message = format!("`{}` is not a number", self.quote(span));
            return BlockDiagnostic::new(DiagnosticCode::MalformedNumber, span, message).because(
                "a number is an optional sign, digits, and at most one decimal point among them",
            )
            .help("write one number");
        }
        let is_word = |c: char| c.is_ascii_alphabetic() || matches!(c, '@' | '^');
        if !letter.starts_with(is_word) {
            let span = SourceSpan::new(word, word + 1);
            return BlockDiagnostic::new(
                DiagnosticCode::Expression,
                span,
                format!("no value behind `{letter}`"),
            )
            .because("a number, a parameter, a function or a bracket is needed there")
            .help("write the value");
        }
        BlockDiagnostic::new(
            DiagnosticCode::MissingNumber,
            SourceSpan::new(word, word + 1),
            format!("{letter} has no number"),
        )
        .because("a letter and its number make a word")
        .help("write the number, or remove the letter")
    }

    /// A byte that is no text at all, where a number should start.
    fn odd_byte(&self, start: usize, rest: &[u8]) -> Option<Box<BlockDiagnostic>> {
        match rest.first() {
            Some(0 | 0x80..) => Some(bad_byte(self.text, start)),
            _ => None,
        }
    }

    /// Refuses what is glued to the number that started at `start`.
    #[cold]
    fn refuse_tail(&self, start: usize) -> Outcome<()> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let mut length = self.tail_length(rest);
        let mut help = "write one number";
        let mut reason = "a number has one decimal point and no sign after its first digit";
        match rest {
            [b',', ..] => {
                help = "use a point as the decimal sign";
                reason = "a comma has no meaning in a block";
            }
            [b'e' | b'E', tail @ ..] => {
                let signed = usize::from(matches!(tail, [b'+' | b'-', ..]));
                let digits = tail.get(signed..).unwrap_or_default();
                if !digits.first().is_some_and(u8::is_ascii_digit) {
                    return Ok(());
                }
                length = 1 + signed + self.tail_length(digits);
                help = "write the number out, for example 0.000015";
                reason = "there is no scientific notation: E starts a word of its own";
            }
            _ => {}
        }
        let span = SourceSpan::new(start, self.at + length);
        let message = format!("`{}` is not a number", self.quote(span));
        Err(
            BlockDiagnostic::new(DiagnosticCode::MalformedNumber, span, message)
                .because(reason)
                .help(help),
        )
    }

    /// Bytes of number-like text at the start of `rest`.
    fn tail_length(&self, rest: &[u8]) -> usize {
        let like = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b',' | b'+' | b'-');
        rest.iter().take_while(|b| like(b)).count()
    }
}

#[expect(
    clippy::cast_precision_loss,
    reason = "the caller has checked that it is at most 2^53"
)]
const fn to_f64(mantissa: u64) -> f64 {
    mantissa as f64
}

/// The whole number a code's value stands for; a computed value may be off by rounding.
pub(crate) fn code_number(value: f64) -> Option<u32> {
    let nearest = value.round();
    let whole = (value - nearest).abs() < 1e-4 && (0.0..10_000.0).contains(&nearest);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    whole.then_some(nearest as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<(f64, usize), (DiagnosticCode, usize, usize)> {
        let mut cursor = Cursor::new(text.as_bytes());
        cursor.advance();
        match cursor.number(0) {
            Ok(value) => Ok((value, cursor.at())),
            Err(fault) => Err((fault.code, fault.span.start, fault.span.length)),
        }
    }

    #[test]
    fn blanks_inside_numbers_do_not_matter() {
        assert_eq!(read("X 1 0\t. 5 Y"), Ok((10.5, 10)));
        assert_eq!(read("X - 5"), Ok((-5.0, 5)));
        assert_eq!(read("X+.5"), Ok((0.5, 4)));
        assert_eq!(read("X5.E"), Ok((5.0, 3)));
    }

    #[test]
    fn malformed_numbers_are_pointed_at() {
        use DiagnosticCode::{MalformedNumber, MissingNumber, NonAsciiCharacter};
        assert_eq!(read("X1.2.3"), Err((MalformedNumber, 1, 5)));
        assert_eq!(read("X--5"), Err((MalformedNumber, 1, 3)));
        assert_eq!(read("X5-"), Err((MalformedNumber, 1, 2)));
        assert_eq!(read("X1,5"), Err((MalformedNumber, 1, 3)));
        assert_eq!(read("X."), Err((MalformedNumber, 1, 1)));
        assert_eq!(read("X-nan"), Err((MalformedNumber, 1, 4)));
        assert_eq!(read("X1.5e-05"), Err((MalformedNumber, 1, 7)));
        assert_eq!(read("X"), Err((MissingNumber, 0, 1)));
        assert_eq!(read("XY"), Err((MissingNumber, 0, 1)));
        assert_eq!(read("X\u{2212}5"), Err((NonAsciiCharacter, 1, 3)));
    }

    #[test]
    fn large_numbers_are_refused_however_long() {
        assert_eq!(read("X1000000000").map(|r| r.0), Ok(MAX_NUMBER));
        assert!(read("X1000000000.1").is_err());
        assert!(read(&format!("X{}", "9".repeat(400))).is_err());
        let long = format!("X0.{}1", "0".repeat(400));
        assert_eq!(read(&long).map(|r| r.0), Ok(0.0));
    }

    proptest! {
        #[test]
        fn agrees_bit_for_bit_with_the_standard_library(
            text in "[-+]?([0-9]{1,9}(\\.[0-9]{0,25})?|\\.[0-9]{1,25})"
        ) {
            let expected: f64 = text.parse().expect("a number by construction");
            let (value, end) = read(&format!("X{text}")).expect("a number by construction");
            prop_assert_eq!(value.to_bits(), expected.to_bits());
            prop_assert_eq!(end, text.len() + 1);
        }

        #[test]
        fn printed_numbers_come_back(value in -1e9_f64..1e9) {
            let (back, _) = read(&format!("X{value}")).expect("a printed number");
            prop_assert_eq!(back.to_bits(), value.to_bits());
        }
    }
}
