//! The words of the SINUMERIK 840D that are names, and what is made of each.

use crate::syntax::dialect::words::Meaning::{self, Own, ReadOver, Refused};

const PLAIN: &str = "let the CAM system write plain blocks";
const FOR_EVER: &str = "it acts beside the motion: write what is to happen into blocks";

/// Names in the order of the manual's sections.
pub(crate) const NAMES: &[(&str, Meaning)] = &[
    // Look-ahead and feed forward are always on, every acceleration is limited in jerk, and dense
    // chords are merged within the tolerance.
    ("BRISK", ReadOver),
    ("BRISKA", ReadOver),
    ("SOFT", ReadOver),
    ("SOFTA", ReadOver),
    ("DRIVE", ReadOver),
    ("DRIVEA", ReadOver),
    ("FFWON", ReadOver),
    ("FFWOF", ReadOver),
    ("FNORM", ReadOver),
    ("CFC", ReadOver),
    ("CFIN", ReadOver),
    ("CFTCP", ReadOver),
    ("CPRECON", ReadOver),
    ("CPRECOF", ReadOver),
    ("NORM", ReadOver),
    ("DYNNORM", ReadOver),
    ("DYNPOS", ReadOver),
    ("DYNROUGH", ReadOver),
    ("DYNSEMIFIN", ReadOver),
    ("DYNFINISH", ReadOver),
    ("DYNPREC", ReadOver),
    ("WALIMON", ReadOver),
    ("WALCS0", ReadOver),
    ("STARTFIFO", ReadOver),
    ("STOPFIFO", ReadOver),
    ("FIFOCTRL", ReadOver),
    ("STOPRE", ReadOver),
    ("COMPON", ReadOver),
    ("COMPCAD", ReadOver),
    ("COMPCURV", ReadOver),
    ("COMPSURF", ReadOver),
    ("COMPOF", ReadOver),
    ("UPATH", ReadOver),
    ("SPATH", ReadOver),
    ("CUT2D", ReadOver),
    ("CDOF", ReadOver),
    ("CDOF2", ReadOver),
    ("SBLOF", ReadOver),
    ("SBLON", ReadOver),
    ("DISPLOF", ReadOver),
    ("DISPLON", ReadOver),
    (
        "PTP",
        Refused(
            "a move of the joints",
            "write G0, and the path that the tip takes",
        ),
    ),
    ("CP", ReadOver),
    ("ORIWKS", ReadOver),
    ("ORIAXES", ReadOver),
    (
        "ORIMKS",
        Refused("orientation in the machine's coordinates", "write ORIWKS"),
    ),
    (
        "ORIVECT",
        Refused("orientation on a great circle", "write ORIAXES"),
    ),
    (
        "ORIPLANE",
        Refused("orientation on a great circle", "write ORIAXES"),
    ),
    ("MSG", ReadOver),
    ("WORKPIECE", ReadOver),
    ("GROUP_BEGIN", ReadOver),
    ("GROUP_END", ReadOver),
    ("GROUP_ADDEND", ReadOver),
    // What is made.
    ("SUPA", Own),
    ("CIP", Own),
    ("CT", Own),
    ("DIAMON", Own),
    ("DIAMOF", Own),
    ("TRAORI", Own),
    ("TRAFOOF", Own),
    ("CYCLE800", Own),
    ("CYCLE832", Own),
    ("CTOL", Own),
    ("OTOL", ReadOver),
    ("RET", Own),
    ("AP", Own),
    ("RP", Own),
    ("AR", Own),
    ("ANG", Own),
    ("CR", Own),
    ("TURN", Own),
    ("RND", Own),
    ("RNDM", Own),
    ("CHR", Own),
    ("CHF", Own),
    ("ADIS", Own),
    ("ADISPOS", ReadOver),
    ("LIMS", Own),
    ("SPOS", Own),
    // What is not.
    (
        "CYCLE840",
        Refused("tapping with a compensating chuck", "write CYCLE84"),
    ),
    (
        "CYCLE87",
        Refused("boring with a stop at the bottom", "use CYCLE86"),
    ),
    (
        "CYCLE88",
        Refused("boring with a stop at the bottom", "use CYCLE86"),
    ),
    (
        "CYCLE89",
        Refused(
            "boring with a dwell",
            "use CYCLE85, which takes a dwell and two feeds",
        ),
    ),
    ("CYCLE60", Refused("engraving", PLAIN)),
    ("CYCLE61", Refused("face milling", PLAIN)),
    ("CYCLE62", Refused("a contour that is called", PLAIN)),
    ("CYCLE63", Refused("a contour pocket", PLAIN)),
    ("CYCLE64", Refused("a contour pocket", PLAIN)),
    ("CYCLE70", Refused("thread milling", PLAIN)),
    ("CYCLE71", Refused("face milling", PLAIN)),
    ("CYCLE72", Refused("contour milling", PLAIN)),
    ("CYCLE76", Refused("a rectangular spigot", PLAIN)),
    ("CYCLE77", Refused("a circular spigot", PLAIN)),
    ("CYCLE79", Refused("a polygon", PLAIN)),
    ("CYCLE90", Refused("thread milling", PLAIN)),
    ("CYCLE93", Refused("a groove", PLAIN)),
    ("CYCLE94", Refused("an undercut", PLAIN)),
    ("CYCLE95", Refused("roughing along a contour", PLAIN)),
    ("CYCLE97", Refused("a thread", "write G33 for each pass")),
    (
        "CYCLE98",
        Refused("a chain of threads", "write G33 for each pass"),
    ),
    ("CYCLE99", Refused("a thread", "write G33 for each pass")),
    (
        "CYCLE802",
        Refused(
            "positions one by one",
            "write each position as a block behind MCALL",
        ),
    ),
    ("CYCLE899", Refused("an open slot", PLAIN)),
    ("CYCLE930", Refused("a groove", PLAIN)),
    ("CYCLE940", Refused("an undercut", PLAIN)),
    ("CYCLE951", Refused("roughing of a corner", PLAIN)),
    ("CYCLE952", Refused("roughing along a contour", PLAIN)),
    (
        "CYCLE996",
        Refused("a measurement of the kinematics", "remove it"),
    ),
    ("CYCLE978", Refused("a measurement", "write G38.3")),
    ("SLOT1", Refused("slots", PLAIN)),
    ("SLOT2", Refused("slots", PLAIN)),
    ("LONGHOLE", Refused("long holes", PLAIN)),
    (
        "GOTOS",
        Refused(
            "a program that begins again for ever",
            "write LOOP and ENDLOOP",
        ),
    ),
    (
        "CALL",
        Refused(
            "a subprogram whose name is computed",
            "write the name itself, which calls it",
        ),
    ),
    (
        "PCALL",
        Refused(
            "a subprogram by its path",
            "write its name, and give its folder",
        ),
    ),
    (
        "EXTCALL",
        Refused(
            "a subprogram by its path",
            "write its name, and give its folder",
        ),
    ),
    ("BLOCK", Refused("a part of a program", "write REPEAT")),
    (
        "MEAS",
        Refused(
            "a measurement that leaves out the rest of the way",
            "write G38.3 with X, Y or Z",
        ),
    ),
    (
        "MEAW",
        Refused(
            "a measurement on the way",
            "measure at the end of the way: write G38.3",
        ),
    ),
    (
        "MEASA",
        Refused(
            "measurements at several edges",
            "write a G38.3 for each of them",
        ),
    ),
    (
        "MEAC",
        Refused(
            "measurements at several edges",
            "write a G38.3 for each of them",
        ),
    ),
    (
        "DIAM90",
        Refused(
            "diameters in G90 alone",
            "write DIAMON or DIAMOF where it changes",
        ),
    ),
    ("DIAMONA", Refused("diameters of one axis", "write DIAMON")),
    (
        "FLIN",
        Refused("a feed that changes along the block", "write FNORM"),
    ),
    (
        "FCUB",
        Refused("a feed that changes along the block", "write FNORM"),
    ),
    (
        "FRC",
        Refused(
            "a feed of corners",
            "remove it: corners have the feed of the path",
        ),
    ),
    (
        "FRCM",
        Refused(
            "a feed of corners",
            "remove it: corners have the feed of the path",
        ),
    ),
    (
        "OFFN",
        Refused("an offset beside the contour", "write it into the contour"),
    ),
    (
        "KONT",
        Refused("a way round the contour's beginning", "write NORM"),
    ),
    (
        "ANG1",
        Refused(
            "angles of two lines in a block",
            "write ANG in a block each",
        ),
    ),
    (
        "ANG2",
        Refused(
            "angles of two lines in a block",
            "write ANG in a block each",
        ),
    ),
    (
        "SPOSA",
        Refused("a spindle that stops beside the motion", "write SPOS"),
    ),
    (
        "SETMS",
        Refused("another master spindle", "there is one spindle"),
    ),
    ("SPCON", Refused("the spindle as an axis", "write SPOS")),
    ("SPCOF", Refused("the spindle as an axis", "write SPOS")),
    ("TRANSMIT", Refused("polar coordinates of a C axis", PLAIN)),
    ("TRACYL", Refused("cylindrical interpolation", PLAIN)),
    ("TRAANG", Refused("an inclined axis", PLAIN)),
    (
        "ASPLINE",
        Refused(
            "a spline through points",
            "let the CAM system write G1, or COMPCAD",
        ),
    ),
    (
        "BSPLINE",
        Refused(
            "a spline of control points",
            "let the CAM system write G1, or COMPCAD",
        ),
    ),
    (
        "CSPLINE",
        Refused(
            "a spline through points",
            "let the CAM system write G1, or COMPCAD",
        ),
    ),
    (
        "POLY",
        Refused("polynomials", "let the CAM system write G1, or COMPCAD"),
    ),
    ("INVCW", Refused("an involute", "write short lines")),
    ("INVCCW", Refused("an involute", "write short lines")),
    (
        "POS",
        Refused(
            "a move of an axis beside the path",
            "write the axis into the block",
        ),
    ),
    (
        "POSA",
        Refused(
            "a move of an axis beside the path",
            "write the axis into the block",
        ),
    ),
    (
        "FGROUP",
        Refused(
            "other axes that the feed counts for",
            "remove it where X, Y and Z are named",
        ),
    ),
    ("FGREF", ReadOver),
    (
        "LEAD",
        Refused(
            "an orientation against the path",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "TILT",
        Refused(
            "an orientation against the path",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "ORICONCW",
        Refused(
            "an orientation on a cone",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "ORICONCCW",
        Refused(
            "an orientation on a cone",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "ORICURVE",
        Refused(
            "an orientation by a second curve",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "ORIEULER",
        Refused(
            "orientation by Euler angles",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "ORIRPY",
        Refused(
            "orientation by angles",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "ORIRPY2",
        Refused(
            "orientation by angles",
            "let the CAM system write A3=, B3=, C3=",
        ),
    ),
    (
        "TOFRAME",
        Refused("a frame along the tool", "write CYCLE800"),
    ),
    ("TOROT", Refused("a frame along the tool", "write CYCLE800")),
    ("ID", Refused("a synchronised action", FOR_EVER)),
    ("IDS", Refused("a synchronised action", FOR_EVER)),
    ("WHEN", Refused("a synchronised action", FOR_EVER)),
    ("WHENEVER", Refused("a synchronised action", FOR_EVER)),
    ("EVERY", Refused("a synchronised action", FOR_EVER)),
    ("DO", Refused("a synchronised action", FOR_EVER)),
    ("CANCEL", Refused("a synchronised action", FOR_EVER)),
    (
        "SETAL",
        Refused("an alarm of the program", "write M0 and a message"),
    ),
    (
        "INIT",
        Refused("another channel", "run each channel's program by itself"),
    ),
    (
        "START",
        Refused("another channel", "run each channel's program by itself"),
    ),
    (
        "WAITM",
        Refused("another channel", "run each channel's program by itself"),
    ),
    (
        "WAITE",
        Refused("another channel", "run each channel's program by itself"),
    ),
    (
        "SETM",
        Refused("another channel", "run each channel's program by itself"),
    ),
    (
        "TCARR",
        Refused("a tool carrier with orientation", "write CYCLE800"),
    ),
    (
        "TCOABS",
        Refused("a tool carrier with orientation", "write CYCLE800"),
    ),
    (
        "TCOFR",
        Refused("a tool carrier with orientation", "write CYCLE800"),
    ),
];

/// What is made of a name, in capitals.
pub(crate) fn meaning(name: &[u8]) -> Option<Meaning> {
    let found = NAMES.iter().find(|(known, _)| known.as_bytes() == name);
    found.map(|(_, meaning)| *meaning)
}
