//! The words of the SINUMERIK 840D that are names, and what is made of each.

use crate::syntax::dialect::words::Meaning::{self, Own, ReadOver, Refused};

const PLAIN: &str = "let the CAM system write plain blocks";
const FOR_EVER: &str = "it acts beside the motion: write what is to happen into blocks";
const VECTOR: &str = "let the CAM system write A3=, B3=, C3=";

/// Names that are read over: look-ahead and feed forward are always on, every acceleration is limited in
/// jerk, dense chords are merged within the tolerance, and headers and messages move nothing.
const READ_OVER: &[&str] = &[
    "BRISK",
    "BRISKA",
    "SOFT",
    "SOFTA",
    "DRIVE",
    "DRIVEA",
    "FFWON",
    "FFWOF",
    "FNORM",
    "CPRECON",
    "CPRECOF",
    "NORM",
    "DYNNORM",
    "DYNPOS",
    "DYNROUGH",
    "DYNSEMIFIN",
    "DYNFINISH",
    "DYNPREC",
    "WALIMON",
    "WALCS0",
    "STARTFIFO",
    "STOPFIFO",
    "FIFOCTRL",
    "STOPRE",
    "COMPON",
    "COMPCAD",
    "COMPCURV",
    "COMPSURF",
    "COMPOF",
    "UPATH",
    "SPATH",
    "CUT2D",
    "CDOF",
    "CDOF2",
    "SBLOF",
    "SBLON",
    "DISPLOF",
    "DISPLON",
    "LFON",
    "LFOF",
    "WALIMOF",
    "CUTCONOF",
    "RTLION",
    "RTLIOF",
    "PAROTOF",
    "TOROTOF",
    "OSOF",
    "ORISOF",
    "ATOL",
    "STOLF",
    "ACC",
    "ACCLIMA",
    "JERKLIM",
    "JERKLIMA",
    "DELAYFSTON",
    "DELAYFSTOF",
    "COMPPATH",
    "CP",
    "ORIWKS",
    "MSG",
    "WORKPIECE",
    "GROUP_BEGIN",
    "GROUP_END",
    "GROUP_ADDEND",
    "OTOL",
    "ADISPOS",
    "FGREF",
];

/// Names whose meaning is made.
const MADE: &[&str] = &[
    "SUPA", "CIP", "CT", "DIAMON", "DIAMOF", "DIAM90", "CFC", "CFIN", "CFTCP", "TRAORI", "TRAFOOF",
    "CYCLE800", "CYCLE832", "CTOL", "RET", "ENDPROC", "AP", "RP", "AR", "ANG", "ANG1", "ANG2",
    "CR", "TURN", "RND", "RNDM", "CHR", "CHF", "FRC", "FRCM", "FB", "ADIS", "LIMS", "SPOS",
    "SETMS", "SF", "FGROUP", "CALL", "PCALL", "EXTCALL", "ORIVECT", "ORIPLANE", "ORIAXES",
];

