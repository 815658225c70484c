"""Constants and structures of libglidepath.

Written by a test of the library: do not change it here.
"""

import ctypes
import enum

ABI = 12
LAYOUT = 0xecd57f4734b916ba
AXES = 9


class ErrorCode(enum.IntEnum):
    """What functions return that fail; gp_last_error has the text."""

    ARGUMENT = -1
    ABI = -2
    THREAD = -3
    NO_SERVER = -4
    VERSION = -5
    TAKEN = -6
    RECORD = -7
    TRANSPORT = -8
    PANIC = -9
    REFUSED = -10


class State(enum.IntEnum):
    """What the interpolator is doing."""

    IDLE = 1
    RUNNING = 2
    HOLDING = 3
    HELD = 4
    STARVING = 5
    STARVED = 6
    PROGRAM_STOP = 7
    STOPPING = 8
    FAULTED = 9
    WAITING = 10
    AWAITING = 11
    JOGGING = 12
    HOMING = 13
    OFF = 14
    NOT_HOMED = 15
    PREPARING = 16


class Command(enum.IntEnum):
    """What can be commanded."""

    PING = 1
    HOLD = 2
    RESUME = 3
    FEED_OVERRIDE = 4
    RAPID_OVERRIDE = 5
    ABORT = 6
    STOP_AT_END_OF_BLOCK = 7
    SINGLE_BLOCK = 8
    RESET = 9
    STEP = 10
    ENABLE = 11
    DISABLE = 12
    SET_POSITION = 13
    HOME = 14
    UNHOME = 15
    RETURN = 16
    ACKNOWLEDGE = 17
    JOG_OVERRIDE = 18
    TELL = 19
    REVERSE = 20
    FORWARD = 21
    JOB = 22
    SPINDLE_OVERRIDE = 23


class Refusal(enum.IntEnum):
    """Why a command was refused."""

    MALFORMED = 1
    UNSUPPORTED = 2
    WRONG_STATE = 3
    BUSY = 4
    SHUTTING_DOWN = 5


class End(enum.IntEnum):
    """How an epoch ended."""

    NONE = 0
    OPEN = 1
    COMPLETED = 2
    ABORTED = 3
    FAULTED = 4
    TRIPPED = 5


class Fault(enum.IntEnum):
    """Why the interpolator stopped by itself."""

    NONE = 0
    PLANNER_LOST = 1
    MISSED_TICKS = 2
    OUTPUT = 3
    PORTS = 4
    REAL_TIME = 5
    FEEDBACK_LOST = 6
    FOLLOWING_ERROR = 7
    DRIVE = 8
    ENABLE_LOST = 9
    AUX_TIMEOUT = 10
    LIMIT_SWITCH = 11
    HOMING = 12
    AUX_FAILED = 13
    SPINDLE_SPEED = 14
    SPINDLE_ANGLE = 15
    THREAD_LOST = 16
    PROBE_CONTACT = 17
    TAP_OVERTRAVEL = 18
    SETPOINTS_LOST = 19
    DEVICE_LOST = 20
    BUS_LOST = 21
    SPINDLE_DRIVE = 22
    SPINDLE_GEAR = 23
    FRAME_NOT_FINITE = 257
    FRAME_MALFORMED = 258
    FRAME_PERIOD = 259
    FRAME_EPOCH = 260
    FRAME_SEQUENCE = 261
    FRAME_DISCONTINUOUS = 262
    FRAME_VELOCITY = 263
    FRAME_ACCELERATION = 264
    FRAME_JERK = 265
    FRAME_SOFT_LIMIT = 266
    FRAME_NOT_AT_REST = 267
    FRAME_ELSEWHERE = 268


class Power(enum.IntEnum):
    """Whether the drives have power, as far as the interpolator knows."""

    SIMULATED = 0
    OFF = 1
    ENABLING = 2
    ON = 3


