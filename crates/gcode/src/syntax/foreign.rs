//! The detection of texts that are no programs, by their beginning: one diagnostic for all of the
//! text, and not one for every line.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// Lines of a beginning that are looked at.
const LOOKED_AT: usize = 20;
/// Lines of prose in a row from which on a text is none of a machine.
const PROSE: usize = 3;

/// What the beginning of a text is, if it is no program of a language that is read; `text` is the
/// first line, `ahead` what follows it.
#[cold]
pub(crate) fn foreign(text: &[u8], ahead: &[u8]) -> Option<Box<BlockDiagnostic>> {
    let first = text.trim_ascii();
    let lines = || {
        core::iter::once(first)
            .chain(ahead.split(|byte| matches!(byte, b'\n' | b'\r')))
            .map(<[u8]>::trim_ascii)
            .filter(|line| !line.is_empty())
            .take(LOOKED_AT)
    };
    let (what, help) = if lines().any(is_klartext) {
        (
            "a program in HEIDENHAIN's Klartext",
            "let the CAM system write it for LinuxCNC, FANUC or SINUMERIK",
        )
    } else if is_heidenhain_iso(first) {
        (
            "a program in HEIDENHAIN's DIN/ISO",
            "let the CAM system write it for LinuxCNC, FANUC or SINUMERIK",
        )
    } else if is_okuma(first) || lines().any(has_okuma_words) {
        (
            "a program of an Okuma control",
            "let the CAM system write it for LinuxCNC, FANUC or SINUMERIK",
        )
    } else if let Some(kind) = file_kind(first) {
        (kind, "give the program that was made from it")
    } else if lines().take(PROSE).filter(|line| is_prose(line)).count() == PROSE
        && !lines().any(is_block)
    {
        ("a text, and no program", "give a program")
    } else {
        return None;
    };
    let span = SourceSpan::new(0, text.len());
    let message = format!("this is {what}");
    Some(
        BlockDiagnostic::new(DiagnosticCode::ForeignLanguage, span, message)
            .because("its lines mean nothing in the languages that are read here")
            .help(help),
    )
}

/// `0 BEGIN PGM NAME MM`.
fn is_klartext(line: &[u8]) -> bool {
    let digits = line.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let words = line.get(digits..).unwrap_or_default().trim_ascii_start();
    let mut words = words
        .split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty());
    words.next() == Some(b"BEGIN".as_slice()) && words.next() == Some(b"PGM".as_slice())
}

/// `%NAME G71 *`.
fn is_heidenhain_iso(line: &[u8]) -> bool {
    let ends = line.strip_suffix(b"*").map(<[u8]>::trim_ascii);
    let is_unit = |line: &[u8]| line.ends_with(b" G71") || line.ends_with(b" G70");
    line.starts_with(b"%") && ends.is_some_and(is_unit)
}

/// `$NAME.MIN%`.
fn is_okuma(line: &[u8]) -> bool {
    let name = line
        .strip_prefix(b"$")
        .and_then(|line| line.strip_suffix(b"%"));
    name.is_some_and(|name| name.contains(&b'.'))
}

/// `G15 H1` (a coordinate system), `CALL O10` (a subroutine), `VZOFZ[1]=0` (its zero), `NOEX` in front of a block
/// that is not shown: what no other control has, behind the number of a block.
fn has_okuma_words(line: &[u8]) -> bool {
    let bare: Vec<u8> = line
        .iter()
        .take_while(|byte| !b"(;".contains(byte))
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let words = match bare.as_slice() {
        [b'N', rest @ ..] if rest.first().is_some_and(u8::is_ascii_digit) => {
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            rest.get(digits..).unwrap_or_default()
        }
        line => line,
    };
    let is_followed_by_digit = |head: &[u8]| {
        let rest = words.strip_prefix(head);
        rest.and_then(<[u8]>::first).is_some_and(u8::is_ascii_digit)
    };
    let is_offset = |head: &[u8]| {
        let rest = words.strip_prefix(head);
        rest.is_some_and(|rest| matches!(rest, [b'X'..=b'Z' | b'A'..=b'C', b'[' | b'=', ..]))
    };
    is_followed_by_digit(b"G15H")
        || is_followed_by_digit(b"CALLO")
        || is_offset(b"VZOF")
        || words.starts_with(b"NOEXV")
}

