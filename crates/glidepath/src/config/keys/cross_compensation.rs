//! The keys of `[squareness]` and `[straightness.ZX]`.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const SQUARENESS: &[Key] = &[
    key(
        "squareness.XY",
        number(-10.0, 10.0, "mm/m"),
        LeftOut::Value("0"),
        "what is added to X for each metre of Y: less than 0 where X gets ahead as Y rises, and the angle between them \
         is less than 90°",
    ),
    key(
        "squareness.XZ",
        number(-10.0, 10.0, "mm/m"),
        LeftOut::Value("0"),
        "what is added to X for each metre of Z",
    ),
    key(
        "squareness.YZ",
        number(-10.0, 10.0, "mm/m"),
        LeftOut::Value("0"),
        "what is added to Y for each metre of Z",
    ),
];

pub(super) const STRAIGHTNESS: &[Key] = &[
    key(
        "straightness.ZX.positions",
        Takes::Numbers {
            min: -1e6,
            max: 1e6,
            unit: "mm or °",
        },
        LeftOut::Refused,
        "where the second axis of the name was when the first one was measured, in machine coordinates, ascending; 2 to \
         256 of them. Only where joints are axes. SINUMERIK's CEC",
    ),
    key(
        "straightness.ZX.corrections",
        Takes::Numbers {
            min: -10.0,
            max: 10.0,
            unit: "mm or °",
        },
        LeftOut::Refused,
        "what is added to the first axis of the name there: less than 0 where it was too far up. In between a smooth \
         curve, a straight line beyond both ends",
    ),
];
