//! The keys of `[adaptive_feed]`.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const ADAPTIVE_FEED: &[Key] = &[
    key(
        "adaptive_feed.input",
        Takes::Whole {
            min: 0,
            max: 7,
            unit: "",
        },
        LeftOut::Means("nothing but the override slows programs down"),
        "the analog input of feedback that slows programs down",
    ),
    key(
        "adaptive_feed.at_zero",
        number(-1e6, 1e6, ""),
        LeftOut::Value("0.0"),
        "what the input says where programs are to stand",
    ),
    key(
        "adaptive_feed.at_full",
        number(-1e6, 1e6, ""),
        LeftOut::Value("1.0"),
        "what the input says where programs are to run as fast as the override lets them",
    ),
    key(
        "adaptive_feed.always",
        Takes::Flag,
        LeftOut::Value("false"),
        "true: at all times; false: from M52 P1 to M52 P0",
    ),
    key(
        "adaptive_feed.backwards",
        Takes::Flag,
        LeftOut::Value("false"),
        "true: on the other side of at_zero the motion goes back along the path; false: it stands",
    ),
];
