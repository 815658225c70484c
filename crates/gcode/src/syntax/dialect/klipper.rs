//! The words of Klipper's commands with names: `SET_GCODE_OFFSET Z=0.2 MOVE=1`.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// A word of such a command.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct KlipperWord {
    /// In capitals.
    pub(crate) key: Vec<u8>,
    /// As it is written.
    pub(crate) value: Vec<u8>,
    pub(crate) span: SourceSpan,
}

impl KlipperWord {
    /// Its value, a number.
    pub(crate) fn number(&self) -> Outcome<f64> {
        let text = core::str::from_utf8(&self.value).ok();
        let number = text.and_then(|text| text.parse::<f64>().ok());
        number.filter(|number| number.is_finite()).ok_or_else(|| {
            let shown = String::from_utf8_lossy(&self.value).into_owned();
            let message = format!("`{shown}` is not a number");
            BlockDiagnostic::new(DiagnosticCode::MalformedNumber, self.span, message)
                .because("behind the equals sign stands a number, without blanks")
                .help("write KEY=1.5")
        })
    }
}

/// The words behind the name of a command, which ends at `at`.
pub(crate) fn words(text: &[u8], at: usize) -> Outcome<Vec<KlipperWord>> {
    let mut words = Vec::new();
    let end = text.iter().position(|byte| matches!(byte, b';' | b'#'));
    let text = text.get(..end.unwrap_or(text.len())).unwrap_or_default();
    let mut start = at;
    while start < text.len() {
        let rest = text.get(start..).unwrap_or_default();
        if rest.first().is_some_and(u8::is_ascii_whitespace) {
            start += 1;
            continue;
        }
        let length = rest.iter().take_while(|b| !b.is_ascii_whitespace()).count();
        let word = rest.get(..length).unwrap_or_default();
        let span = SourceSpan::new(start, start + length);
        let Some(sign) = word.iter().position(|byte| *byte == b'=') else {
            let shown = String::from_utf8_lossy(word).into_owned();
            let message = format!("`{shown}` has no value");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::MissingNumber, span, message)
                    .because("the words of a command with a name are KEY=VALUE")
                    .help("write the value behind an equals sign"),
            );
        };
        words.push(KlipperWord {
            key: word.get(..sign).unwrap_or_default().to_ascii_uppercase(),
            value: word.get(sign + 1..).unwrap_or_default().to_vec(),
            span,
        });
        start += length;
    }
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_keys_and_values() {
        let text = b"SET_GCODE_OFFSET z=0.2  MOVE=1 ; up";
        let found = words(text, 16).expect("words");
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].key, b"Z");
        assert_eq!(found[0].number().ok(), Some(0.2));
        assert_eq!(found[1].span, SourceSpan::new(24, 30));
        assert!(words(b"A B", 1).is_err());
        assert!(words(b"A B=x", 1).expect("words")[0].number().is_err());
        assert!(words(b"A B=inf", 1).expect("words")[0].number().is_err());
    }
}
