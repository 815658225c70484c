//! The marks of SINUMERIK programs: what only they have, at their head and in their body.

use crate::syntax::dialect::bare_words::{bare_words, has_code, without_comments};
use crate::syntax::dialect::line_body::body;

/// What a line of such a program may begin with.
const BEGINNINGS: [&[u8]; 33] = [
    b"MSG(",
    b"PROC",
    b"DEFREAL",
    b"DEFINT",
    b"DEFBOOL",
    b"ENDIF",
    b"ENDWHILE",
    b"ENDFOR",
    b"ENDLOOP",
    b"ATRANS",
    b"AROT",
    b"AMIRROR",
    b"ASCALE",
    b"ROTRPL",
    b"ROTX",
    b"ROTY",
    b"ROTZ",
    b"MIRRORX",
    b"MIRRORY",
    b"MCALL",
    b"WORKPIECE(",
    b"TRANSX",
    b"TRANSY",
    b"TRANSZ",
    b"EXTCALL",
    b"CALL\"",
    b"PCALL/",
    b"BSPLINE",
    b"ASPLINE",
    b"CSPLINE",
    b"GROUP_BEGIN(",
    b"E_HEAD(",
    b"F_HEAD(",
];

/// Names that no other language has, anywhere in a line.
const NAMES: [&[u8]; 15] = [
    b"SUPA", b"TRAORI", b"TRAFOOF", b"DIAMON", b"DIAMOF", b"DIAM90", b"STOPRE", b"FNORM", b"FFWON",
    b"FFWOF", b"COMPCAD", b"COMPOF", b"CFTCP", b"ORIWKS", b"ORIVECT",
];

/// Codes that no other language has.
const CODES: [f64; 12] = [
    450.0, 500.0, 601.0, 602.0, 603.0, 641.0, 642.0, 643.0, 644.0, 645.0, 700.0, 710.0,
];

/// Cycles that are called by name; those called CYCLE have a number.
const CYCLES: [&[u8]; 7] = [
    b"CYCLE",
    b"POCKET",
    b"SLOT",
    b"HOLES",
    b"LONGHOLE",
    b"CONTPRON",
    b"CONTDCON",
];

/// Words that take their value behind an equals sign, where RS274/NGC has an address and a number.
/// Longer ones first.
const ASSIGNED: [&[u8]; 33] = [
    b"DISR", b"DISCL", b"FAD", b"TURN", b"ADIS", b"RNDM", b"RND", b"CHR", b"CHF", b"FRCM", b"FRC",
    b"ANG", b"LIMS", b"SPOS", b"CTOL", b"CR", b"AR", b"AP", b"RP", b"X", b"Y", b"Z", b"A", b"B",
    b"C", b"U", b"V", b"W", b"I", b"J", b"K", b"T", b"F",
];

/// True if a line, without blanks and in upper case, is of a SINUMERIK program.
pub(crate) fn marks(bare: &[u8]) -> bool {
    if bare.starts_with(b"%_N_") || bare.starts_with(b";$PATH") {
        return true;
    }
    let text = bare.get(body(bare)..).unwrap_or_default();
    let calls_a_cycle = CYCLES.iter().any(|name| {
        text.strip_prefix(*name).is_some_and(|rest| {
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            rest.get(digits) == Some(&b'(')
        })
    });
    calls_a_cycle
        || BEGINNINGS.iter().any(|word| text.starts_with(word))
        || sets_a_parameter(text)
        || jumps(text)
        || assigns(text)
        || has_own_word(text)
}

/// True if a name or a code of these alone stands somewhere in the line.
fn has_own_word(text: &[u8]) -> bool {
    if is_foreign(text) {
        return false;
    }
    let code = without_comments(text);
    let names = NAMES.iter().any(|name| {
        code.windows(name.len()).enumerate().any(|(at, part)| {
            let before = at.checked_sub(1).and_then(|at| code.get(at));
            part == *name && !before.is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_')
        })
    });
    let words = bare_words(&code);
    names
        || CODES
            .into_iter()
            .any(|number| has_code(&words, b'G', number))
}

