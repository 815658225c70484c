//! The keys of mechanisms: their dimensions.

use super::key::{Key, LeftOut, Takes, key};

const LENGTH: Takes = Takes::Number {
    min: 1e-3,
    max: 1e5,
    unit: "mm",
};
const OFFSET: Takes = Takes::Number {
    min: -1e5,
    max: 1e5,
    unit: "mm",
};
const ANGLE: Takes = Takes::Number {
    min: 0.0,
    max: 180.0,
    unit: "°",
};
const POINT: Takes = Takes::ThreeNumbers {
    min: -1e5,
    max: 1e5,
    unit: "mm",
};
const PARTS: Takes = Takes::ThreeNumbers {
    min: -1e3,
    max: 1e3,
    unit: "",
};
const DIRECTIONS: Takes = Takes::ThreeNumbers {
    min: -360.0,
    max: 360.0,
    unit: "°",
};
const ORIGIN: LeftOut = LeftOut::Value("[0, 0, 0]");

pub(super) const TABLES: [&[Key]; 7] = [
    LINEAR_DELTA,
    ROTARY_DELTA,
    SCARA,
    FIVE_BAR,
    FIVE_AXIS,
    HEXAPOD,
    TRANSLATIONAL_HEXAPOD,
];

const LINEAR_DELTA: &[Key] = &[
    key(
        "machine.linear-delta.rod",
        LENGTH,
        LeftOut::Refused,
        "length of the rods between their pivots",
    ),
    key(
        "machine.linear-delta.radius",
        LENGTH,
        LeftOut::Refused,
        "radius of the towers less that of the effector less the carriages' offset",
    ),
    key(
        "machine.linear-delta.tower_angles",
        DIRECTIONS,
        LeftOut::Value("[90, 210, 330]"),
        "direction of each tower from +X",
    ),
];

const ROTARY_DELTA: &[Key] = &[
    key(
        "machine.rotary-delta.base_radius",
        LENGTH,
        LeftOut::Refused,
        "from the centre to the pivots of the arms",
    ),
    key(
        "machine.rotary-delta.platform_radius",
        LENGTH,
        LeftOut::Refused,
        "from the centre of the platform to the joints of the forearms",
    ),
    key(
        "machine.rotary-delta.upper_arm",
        LENGTH,
        LeftOut::Refused,
        "from pivot to knee",
    ),
    key(
        "machine.rotary-delta.forearm",
        LENGTH,
        LeftOut::Refused,
        "from knee to platform",
    ),
    key(
        "machine.rotary-delta.arm_angles",
        DIRECTIONS,
        LeftOut::Value("[90, 210, 330]"),
        "direction of each arm from +X, at least 10° apart from the others",
    ),
];

const SCARA: &[Key] = &[
    key(
        "machine.scara.upper_arm",
        LENGTH,
        LeftOut::Refused,
        "from the shoulder's axis to the elbow's",
    ),
    key(
        "machine.scara.forearm",
        LENGTH,
        LeftOut::Refused,
        "from the elbow's axis to the wrist's",
    ),
    key(
        "machine.scara.tool",
        OFFSET,
        LeftOut::Value("0"),
        "from the wrist's axis to the tool's tip, in the direction C",
    ),
    key(
        "machine.scara.height",
        OFFSET,
        LeftOut::Value("0"),
        "Z of the tool's tip where J2 is at zero",
    ),
    key(
        "machine.scara.elbow",
        Takes::Choice {
            of: &["positive", "negative"],
        },
        LeftOut::Value("\"positive\""),
        "which way the elbow bends; \"positive\": J1 above zero",
    ),
];

const FIVE_BAR: &[Key] = &[
    key(
        "machine.five-bar.shoulder_distance",
        LENGTH,
        LeftOut::Refused,
        "from the axis of one shoulder to that of the other, along X",
    ),
    key(
        "machine.five-bar.upper_arm",
        LENGTH,
        LeftOut::Refused,
        "from a shoulder's axis to the knee's, of both arms",
    ),
    key(
        "machine.five-bar.forearm",
        LENGTH,
        LeftOut::Refused,
        "from a knee's axis to the tool, of both arms",
    ),
];