class Mode(enum.IntEnum):
    """What moves the axes."""

    NONE = 0
    PROGRAM = 1
    JOG = 2
    HOMING = 3
    RETURN = 4
    BACKWARDS = 5


class Superposition(enum.IntEnum):
    """What the superposition of an axis does."""

    NONE = 0
    OFF = 1
    FOLLOWS = 2
    FROZEN = 3
    RETURNS = 4
    SILENT = 5


class FreezeReason(enum.IntEnum):
    """Why the superposition of an axis is frozen."""

    NONE = 0
    NOT_ONWARD = 1
    PROBING = 2
    FOLLOWS_SPINDLE = 3
    RAPID = 4
    SLOW = 5
    NOT_ENABLED = 6
    SWITCHED_OFF = 7


class Contact(enum.IntEnum):
    """What a probe has found."""

    NONE = 0
    MADE = 1
    ALREADY_SO = 2


class Job(enum.IntEnum):
    """How the job of a planner stands."""

    NONE = 0
    WAITING = 1
    PREPARING = 2
    BEGUN = 3
    OVER = 4
    ABORTED = 5
    REFUSED = 6


class Event(enum.IntEnum):
    """What an event is: kind of a gp_event, and the lowest byte of event_kind of a gp_segment."""

    NONE = 0
    SPINDLE_SPEED = 1
    SELECT_TOOL = 2
    M_CODE = 3
    PROGRAM_STOP = 4
    OPTIONAL_STOP = 5
    DIGITAL_OUTPUT = 6
    ANALOG_OUTPUT = 7
    PROBE = 8
    SYNCHRONISE = 9
    CODE_WORD_P = 10
    CODE_WORD_Q = 11
    AWAIT = 12
    TAP = 13
    PASSING_CODE = 14
    SPINDLE_ANGLE = 15
    SPINDLE_GEAR = 16


class Drive(enum.IntEnum):
    """What a drive does, by the states of CiA 402."""

    UNKNOWN = 0
    NOT_READY = 1
    SWITCH_ON_DISABLED = 2
    READY = 3
    SWITCHED_ON = 4
    OPERATION_ENABLED = 5
    QUICK_STOP = 6
    FAULT_REACTION = 7
    FAULT = 8


class Flag(enum.IntFlag):
    """Properties of a frame."""

    FIRST = 1
    LAST = 2
    RAPID = 4
    EXACT_STOP = 8
    DWELL = 16
    PROGRAM_STOP = 32
    SYNC = 64
    PER_REV = 128


class Mark(enum.IntFlag):
    """Properties of a setpoint."""

    LATE = 1
    AFTER_MISSED = 2


class Grant(enum.IntFlag):
    """Which real-time grants the interpolator holds."""

    FIFO = 1
    PINNED = 2
    MEMORY_LOCKED = 4
    PREFAULTED = 8
    DMA_LATENCY = 16
    BEST_EFFORT = 32


class Spindle(enum.IntFlag):
    """What the spindle does."""

    AT_SPEED = 1
    STOPPED = 2
    ORIENTED = 4
    FAULT = 8
    ANGLE = 16
    INDEX = 32
    SPEED = 64
    LOAD = 128
    IN_GEAR = 256


class Stopped(enum.IntEnum):
    """Why a servo stopped the joints by itself."""

    NOT = 0
    SILENCE = 1
    ASKED = 2
    JUMP = 3


class Jump(enum.IntEnum):
    """What of a jump is too much."""

    NONE = 0
    VELOCITY = 1
    ACCELERATION = 2


class Loss(enum.IntEnum):
    """What a servo stack has lost."""

    NONE = 0
    SETPOINTS = 1
    DEVICE = 2
    BUS = 3
    SPINDLE = 4
    GEAR = 5


class Latch(enum.IntEnum):
    """How a latched position was found."""

    NONE = 0
    DRIVE = 1
    INTERPOLATED = 2
    SAMPLED = 3
    AWAITED = 4