/// Names that are refused: what they are, and what to do instead.
const REFUSED: &[(&[&str], &str, &str)] = &[
    (
        &["PTP"],
        "a move of the joints",
        "write G0, and the path that the tip takes",
    ),
    (
        &["ORIMKS"],
        "orientation in the machine's coordinates",
        "write ORIWKS",
    ),
    (
        &["E_HEAD", "F_HEAD"],
        "the head of a program of ShopMill or ShopTurn, whose steps the control alone knows",
        PLAIN,
    ),
    (&["CYCLE60"], "engraving", PLAIN),
    (
        &["CYCLE61"],
        "face milling with borders: what the digits of its last arguments mean is not known here",
        "write CYCLE71",
    ),
    (&["CYCLE62"], "a contour that is called", PLAIN),
    (&["CYCLE63", "CYCLE64"], "a contour pocket", PLAIN),
    (&["CYCLE70", "CYCLE90"], "thread milling", PLAIN),
    (
        &["CYCLE72"],
        "contour milling: whether LP1 and LP2 count from the middle of the tool or from its edge is not known here",
        PLAIN,
    ),
    (&["CYCLE79"], "a polygon", PLAIN),
    (
        &["CYCLE93", "CYCLE930"],
        "a groove: how wide the tool is, which its edges D1 and D2 say there, is not known here",
        PLAIN,
    ),
    (
        &["CYCLE94", "CYCLE940", "CYCLE96"],
        "an undercut, whose size is in tables of the control",
        PLAIN,
    ),
    (&["CYCLE952"], "roughing along a contour", PLAIN),
    (
        &["CYCLE99"],
        "a thread: what the digits of its arguments mean is not known here",
        "write G33 for each pass",
    ),
    (&["CYCLE899"], "an open slot", PLAIN),
    (&["CYCLE951"], "roughing of a corner", PLAIN),
    (
        &["CYCLE996"],
        "a measurement of the kinematics",
        "remove it",
    ),
    (
        &[
            "CYCLE961", "CYCLE971", "CYCLE973", "CYCLE974", "CYCLE976", "CYCLE977", "CYCLE978",
            "CYCLE979", "CYCLE982", "CYCLE994", "CYCLE995", "CYCLE997", "CYCLE998",
        ],
        "a measurement",
        "write G38.3",
    ),
    (
        &["SLOT1", "SLOT2"],
        "slots on a circle: where RAD leads, to their beginning or to their middle, is not known here",
        PLAIN,
    ),
    (
        &["LONGHOLE"],
        "long holes on a circle: where RAD leads, to their beginning or to their middle, is not known here",
        PLAIN,
    ),
    (
        &["GOTOS"],
        "a program that begins again for ever",
        "write LOOP and ENDLOOP",
    ),
    (
        &["MEAS"],
        "a measurement that leaves out the rest of the way",
        "write G38.3 with X, Y or Z",
    ),
    (
        &["MEAW"],
        "a measurement on the way",
        "measure at the end of the way: write G38.3",
    ),
    (
        &["MEASA", "MEAC"],
        "measurements at several edges",
        "write a G38.3 for each of them",
    ),
    (&["DIAMONA"], "diameters of one axis", "write DIAMON"),
    (
        &["VELOLIM", "VELOLIMA"],
        "a limit of the speed of an axis or spindle",
        "write a smaller F or S, or set it in the configuration",
    ),
    (
        &["FLIN", "FCUB"],
        "a feed that changes along the block",
        "write FNORM",
    ),
    (
        &["OFFN"],
        "an offset beside the contour",
        "write it into the contour",
    ),
    (
        &["KONT"],
        "a way round the contour's beginning",
        "write NORM",
    ),
    (
        &["OVR", "OVRRAP", "OVRA"],
        "a feed in per cent",
        "write the feed itself as F",
    ),
    (
        &["SPOSA"],
        "a spindle that stops beside the motion",
        "write SPOS",
    ),
    (&["SPCON", "SPCOF"], "the spindle as an axis", "write SPOS"),
    (&["TRANSMIT"], "polar coordinates of a C axis", PLAIN),
    (&["TRACYL"], "cylindrical interpolation", PLAIN),
    (&["TRAANG"], "an inclined axis", PLAIN),
    (
        &["ASPLINE", "CSPLINE"],
        "a spline through points",
        "let the CAM system write G1, or COMPCAD",
    ),
    (
        &["BSPLINE"],
        "a spline of control points",
        "let the CAM system write G1, or COMPCAD",
    ),
    (
        &["POLY"],
        "polynomials",
        "let the CAM system write G1, or COMPCAD",
    ),
    (&["INVCW", "INVCCW"], "an involute", "write short lines"),
    (
        &["POS", "POSA"],
        "a move of an axis beside the path",
        "write the axis into the block",
    ),
    (&["LEAD", "TILT"], "an orientation against the path", VECTOR),
    (
        &["ORICONCW", "ORICONCCW"],
        "an orientation on a cone",
        VECTOR,
    ),
    (&["ORICURVE"], "an orientation by a second curve", VECTOR),
    (&["ORIEULER"], "orientation by Euler angles", VECTOR),
    (&["ORIRPY", "ORIRPY2"], "orientation by angles", VECTOR),
    (
        &["TOFRAME", "TOROT"],
        "a frame along the tool, whose turn about it is machine data",
        "write CYCLE800",
    ),
    (
        &["ID", "IDS", "WHEN", "WHENEVER", "EVERY", "DO", "CANCEL"],
        "a synchronised action",
        FOR_EVER,
    ),
    (
        &["SETAL"],
        "an alarm of the program",
        "write M0 and a message",
    ),
    (
        &["INIT", "START", "WAITM", "WAITE", "SETM"],
        "another channel",
        "run each channel's program by itself",
    ),
    (
        &["TCARR", "TCOABS", "TCOFR"],
        "a tool carrier with orientation, whose axes are machine data",
        "write CYCLE800, or TRAORI",
    ),
];

/// All names, with what is made of each.
pub(crate) fn names() -> impl Iterator<Item = (&'static str, Meaning)> {
    let of = |names: &'static [&'static str], meaning: Meaning| {
        names.iter().map(move |name| (*name, meaning))
    };
    let refused = REFUSED
        .iter()
        .flat_map(move |(names, what, help)| of(names, Refused(what, help)));
    of(READ_OVER, ReadOver).chain(of(MADE, Own)).chain(refused)
}

/// What is made of a name, in capitals.
pub(crate) fn meaning(name: &[u8]) -> Option<Meaning> {
    let found = names().find(|(known, _)| known.as_bytes() == name);
    found.map(|(_, meaning)| meaning)
}