const FIVE_AXIS: &[Key] = &[
    key(
        "machine.five-axis.layout",
        Takes::Choice {
            of: &["table-table", "head-head", "table-head"],
        },
        LeftOut::Refused,
        "which of the two rotary axes carry the work, and which the tool",
    ),
    key(
        "machine.five-axis.tilt",
        Takes::Choice { of: &["A", "B"] },
        LeftOut::Refused,
        "the axis that tilts; the rotary axis is C",
    ),
    key(
        "machine.five-axis.tilt_direction",
        PARTS,
        LeftOut::Means("along X for A, along Y for B"),
        "direction of the tilt axis with C at zero, of any length; [0, 1, 1]: at 45° between Y and Z (nutating)",
    ),
    key(
        "machine.five-axis.tool",
        OFFSET,
        LeftOut::Refused,
        "length of the tool: from the spindle's reference point on tables, from the pivot of a head to \
         the tip",
    ),
    key(
        "machine.five-axis.tilt_reversed",
        Takes::Flag,
        LeftOut::Value("false"),
        "true if a positive angle of the tilt turns its table or head the left-handed way",
    ),
    key(
        "machine.five-axis.rotary_reversed",
        Takes::Flag,
        LeftOut::Value("false"),
        "the same of C",
    ),
    key(
        "machine.five-axis.tilt_point",
        POINT,
        ORIGIN,
        "a point on the tilt axis, in work coordinates at zero; \"table-table\"",
    ),
    key(
        "machine.five-axis.rotary_point",
        POINT,
        ORIGIN,
        "a point on the rotary axis, likewise; \"table-table\" and \"table-head\"",
    ),
    key(
        "machine.five-axis.rotary_to_tilt",
        POINT,
        ORIGIN,
        "from the rotary axis to the tilt axis at zero; \"head-head\"",
    ),
    key(
        "machine.five-axis.tilt_to_spindle",
        POINT,
        ORIGIN,
        "from the tilt axis to the spindle's axis at zero; \"head-head\"",
    ),
];

const HEXAPOD: &[Key] = &[
    key(
        "machine.hexapod.base_radius",
        LENGTH,
        LeftOut::Refused,
        "circle of the base joints",
    ),
    key(
        "machine.hexapod.platform_radius",
        LENGTH,
        LeftOut::Refused,
        "circle of the platform joints",
    ),
    key(
        "machine.hexapod.half_angle",
        Takes::Number {
            min: 0.5,
            max: 29.0,
            unit: "°",
        },
        LeftOut::Refused,
        "half the angle between the two joints of a pair",
    ),
    key(
        "machine.hexapod.base_z",
        OFFSET,
        LeftOut::Value("0"),
        "height of the base joints",
    ),
    key(
        "machine.hexapod.tool",
        POINT,
        ORIGIN,
        "the tool's tip in the frame of the platform joints",
    ),
    key(
        "machine.hexapod.max_base_angle",
        ANGLE,
        LeftOut::Means("no such limit"),
        "largest angle between a strut and the normal of the base",
    ),
    key(
        "machine.hexapod.max_platform_angle",
        ANGLE,
        LeftOut::Means("no such limit"),
        "largest angle between a strut and the normal of the platform",
    ),
    key(
        "machine.hexapod.min_strut_distance",
        LENGTH,
        LeftOut::Means("no such limit"),
        "least distance between the centre lines of two struts",
    ),
];

const TRANSLATIONAL_HEXAPOD: &[Key] = &[
    key(
        "machine.translational-hexapod.radius_difference",
        LENGTH,
        LeftOut::Refused,
        "radius of the base hexagon less that of the platform",
    ),
    key(
        "machine.translational-hexapod.base_z",
        OFFSET,
        LeftOut::Value("0"),
        "height of the base joints",
    ),
];
