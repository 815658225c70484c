//! The keys of the tables about the machine and what moves it.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const MACHINE: &[Key] = &[key(
    "machine.kinematics",
    Takes::Choice {
        of: &[
            "trivial",
            "corexy",
            "linear-delta",
            "rotary-delta",
            "scara",
            "five-bar",
            "five-axis",
            "hexapod",
            "translational-hexapod",
        ],
    },
    LeftOut::Value("\"trivial\""),
    "how the axes are driven; \"trivial\": every axis by a drive of its own. The others have a table \
     of their dimensions, [machine.…], and one for each joint; \"corexy\" has only the joints",
)];

pub(super) const AXIS: &[Key] = &[
    key(
        "axis.X.min_position",
        number(-1e6, 1e6, "mm or °"),
        LeftOut::Refused,
        "lower soft limit in machine coordinates. Only a rotary axis (A, B, C) may have none, and then \
         neither of the two",
    ),
    key(
        "axis.X.max_position",
        number(-1e6, 1e6, "mm or °"),
        LeftOut::Refused,
        "upper soft limit in machine coordinates, above the lower one",
    ),
    key(
        "axis.X.max_velocity",
        number(1e-3, 1e5, "mm/s or °/s"),
        LeftOut::Refused,
        "what the drive can do, in either direction of motion. Not needed where joints that are not the \
         axes have their limits; nor are the two below",
    ),
    key(
        "axis.X.max_acceleration",
        number(1e-3, 1e7, "mm/s² or °/s²"),
        LeftOut::Refused,
        "what the drive can do, speeding up and slowing down",
    ),
    key(
        "axis.X.max_jerk",
        number(1e-3, 1e10, "mm/s³ or °/s³"),
        LeftOut::Refused,
        "how fast the acceleration may change. Too high a jerk shows as vibration; the acceleration \
         divided by the jerk is the time a full acceleration takes to build up",
    ),
    key(
        "axis.X.jog_velocity",
        number(1e-3, 1e5, "mm/s or °/s"),
        LeftOut::Means("jog.velocity"),
        "top speed of a jog of this axis",
    ),
    key(
        "axis.X.gantry_difference",
        number(1e-6, 1e3, "mm or °"),
        LeftOut::Means("the axis has one joint"),
        "a second joint moves the axis, too; it comes after those of the axes. By so much the two may \
         differ: beyond it the motion stops, beyond twice of it the power goes",
    ),
];

pub(super) const JOINT: &[Key] = &[
    key(
        "joint.J0.min_position",
        number(-1e6, 1e6, "mm or °"),
        LeftOut::Means("no lower end"),
        "lower end of the joint's range; only of machines whose joints are not their axes",
    ),
    key(
        "joint.J0.max_position",
        number(-1e6, 1e6, "mm or °"),
        LeftOut::Means("no upper end"),
        "upper end of the joint's range",
    ),
    key(
        "joint.J0.max_velocity",
        number(1e-3, 1e5, "mm/s or °/s"),
        LeftOut::Refused,
        "what the joint's drive can do",
    ),
    key(
        "joint.J0.max_acceleration",
        number(1e-3, 1e7, "mm/s² or °/s²"),
        LeftOut::Refused,
        "what the joint's drive can do",
    ),
    key(
        "joint.J0.max_jerk",
        number(1e-3, 1e10, "mm/s³ or °/s³"),
        LeftOut::Refused,
        "how fast the joint's acceleration may change",
    ),
];

