//! The G codes and M codes of printers, but for the M codes that are functions of the machine
//! ([`crate::syntax::dialect::marlin`]).

use crate::syntax::dialect::words::Meaning::{self, Own, Refused, Shared};

/// What is made of a G code, whose number comes times ten.
pub(crate) const fn g(tenths: u32) -> Option<Meaning> {
    const FIRMWARE: &str = "the firmware moves the machine by itself: write the moves out";
    Some(match tenths {
        0 | 10 | 20 | 30 | 40 | 50 | 170 | 180 | 190 | 200 | 210 | 900 | 910 | 920 => Shared,
        280 | 600 | 610 => Own,
        60 => Refused("a move of the motors", FIRMWARE),
        100 | 110 => Refused(
            "retraction by the firmware",
            "let the slicer write the moves of the extruder",
        ),
        120 | 260 | 270 => Refused("a pattern or a parking place of the firmware", FIRMWARE),
        290..=310 | 330 | 340 | 350 | 380 | 382..=385 | 420 | 760 => {
            Refused("probing and levelling", FIRMWARE)
        }
        530..=599 => Refused("a workspace of the firmware", "write G92"),
        800..=890 => Refused("a cycle of the firmware", FIRMWARE),
        921 => Refused(
            "offsets of G92 taken back",
            "write G92 with the old coordinates",
        ),
        _ => return None,
    })
}

/// What is made of an M code that is no function of the machine. Declared ones come first.
pub(crate) const fn m(number: u32) -> Option<Meaning> {
    Some(match number {
        0..=1 | 3..=5 | 7..=9 => Shared,
        25 | 82 | 83 => Own,
        2 | 30 => Refused(
            "the end of a program on other controls, a file on this one",
            "remove it: a program ends with its text",
        ),
        48 => Refused("a test of the probe", "remove it"),
        49..=53 | 60..=72 => Refused("a code of other controls", "remove it"),
        207..=209 => Refused(
            "retraction by the firmware",
            "let the slicer write the moves of the extruder",
        ),
        125 | 290 | 401 | 402 | 600 | 603 | 701 | 702 => {
            Refused("a move of the firmware", "write the moves out, or M0")
        }
        206 => Refused(
            "offsets of home positions",
            "write G92, or set the work offset of the machine",
        ),
        _ => return None,
    })
}
