//! Programs of printers: checksums of lines, and the M codes that take the rest of their line.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::line_body::body;

/// Commands of Klipper with names that move nothing and give no place another name: their beginnings.
const SILENT: [&[u8]; 11] = [
    b"EXCLUDE_OBJECT",
    b"SET_PRINT_STATS_INFO",
    b"SET_DISPLAY_TEXT",
    b"SET_FAN_SPEED",
    b"SET_HEATER_TEMPERATURE",
    b"SET_PRESSURE_ADVANCE",
    b"SET_VELOCITY_LIMIT",
    b"SET_LED",
    b"SET_PIN",
    b"TIMELAPSE_",
    b"RESPOND",
];

/// A command of Klipper with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NamedCommand {
    /// Where its name stands.
    pub(crate) span: SourceSpan,
    /// It moves nothing.
    pub(crate) is_silent: bool,
}

/// The command with a name that a line is: a name has three letters and more, and no number behind
/// its first one.
pub(crate) fn named_command(text: &[u8]) -> Option<NamedCommand> {
    let start = body(text);
    let rest = text.get(start..).unwrap_or_default();
    let is_name = |byte: &&u8| byte.is_ascii_alphanumeric() || **byte == b'_';
    let length = rest.iter().take_while(is_name).count();
    let name = rest.get(..length).unwrap_or_default().to_ascii_uppercase();
    let begins = name
        .iter()
        .take(3)
        .filter(|byte| !byte.is_ascii_digit())
        .count()
        == 3;
    begins.then(|| NamedCommand {
        span: SourceSpan::new(start, start + length),
        is_silent: SILENT.iter().any(|silent| name.starts_with(silent)),
    })
}

/// True if a line, without blanks and in upper case, is of a printer's program.
pub(super) fn marks(bare: &[u8]) -> bool {
    if bare.starts_with(b";FLAVOR:MARLIN")
        || bare.starts_with(b";GENERATEDBY") && bare.windows(6).any(|part| part == b"SLICER")
    {
        return true;
    }
    let text = bare.get(body(bare)..).unwrap_or_default();
    let code = |word: &[u8]| {
        text.starts_with(word) && !text.get(word.len()).is_some_and(u8::is_ascii_digit)
    };
    let codes: [&[u8]; 12] = [
        b"M82", b"M83", b"M84", b"M104", b"M105", b"M106", b"M107", b"M109", b"M140", b"M190",
        b"M201", b"G92E",
    ];
    let numbered = matches!(bare.first(), Some(b'N')) && split_checksum(bare).is_some();
    codes.iter().any(|word| code(word)) || numbered || text.starts_with(b"G92E0")
}

/// Splits `N1 G1 X1*57` at its star: the text in front, and what the checksum says.
fn split_checksum(text: &[u8]) -> Option<(usize, &[u8])> {
    let semicolon = text.iter().position(|byte| *byte == b';');
    let code = text.get(..semicolon.unwrap_or(text.len()))?;
    let star = code.iter().rposition(|byte| *byte == b'*')?;
    let digits = code.get(star + 1..)?.trim_ascii();
    let number = !digits.is_empty() && digits.iter().all(u8::is_ascii_digit);
    number.then_some((star, digits))
}

/// The text without its checksum, which has been verified; the length of the text to read.
///
/// The checksum of a line is the exclusive or of all bytes in front of its star.
pub(crate) fn verified(text: &[u8]) -> Outcome<&[u8]> {
    let Some((star, digits)) = split_checksum(text) else {
        return Ok(text);
    };
    let line = text.get(..star).unwrap_or_default();
    let sum = line.iter().fold(0, |sum, byte| sum ^ byte);
    let said: Option<u8> = core::str::from_utf8(digits)
        .ok()
        .and_then(|t| t.parse().ok());
    if said == Some(sum) {
        return Ok(line);
    }
    let span = SourceSpan::new(star, star + 1 + digits.len());
    let message = format!("the checksum of the line is {sum}");
    Err(
        BlockDiagnostic::new(DiagnosticCode::Checksum, span, message)
            .because("the line was damaged on its way, or changed by hand")
            .help("write the program again, or remove the checksum"),
    )
}

/// M codes of printers; the rest of the line belongs to them. None of them moves an axis or gives
/// places other names.
const FUNCTIONS: [u32; 89] = [
    16, 17, 18, 20, 21, 22, 31, 42, 73, 74, 75, 76, 77, 78, 80, 81, 84, 85, 86, 87, 92, 104, 105,
    106, 107, 108, 109, 110, 111, 113, 114, 115, 117, 118, 119, 120, 121, 123, 140, 141, 142, 145,
    149, 150, 155, 190, 191, 200, 201, 203, 204, 205, 211, 217, 218, 220, 221, 250, 256, 280, 300,
    301, 302, 304, 305, 350, 355, 400, 412, 413, 420, 430, 486, 500, 501, 502, 503, 504, 540, 555,
    569, 572, 593, 851, 862, 900, 906, 907, 914,
];

/// True for an M code whose line goes on with text to show.
pub(crate) const fn shows_text(number: u32) -> bool {
    matches!(number, 117 | 118)
}

/// True for an M code whose words say whether it changes the motion: M200, M220, M221.
pub(crate) const fn reads_words(number: u32) -> bool {
    matches!(number, 200 | 220 | 221)
}

/// The function of a code with a decimal: M862.1 to M862.6, which check the printer.
pub(crate) fn function_with_decimal(value: f64) -> Option<u32> {
    const CHECKS: f64 = 862.0;
    (CHECKS < value && value < CHECKS + 1.0).then_some(862)
}

/// True for an M code that is a function of the machine.
pub(crate) fn is_function(number: u32) -> bool {
    FUNCTIONS.contains(&number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_verified() {
        assert_eq!(verified(b"N3 T0*57"), Ok(b"N3 T0".as_slice()));
        assert_eq!(verified(b"N3 T0*57 ; *9"), Ok(b"N3 T0".as_slice()));
        assert_eq!(verified(b"G1 X1"), Ok(b"G1 X1".as_slice()));
        let fault = verified(b"N3 T1*57").expect_err("it was changed");
        assert_eq!(
            (fault.code, fault.span.start),
            (DiagnosticCode::Checksum, 5)
        );
        assert!(verified(b"N3 T0*570").is_err());
    }
}
