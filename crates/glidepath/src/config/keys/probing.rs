//! The keys of `[probe]`.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const PROBE: &[Key] = &[
    key(
        "probe.input",
        Takes::Whole {
            min: 0,
            max: 63,
            unit: "",
        },
        LeftOut::Means("there is no probe"),
        "the digital input of feedback that a probe is connected to",
    ),
    key(
        "probe.contact",
        Takes::Choice {
            of: &["high", "low"],
        },
        LeftOut::Value("\"high\""),
        "what the input is while the probe touches",
    ),
    key(
        "probe.overtravel",
        number(0.01, 100.0, "mm"),
        LeftOut::Value("2.0"),
        "how far the machine may go on after the contact; a program with a feed that takes longer is \
         refused",
    ),
    key(
        "probe.protect",
        Takes::Flag,
        LeftOut::Value("false"),
        "true: a contact outside of a probing move stops whatever moves",
    ),
];
