//! The keys of `[spindle]`.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const SPINDLE: &[Key] = &[
    key(
        "spindle.encoder",
        Takes::Flag,
        LeftOut::Value("false"),
        "the angle of the spindle is known, so that threads (G33) and taps (G33.1) can follow it: the \
         drives' feedback tells it (feedback.source = \"drives\"), or it is simulated with them",
    ),
    key(
        "spindle.axis",
        Takes::Choice {
            of: &["none", "A", "B", "C"],
        },
        LeftOut::Value("\"none\""),
        "the rotary axis that the servo of the spindle follows while M3 and M4 do not turn it: taps \
         (G33.1, CYCLE84, and G84 and G74 where they are rigid) are straight moves of both axes then, \
         and follow nothing. M3 turns it to higher angles. With feedback of drives it takes a table \
         [m_codes.M5] that says when the spindle stands",
    ),
    key(
        "spindle.orientation",
        Takes::Flag,
        LeftOut::Value("false"),
        "the spindle is turned to the angle that a program gives it (M19 R, SPOS) and held there; without \
         it such a program is refused. With feedback of drives it takes a table [m_codes.M19] that says when \
         it stands there",
    ),
    key(
        "spindle.rigid_tapping",
        Takes::Flag,
        LeftOut::Value("false"),
        "G84 and G74 tap rigidly; else they are for a tap in a holder that gives way",
    ),
    key(
        "spindle.acceleration",
        number(0.1, 10_000.0, "rev/s²"),
        LeftOut::Means("a rigid tap turns back at the bottom of its hole, and runs on below it"),
        "how fast the speed of the spindle changes when it turns back: a rigid tap is turned back so \
         much above the bottom of its hole",
    ),
    key(
        "spindle.override_min",
        number(0.1, 1.0, ""),
        LeftOut::Value("0.5"),
        "the least spindle override that an operator may set: 0.5 is 50 %",
    ),
    key(
        "spindle.override_max",
        number(1.0, 2.0, ""),
        LeftOut::Means("1.2, and 1.1 with encoder = true"),
        "the highest spindle override that an operator may set; at most 1.1 with encoder = true, because threads \
         are planned for a spindle that turns that much faster than programmed",
    ),
    key(
        "spindle.gear_max",
        Takes::Numbers {
            min: 1.0,
            max: 1e6,
            unit: "rev/min",
        },
        LeftOut::Means("no gears, and M41 to M45 are what a table [m_codes.M41] makes of them"),
        "the gears of the spindle: the highest speed of each, up to five, that of M41 first. A higher S is refused. \
         With feedback of drives each gear takes a table [m_codes.M41] that says when it is in",
    ),
    key(
        "spindle.gear_min",
        Takes::Numbers {
            min: 0.0,
            max: 1e6,
            unit: "rev/min",
        },
        LeftOut::Means("0 in each gear"),
        "the lowest speed of the spindle in each gear, in the order of gear_max. A lower S is refused",
    ),
    key(
        "spindle.gear_choice",
        Takes::Choice {
            of: &["words", "speed"],
        },
        LeftOut::Value("\"words\""),
        "who chooses the gear: \"words\": M41 to M45, and S behind M40 of a SINUMERIK. \"speed\": S, in every program \
         until it has one of these words",
    ),
    key(
        "spindle.overtravel",
        number(0.1, 100.0, "revolutions"),
        LeftOut::Value("10"),
        "how far a rigid tap goes on, at most, from where the spindle is told to turn back: there it \
         stops in its hole, with a fault, and there it has to be inside the travel of its axis",
    ),
];