pub(super) const HOME: &[Key] = &[
    key(
        "home.J0.search_velocity",
        number(-1e5, 1e5, "mm/s or °/s"),
        LeftOut::Value("0"),
        "velocity of the search for the home switch, with its direction; 0: there is none. LinuxCNC's \
         HOME_SEARCH_VEL",
    ),
    key(
        "home.J0.latch_velocity",
        number(-1e5, 1e5, "mm/s or °/s"),
        LeftOut::Value("0"),
        "velocity at which the place is found: of the search's sign onto the edge of the switch, of \
         the other one off it; with index or index_input, to the index pulse. Without a search and without a \
         latch, the joint is where its offset says. LinuxCNC's HOME_LATCH_VEL",
    ),
    key(
        "home.J0.final_velocity",
        number(1e-3, 1e5, "mm/s or °/s"),
        LeftOut::Means("the joint's highest"),
        "velocity of the way from there to the home position. LinuxCNC's HOME_FINAL_VEL",
    ),
    key(
        "home.J0.index_input",
        Takes::Whole {
            min: 0,
            max: 63,
            unit: "",
        },
        LeftOut::Means("the edge of the switch is the place"),
        "the digital input that is the index pulse of the encoder, which the servo stack has to latch. \
         LinuxCNC's HOME_USE_INDEX",
    ),
    key(
        "home.J0.index",
        Takes::Choice {
            of: &["none", "drive"],
        },
        LeftOut::Value("\"none\""),
        "\"drive\": the joint's drive keeps where the index pulse of its encoder is, and is asked to before the joint \
         sets out: on EtherCAT by its touch probe, `index` in drives.toml. LinuxCNC's HOME_USE_INDEX",
    ),
    key(
        "home.J0.offset",
        number(-1e6, 1e6, "mm or °"),
        LeftOut::Value("0"),
        "position of the edge of the switch, or of the index pulse; of an absolute encoder what is \
         added to its count. LinuxCNC's HOME_OFFSET",
    ),
    key(
        "home.J0.position",
        number(-1e6, 1e6, "mm or °"),
        LeftOut::Value("0"),
        "where the joint goes in the end; inside the travel of its axis. LinuxCNC's HOME",
    ),
    key(
        "home.J0.absolute",
        Takes::Choice {
            of: &["no", "stay", "move"],
        },
        LeftOut::Value("\"no\""),
        "\"stay\", \"move\": the encoder is absolute, nothing is searched, and the joint stays or goes \
         home. LinuxCNC's HOME_ABSOLUTE_ENCODER 2 and 1",
    ),
    key(
        "home.J0.sequence",
        Takes::Whole {
            min: -100,
            max: 100,
            unit: "",
        },
        LeftOut::Value("0"),
        "groups of joints come home one after the other, in rising order of the amount; a group that \
         fails stops those after it. Negative: its joints make the last way together, as the two \
         joints of an axis have to. LinuxCNC's HOME_SEQUENCE",
    ),
    key(
        "home.J0.shared",
        Takes::Flag,
        LeftOut::Value("false"),
        "other joints use the same switch: a search does not begin while it is closed. LinuxCNC's \
         HOME_IS_SHARED",
    ),
    key(
        "home.J0.volatile",
        Takes::Flag,
        LeftOut::Value("false"),
        "the joint is not homed any more once its power was off. LinuxCNC's VOLATILE_HOME",
    ),
    key(
        "home.J0.ignore_limits",
        Takes::Flag,
        LeftOut::Value("false"),
        "limit switches do not stop the joint while it comes home. LinuxCNC's HOME_IGNORE_LIMITS",
    ),
    key(
        "home.J0.search_travel",
        number(1e-3, 1e6, "mm or °"),
        LeftOut::Means("refused where something is searched"),
        "most way of a search; without a find it ends there, as a fault",
    ),
    key(
        "home.J0.clearance",
        number(1e-3, 1e6, "mm or °"),
        LeftOut::Means("refused where a switch is searched"),
        "how far the joint may go past the edge of its switch. Three periods at the velocity of the \
         search and the stop from there have to fit in, else the file is refused",
    ),
];

pub(super) const PATH: &[Key] = &[
    key(
        "path.tolerance",
        number(1e-5, 10.0, "mm"),
        LeftOut::Value("0.02"),
        "how far the motion may leave the programmed path, everything included: corner smoothing, chord \
         error, merged lines. G64 P overrides it",
    ),
    key(
        "path.direction_tolerance",
        number(1e-5, 10.0, "°"),
        LeftOut::Means(
            "as many degrees as the tolerance in force has mm: a flank is off by no more than the tip may be, up to 57 mm above it",
        ),
        "how far the direction of the tool may be from the programmed one, whatever the tolerance in force is; on \
         machines whose rotary axes turn no tool, how far these may be off together",
    ),
    key(
        "path.smoothing",
        Takes::Choice {
            of: &["auto", "sextic", "bezier-pair", "exact-stop"],
        },
        LeftOut::Value("\"auto\""),
        "the curve at corners; \"auto\": as the effort does it best. A curve named here is planned with \
         effort \"fast\"",
    ),
    key(
        "path.corners",
        Takes::Choice {
            of: &["inner", "either"],
        },
        LeftOut::Value("\"inner\""),
        "on which side of the program effort \"optimal\" may be, within the tolerance. \"inner\": on the \
         inner side of corners, and no axis passes the place where it stops or turns round; \"either\": \
         corners may be swung out of, which is faster",
    ),
    key(
        "path.effort",
        Takes::Choice {
            of: &["optimal", "fast"],
        },
        LeftOut::Value("\"optimal\""),
        "\"optimal\": near the least time that limits and tolerance allow; \"fast\": corners are rounded \
         one by one, with hardly any work",
    ),
    key(
        "path.default_feed",
        number(1e-3, 1e7, "mm/min"),
        LeftOut::Means("a program that moves at feed without an F word is refused"),
        "the feedrate where the program gives no F",
    ),
    key(
        "path.max_tangential_acceleration",
        number(1e-3, 1e9, "mm/s²"),
        LeftOut::Means("no such limit"),
        "limit along the path, beside those of the axes; selects effort \"fast\"",
    ),
    key(
        "path.max_normal_acceleration",
        number(1e-3, 1e9, "mm/s²"),
        LeftOut::Means("no such limit"),
        "limit across the path: v² over the radius; selects effort \"fast\"",
    ),
    key(
        "path.max_jerk",
        number(1e-3, 1e9, "mm/s³"),
        LeftOut::Means("no such limit"),
        "limit along the path, and of v³ over the radius squared; selects effort \"fast\"",
    ),
];

