//! The keys of `[superposition]`.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const SUPERPOSITION: &[Key] = &[
    key(
        "superposition.axis",
        Takes::Choice {
            of: &["X", "Y", "Z", "A", "B", "C", "U", "V", "W"],
        },
        LeftOut::Means("nothing is added to the motion of programs"),
        "the axis that an input moves in addition to programs",
    ),
    key(
        "superposition.by",
        Takes::Choice {
            of: &["input", "wheel"],
        },
        LeftOut::Value("\"input\""),
        "what moves it: an analog input; or a handwheel, or a program that demands as one does",
    ),
    key(
        "superposition.share",
        number(0.01, 0.9, ""),
        LeftOut::Value("0.25"),
        "the part of the axis' velocity, acceleration and jerk for that; programs and jogs have the rest",
    ),
    key(
        "superposition.lowest",
        number(-1000.0, 0.0, "mm or °"),
        LeftOut::Value("-5.0"),
        "the lowest offset; programs stay so far above the lower end of the travel",
    ),
    key(
        "superposition.highest",
        number(0.0, 1000.0, "mm or °"),
        LeftOut::Value("5.0"),
        "the highest offset; programs stay so far below the upper end of the travel",
    ),
    key(
        "superposition.input",
        Takes::Whole {
            min: 0,
            max: 7,
            unit: "",
        },
        LeftOut::Refused,
        "the analog input of feedback that moves the axis; without meaning for a wheel",
    ),
    key(
        "superposition.sets",
        Takes::Choice {
            of: &["velocity", "offset"],
        },
        LeftOut::Value("\"velocity\""),
        "what the input sets: the velocity of the offset, so that the input comes to its target; or the offset itself",
    ),
    key(
        "superposition.target",
        number(-1e6, 1e6, ""),
        LeftOut::Value("0.0"),
        "what the input says where nothing is to move, or where the offset is 0",
    ),
    key(
        "superposition.gain",
        number(-1e6, 1e6, ""),
        LeftOut::Value("1.0"),
        "mm/s, or mm, for each unit of the input above the target; below 0 for the other direction",
    ),
    key(
        "superposition.dead_band",
        number(0.0, 1e6, ""),
        LeftOut::Value("0.0"),
        "how far the input may be from the target without effect",
    ),
    key(
        "superposition.switched_by",
        Takes::Whole {
            min: 0,
            max: 63,
            unit: "",
        },
        LeftOut::Means("it is on while programs cut"),
        "the digital output by which programs switch it on and off (M62 to M65)",
    ),
    key(
        "superposition.enabled_by",
        Takes::Whole {
            min: 0,
            max: 63,
            unit: "",
        },
        LeftOut::Means("no input has to allow it"),
        "the digital input of feedback without which the offset stands still (the arc is there)",
    ),
    key(
        "superposition.enabled_at",
        Takes::Choice {
            of: &["high", "low"],
        },
        LeftOut::Value("\"high\""),
        "what that input is where the offset may move",
    ),
    key(
        "superposition.freeze_below",
        number(0.0, 1.0, ""),
        LeftOut::Value("0.9"),
        "the part of the programmed feed below which the offset stands still: at corners",
    ),
    key(
        "superposition.freeze_for",
        number(0.0, 10.0, "s"),
        LeftOut::Value("0.1"),
        "how long it stands still behind that",
    ),
    key(
        "superposition.off",
        Takes::Choice {
            of: &["return", "keep"],
        },
        LeftOut::Value("\"return\""),
        "what happens where it is switched off: the axis returns to the program, or keeps its offset",
    ),
];
