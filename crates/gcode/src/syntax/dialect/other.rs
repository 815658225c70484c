//! The other dialects that have a word which the one in use does not have.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::setup::m_codes::MCodes;
use crate::setup::machine::Machine;
use crate::syntax::codes::Codes;
use crate::syntax::dialect::bare_words::{bare_words, value};
use crate::syntax::dialect::lathe_marks::{LatheMark, lathe_mark};
use crate::syntax::dialect::marlin::is_function;
use crate::syntax::dialect::words::{
    Meaning, fanuc, fanuc_lathe, marlin as printer, siemens as sinumerik,
};
use crate::syntax::dialect::{Dialect, fanuc_marks, marlin, siemens};
use crate::syntax::number::code_number;

/// Every dialect.
const ALL: [Dialect; 4] = [
    Dialect::LinuxCnc,
    Dialect::Marlin,
    Dialect::Fanuc,
    Dialect::Siemens,
];

/// Names the other dialects in the help of a fault about a word, where they have it.
#[cold]
pub(crate) fn name_dialects(
    fault: &mut BlockDiagnostic,
    text: &[u8],
    used: Dialect,
    machine: &Machine,
) {
    let found: Vec<Dialect> = match fault.code {
        DiagnosticCode::UnknownGCode | DiagnosticCode::UnknownMCode => {
            let by_line = of_line(text, machine);
            by_line.map_or_else(|| with_code(text, fault.span), |dialect| vec![dialect])
        }
        DiagnosticCode::BadCharacter
        | DiagnosticCode::MissingNumber
        | DiagnosticCode::MalformedNumber
        | DiagnosticCode::UnusedWord
        | DiagnosticCode::UnknownWord
        | DiagnosticCode::FlowStructure
        | DiagnosticCode::NotSupported
        | DiagnosticCode::AxisNotConfigured => of_line(text, machine).into_iter().collect(),
        _ => return,
    };
    let others: Vec<String> = found
        .into_iter()
        .filter(|dialect| *dialect != used)
        .map(|dialect| format!("--dialect {dialect}"))
        .collect();
    if !others.is_empty() {
        fault.first_try(&format!(
            "read the program with {}, if it is for that control",
            others.join(" or ")
        ));
    }
}

/// The dialect of a line by what only one has.
fn of_line(text: &[u8], machine: &Machine) -> Option<Dialect> {
    let bare: Vec<u8> = text
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    if siemens::marks(&bare) {
        Some(Dialect::Siemens)
    } else if marlin::marks(&bare) {
        Some(Dialect::Marlin)
    } else if fanuc_marks::marks(&bare)
        || machine.is_lathe() && lathe_mark(&bare, machine) == Some(LatheMark::Fanuc)
    {
        Some(Dialect::Fanuc)
    } else {
        None
    }
}

/// The dialects that have the code which stands there.
fn with_code(text: &[u8], span: SourceSpan) -> Vec<Dialect> {
    let word = text.get(span.start..).unwrap_or_default();
    let word: Vec<u8> = word
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let Some((letter, number)) = bare_words(&word)
        .first()
        .and_then(|(letter, number)| Some((*letter, value(number)?)))
    else {
        return Vec::new();
    };
    let has = |dialect: &Dialect| match letter {
        b'G' => has_g(*dialect, number),
        b'M' => code_number(number).is_some_and(|number| has_m(*dialect, number)),
        _ => false,
    };
    ALL.into_iter().filter(has).collect()
}

/// Whether a meaning is one that is read.
const fn is_read(meaning: Option<Meaning>) -> bool {
    matches!(
        meaning,
        Some(Meaning::Shared | Meaning::Own | Meaning::ReadOver)
    )
}

fn has_g(dialect: Dialect, number: f64) -> bool {
    let Some(tenths) = code_number(10.0 * number) else {
        return false;
    };
    match dialect {
        Dialect::LinuxCnc => Codes::default()
            .add_g(number, SourceSpan::default())
            .is_ok(),
        Dialect::Marlin => is_read(printer::g(tenths)),
        Dialect::Fanuc => is_read(fanuc::g(tenths)) || is_read(fanuc_lathe::g(tenths)),
        Dialect::Siemens => tenths.is_multiple_of(10) && is_read(sinumerik::g(tenths / 10)),
    }
}

fn has_m(dialect: Dialect, number: u32) -> bool {
    match dialect {
        Dialect::LinuxCnc => Codes::default()
            .add_m(f64::from(number), SourceSpan::default(), &MCodes::default())
            .is_ok(),
        Dialect::Marlin => is_function(number) || is_read(printer::m(number)),
        Dialect::Fanuc => is_read(fanuc::m(number)),
        Dialect::Siemens => is_read(sinumerik::m(number)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::Axis;

    fn others(text: &[u8], start: usize, code: DiagnosticCode, used: Dialect) -> String {
        let mut fault =
            BlockDiagnostic::new(code, SourceSpan::new(start, start + 1), "no").help("remove it");
        let machine = Machine::new(&[Axis::X, Axis::Z]);
        name_dialects(&mut fault, text, used, &machine);
        fault.at(1, text).help
    }

    #[test]
    fn the_dialects_that_have_a_word_are_named() {
        let unknown = DiagnosticCode::UnknownGCode;
        let fanuc =
            "read the program with --dialect fanuc, if it is for that control; else remove it";
        let linuxcnc = Dialect::LinuxCnc;
        assert_eq!(others(b"G187 P1", 0, unknown, linuxcnc), fanuc);
        assert_eq!(others(b"X1 G32 Z5", 3, unknown, linuxcnc), fanuc);
        let siemens = fanuc.replace("fanuc", "siemens");
        assert_eq!(others(b"G331 Z5", 0, unknown, linuxcnc), siemens);
        let marlin = fanuc.replace("fanuc", "marlin");
        let unknown_m = DiagnosticCode::UnknownMCode;
        assert_eq!(others(b"M250", 0, unknown_m, linuxcnc), marlin);
        // A code of several.
        let two = others(b"G9 X1", 0, unknown, linuxcnc);
        assert!(
            two.contains("--dialect fanuc or --dialect siemens"),
            "{two}"
        );
        let back = others(b"G61.1", 0, unknown, Dialect::Fanuc);
        assert!(back.contains("--dialect linuxcnc"), "{back}");
        // Words that are no codes, and what nobody has.
        let no_number = DiagnosticCode::MissingNumber;
        assert_eq!(others(b"G0 SUPA Z0", 3, no_number, linuxcnc), siemens);
        let no_axis = DiagnosticCode::AxisNotConfigured;
        assert_eq!(others(b"G28 U0", 4, no_axis, linuxcnc), fanuc);
        assert_eq!(others(b"G999", 0, unknown, linuxcnc), "remove it");
        assert_eq!(others(b"G0 Y1", 3, no_axis, linuxcnc), "remove it");
    }
}