class JogMode(enum.IntEnum):
    """How a jog moves the machine."""

    NONE = 0
    CONTINUOUS = 1
    INCREMENTAL = 2
    WHEEL = 3
    WHEEL_VELOCITY = 4


class Segment(enum.IntEnum):
    """What a piece of a stream is."""

    OPEN = 1
    LINE = 2
    ARC = 3
    DWELL = 4
    EVENT = 5
    END = 6
    CURVE = 7


class Path(enum.IntEnum):
    """How the path is followed at corners: G61.1, G61, G64, G64 P."""

    EXACT_STOP = 1
    EXACT_PATH = 2
    CONTINUOUS = 3
    CONTINUOUS_WITHIN = 4


class Plane(enum.IntEnum):
    """Planes of arcs: G17, G18, G19, G17.1, G18.1, G19.1."""

    XY = 1
    ZX = 2
    YZ = 3
    UV = 4
    WU = 5
    VW = 6


class SegmentRefusal(enum.IntEnum):
    """Why a piece of a stream was refused."""

    BUSY = 1
    NOT_OPEN = 2
    OUT_OF_ORDER = 3
    NO_CREDIT = 4
    MALFORMED = 5
    DISCONTINUOUS = 6
    SOFT_LIMIT = 7
    UNPLANNABLE = 8
    STOPPED = 9
    SHUTTING_DOWN = 10
    ABORTED = 11


class QuantilesRecord(ctypes.Structure):
    """Quantiles of a time, ns."""

    _fields_ = [
        ("p50_ns", ctypes.c_uint64),
        ("p99_ns", ctypes.c_uint64),
        ("p999_ns", ctypes.c_uint64),
        ("max_ns", ctypes.c_uint64),
    ]


class EventIdRecord(ctypes.Structure):
    """Which event: no two have the same."""

    _fields_ = [
        ("boot_id", ctypes.c_uint64),
        ("epoch", ctypes.c_uint64),
        ("sequence", ctypes.c_uint64),
    ]


