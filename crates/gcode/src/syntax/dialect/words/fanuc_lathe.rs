//! The codes of FANUC's and Haas' lathes, system A, where they are others than those of mills.

use crate::syntax::dialect::words::Meaning::{self, Own, Refused};
use crate::syntax::dialect::words::fanuc;

/// What is made of a G code, whose number comes times ten.
pub(crate) const fn g(tenths: u32) -> Option<Meaning> {
    const PLAIN_BLOCKS: &str = "let the CAM system write plain blocks";
    Some(match tenths {
        // G32, G50; G70 to G75; G90, G92 and G94, which are cycles; G98 and G99, which say
        // what F is.
        320 | 500 | 700 | 710 | 720 | 730 | 740 | 750 | 900 | 920 | 940 | 980 | 990 => Own,
        // G184 of a Haas.
        1840 => Own,
        330 => Refused("a thread in another system of codes", "write G32"),
        921 => Refused(
            "offsets of G92 taken back",
            "name the place by the old coordinates again",
        ),
        340 => Refused("a thread whose pitch changes", PLAIN_BLOCKS),
        770 | 780 | 790 | 910 | 930 | 950 => Refused(
            "a code of the systems B and C",
            "write the codes of system A: U and W for G91, G98 and G99 for G94 and G95",
        ),
        870 | 880 => Refused(
            "a cycle on the side of the part, of a Haas boring with retraction by hand",
            PLAIN_BLOCKS,
        ),
        120 | 130 | 150 | 160 | 434 | 435 | 440 | 531 | 682 | 2340 | 2540 | 2550 | 501 | 510
        | 511 | 680 | 690 => Refused("a code of mills", PLAIN_BLOCKS),
        450 | 460 | 470 | 480 => Refused(
            "a tool offset that makes moves longer or shorter",
            PLAIN_BLOCKS,
        ),
        1000 | 1010 => Refused("a mirror image switched on and off", PLAIN_BLOCKS),
        430 | 490 => Refused("a code of mills", "write T0101"),
        _ => return fanuc::g(tenths),
    })
}

/// What is made of an M code that mills do not have: the way out of threads of G92, and none.
pub(crate) const fn m(number: u32) -> Option<Meaning> {
    match number {
        23 | 24 => Some(Own),
        _ => None,
    }
}
