//! The codes of the SINUMERIK 840D, as they stand in a program, and its addresses.

use crate::syntax::dialect::words::Meaning::{self, Own, ReadOver, Refused, Shared};

/// What is made of a G code, by its number.
pub(crate) const fn g(number: u32) -> Option<Meaning> {
    const PLAIN: &str = "let the CAM system write plain blocks";
    Some(match number {
        0..=4 | 17..=19 | 33 | 40..=42 | 53..=57 | 64 | 90 | 91 | 93..=97 => Shared,
        9
        // Limits of the spindle's speed.
        | 25
        | 26
        | 58
        | 59
        | 60
        | 70
        | 71
        | 110..=112
        | 153
        | 331
        | 332
        | 500
        | 505..=599
        | 641..=645
        | 700
        | 710
        | 961
        | 971..=973 => Own,
        // Windows of exact stops, how corners of G41 and G42 are gone round, and this language: see the manual.
        // G62 and G621: the feed is less at inner corners, or at all of them, by an override.
        62 | 290 | 450 | 601..=603 | 621 => ReadOver,
        5 | 7 => Refused("an inclined axis", PLAIN),
        34 | 35 => Refused("a thread whose pitch changes", PLAIN),
        63 => Refused("tapping with a compensating chuck", "write CYCLE84"),
        74 | 75 => Refused("a reference or fixed point", "write G53 and the place"),
        140..=143 | 147 | 148 | 247 | 248 | 340 | 341 | 347 | 348 => Refused(
            "a smooth way to and from the contour",
            "write it as G1 and G2",
        ),
        291 => Refused(
            "the language of another control (ISO)",
            "read the program with --dialect fanuc",
        ),
        451 => Refused("a corner cut at the crossing of its sides", "write G450"),
        460..=462 => Refused("a way to and from the contour", "write it out"),
        810..=829 => Refused("a code of the machine's builder", "remove it"),
        931 | 942 | 952 | 962 | 963 => Refused(
            "a meaning of F and S in one code",
            "write G94, G95, G96 and G97",
        ),
        _ => return None,
    })
}

/// What is made of an M code. Codes that the machine's builder declared come first.
pub(crate) const fn m(number: u32) -> Option<Meaning> {
    const DECLARE: &str = "declare it by a table [m_codes.M…] in the configuration, or remove it";
    Some(match number {
        0..=9 | 19 | 30 => Shared,
        17 => Own,
        // Stages of the gear: what S says is the speed of the spindle.
        40..=45 => ReadOver,
        70 => Refused("the spindle as an axis", "write M19"),
        66 => Refused(
            "a code of the machine's builder",
            "remove it: the number is taken by the machine's own inputs",
        ),
        48..=53 | 60..=69 | 71..=73 => Refused("a code of the machine's builder", DECLARE),
        _ => return None,
    })
}

/// Letters that are addresses by themselves.
pub(crate) const ADDRESSES: &[u8] = b"ABCDFGHIJKLMNSTUVWXYZ";