class CodeWordsRecord(ctypes.Structure):
    """The words of an M code of the machine's own."""

    _fields_ = [
        ("p", ctypes.c_double),
        ("q", ctypes.c_double),
        ("given", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
    ]


class LatchRecord(ctypes.Structure):
    """The positions at the last edge of an input."""

    _fields_ = [
        ("count", ctypes.c_uint64),
        ("latch_ns", ctypes.c_uint64),
        ("position", ctypes.c_double * 9),
        ("input", ctypes.c_uint32),
        ("rising", ctypes.c_uint32),
        ("kind", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
    ]


class EventRecord(ctypes.Structure):
    """An event in the period of a setpoint."""

    _fields_ = [
        ("value", ctypes.c_double),
        ("offset_ns", ctypes.c_uint32),
        ("kind", ctypes.c_uint32),
        ("number", ctypes.c_uint32),
        ("axis", ctypes.c_uint32),
        ("depth_um", ctypes.c_uint32),
        ("phase", ctypes.c_uint32),
    ]


class SetpointRecord(ctypes.Structure):
    """What the drives are to do at apply_ns."""

    _fields_ = [
        ("boot_id", ctypes.c_uint64),
        ("reference", ctypes.c_uint64),
        ("number", ctypes.c_uint64),
        ("tick", ctypes.c_uint64),
        ("scheduled_ns", ctypes.c_uint64),
        ("apply_ns", ctypes.c_uint64),
        ("lateness_ns", ctypes.c_uint64),
        ("missed_ticks", ctypes.c_uint64),
        ("epoch", ctypes.c_uint64),
        ("sequence", ctypes.c_uint64),
        ("fraction", ctypes.c_double),
        ("line", ctypes.c_uint32),
        ("flags", ctypes.c_uint32),
        ("marks", ctypes.c_uint32),
        ("state", ctypes.c_uint32),
        ("event_count", ctypes.c_uint32),
        ("block", ctypes.c_uint32),
        ("enable", ctypes.c_uint32),
        ("home", ctypes.c_uint32),
        ("path_s", ctypes.c_double),
        ("feed_v", ctypes.c_double),
        ("effective_override", ctypes.c_double),
        ("position", ctypes.c_double * 9),
        ("velocity", ctypes.c_double * 9),
        ("acceleration", ctypes.c_double * 9),
        ("joint_position", ctypes.c_double * 9),
        ("joint_velocity", ctypes.c_double * 9),
        ("joint_acceleration", ctypes.c_double * 9),
        ("away", ctypes.c_double * 9),
        ("events", EventRecord * 16),
        ("superposed", ctypes.c_double * 9),
        ("index", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
    ]


class StatusRecord(ctypes.Structure):
    """What the interpolator does and how well. Counts are of this life of it."""

    _fields_ = [
        ("boot_id", ctypes.c_uint64),
        ("updated_ns", ctypes.c_uint64),
        ("period_ns", ctypes.c_uint64),
        ("tick", ctypes.c_uint64),
        ("epoch", ctypes.c_uint64),
        ("frames_received", ctypes.c_uint64),
        ("frames_executed", ctypes.c_uint64),
        ("queue_depth", ctypes.c_uint32),
        ("queue_capacity", ctypes.c_uint32),
        ("pid", ctypes.c_uint32),
        ("state", ctypes.c_uint32),
        ("end_of_epoch", ctypes.c_uint32),
        ("fault", ctypes.c_uint32),
        ("fault_line", ctypes.c_uint32),
        ("fault_axis", ctypes.c_uint32),
        ("fault_joint", ctypes.c_uint32),
        ("drive_fault", ctypes.c_uint32),
        ("fault_sequence", ctypes.c_uint64),
        ("fault_value", ctypes.c_double),
        ("fault_limit", ctypes.c_double),
        ("line", ctypes.c_uint32),
        ("grants", ctypes.c_uint32),
        ("block", ctypes.c_uint32),
        ("single_block", ctypes.c_uint32),
        ("program", ctypes.c_uint64),
        ("program_start", ctypes.c_double * 9),
        ("position", ctypes.c_double * 9),
        ("away", ctypes.c_double * 9),
        ("power", ctypes.c_uint32),
        ("mode", ctypes.c_uint32),
        ("joints", ctypes.c_uint32),
        ("enabled", ctypes.c_uint32),
        ("homed", ctypes.c_uint32),
        ("drive_faults", ctypes.c_uint32),
        ("reference", ctypes.c_uint64),
        ("feedback_age_ns", ctypes.c_uint64),
        ("joint_actual", ctypes.c_double * 9),
        ("following_error", ctypes.c_double * 9),
        ("following_peak", ctypes.c_double * 9),
        ("awaited_sequence", ctypes.c_uint64),
        ("awaited_since_ns", ctypes.c_uint64),
        ("awaited_value", ctypes.c_double),
        ("awaited_kind", ctypes.c_uint32),
        ("awaited_line", ctypes.c_uint32),
        ("awaited_words", CodeWordsRecord),
        ("contact", ctypes.c_double * 9),
        ("contact_kind", ctypes.c_uint32),
        ("unanswered", ctypes.c_uint32),
        ("path_s", ctypes.c_double),
        ("block_path_s", ctypes.c_double),
        ("feed_v", ctypes.c_double),
        ("feed_override", ctypes.c_double),
        ("rapid_override", ctypes.c_double),
        ("jog_override", ctypes.c_double),
        ("effective_override", ctypes.c_double),
        ("adaptive_feed", ctypes.c_double),
        ("ticks", ctypes.c_uint64),
        ("missed_ticks", ctypes.c_uint64),
        ("late_ticks", ctypes.c_uint64),
        ("setpoints_published", ctypes.c_uint64),
        ("setpoints_lost", ctypes.c_uint64),
        ("reserve_stops", ctypes.c_uint64),
        ("starved_ticks", ctypes.c_uint64),
        ("commands_served", ctypes.c_uint64),
        ("commands_refused", ctypes.c_uint64),
        ("frames_refused", ctypes.c_uint64 * 12),
        ("lateness", QuantilesRecord),
        ("work", QuantilesRecord),
        ("latency", QuantilesRecord),
        ("response", QuantilesRecord),
        ("job_number", ctypes.c_uint64),
        ("next_epoch", ctypes.c_uint64),
        ("job_stage", ctypes.c_uint32),
        ("job_held", ctypes.c_uint32),
        ("last_error", ctypes.c_char * 128),
        ("last_event", ctypes.c_char * 128),
        ("message", ctypes.c_char * 128),
        ("job", ctypes.c_char * 128),
        ("job_end", ctypes.c_char * 128),
        ("jog_client", ctypes.c_uint64),
        ("jog_number", ctypes.c_uint64),
        ("spindle_v", ctypes.c_double),
        ("spindle_flags", ctypes.c_uint32),
        ("superposition", ctypes.c_uint32),
        ("superposed", ctypes.c_double * 9),
        ("freeze_reason", ctypes.c_uint32),
        ("job_stream", ctypes.c_uint32),
        ("spindle_override", ctypes.c_double),
        ("spindle_load", ctypes.c_double),
    ]


class FeedbackRecord(ctypes.Structure):
    """What a servo stack knows of the joints it drives, at one moment."""

    _fields_ = [
        ("boot_id", ctypes.c_uint64),
        ("number", ctypes.c_uint64),
        ("sample_ns", ctypes.c_uint64),
        ("reference", ctypes.c_uint64),
        ("setpoint_number", ctypes.c_uint64),
        ("joints", ctypes.c_uint32),
        ("enabled", ctypes.c_uint32),
        ("homed", ctypes.c_uint32),
        ("homing", ctypes.c_uint32),
        ("fault", ctypes.c_uint32),
        ("limit_low", ctypes.c_uint32),
        ("limit_high", ctypes.c_uint32),
        ("home_switch", ctypes.c_uint32),
        ("position", ctypes.c_double * 9),
        ("velocity", ctypes.c_double * 9),
        ("drive_state", ctypes.c_uint32 * 9),
        ("fault_code", ctypes.c_uint32 * 9),
        ("digital_in", ctypes.c_uint64),
        ("analog_in", ctypes.c_double * 8),
        ("spindle_angle", ctypes.c_double),
        ("spindle_v", ctypes.c_double),
        ("spindle_index_count", ctypes.c_uint64),
        ("spindle_flags", ctypes.c_uint32),
        ("loss", ctypes.c_uint32),
        ("loss_value", ctypes.c_double),
        ("latch", LatchRecord * 4),
        ("index_armed", ctypes.c_uint32),
        ("index_kept", ctypes.c_uint32),
        ("index_position", ctypes.c_double * 9),
        ("spindle_load", ctypes.c_double),
    ]


class ReplyRecord(ctypes.Structure):
    """The answer to a command."""

    _fields_ = [
        ("boot_id", ctypes.c_uint64),
        ("number", ctypes.c_uint64),
        ("refusal", ctypes.c_uint32),
        ("state", ctypes.c_uint32),
        ("message", ctypes.c_char * 128),
    ]


class JogRecord(ctypes.Structure):
    """How the axes, or the joints, are to be moved by hand. The latest counts; the first
    client owns the axes until they are at rest."""

    _fields_ = [
        ("client", ctypes.c_uint64),
        ("number", ctypes.c_uint64),
        ("sent_ns", ctypes.c_uint64),
        ("asked_ns", ctypes.c_uint64),
        ("mode", ctypes.c_uint32),
        ("mask", ctypes.c_uint32),
        ("by_joint", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("velocity_v", ctypes.c_double),
        ("scale", ctypes.c_double),
        ("value", ctypes.c_double * 9),
    ]


class SegmentRecord(ctypes.Structure):
    """A piece of a stream. Fields that a kind does not use are zero."""

    _fields_ = [
        ("session", ctypes.c_uint64),
        ("number", ctypes.c_uint64),
        ("asked_ns", ctypes.c_uint64),
        ("kind", ctypes.c_uint32),
        ("line", ctypes.c_uint32),
        ("rapid", ctypes.c_uint32),
        ("mode", ctypes.c_uint32),
        ("plane", ctypes.c_uint32),
        ("event_kind", ctypes.c_uint32),
        ("event_value", ctypes.c_double),
        ("feed_v", ctypes.c_double),
        ("tolerance_mm", ctypes.c_double),
        ("dwell_t", ctypes.c_double),
        ("sweep_rad", ctypes.c_double),
        ("center", ctypes.c_double * 2),
        ("start", ctypes.c_double * 9),
        ("end", ctypes.c_double * 9),
        ("tangents", ctypes.c_double * 6),
        ("bends", ctypes.c_double * 6),
        ("length", ctypes.c_double),
        ("error_mm", ctypes.c_double),
    ]


class SegmentReplyRecord(ctypes.Structure):
    """The answer to a piece of a stream."""

    _fields_ = [
        ("session", ctypes.c_uint64),
        ("number", ctypes.c_uint64),
        ("accepted", ctypes.c_uint64),
        ("credit", ctypes.c_uint32),
        ("refusal", ctypes.c_uint32),
        ("position", ctypes.c_double * 9),
        ("message", ctypes.c_char * 1024),
    ]


class JointRecord(ctypes.Structure):
    """What a joint is to do."""

    _fields_ = [
        ("position", ctypes.c_double),
        ("velocity", ctypes.c_double),
        ("acceleration", ctypes.c_double),
    ]


class StopLimitsRecord(ctypes.Structure):
    """What a joint's own stop may use, both > 0."""

    _fields_ = [
        ("acceleration", ctypes.c_double),
        ("jerk", ctypes.c_double),
    ]


class JumpLimitsRecord(ctypes.Structure):
    """Beyond this a setpoint is a jump and is not played; both > 0, INFINITY for no guard. Set
    them above the joint's limits: 1.2 times the velocity and twice the acceleration are
    good."""

    _fields_ = [
        ("velocity", ctypes.c_double),
        ("acceleration", ctypes.c_double),
    ]


class ServoSettingsRecord(ctypes.Structure):
    """How a servo behaves when setpoints stay away, or jump."""

    _fields_ = [
        ("patience_ns", ctypes.c_uint64),
        ("stop", StopLimitsRecord * 9),
        ("jump", JumpLimitsRecord * 9),
    ]


class JumpRecord(ctypes.Structure):
    """A setpoint that was not played, because the way to it is beyond the limits."""

    _fields_ = [
        ("joint", ctypes.c_uint32),
        ("of", ctypes.c_uint32),
        ("from_position", ctypes.c_double),
        ("to_position", ctypes.c_double),
        ("span_t", ctypes.c_double),
        ("asked", ctypes.c_double),
        ("limit", ctypes.c_double),
    ]


class ServoStateRecord(ctypes.Structure):
    """What a servo does, and what arrived so far."""

    _fields_ = [
        ("armed", ctypes.c_uint32),
        ("stopped", ctypes.c_uint32),
        ("port_failed", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("jump", JumpRecord),
        ("received", ctypes.c_uint64),
        ("lost", ctypes.c_uint64),
        ("gaps", ctypes.c_uint64),
        ("duplicates", ctypes.c_uint64),
        ("late", ctypes.c_uint64),
        ("refused", ctypes.c_uint64),
        ("missed_ticks", ctypes.c_uint64),
        ("restarts", ctypes.c_uint64),
        ("references", ctypes.c_uint64),
        ("stops", ctypes.c_uint64),
        ("jumps", ctypes.c_uint64),
    ]


# Size, and where every field is: held against the structures above when this is loaded.
PLACES = {
    QuantilesRecord: (32, {
        "p50_ns": 0,
        "p99_ns": 8,
        "p999_ns": 16,
        "max_ns": 24,
    }),
    EventIdRecord: (24, {
        "boot_id": 0,
        "epoch": 8,
        "sequence": 16,
    }),
    CodeWordsRecord: (24, {
        "p": 0,
        "q": 8,
        "given": 16,
        "reserved": 20,
    }),
    LatchRecord: (104, {
        "count": 0,
        "latch_ns": 8,
        "position": 16,
        "input": 88,
        "rising": 92,
        "kind": 96,
        "reserved": 100,
    }),
    EventRecord: (32, {
        "value": 0,
        "offset_ns": 8,
        "kind": 12,
        "number": 16,
        "axis": 20,
        "depth_um": 24,
        "phase": 28,
    }),
    SetpointRecord: (1240, {
        "boot_id": 0,
        "reference": 8,
        "number": 16,
        "tick": 24,
        "scheduled_ns": 32,
        "apply_ns": 40,
        "lateness_ns": 48,
        "missed_ticks": 56,
        "epoch": 64,
        "sequence": 72,
        "fraction": 80,
        "line": 88,
        "flags": 92,
        "marks": 96,
        "state": 100,
        "event_count": 104,
        "block": 108,
        "enable": 112,
        "home": 116,
        "path_s": 120,
        "feed_v": 128,
        "effective_override": 136,
        "position": 144,
        "velocity": 216,
        "acceleration": 288,
        "joint_position": 360,
        "joint_velocity": 432,
        "joint_acceleration": 504,
        "away": 576,
        "events": 648,
        "superposed": 1160,
        "index": 1232,
        "reserved": 1236,
    }),
    StatusRecord: (1904, {
        "boot_id": 0,
        "updated_ns": 8,
        "period_ns": 16,
        "tick": 24,
        "epoch": 32,
        "frames_received": 40,
        "frames_executed": 48,
        "queue_depth": 56,
        "queue_capacity": 60,
        "pid": 64,
        "state": 68,
        "end_of_epoch": 72,
        "fault": 76,
        "fault_line": 80,
        "fault_axis": 84,
        "fault_joint": 88,
        "drive_fault": 92,
        "fault_sequence": 96,
        "fault_value": 104,
        "fault_limit": 112,
        "line": 120,
        "grants": 124,
        "block": 128,
        "single_block": 132,
        "program": 136,
        "program_start": 144,
        "position": 216,
        "away": 288,
        "power": 360,
        "mode": 364,
        "joints": 368,
        "enabled": 372,
        "homed": 376,
        "drive_faults": 380,
        "reference": 384,
        "feedback_age_ns": 392,
        "joint_actual": 400,
        "following_error": 472,
        "following_peak": 544,
        "awaited_sequence": 616,
        "awaited_since_ns": 624,
        "awaited_value": 632,
        "awaited_kind": 640,
        "awaited_line": 644,
        "awaited_words": 648,
        "contact": 672,
        "contact_kind": 744,
        "unanswered": 748,
        "path_s": 752,
        "block_path_s": 760,
        "feed_v": 768,
        "feed_override": 776,
        "rapid_override": 784,
        "jog_override": 792,
        "effective_override": 800,
        "adaptive_feed": 808,
        "ticks": 816,
        "missed_ticks": 824,
        "late_ticks": 832,
        "setpoints_published": 840,
        "setpoints_lost": 848,
        "reserve_stops": 856,
        "starved_ticks": 864,
        "commands_served": 872,
        "commands_refused": 880,
        "frames_refused": 888,
        "lateness": 984,
        "work": 1016,
        "latency": 1048,
        "response": 1080,
        "job_number": 1112,
        "next_epoch": 1120,
        "job_stage": 1128,
        "job_held": 1132,
        "last_error": 1136,
        "last_event": 1264,
        "message": 1392,
        "job": 1520,
        "job_end": 1648,
        "jog_client": 1776,
        "jog_number": 1784,
        "spindle_v": 1792,
        "spindle_flags": 1800,
        "superposition": 1804,
        "superposed": 1808,
        "freeze_reason": 1880,
        "job_stream": 1884,
        "spindle_override": 1888,
        "spindle_load": 1896,
    }),
    FeedbackRecord: (904, {
        "boot_id": 0,
        "number": 8,
        "sample_ns": 16,
        "reference": 24,
        "setpoint_number": 32,
        "joints": 40,
        "enabled": 44,
        "homed": 48,
        "homing": 52,
        "fault": 56,
        "limit_low": 60,
        "limit_high": 64,
        "home_switch": 68,
        "position": 72,
        "velocity": 144,
        "drive_state": 216,
        "fault_code": 252,
        "digital_in": 288,
        "analog_in": 296,
        "spindle_angle": 360,
        "spindle_v": 368,
        "spindle_index_count": 376,
        "spindle_flags": 384,
        "loss": 388,
        "loss_value": 392,
        "latch": 400,
        "index_armed": 816,
        "index_kept": 820,
        "index_position": 824,
        "spindle_load": 896,
    }),
    ReplyRecord: (152, {
        "boot_id": 0,
        "number": 8,
        "refusal": 16,
        "state": 20,
        "message": 24,
    }),
    JogRecord: (136, {
        "client": 0,
        "number": 8,
        "sent_ns": 16,
        "asked_ns": 24,
        "mode": 32,
        "mask": 36,
        "by_joint": 40,
        "reserved": 44,
        "velocity_v": 48,
        "scale": 56,
        "value": 64,
    }),
    SegmentRecord: (360, {
        "session": 0,
        "number": 8,
        "asked_ns": 16,
        "kind": 24,
        "line": 28,
        "rapid": 32,
        "mode": 36,
        "plane": 40,
        "event_kind": 44,
        "event_value": 48,
        "feed_v": 56,
        "tolerance_mm": 64,
        "dwell_t": 72,
        "sweep_rad": 80,
        "center": 88,
        "start": 104,
        "end": 176,
        "tangents": 248,
        "bends": 296,
        "length": 344,
        "error_mm": 352,
    }),
    SegmentReplyRecord: (1128, {
        "session": 0,
        "number": 8,
        "accepted": 16,
        "credit": 24,
        "refusal": 28,
        "position": 32,
        "message": 104,
    }),
    JointRecord: (24, {
        "position": 0,
        "velocity": 8,
        "acceleration": 16,
    }),
    StopLimitsRecord: (16, {
        "acceleration": 0,
        "jerk": 8,
    }),
    JumpLimitsRecord: (16, {
        "velocity": 0,
        "acceleration": 8,
    }),
    ServoSettingsRecord: (296, {
        "patience_ns": 0,
        "stop": 8,
        "jump": 152,
    }),
    JumpRecord: (48, {
        "joint": 0,
        "of": 4,
        "from_position": 8,
        "to_position": 16,
        "span_t": 24,
        "asked": 32,
        "limit": 40,
    }),
    ServoStateRecord: (152, {
        "armed": 0,
        "stopped": 4,
        "port_failed": 8,
        "reserved": 12,
        "jump": 16,
        "received": 64,
        "lost": 72,
        "gaps": 80,
        "duplicates": 88,
        "late": 96,
        "refused": 104,
        "missed_ticks": 112,
        "restarts": 120,
        "references": 128,
        "stops": 136,
        "jumps": 144,
    }),
}
