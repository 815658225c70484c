//! The codes of FANUC's and Haas' mills.

use crate::syntax::dialect::words::Meaning::{self, Own, ReadOver, Refused, Shared};

const AXES_OF_THE_CAM: &str = "let the CAM system write the positions of the axes";
const PLAIN_BLOCKS: &str = "let the CAM system write plain blocks";

/// What is made of a G code, whose number comes times ten.
pub(crate) const fn g(tenths: u32) -> Option<Meaning> {
    Some(match tenths {
        // Moves, planes, units, offsets, cycles, feed and speed.
        0 | 10 | 20 | 30 | 40 | 170 | 180 | 190 | 200 | 210 | 280 | 330 | 62 | 400 | 410 | 420
        | 430 | 490 | 520 | 530 | 540 | 550 | 560 | 570 | 580 | 590 | 610 | 640 | 730 | 740
        | 800 | 810 | 820 | 830 | 840 | 850 | 860 | 890 | 900 | 910 | 920 | 930 | 940 | 950
        | 960 | 970 | 980 | 990 => Shared,
        // G9, G10, G12, G13, G15, G16, G30, G31, G44, G43.4, G43.5, G45 to G48, G50, G51, G50.1, G51.1, G54.1, G60,
        // G62, G63, G53.1, G68, G68.2, G69, G70, G71, G76, G87, G92.1, G100, G101, G154, G234, G254, G255.
        90 | 100 | 120 | 130 | 150 | 160 | 300 | 310 | 434 | 435 | 440 | 450 | 460 | 470 | 480
        | 500 | 501 | 510 | 511 | 531 | 541 | 600 | 620 | 630 | 680 | 682 | 690 | 700 | 710
        | 760 | 870 | 921 | 1000 | 1010 | 1540 | 2340 | 2540 | 2550 => Own,
        // Look-ahead and smoothness (G5 P, G5.1 Q, G8 P, G103 P, G187 P E), the end of G10 L50,
        // no stroke check (G23), no watch on the spindle's speed (G25), the end of what is refused
        // (G13.1, G54.2 P0 apart).
        50 | 51 | 80 | 110 | 131 | 230 | 250 | 1030 | 1870 => ReadOver,
        71 | 1070 => Refused("cylindrical interpolation", PLAIN_BLOCKS),

        121 | 1120 => Refused("polar coordinates of a C axis", PLAIN_BLOCKS),
        1130 => Refused(
            "the end of polar coordinates, or a work offset",
            "remove it, or write G154 P4",
        ),
        220 => Refused(
            "a zone the tool may not enter",
            "set the travel of the axes in the configuration",
        ),
        260 => Refused("a watch on the spindle's speed", "remove it"),
        270 => Refused(
            "a check of the reference position",
            "remove it, or write G28",
        ),
        281 | 301 => Refused("a reference position in another form", "write G28 or G30"),
        290 => Refused(
            "the way back from the reference position",
            "write the way out as G0",
        ),
        311 | 312 | 350 | 360 | 370 => Refused("a measurement", "write G31"),
        431 => Refused(
            "the length of the tool along the tool",
            "write G43 H where the rotary axes stand at zero",
        ),
        432 => Refused("a second tool length", "write G43 H"),
        340 => Refused("a thread whose pitch changes", PLAIN_BLOCKS),
        683 | 684 | 2680 | 2690 => Refused("a tilted work plane", AXES_OF_THE_CAM),
        542 => Refused("a work offset that goes with the table", AXES_OF_THE_CAM),
        720 => Refused(
            "holes along a line: whether the first one is where the tool stands is not known here",
            "write the position of each hole",
        ),
        770 | 1560 => Refused("broaching, or a back-side cycle", PLAIN_BLOCKS),
        842 | 843 => Refused("rigid tapping in another form", "write M29 S, and G84"),
        880 => Refused(
            "boring with retraction by hand",
            "use G86 or G89, which retract by themselves",
        ),
        // Those of Haas, G154 P1 to P20; two of them are codes of a C axis, too.
        1100..=1290 if tenths.is_multiple_of(10) => Own,
        1500 => Refused("a pocket of any shape, by a subprogram", PLAIN_BLOCKS),
        1360 | 1430 | 1530 | 1740 | 1840 => Refused("a function of Haas", PLAIN_BLOCKS),
        _ => return None,
    })
}

/// What is made of an M code. Codes that the machine's builder declared come first.
pub(crate) const fn m(number: u32) -> Option<Meaning> {
    const BUILDER: &str = "a code of the machine's builder";
    const DECLARE: &str = "declare it by a table [m_codes.M…] in the configuration, or remove it";
    Some(match number {
        0..=9 | 19 | 30 | 60 => Shared,
        29 => Own,
        66 => Refused(
            BUILDER,
            "remove it: the number is taken by the machine's own inputs",
        ),
        48..=53 | 61..=73 => Refused(BUILDER, DECLARE),
        96 => Refused("a jump on an input", "write IF … GOTO"),
        97..=99 => Refused(
            "a call inside of a statement",
            "give the call a line of its own",
        ),
        128 | 129 => Refused(
            "tool centre point control of another control",
            AXES_OF_THE_CAM,
        ),
        _ => return None,
    })
}
