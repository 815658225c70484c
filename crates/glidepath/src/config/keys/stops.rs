//! The keys of `[stops]`.

use super::key::{Key, LeftOut, Takes, key};

pub(super) const STOPS: &[Key] = &[
    key(
        "stops.abort",
        Takes::Flag,
        LeftOut::Value("true"),
        "spindle and coolant stop (M5, M9) when the motion has come to rest after an abort",
    ),
    key(
        "stops.fault",
        Takes::Flag,
        LeftOut::Value("true"),
        "likewise after a fault",
    ),
    key(
        "stops.disable",
        Takes::Flag,
        LeftOut::Value("true"),
        "likewise as soon as the drives have no power any more",
    ),
];
