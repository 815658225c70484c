//! Words of SINUMERIK's language that are not read.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::Fault;
use crate::diagnostic::span::SourceSpan;

/// What is known of the language, and not read here.
const REFUSED: [(&[u8], &str, &str); 18] = [
    (
        b"CYCLE840",
        "tapping with a compensating chuck",
        "write M3, G84 and its words",
    ),
    (
        b"CYCLE87",
        "boring with a stop at the bottom",
        "use CYCLE86",
    ),
    (
        b"CYCLE88",
        "boring with a stop at the bottom",
        "use CYCLE86",
    ),
    (
        b"CYCLE89",
        "boring with a dwell",
        "use CYCLE85, which takes a dwell and two feeds",
    ),
    (b"SLOT1", "slots", "let the CAM system write plain blocks"),
    (b"SLOT2", "slots", "let the CAM system write plain blocks"),
    (
        b"LONGHOLE",
        "long holes",
        "let the CAM system write plain blocks",
    ),
    (
        b"CASE",
        "a choice of jumps",
        "write IF … GOTOF for each of them",
    ),
    (
        b"GOTOS",
        "a program that begins again for ever",
        "write LOOP and ENDLOOP",
    ),
    (
        b"PROC",
        "a subprogram with a name",
        "call the program by its file",
    ),
    (
        b"EXTERN",
        "a subprogram in another file",
        "copy its blocks to where it is called",
    ),
    (
        b"CALL",
        "a subprogram in another file",
        "copy its blocks to where it is called",
    ),
    (b"AP", "polar coordinates", "write X and Y"),
    (b"RP", "polar coordinates", "write X and Y"),
    (b"SPOS", "a spindle that stops at an angle", "write M19 R"),
    (
        b"MEAS",
        "a measurement that leaves out the rest of the way",
        "write G38.3 with X, Y or Z",
    ),
    (
        b"MEAW",
        "a measurement on the way",
        "measure at the end of the way: write G38.3",
    ),
    (
        b"MEASA",
        "measurements at several edges",
        "write a G38.3 for each of them",
    ),
];

/// A word that is not read.
pub(super) fn unknown(name: &[u8], span: SourceSpan) -> Box<Fault> {
    let shown = String::from_utf8_lossy(name).into_owned();
    if let Some((_, what, help)) = REFUSED.into_iter().find(|(known, ..)| *known == name) {
        let message = format!("{shown} ({what}) is not supported");
        return Fault::new(DiagnosticCode::NotSupported, span, message)
            .because("skipping it would make another motion than the program's")
            .help(help);
    }
    let message = format!("{shown} is not supported");
    Fault::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "of SINUMERIK's language the words of motion, variables, structures, jumps, frames and \
             the cycles in the manual are read",
        )
        .help("let the CAM system write plain blocks, or declare a variable by DEF")
}
