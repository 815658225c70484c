//! The keys of `[compensation.J0]`.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const COMPENSATION: &[Key] = &[
    key(
        "compensation.J0.backlash",
        number(0.0, 10.0, "mm or °"),
        LeftOut::Value("0"),
        "how far the motor turns before the joint follows, where it turns round. It is taken up inside a share of \
         the joint's limits that plans leave free: 3 % of velocity, 10 % of acceleration, 25 % of jerk. LinuxCNC's BACKLASH",
    ),
    key(
        "compensation.J0.positions",
        Takes::Numbers {
            min: -1e6,
            max: 1e6,
            unit: "mm or °",
        },
        LeftOut::Means("no table"),
        "where the joint's screw was measured, in machine coordinates, ascending; 2 to 256 of them. Only where joints \
         are axes. `glidepath config from-screw --help` says how to make the table of a measurement",
    ),
    key(
        "compensation.J0.corrections",
        Takes::Numbers {
            min: -10.0,
            max: 10.0,
            unit: "mm or °",
        },
        LeftOut::Means("no table"),
        "what is added to the joint's position there: the position less what was measured. In between a smooth curve, \
         a straight line beyond both ends",
    ),
    key(
        "compensation.J0.corrections_down",
        Takes::Numbers {
            min: -10.0,
            max: 10.0,
            unit: "mm or °",
        },
        LeftOut::Means("as corrections"),
        "the same where the joint goes down: for screws measured both ways. Their difference is play, beside backlash",
    ),
];
