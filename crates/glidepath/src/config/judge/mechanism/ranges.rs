//! The ranges of the dimensions of mechanisms.

use crate::config::judge::values::Range;

pub(super) const LENGTH: Range = Range {
    min: 1e-3,
    max: 1e5,
    unit: "mm",
    help: "a length of the mechanism",
};
pub(super) const OFFSET: Range = Range {
    min: -1e5,
    max: 1e5,
    unit: "mm",
    help: "an offset of the mechanism",
};
pub(super) const ANGLE: Range = Range {
    min: 0.0,
    max: 180.0,
    unit: "°",
    help: "an angle of the mechanism",
};
pub(super) const PART: Range = Range {
    min: -1e3,
    max: 1e3,
    unit: "",
    help: "a part of a direction, which may have any length",
};
pub(super) const DIRECTION: Range = Range {
    min: -360.0,
    max: 360.0,
    unit: "°",
    help: "a direction in the plane, counted from X towards Y",
};
