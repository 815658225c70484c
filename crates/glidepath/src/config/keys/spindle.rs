//! The keys of `[spindle]`.

use super::key::{Key, LeftOut, Takes, key};

pub(super) const SPINDLE: &[Key] = &[key(
    "spindle.encoder",
    Takes::Flag,
    LeftOut::Value("false"),
    "the angle of the spindle is known, so that threads (G33) can follow it: the drives' feedback tells \
     it (feedback.source = \"drives\"), or it is simulated with them",
)];