/// What a file is whose first bytes say so.
fn file_kind(line: &[u8]) -> Option<&'static str> {
    let starts = |word: &[u8]| {
        line.get(..word.len())
            .is_some_and(|head| head.eq_ignore_ascii_case(word))
    };
    [
        (&b"%PDF-"[..], "a PDF document"),
        (b"<!DOCTYPE", "a page of the web"),
        (b"<html", "a page of the web"),
        (b"<?xml", "an XML document"),
        (b"<svg", "a drawing (SVG)"),
        (b"{\\rtf", "a text document (RTF)"),
        (b"ISO-10303-21", "a model (STEP)"),
        (b"solid ", "a model (STL)"),
        (b"PK\x03\x04", "an archive (ZIP)"),
    ]
    .into_iter()
    .find_map(|(word, kind)| starts(word).then_some(kind))
}

/// True for a line of words of a human language: three and more, of letters alone.
fn is_prose(line: &[u8]) -> bool {
    let words = line.split(u8::is_ascii_whitespace).filter(|word| {
        let letters = word.trim_ascii_end();
        let letters = letters
            .strip_suffix(b",")
            .or_else(|| letters.strip_suffix(b"."))
            .unwrap_or(letters);
        letters.len() >= 2 && letters.iter().all(u8::is_ascii_alphabetic)
    });
    line.first().is_some_and(u8::is_ascii_alphabetic)
        && !line.iter().any(|byte| b"=[]#%".contains(byte))
        && words.count() >= 3
}

/// True for a line that begins as a block does: a letter and a number, or what every control skips.
fn is_block(line: &[u8]) -> bool {
    match line {
        [b'%' | b'(' | b';' | b'#' | b'/' | b':' | b'$', ..] => true,
        [letter, rest @ ..] if letter.is_ascii_alphabetic() => {
            let next = rest.iter().find(|byte| !byte.is_ascii_whitespace());
            next.is_some_and(|byte| byte.is_ascii_digit() || b"+-.#[<=".contains(byte))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> bool {
        let (first, ahead) = text.split_once('\n').unwrap_or((text, ""));
        foreign(first.as_bytes(), ahead.as_bytes()).is_some()
    }

    #[test]
    fn texts_of_another_kind_are_told() {
        for text in [
            "0 BEGIN PGM TEST MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n",
            "; header\n0  BEGIN PGM A INCH\n",
            "%TEST G71 *\nN10 G30 G17 X+0 Y+0 Z-20 *\n",
            "$PART.MIN%\nO1\nG15 H1\n",
            "OPART\nG0 G90\nN10 G15 H1\nG56 Z100 H1\n",
            "O1\nN1 CALL O10 PX=5\n",
            "(SETUP)\nNOEX VC1=5\nVZOFZ[1]=12.5\n",
            "<!doctype html>\n<html>\n",
            "%PDF-1.4\n",
            "this is no program at all\nbut a note to whoever\nreads the folder next\n",
        ] {
            assert!(told(text), "{text}");
        }
    }

    #[test]
    fn programs_are_none_of_them() {
        for text in [
            "%\nO1\nG0 X1\n",
            "% \n(a note of three words)\nG0 X1",
            "G21\nG0 X1\n",
            "START_PRINT EXTRUDER_TEMP=205 BED=60\nG28\n",
            "DEF REAL A\nDEF REAL B\nDEF REAL C\nG0 X1\n",
            "PART NUMBER ONE\nREVISION B OF IT\nMADE BY ME AND YOU\n%\nO1\nG0 X1\n",
            "$H\nG0 X1\n",
            "G15\nG16\nG0 X1\n",
            "G0 X1 (G15 H1)\nG15\nH1\n",
            "CALL \"O10\"\nG0 X1\n",
            "",
        ] {
            assert!(!told(text), "{text}");
        }
    }
}