pub(super) const INTERPOLATOR: &[Key] = &[
    key(
        "interpolator.period_us",
        Takes::Whole {
            min: 250,
            max: 20_000,
            unit: "µs",
        },
        LeftOut::Value("4000"),
        "time between two setpoints; the same for planner and interpolator",
    ),
    key(
        "interpolator.priority",
        Takes::Whole {
            min: 1,
            max: 99,
            unit: "",
        },
        LeftOut::Value("80"),
        "SCHED_FIFO priority of the real-time thread",
    ),
    key(
        "interpolator.cpu",
        Takes::Whole {
            min: 0,
            max: 1023,
            unit: "",
        },
        LeftOut::Means("it is not pinned"),
        "the CPU the real-time thread is pinned to",
    ),
    key(
        "interpolator.horizon_s",
        number(0.05, 60.0, "s"),
        LeftOut::Means(
            "0.6 s, or more if three stops from full speed of the slowest axis take longer",
        ),
        "motion published ahead of what is executed; at most 512 frames",
    ),
    key(
        "interpolator.max_missed_ticks",
        Takes::Whole {
            min: 0,
            max: 1_000_000,
            unit: "",
        },
        LeftOut::Value("10"),
        "ticks missed within a second before the motion stops with a fault",
    ),
];

pub(super) const JOG: &[Key] = &[
    key(
        "jog.velocity",
        number(1e-3, 1e5, "mm/s or °/s"),
        LeftOut::Value("50"),
        "top speed of a jog, of every axis that gives no jog_velocity of its own; above what the axis can \
         do it is without effect",
    ),
    key(
        "jog.unhomed_velocity",
        number(1e-3, 1e5, "mm/s or °/s"),
        LeftOut::Value("10"),
        "top speed of a jog where the machine does not know where it is",
    ),
    key(
        "jog.return_velocity",
        number(1e-3, 1e5, "mm/s"),
        LeftOut::Value("50"),
        "top speed of the way back to the path, after a jog in a hold",
    ),
    key(
        "jog.increments",
        Takes::Numbers {
            min: 1e-4,
            max: 1e3,
            unit: "mm or °",
        },
        LeftOut::Value("[0.01, 0.1, 1, 10]"),
        "the steps that jogging by keys offers",
    ),
    key(
        "jog.lift",
        number(0.0, 1e3, "mm"),
        LeftOut::Value("0"),
        "by how much `glidepath abort` takes the tool axis up when a program was under way, not beyond \
         its travel",
    ),
    key(
        "jog.dead_man_ms",
        Takes::Whole {
            min: 50,
            max: 1_000,
            unit: "ms",
        },
        LeftOut::Value("150"),
        "a jog that goes on as long as it is demanded stops when the last demand is so old",
    ),
    key(
        "jog.tool_axis",
        Takes::Choice {
            of: &["Z", "Y", "X", "A", "B", "C", "U", "V", "W"],
        },
        LeftOut::Value("\"Z\""),
        "the axis that goes last on the way back to the path",
    ),
];

pub(super) const FEEDBACK: &[Key] = &[
    key(
        "feedback.source",
        Takes::Choice {
            of: &["none", "drives"],
        },
        LeftOut::Value("\"none\""),
        "\"drives\": servo stacks send feedback, and the machine is off until it was switched on; \
         \"none\": the drives are taken to do what the setpoints say, and to be on and homed",
    ),
    key(
        "feedback.homing",
        Takes::Choice {
            of: &["none", "drive", "controller"],
        },
        LeftOut::Value("\"none\""),
        "\"drive\": no program starts before every drive has said that its joint is homed; \
         \"controller\": nor before every joint was brought home as its [home.J0] says; \"none\": the \
         position is believed as it is",
    ),
    key(
        "feedback.following_error",
        number(1e-6, 1e3, "mm or °"),
        LeftOut::Value("1.0"),
        "how far a joint may be from where it is to be at its highest speed; at lower speeds in \
         proportion. Beyond it the machine stops, beyond twice of it the power goes",
    ),
    key(
        "feedback.min_following_error",
        number(1e-6, 1e3, "mm or °"),
        LeftOut::Value("0.1"),
        "how far it may be at rest, and at any speed",
    ),
    key(
        "feedback.stale_s",
        number(1e-3, 10.0, "s"),
        LeftOut::Means("three periods"),
        "feedback that is older than this stops the motion on the path",
    ),
    key(
        "feedback.off_s",
        number(1e-3, 10.0, "s"),
        LeftOut::Value("0.1"),
        "feedback that is older than this takes the power from the drives",
    ),
];