/// True for messages of printers, settings of grbl and its kin, and what FANUC prints.
fn is_foreign(text: &[u8]) -> bool {
    let foreign: [&[u8]; 6] = [b"M117", b"M118", b"$", b"{", b"DPRNT", b"BPRNT"];
    foreign.iter().any(|word| text.starts_with(word))
}

/// True for `GOTOF A`, and `GOTO A`: block numbers alone are another control's.
fn jumps(text: &[u8]) -> bool {
    text.strip_prefix(b"GOTO")
        .and_then(<[u8]>::first)
        .is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_')
}

/// True for `R5=…`.
fn sets_a_parameter(text: &[u8]) -> bool {
    let Some((b'R', rest)) = text.split_first() else {
        return false;
    };
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    digits > 0 && rest.get(digits) == Some(&b'=')
}

/// True if a word of the line has an equals sign behind its name, as in `G1X=AC(5)` or `CR=10`:
/// outside comments, and not in lines that are text or settings of other controls.
fn assigns(text: &[u8]) -> bool {
    if is_foreign(text) {
        return false;
    }
    let end = text.iter().position(|byte| matches!(byte, b'(' | b';'));
    let code = text.get(..end.unwrap_or(text.len())).unwrap_or_default();
    let mut signs = (0..code.len()).filter(|at| code.get(*at) == Some(&b'='));
    signs.any(|at| {
        let before = code.get(..at).unwrap_or_default();
        let name = ASSIGNED.iter().find(|name| before.ends_with(name));
        name.is_some_and(|name| {
            let in_front = before.len().checked_sub(name.len() + 1);
            let in_front = in_front.and_then(|at| before.get(at));
            // A number or a blank ends the word before; a letter belongs to a longer name.
            !in_front.is_some_and(|byte| byte.is_ascii_alphabetic() || b"_<#$".contains(byte))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_is_known_without_its_head() {
        for line in [
            "G1X=AC(5)Y2",
            "N10G0X=R1+5",
            "G2X10Y5CR=12.5",
            "N20T=\"MILL_6\"D1",
            "CYCLE81(10,0,2,-5)",
            "N30MCALLCYCLE83(10,0,1)",
            "POCKET3(5,0,1,-10)",
            "Z=IC(-2)",
            "G3X0Y0I=AC(10)J0",
            "N5TRANSX10Y10",
            "G641ADIS=0.1",
            "R12=3",
            "N10GOTOFEND",
            "GOTO_A",
            "N5AROTZ45",
            "ENDIF",
            "G0SUPAZ0D0",
            "G54G17G710",
            "G500",
            "G1X5RND=2",
            "N30TRAORI",
            "N40EXTCALL\"ROUGH\"",
            "CALL\"FINISH\"",
            "PCALL/_N_SPF_DIR/_N_FINISH_SPF",
            "N30BSPLINESD=3F1000",
            "G41G147DISR=5X0Y0",
            "N80ORIWKSORIVECT",
            "N10E_HEAD(0,100,0)",
        ] {
            assert!(marks(line.as_bytes()), "{line}");
        }
    }

    #[test]
    fn others_are_not_taken_for_it() {
        for line in [
            "G1X10(X=5)",
            "(D=1.587CR=0.-ZMIN=-8.427)",
            "G1X10;X=5",
            "#5=3",
            "#<X>=4",
            "#[#1+2]=3",
            "G1X#5F100",
            "M117X=5",
            "$X=5",
            "$100=250",
            "{\"X\":1}",
            "DPRNT[X=#100[53]]",
            "START_PRINTEXTRUDER_TEMP=205",
            "SET_VELOCITY_LIMITACCEL=1000",
            "O100IF[#1GT2]",
            "IF[#1EQ2]THEN#3=4",
            "G10L2P1X5",
            "CYCLE",
            "N10R5",
            "GOTO10",
            "GOTO#1",
            "(SUPAZ0)",
            "G0X1;TRAORI",
            "SET_SUPA",
            "M117G500",
            "G50",
            "G154P1",
            "O100CALL",
            "CALL",
        ] {
            assert!(!marks(line.as_bytes()), "{line}");
        }
    }
}
