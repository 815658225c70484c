/* libglidepath: setpoints, status, commands, feedback, jogs, segments and the servo of Glidepath.
 *
 *     gp_link *link;
 *     if (gp_open("default", &link) < 0) { char why[512]; gp_last_error(why, sizeof why); ... }
 *     gp_setpoints *setpoints;
 *     gp_setpoints_open(link, &setpoints);
 *     gp_setpoint setpoint;
 *     while (gp_next(setpoints, &setpoint, sizeof setpoint) > 0) ...
 *
 * Results. Functions that return int give a GP_E_ below 0 where they fail; gp_last_error has the
 * text, with what to do. Of the others 1 is "there is one" or "it was done", 0 "there is none" or
 * "done, and nothing to tell". No function ends the process, installs a handler of signals or calls
 * back, or prints anything but the report of an error inside the library.
 *
 * Threads. A handle belongs to the thread that opened it; from another one every function answers
 * GP_E_THREAD and does nothing. Each thread opens its own link. A servo may be handed over with
 * gp_servo_release. Handles may be closed in any order; closing NULL does nothing. A closed handle
 * must not be used again.
 *
 * Real time. gp_servo_receive, gp_servo_demand, gp_servo_stop, gp_servo_rearm, gp_servo_rearm_at and
 * gp_servo_read_state make no system call, take no lock and allocate nothing, after the first of
 * them in a thread. All other functions may do all of that.
 *
 * Times are ns of CLOCK_MONOTONIC. Positions are mm or degrees, in the order X Y Z A B C U V W or
 * J0 to J8; sets of joints have one bit each, J0 lowest; overrides are ratios, 1 is 100 %.
 *
 * Children made by fork() must not use handles of their parent. Structures are passed with their
 * sizeof, and a library of another ABI refuses to be used.
 */
#ifndef GLIDEPATH_H
#define GLIDEPATH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define GP_ASSERT(condition, text) static_assert(condition, text)
extern "C" {
#else
#define GP_ASSERT(condition, text) _Static_assert(condition, text)
#endif

/* A field that is not where the library has it, or has another size, does not compile. */
#define GP_FIELD(type, field, offset, size)                                                        \
    GP_ASSERT(offsetof(type, field) == (offset), #type "." #field " is elsewhere");                \
    GP_ASSERT(sizeof(((type *)0)->field) == (size), #type "." #field " has another size")

/* layout: begin, written by a test of the library */
/* The version of the ABI: functions and structures. */
#define GP_ABI 12u
/* What the structures of this header are, as one number. */
#define GP_LAYOUT UINT64_C(0xecd57f4734b916ba)
/* Axes X Y Z A B C U V W, and joints J0 to J8. */
#define GP_AXES 9

/* What functions return that fail; gp_last_error has the text. */
enum {
    GP_E_ARGUMENT = -1,
    GP_E_ABI = -2,
    GP_E_THREAD = -3,
    GP_E_NO_SERVER = -4,
    GP_E_VERSION = -5,
    GP_E_TAKEN = -6,
    GP_E_RECORD = -7,
    GP_E_TRANSPORT = -8,
    GP_E_PANIC = -9,
    GP_E_REFUSED = -10
};

/* What the interpolator is doing. */
enum {
    GP_STATE_IDLE = 1,
    GP_STATE_RUNNING = 2,
    GP_STATE_HOLDING = 3,
    GP_STATE_HELD = 4,
    GP_STATE_STARVING = 5,
    GP_STATE_STARVED = 6,
    GP_STATE_PROGRAM_STOP = 7,
    GP_STATE_STOPPING = 8,
    GP_STATE_FAULTED = 9,
    GP_STATE_WAITING = 10,
    GP_STATE_AWAITING = 11,
    GP_STATE_JOGGING = 12,
    GP_STATE_HOMING = 13,
    GP_STATE_OFF = 14,
    GP_STATE_NOT_HOMED = 15,
    GP_STATE_PREPARING = 16
};

/* What can be commanded. */
enum {
    GP_COMMAND_PING = 1,
    GP_COMMAND_HOLD = 2,
    GP_COMMAND_RESUME = 3,
    GP_COMMAND_FEED_OVERRIDE = 4,
    GP_COMMAND_RAPID_OVERRIDE = 5,
    GP_COMMAND_ABORT = 6,
    GP_COMMAND_STOP_AT_END_OF_BLOCK = 7,
    GP_COMMAND_SINGLE_BLOCK = 8,
    GP_COMMAND_RESET = 9,
    GP_COMMAND_STEP = 10,
    GP_COMMAND_ENABLE = 11,
    GP_COMMAND_DISABLE = 12,
    GP_COMMAND_SET_POSITION = 13,
    GP_COMMAND_HOME = 14,
    GP_COMMAND_UNHOME = 15,
    GP_COMMAND_RETURN = 16,
    GP_COMMAND_ACKNOWLEDGE = 17,
    GP_COMMAND_JOG_OVERRIDE = 18,
    GP_COMMAND_TELL = 19,
    GP_COMMAND_REVERSE = 20,
    GP_COMMAND_FORWARD = 21,
    GP_COMMAND_JOB = 22,
    GP_COMMAND_SPINDLE_OVERRIDE = 23
};

/* Why a command was refused. */
enum {
    GP_REFUSAL_MALFORMED = 1,
    GP_REFUSAL_UNSUPPORTED = 2,
    GP_REFUSAL_WRONG_STATE = 3,
    GP_REFUSAL_BUSY = 4,
    GP_REFUSAL_SHUTTING_DOWN = 5
};

/* How an epoch ended. */
enum {
    GP_END_NONE = 0,
    GP_END_OPEN = 1,
    GP_END_COMPLETED = 2,
    GP_END_ABORTED = 3,
    GP_END_FAULTED = 4,
    GP_END_TRIPPED = 5
};

/* Why the interpolator stopped by itself. */
enum {
    GP_FAULT_NONE = 0,
    GP_FAULT_PLANNER_LOST = 1,
    GP_FAULT_MISSED_TICKS = 2,
    GP_FAULT_OUTPUT = 3,
    GP_FAULT_PORTS = 4,
    GP_FAULT_REAL_TIME = 5,
    GP_FAULT_FEEDBACK_LOST = 6,
    GP_FAULT_FOLLOWING_ERROR = 7,
    GP_FAULT_DRIVE = 8,
    GP_FAULT_ENABLE_LOST = 9,
    GP_FAULT_AUX_TIMEOUT = 10,
    GP_FAULT_LIMIT_SWITCH = 11,
    GP_FAULT_HOMING = 12,
    GP_FAULT_AUX_FAILED = 13,
    GP_FAULT_SPINDLE_SPEED = 14,
    GP_FAULT_SPINDLE_ANGLE = 15,
    GP_FAULT_THREAD_LOST = 16,
    GP_FAULT_PROBE_CONTACT = 17,
    GP_FAULT_TAP_OVERTRAVEL = 18,
    GP_FAULT_SETPOINTS_LOST = 19,
    GP_FAULT_DEVICE_LOST = 20,
    GP_FAULT_BUS_LOST = 21,
    GP_FAULT_SPINDLE_DRIVE = 22,
    GP_FAULT_SPINDLE_GEAR = 23,
    GP_FAULT_FRAME_NOT_FINITE = 0x101,
    GP_FAULT_FRAME_MALFORMED = 0x102,
    GP_FAULT_FRAME_PERIOD = 0x103,
    GP_FAULT_FRAME_EPOCH = 0x104,
    GP_FAULT_FRAME_SEQUENCE = 0x105,
    GP_FAULT_FRAME_DISCONTINUOUS = 0x106,
    GP_FAULT_FRAME_VELOCITY = 0x107,
    GP_FAULT_FRAME_ACCELERATION = 0x108,
    GP_FAULT_FRAME_JERK = 0x109,
    GP_FAULT_FRAME_SOFT_LIMIT = 0x10a,
    GP_FAULT_FRAME_NOT_AT_REST = 0x10b,
    GP_FAULT_FRAME_ELSEWHERE = 0x10c
};

/* Whether the drives have power, as far as the interpolator knows. */
enum {
    GP_POWER_SIMULATED = 0,
    GP_POWER_OFF = 1,
    GP_POWER_ENABLING = 2,
    GP_POWER_ON = 3
};

/* What moves the axes. */
enum {
    GP_MODE_NONE = 0,
    GP_MODE_PROGRAM = 1,
    GP_MODE_JOG = 2,
    GP_MODE_HOMING = 3,
    GP_MODE_RETURN = 4,
    GP_MODE_BACKWARDS = 5
};

/* What the superposition of an axis does. */
enum {
    GP_SUPERPOSITION_NONE = 0,
    GP_SUPERPOSITION_OFF = 1,
    GP_SUPERPOSITION_FOLLOWS = 2,
    GP_SUPERPOSITION_FROZEN = 3,
    GP_SUPERPOSITION_RETURNS = 4,
    GP_SUPERPOSITION_SILENT = 5
};

/* Why the superposition of an axis is frozen. */
enum {
    GP_FREEZE_REASON_NONE = 0,
    GP_FREEZE_REASON_NOT_ONWARD = 1,
    GP_FREEZE_REASON_PROBING = 2,
    GP_FREEZE_REASON_FOLLOWS_SPINDLE = 3,
    GP_FREEZE_REASON_RAPID = 4,
    GP_FREEZE_REASON_SLOW = 5,
    GP_FREEZE_REASON_NOT_ENABLED = 6,
    GP_FREEZE_REASON_SWITCHED_OFF = 7
};

/* What a probe has found. */
enum {
    GP_CONTACT_NONE = 0,
    GP_CONTACT_MADE = 1,
    GP_CONTACT_ALREADY_SO = 2
};

/* How the job of a planner stands. */
enum {
    GP_JOB_NONE = 0,
    GP_JOB_WAITING = 1,
    GP_JOB_PREPARING = 2,
    GP_JOB_BEGUN = 3,
    GP_JOB_OVER = 4,
    GP_JOB_ABORTED = 5,
    GP_JOB_REFUSED = 6
};

/* What an event is: kind of a gp_event, and the lowest byte of event_kind of a gp_segment. */
enum {
    GP_EVENT_NONE = 0,
    GP_EVENT_SPINDLE_SPEED = 1,
    GP_EVENT_SELECT_TOOL = 2,
    GP_EVENT_M_CODE = 3,
    GP_EVENT_PROGRAM_STOP = 4,
    GP_EVENT_OPTIONAL_STOP = 5,
    GP_EVENT_DIGITAL_OUTPUT = 6,
    GP_EVENT_ANALOG_OUTPUT = 7,
    GP_EVENT_PROBE = 8,
    GP_EVENT_SYNCHRONISE = 9,
    GP_EVENT_CODE_WORD_P = 10,
    GP_EVENT_CODE_WORD_Q = 11,
    GP_EVENT_AWAIT = 12,
    GP_EVENT_TAP = 13,
    GP_EVENT_PASSING_CODE = 14,
    GP_EVENT_SPINDLE_ANGLE = 15,
    GP_EVENT_SPINDLE_GEAR = 16
};

/* What a drive does, by the states of CiA 402. */
enum {
    GP_DRIVE_UNKNOWN = 0,
    GP_DRIVE_NOT_READY = 1,
    GP_DRIVE_SWITCH_ON_DISABLED = 2,
    GP_DRIVE_READY = 3,
    GP_DRIVE_SWITCHED_ON = 4,
    GP_DRIVE_OPERATION_ENABLED = 5,
    GP_DRIVE_QUICK_STOP = 6,
    GP_DRIVE_FAULT_REACTION = 7,
    GP_DRIVE_FAULT = 8
};

/* Properties of a frame. */
enum {
    GP_FLAG_FIRST = 0x1,
    GP_FLAG_LAST = 0x2,
    GP_FLAG_RAPID = 0x4,
    GP_FLAG_EXACT_STOP = 0x8,
    GP_FLAG_DWELL = 0x10,
    GP_FLAG_PROGRAM_STOP = 0x20,
    GP_FLAG_SYNC = 0x40,
    GP_FLAG_PER_REV = 0x80
};

/* Properties of a setpoint. */
enum {
    GP_MARK_LATE = 0x1,
    GP_MARK_AFTER_MISSED = 0x2
};

/* Which real-time grants the interpolator holds. */
enum {
    GP_GRANT_FIFO = 0x1,
    GP_GRANT_PINNED = 0x2,
    GP_GRANT_MEMORY_LOCKED = 0x4,
    GP_GRANT_PREFAULTED = 0x8,
    GP_GRANT_DMA_LATENCY = 0x10,
    GP_GRANT_BEST_EFFORT = 0x20
};

/* What the spindle does. */
enum {
    GP_SPINDLE_AT_SPEED = 0x1,
    GP_SPINDLE_STOPPED = 0x2,
    GP_SPINDLE_ORIENTED = 0x4,
    GP_SPINDLE_FAULT = 0x8,
    GP_SPINDLE_ANGLE = 0x10,
    GP_SPINDLE_INDEX = 0x20,
    GP_SPINDLE_SPEED = 0x40,
    GP_SPINDLE_LOAD = 0x80,
    GP_SPINDLE_IN_GEAR = 0x100
};

/* Why a servo stopped the joints by itself. */
enum {
    GP_STOPPED_NOT = 0,
    GP_STOPPED_SILENCE = 1,
    GP_STOPPED_ASKED = 2,
    GP_STOPPED_JUMP = 3
};

/* What of a jump is too much. */
enum {
    GP_JUMP_NONE = 0,
    GP_JUMP_VELOCITY = 1,
    GP_JUMP_ACCELERATION = 2
};

/* What a servo stack has lost. */
enum {
    GP_LOSS_NONE = 0,
    GP_LOSS_SETPOINTS = 1,
    GP_LOSS_DEVICE = 2,
    GP_LOSS_BUS = 3,
    GP_LOSS_SPINDLE = 4,
    GP_LOSS_GEAR = 5
};

/* How a latched position was found. */
enum {
    GP_LATCH_NONE = 0,
    GP_LATCH_DRIVE = 1,
    GP_LATCH_INTERPOLATED = 2,
    GP_LATCH_SAMPLED = 3,
    GP_LATCH_AWAITED = 4
};

/* How a jog moves the machine. */
enum {
    GP_JOG_MODE_NONE = 0,
    GP_JOG_MODE_CONTINUOUS = 1,
    GP_JOG_MODE_INCREMENTAL = 2,
    GP_JOG_MODE_WHEEL = 3,
    GP_JOG_MODE_WHEEL_VELOCITY = 4
};

/* What a piece of a stream is. */
enum {
    GP_SEGMENT_OPEN = 1,
    GP_SEGMENT_LINE = 2,
    GP_SEGMENT_ARC = 3,
    GP_SEGMENT_DWELL = 4,
    GP_SEGMENT_EVENT = 5,
    GP_SEGMENT_END = 6,
    GP_SEGMENT_CURVE = 7
};

/* How the path is followed at corners: G61.1, G61, G64, G64 P. */
enum {
    GP_PATH_EXACT_STOP = 1,
    GP_PATH_EXACT_PATH = 2,
    GP_PATH_CONTINUOUS = 3,
    GP_PATH_CONTINUOUS_WITHIN = 4
};

/* Planes of arcs: G17, G18, G19, G17.1, G18.1, G19.1. */
enum {
    GP_PLANE_XY = 1,
    GP_PLANE_ZX = 2,
    GP_PLANE_YZ = 3,
    GP_PLANE_UV = 4,
    GP_PLANE_WU = 5,
    GP_PLANE_VW = 6
};

/* Why a piece of a stream was refused. */
enum {
    GP_SEGMENT_REFUSAL_BUSY = 1,
    GP_SEGMENT_REFUSAL_NOT_OPEN = 2,
    GP_SEGMENT_REFUSAL_OUT_OF_ORDER = 3,
    GP_SEGMENT_REFUSAL_NO_CREDIT = 4,
    GP_SEGMENT_REFUSAL_MALFORMED = 5,
    GP_SEGMENT_REFUSAL_DISCONTINUOUS = 6,
    GP_SEGMENT_REFUSAL_SOFT_LIMIT = 7,
    GP_SEGMENT_REFUSAL_UNPLANNABLE = 8,
    GP_SEGMENT_REFUSAL_STOPPED = 9,
    GP_SEGMENT_REFUSAL_SHUTTING_DOWN = 10,
    GP_SEGMENT_REFUSAL_ABORTED = 11
};

/* Quantiles of a time, ns. */
typedef struct gp_quantiles {
    /* Median. */
    uint64_t p50_ns;
    /* 99 % are no longer. */
    uint64_t p99_ns;
    /* 99.9 % are no longer. */
    uint64_t p999_ns;
    /* The longest. */
    uint64_t max_ns;
} gp_quantiles;
GP_ASSERT(sizeof(gp_quantiles) == 32, "gp_quantiles has another size");
GP_FIELD(gp_quantiles, p50_ns, 0, 8);
GP_FIELD(gp_quantiles, p99_ns, 8, 8);
GP_FIELD(gp_quantiles, p999_ns, 16, 8);
GP_FIELD(gp_quantiles, max_ns, 24, 8);

/* Which event: no two have the same. */
typedef struct gp_event_id {
    /* The life of the interpolator that published it. */
    uint64_t boot_id;
    /* The epoch it happened in. */
    uint64_t epoch;
    /* The sequence of its frame. */
    uint64_t sequence;
} gp_event_id;
GP_ASSERT(sizeof(gp_event_id) == 24, "gp_event_id has another size");
GP_FIELD(gp_event_id, boot_id, 0, 8);
GP_FIELD(gp_event_id, epoch, 8, 8);
GP_FIELD(gp_event_id, sequence, 16, 8);

/* The words of an M code of the machine's own. */
typedef struct gp_code_words {
    /* P; zero where there is none. */
    double p;
    /* Q; zero where there is none. */
    double q;
    /* 1 with a P word, 2 with a Q word, 3 with both. */
    uint32_t given;
    /* Must be zero. */
    uint32_t reserved;
} gp_code_words;
GP_ASSERT(sizeof(gp_code_words) == 24, "gp_code_words has another size");
GP_FIELD(gp_code_words, p, 0, 8);
GP_FIELD(gp_code_words, q, 8, 8);
GP_FIELD(gp_code_words, given, 16, 4);
GP_FIELD(gp_code_words, reserved, 20, 4);

/* The positions at the last edge of an input. */
typedef struct gp_latch {
    /* Counts the edges from 0. */
    uint64_t count;
    /* When the last one was, ns of CLOCK_MONOTONIC. */
    uint64_t latch_ns;
    /* Joint positions then, as the drives count them, mm or degrees. */
    double position[9];
    /* Which input: a bit of digital_in by its index. */
    uint32_t input;
    /* 1 for a rising edge, 0 for a falling one. */
    uint32_t rising;
    /* A GP_LATCH_. */
    uint32_t kind;
    /* Must be zero. */
    uint32_t reserved;
} gp_latch;
GP_ASSERT(sizeof(gp_latch) == 104, "gp_latch has another size");
GP_FIELD(gp_latch, count, 0, 8);
GP_FIELD(gp_latch, latch_ns, 8, 8);
GP_FIELD(gp_latch, position, 16, 72);
GP_FIELD(gp_latch, input, 88, 4);
GP_FIELD(gp_latch, rising, 92, 4);
GP_FIELD(gp_latch, kind, 96, 4);
GP_FIELD(gp_latch, reserved, 100, 4);

/* An event in the period of a setpoint. */
typedef struct gp_event {
    /* Speed (rev/min), tool, M code, value of an output, way of a revolution (mm). */
    double value;
    /* When it happens: ns after scheduled_ns of its setpoint, up to a period. */
    uint32_t offset_ns;
    /* A GP_EVENT_. */
    uint32_t kind;
    /* Of an output: which; else 0. */
    uint32_t number;
    /* Of a tapped hole: index of the axis; else 0. */
    uint32_t axis;
    /* Of a tapped hole: depth in micrometres; else 0. */
    uint32_t depth_um;
    /* Of a pass of a thread: the angle it begins at, in 2^-24 of a revolution; else 0. */
    uint32_t phase;
} gp_event;
GP_ASSERT(sizeof(gp_event) == 32, "gp_event has another size");
GP_FIELD(gp_event, value, 0, 8);
GP_FIELD(gp_event, offset_ns, 8, 4);
GP_FIELD(gp_event, kind, 12, 4);
GP_FIELD(gp_event, number, 16, 4);
GP_FIELD(gp_event, axis, 20, 4);
GP_FIELD(gp_event, depth_um, 24, 4);
GP_FIELD(gp_event, phase, 28, 4);

/* What the drives are to do at apply_ns. The record glidepath.Setpoint.v6. */
typedef struct gp_setpoint {
    /* Identifies one life of the interpolator: all counts start again with a new one. */
    uint64_t boot_id;
    /* Counts how often the position was taken from the drives, or given a new meaning,
       instead of continuing the one before. Whoever plays setpoints begins anew at a new
       one, at rest, and never goes from the position before to the one after. */
    uint64_t reference;
    /* Counts the setpoints of this life from 0, without gaps. A gap seen by a subscriber is
       loss. */
    uint64_t number;
    /* Index on the interpolator's time grid. A gap where number has none is a missed tick. */
    uint64_t tick;
    /* When the tick was due, ns of CLOCK_MONOTONIC. */
    uint64_t scheduled_ns;
    /* When the setpoint is to be applied, ns of CLOCK_MONOTONIC: one period after
       scheduled_ns, so that the time of delivery does not matter. */
    uint64_t apply_ns;
    /* How late the tick began, ns. */
    uint64_t lateness_ns;
    /* Missed ticks of this life so far. */
    uint64_t missed_ticks;
    /* The trajectory, 0 before the first. */
    uint64_t epoch;
    /* Last frame at or before the present program time, which falls while the motion goes
       back. */
    uint64_t sequence;
    /* Program time past that frame, in periods, 0 <= f < 1. */
    double fraction;
    /* Source line, 0 before the first. */
    uint32_t line;
    /* Bits of GP_FLAG_ of the frame sequence. */
    uint32_t flags;
    /* Bits of GP_MARK_. */
    uint32_t marks;
    /* A GP_STATE_. */
    uint32_t state;
    /* How many of events are used. */
    uint32_t event_count;
    /* Block of the program being executed, 0 before the first. */
    uint32_t block;
    /* The joints whose drives are to have power, one bit each, J0 lowest. */
    uint32_t enable;
    /* The joints whose drives are to find their home by themselves, one bit each. Their
       positions here are those they report, and nothing to be followed: having found it,
       they stay there until their bit is 0. */
    uint32_t home;
    /* Path position since the start of the program, mm. */
    double path_s;
    /* Rate of path position as executed, mm/s; below 0 while the motion goes back. */
    double feed_v;
    /* Override as executed, 0 to 2: that of the plan times the rate of program time. */
    double effective_override;
    /* Axis positions, mm or degrees. */
    double position[9];
    /* Axis velocities, mm/s or degrees/s. */
    double velocity[9];
    /* Axis accelerations, mm/s^2 or degrees/s^2. */
    double acceleration[9];
    /* Joint positions as the drives count them, mm or degrees. */
    double joint_position[9];
    /* Joint velocities, mm/s or degrees/s. */
    double joint_velocity[9];
    /* Joint accelerations, mm/s^2 or degrees/s^2. */
    double joint_acceleration[9];
    /* How far the axes are from the path, mm or degrees, because they were jogged while the
       program was held: the positions above are those of the path and this together. */
    double away[9];
    /* What happens in the period from scheduled_ns to apply_ns, in order. */
    gp_event events[16];
    /* How far the axes are from position by a superposition, mm or degrees: the joints are
       where both together ask for. */
    double superposed[9];
    /* The joints whose drives are to keep where they are at the next index pulse of their
       encoder, one bit each. What was kept before counts no more while the bit is 0. */
    uint32_t index;
    /* Zero. */
    uint32_t reserved;
} gp_setpoint;
GP_ASSERT(sizeof(gp_setpoint) == 1240, "gp_setpoint has another size");
GP_FIELD(gp_setpoint, boot_id, 0, 8);
GP_FIELD(gp_setpoint, reference, 8, 8);
GP_FIELD(gp_setpoint, number, 16, 8);
GP_FIELD(gp_setpoint, tick, 24, 8);
GP_FIELD(gp_setpoint, scheduled_ns, 32, 8);
GP_FIELD(gp_setpoint, apply_ns, 40, 8);
GP_FIELD(gp_setpoint, lateness_ns, 48, 8);
GP_FIELD(gp_setpoint, missed_ticks, 56, 8);
GP_FIELD(gp_setpoint, epoch, 64, 8);
GP_FIELD(gp_setpoint, sequence, 72, 8);
GP_FIELD(gp_setpoint, fraction, 80, 8);
GP_FIELD(gp_setpoint, line, 88, 4);
GP_FIELD(gp_setpoint, flags, 92, 4);
GP_FIELD(gp_setpoint, marks, 96, 4);
GP_FIELD(gp_setpoint, state, 100, 4);
GP_FIELD(gp_setpoint, event_count, 104, 4);
GP_FIELD(gp_setpoint, block, 108, 4);
GP_FIELD(gp_setpoint, enable, 112, 4);
GP_FIELD(gp_setpoint, home, 116, 4);
GP_FIELD(gp_setpoint, path_s, 120, 8);
GP_FIELD(gp_setpoint, feed_v, 128, 8);
GP_FIELD(gp_setpoint, effective_override, 136, 8);
GP_FIELD(gp_setpoint, position, 144, 72);
GP_FIELD(gp_setpoint, velocity, 216, 72);
GP_FIELD(gp_setpoint, acceleration, 288, 72);
GP_FIELD(gp_setpoint, joint_position, 360, 72);
GP_FIELD(gp_setpoint, joint_velocity, 432, 72);
GP_FIELD(gp_setpoint, joint_acceleration, 504, 72);
GP_FIELD(gp_setpoint, away, 576, 72);
GP_FIELD(gp_setpoint, events, 648, 512);
GP_FIELD(gp_setpoint, superposed, 1160, 72);
GP_FIELD(gp_setpoint, index, 1232, 4);
GP_FIELD(gp_setpoint, reserved, 1236, 4);

/* What the interpolator does and how well. Counts are of this life of it. The record
   glidepath.Status.v16. */
typedef struct gp_status {
    /* Identifies one life of the interpolator. */
    uint64_t boot_id;
    /* When this was true, ns of CLOCK_MONOTONIC. A reader takes an old one for a dead
       interpolator. */
    uint64_t updated_ns;
    /* Interpolation period, ns. */
    uint64_t period_ns;
    /* Last tick on the time grid. */
    uint64_t tick;
    /* The present or last epoch, 0 before the first. */
    uint64_t epoch;
    /* Frames of the epoch accepted so far: the sequence of the next one expected. */
    uint64_t frames_received;
    /* Frames of the epoch whose instant has come: one more than the sequence executed last. */
    uint64_t frames_executed;
    /* Frames accepted but not yet reached. */
    uint32_t queue_depth;
    /* Most frames it can hold. */
    uint32_t queue_capacity;
    /* Its process. */
    uint32_t pid;
    /* A GP_STATE_. */
    uint32_t state;
    /* A GP_END_. */
    uint32_t end_of_epoch;
    /* The GP_FAULT_ that is latched. */
    uint32_t fault;
    /* Source line of the latched fault, 0 if it has none. */
    uint32_t fault_line;
    /* Axis of the latched fault, as its index plus one, 0 if it has none. */
    uint32_t fault_axis;
    /* Joint of the latched fault, as its index plus one, 0 if it has none. */
    uint32_t fault_joint;
    /* The drive's own number of its fault, 0 if there is none. */
    uint32_t drive_fault;
    /* Sequence of the frame the latched fault is about. */
    uint64_t fault_sequence;
    /* What was measured at the latched fault, in units of the limit it broke. */
    double fault_value;
    /* The limit that was broken. */
    double fault_limit;
    /* Source line being executed, 0 before the first. */
    uint32_t line;
    /* Bits of GP_GRANT_. */
    uint32_t grants;
    /* Block of the program being executed, 0 before the first. */
    uint32_t block;
    /* 1 if the machine rests at the end of every block, 0 if not. */
    uint32_t single_block;
    /* The program of the present or last epoch. */
    uint64_t program;
    /* Where the machine stood when that program began, mm or degrees. A planner that goes on
       with the program in a new epoch changes neither. */
    double program_start[9];
    /* Axis positions as last commanded, mm or degrees. */
    double position[9];
    /* How far the axes are from the path. */
    double away[9];
    /* A GP_POWER_. */
    uint32_t power;
    /* A GP_MODE_. */
    uint32_t mode;
    /* The joints that the machine has, one bit each, J0 lowest. */
    uint32_t joints;
    /* The joints whose drives say that they have power. */
    uint32_t enabled;
    /* The joints that know where they are. */
    uint32_t homed;
    /* The joints whose drives report a fault. */
    uint32_t drive_faults;
    /* That of the last setpoint. */
    uint64_t reference;
    /* How old the oldest feedback of a joint is, ns; 0 if none is configured, UINT64_MAX
       before the first. */
    uint64_t feedback_age_ns;
    /* Joint positions as the drives reported them last, in the machine's own count, mm or
       degrees. */
    double joint_actual[9];
    /* What was commanded of each joint for the moment of its last feedback, less what it
       reported, mm or degrees. */
    double following_error[9];
    /* The largest magnitude of that since power came on. */
    double following_peak[9];
    /* Sequence of the frame whose event is awaited; means something if the next field does. */
    uint64_t awaited_sequence;
    /* Since when it is awaited, ns of CLOCK_MONOTONIC; 0 if nothing is. */
    uint64_t awaited_since_ns;
    /* The event's number, as in a setpoint. */
    double awaited_value;
    /* The event's code, as in a setpoint; 0 if nothing is awaited. */
    uint32_t awaited_kind;
    /* Its source line. */
    uint32_t awaited_line;
    /* Its words, where it is an M code of the machine's own. */
    gp_code_words awaited_words;
    /* Where the axes really were when the probe found what it looked for in this epoch, mm
       or degrees. */
    double contact[9];
    /* A GP_CONTACT_. */
    uint32_t contact_kind;
    /* 1 if the last epoch was left before the event of its block was done: an M code that
       nobody answered, or a program stop that nobody let pass. 0 if not, and while one is
       open. */
    uint32_t unanswered;
    /* Path position, mm. */
    double path_s;
    /* Path position of the first setpoint of the block, mm. */
    double block_path_s;
    /* Rate of path position, mm/s. */
    double feed_v;
    /* Feed override as commanded; below 0 if the motion is to go back along the path. */
    double feed_override;
    /* Rapid override as commanded. */
    double rapid_override;
    /* Part of their speed that jogs have, as commanded, 0 to 1. */
    double jog_override;
    /* Override as executed. */
    double effective_override;
    /* What an input makes of both overrides, -1 to 1; below 0 it turns the motion round. 1
       where none slows programs down. */
    double adaptive_feed;
    /* Ticks run. */
    uint64_t ticks;
    /* Ticks that were not run because the one before took until after them. */
    uint64_t missed_ticks;
    /* Ticks that began late, within their period. */
    uint64_t late_ticks;
    /* Setpoints handed to the transport. */
    uint64_t setpoints_published;
    /* Setpoints lost inside the interpolator. */
    uint64_t setpoints_lost;
    /* Stops in reserve that were begun: for want of frames, or because no later stop was
       found. */
    uint64_t reserve_stops;
    /* Ticks in which a motion that had begun slowed or stood for want of frames. */
    uint64_t starved_ticks;
    /* Commands served. */
    uint64_t commands_served;
    /* Commands refused, among those served. */
    uint64_t commands_refused;
    /* Frames refused, by cause: GP_FAULT_FRAME_ in order. */
    uint64_t frames_refused[12];
    /* How late ticks began. */
    gp_quantiles lateness;
    /* How long the work of a tick took, before and at its deadline. */
    gp_quantiles work;
    /* How long the host took to wake the thread before a tick. */
    gp_quantiles latency;
    /* From the deadline of a tick to its setpoint published: whoever subscribes has it. */
    gp_quantiles response;
    /* The number of the job that a planner has told of last, 0 for none. */
    uint64_t job_number;
    /* The number that the next epoch has to have. An abort uses it up. */
    uint64_t next_epoch;
    /* A GP_JOB_. */
    uint32_t job_stage;
    /* 1 if the job begins held, 0 if not. */
    uint32_t job_held;
    /* The last error, for people. */
    char last_error[128];
    /* The last thing that happened (a change of state, missed ticks, ...), for people. */
    char last_event[128];
    /* What the program said last to people: MSG, DEBUG, the comment of a stop; empty before
       that. */
    char message[128];
    /* The job that a planner has told of last, and what is being done for it, for people. */
    char job[128];
    /* Why that job does not begin, for people; empty if it may. */
    char job_end[128];
    /* The client of the jog whose demand was followed last; 0 before the first. */
    uint64_t jog_client;
    /* The number of that demand. */
    uint64_t jog_number;
    /* Speed of the spindle as it was measured last, rev/s, negative if it turns backwards;
       means something if GP_SPINDLE_SPEED is set. */
    double spindle_v;
    /* Bits of GP_SPINDLE_. */
    uint32_t spindle_flags;
    /* A GP_SUPERPOSITION_. */
    uint32_t superposition;
    /* How far the axes are from position by a superposition, mm or degrees. */
    double superposed[9];
    /* A GP_FREEZE_REASON_: why the superposition is frozen. */
    uint32_t freeze_reason;
    /* 1 if the job that a planner has told of last is a stream of segments, 0 if not. */
    uint32_t job_stream;
    /* Spindle override as commanded. */
    double spindle_override;
    /* Load of the spindle as it was measured last: the magnitude of its torque as a part of
       its rated one; means something if GP_SPINDLE_LOAD is set. */
    double spindle_load;
} gp_status;
GP_ASSERT(sizeof(gp_status) == 1904, "gp_status has another size");
GP_FIELD(gp_status, boot_id, 0, 8);
GP_FIELD(gp_status, updated_ns, 8, 8);
GP_FIELD(gp_status, period_ns, 16, 8);
GP_FIELD(gp_status, tick, 24, 8);
GP_FIELD(gp_status, epoch, 32, 8);
GP_FIELD(gp_status, frames_received, 40, 8);
GP_FIELD(gp_status, frames_executed, 48, 8);
GP_FIELD(gp_status, queue_depth, 56, 4);
GP_FIELD(gp_status, queue_capacity, 60, 4);
GP_FIELD(gp_status, pid, 64, 4);
GP_FIELD(gp_status, state, 68, 4);
GP_FIELD(gp_status, end_of_epoch, 72, 4);
GP_FIELD(gp_status, fault, 76, 4);
GP_FIELD(gp_status, fault_line, 80, 4);
GP_FIELD(gp_status, fault_axis, 84, 4);
GP_FIELD(gp_status, fault_joint, 88, 4);
GP_FIELD(gp_status, drive_fault, 92, 4);
GP_FIELD(gp_status, fault_sequence, 96, 8);
GP_FIELD(gp_status, fault_value, 104, 8);
GP_FIELD(gp_status, fault_limit, 112, 8);
GP_FIELD(gp_status, line, 120, 4);
GP_FIELD(gp_status, grants, 124, 4);
GP_FIELD(gp_status, block, 128, 4);
GP_FIELD(gp_status, single_block, 132, 4);
GP_FIELD(gp_status, program, 136, 8);
GP_FIELD(gp_status, program_start, 144, 72);
GP_FIELD(gp_status, position, 216, 72);
GP_FIELD(gp_status, away, 288, 72);
GP_FIELD(gp_status, power, 360, 4);
GP_FIELD(gp_status, mode, 364, 4);
GP_FIELD(gp_status, joints, 368, 4);
GP_FIELD(gp_status, enabled, 372, 4);
GP_FIELD(gp_status, homed, 376, 4);
GP_FIELD(gp_status, drive_faults, 380, 4);
GP_FIELD(gp_status, reference, 384, 8);
GP_FIELD(gp_status, feedback_age_ns, 392, 8);
GP_FIELD(gp_status, joint_actual, 400, 72);
GP_FIELD(gp_status, following_error, 472, 72);
GP_FIELD(gp_status, following_peak, 544, 72);
GP_FIELD(gp_status, awaited_sequence, 616, 8);
GP_FIELD(gp_status, awaited_since_ns, 624, 8);
GP_FIELD(gp_status, awaited_value, 632, 8);
GP_FIELD(gp_status, awaited_kind, 640, 4);
GP_FIELD(gp_status, awaited_line, 644, 4);
GP_FIELD(gp_status, awaited_words, 648, 24);
GP_FIELD(gp_status, contact, 672, 72);
GP_FIELD(gp_status, contact_kind, 744, 4);
GP_FIELD(gp_status, unanswered, 748, 4);
GP_FIELD(gp_status, path_s, 752, 8);
GP_FIELD(gp_status, block_path_s, 760, 8);
GP_FIELD(gp_status, feed_v, 768, 8);
GP_FIELD(gp_status, feed_override, 776, 8);
GP_FIELD(gp_status, rapid_override, 784, 8);
GP_FIELD(gp_status, jog_override, 792, 8);
GP_FIELD(gp_status, effective_override, 800, 8);
GP_FIELD(gp_status, adaptive_feed, 808, 8);
GP_FIELD(gp_status, ticks, 816, 8);
GP_FIELD(gp_status, missed_ticks, 824, 8);
GP_FIELD(gp_status, late_ticks, 832, 8);
GP_FIELD(gp_status, setpoints_published, 840, 8);
GP_FIELD(gp_status, setpoints_lost, 848, 8);
GP_FIELD(gp_status, reserve_stops, 856, 8);
GP_FIELD(gp_status, starved_ticks, 864, 8);
GP_FIELD(gp_status, commands_served, 872, 8);
GP_FIELD(gp_status, commands_refused, 880, 8);
GP_FIELD(gp_status, frames_refused, 888, 96);
GP_FIELD(gp_status, lateness, 984, 32);
GP_FIELD(gp_status, work, 1016, 32);
GP_FIELD(gp_status, latency, 1048, 32);
GP_FIELD(gp_status, response, 1080, 32);
GP_FIELD(gp_status, job_number, 1112, 8);
GP_FIELD(gp_status, next_epoch, 1120, 8);
GP_FIELD(gp_status, job_stage, 1128, 4);
GP_FIELD(gp_status, job_held, 1132, 4);
GP_FIELD(gp_status, last_error, 1136, 128);
GP_FIELD(gp_status, last_event, 1264, 128);
GP_FIELD(gp_status, message, 1392, 128);
GP_FIELD(gp_status, job, 1520, 128);
GP_FIELD(gp_status, job_end, 1648, 128);
GP_FIELD(gp_status, jog_client, 1776, 8);
GP_FIELD(gp_status, jog_number, 1784, 8);
GP_FIELD(gp_status, spindle_v, 1792, 8);
GP_FIELD(gp_status, spindle_flags, 1800, 4);
GP_FIELD(gp_status, superposition, 1804, 4);
GP_FIELD(gp_status, superposed, 1808, 72);
GP_FIELD(gp_status, freeze_reason, 1880, 4);
GP_FIELD(gp_status, job_stream, 1884, 4);
GP_FIELD(gp_status, spindle_override, 1888, 8);
GP_FIELD(gp_status, spindle_load, 1896, 8);

/* What a servo stack knows of the joints it drives, at one moment. The record
   glidepath.Feedback.v5. */
typedef struct gp_feedback {
    /* Identifies one life of the stack: another stack, or the same started again, has
       another. */
    uint64_t boot_id;
    /* Counts the records of this life, without gaps. A gap seen by a reader is loss. */
    uint64_t number;
    /* When the positions were measured, ns of CLOCK_MONOTONIC. */
    uint64_t sample_ns;
    /* The reference of the setpoint that the stack plays; 0 before the first. */
    uint64_t reference;
    /* The number of that setpoint. */
    uint64_t setpoint_number;
    /* The joints that this is about, one bit each, J0 lowest. What is said below of others
       means nothing. */
    uint32_t joints;
    /* The joints that have power and follow setpoints. */
    uint32_t enabled;
    /* The joints that know where they are: absolute encoders, or those that found their
       home. */
    uint32_t homed;
    /* The joints that look for their home by themselves. */
    uint32_t homing;
    /* The joints whose drives report a fault. */
    uint32_t fault;
    /* The joints that stand at their lower limit switch. */
    uint32_t limit_low;
    /* The joints that stand at their upper limit switch. */
    uint32_t limit_high;
    /* The joints that stand at their home switch. */
    uint32_t home_switch;
    /* Joint positions as the drives count them, mm or degrees. */
    double position[9];
    /* Joint velocities, mm/s or degrees/s. */
    double velocity[9];
    /* A GP_DRIVE_ each. */
    uint32_t drive_state[9];
    /* The drives' own numbers of their faults, 0 for none. */
    uint32_t fault_code[9];
    /* Digital inputs, one bit each. */
    uint64_t digital_in;
    /* Analog inputs, in whatever unit they have. */
    double analog_in[8];
    /* Angle of the spindle since some start, in revolutions, never wrapped. */
    double spindle_angle;
    /* Speed of the spindle, rev/s, negative if it turns backwards. */
    double spindle_v;
    /* Index pulses of the spindle so far. */
    uint64_t spindle_index_count;
    /* Bits of GP_SPINDLE_. */
    uint32_t spindle_flags;
    /* A GP_LOSS_: what the stack has lost, for which it does not obey any more. What it
       stopped for that it tells until a fault of the interpolator is reset, or another
       interpolator is there. */
    uint32_t loss;
    /* Of setpoints, how long none came, s. Of a device, its place in the line from 0, or -1
       where none says that it is missing. Of a spindle the number of its fault, 0 without
       power. Of a gear its number, 0 where nobody said which one is to be in. 0 otherwise. */
    double loss_value;
    /* The inputs that are latched. */
    gp_latch latch[4];
    /* The joints whose drives are ready to keep where they are at the next index pulse, one
       bit each: of those in index of gp_setpoint alone, and not before they have forgotten
       what they kept. One that was ready and is not any more is not ready again before its
       bit there was 0. */
    uint32_t index_armed;
    /* Those of them that have kept it since. */
    uint32_t index_kept;
    /* Where these were at the index pulse, as the drives count, mm or degrees. */
    double index_position[9];
    /* Load of the spindle: the magnitude of its torque as a part of its rated one. */
    double spindle_load;
} gp_feedback;
GP_ASSERT(sizeof(gp_feedback) == 904, "gp_feedback has another size");
GP_FIELD(gp_feedback, boot_id, 0, 8);
GP_FIELD(gp_feedback, number, 8, 8);
GP_FIELD(gp_feedback, sample_ns, 16, 8);
GP_FIELD(gp_feedback, reference, 24, 8);
GP_FIELD(gp_feedback, setpoint_number, 32, 8);
GP_FIELD(gp_feedback, joints, 40, 4);
GP_FIELD(gp_feedback, enabled, 44, 4);
GP_FIELD(gp_feedback, homed, 48, 4);
GP_FIELD(gp_feedback, homing, 52, 4);
GP_FIELD(gp_feedback, fault, 56, 4);
GP_FIELD(gp_feedback, limit_low, 60, 4);
GP_FIELD(gp_feedback, limit_high, 64, 4);
GP_FIELD(gp_feedback, home_switch, 68, 4);
GP_FIELD(gp_feedback, position, 72, 72);
GP_FIELD(gp_feedback, velocity, 144, 72);
GP_FIELD(gp_feedback, drive_state, 216, 36);
GP_FIELD(gp_feedback, fault_code, 252, 36);
GP_FIELD(gp_feedback, digital_in, 288, 8);
GP_FIELD(gp_feedback, analog_in, 296, 64);
GP_FIELD(gp_feedback, spindle_angle, 360, 8);
GP_FIELD(gp_feedback, spindle_v, 368, 8);
GP_FIELD(gp_feedback, spindle_index_count, 376, 8);
GP_FIELD(gp_feedback, spindle_flags, 384, 4);
GP_FIELD(gp_feedback, loss, 388, 4);
GP_FIELD(gp_feedback, loss_value, 392, 8);
GP_FIELD(gp_feedback, latch, 400, 416);
GP_FIELD(gp_feedback, index_armed, 816, 4);
GP_FIELD(gp_feedback, index_kept, 820, 4);
GP_FIELD(gp_feedback, index_position, 824, 72);
GP_FIELD(gp_feedback, spindle_load, 896, 8);

/* The answer to a command. The record glidepath.CommandReply.v3. */
typedef struct gp_reply {
    /* The life of the interpolator that answers. */
    uint64_t boot_id;
    /* The number of the request. */
    uint64_t number;
    /* A GP_REFUSAL_, 0 if the command was accepted. */
    uint32_t refusal;
    /* The GP_STATE_ when the answer was given. */
    uint32_t state;
    /* More about a refusal, for people. */
    char message[128];
} gp_reply;
GP_ASSERT(sizeof(gp_reply) == 152, "gp_reply has another size");
GP_FIELD(gp_reply, boot_id, 0, 8);
GP_FIELD(gp_reply, number, 8, 8);
GP_FIELD(gp_reply, refusal, 16, 4);
GP_FIELD(gp_reply, state, 20, 4);
GP_FIELD(gp_reply, message, 24, 128);

/* How the axes, or the joints, are to be moved by hand. The latest counts; the first client
   owns the axes until they are at rest. The record glidepath.JogDemand.v2. */
typedef struct gp_jog {
    /* Who asks. Filled in. */
    uint64_t client;
    /* Counts what the client asks for. Filled in. */
    uint64_t number;
    /* When it was sent, ns of CLOCK_MONOTONIC. Filled in. */
    uint64_t sent_ns;
    /* When it was asked for, by gp_now_ns. What was asked for before the machine was stopped
       moves nothing. Filled in where it is 0. */
    uint64_t asked_ns;
    /* A GP_JOG_MODE_. */
    uint32_t mode;
    /* The axes, or joints, that are meant, one bit each, X or J0 lowest. */
    uint32_t mask;
    /* 1 if mask and value are about joints, 0 if about axes. */
    uint32_t by_joint;
    /* Must be zero. */
    uint32_t reserved;
    /* How fast at most, mm/s or degrees/s, in the modes that give no velocity; 0 for as fast
       as jogging may be. */
    double velocity_v;
    /* What a count of a wheel is, mm or degrees. */
    double scale;
    /* Velocities, mm/s or degrees/s (continuous); distances, mm or degrees (incremental); or
       counts of the wheel since it was switched on. */
    double value[9];
} gp_jog;
GP_ASSERT(sizeof(gp_jog) == 136, "gp_jog has another size");
GP_FIELD(gp_jog, client, 0, 8);
GP_FIELD(gp_jog, number, 8, 8);
GP_FIELD(gp_jog, sent_ns, 16, 8);
GP_FIELD(gp_jog, asked_ns, 24, 8);
GP_FIELD(gp_jog, mode, 32, 4);
GP_FIELD(gp_jog, mask, 36, 4);
GP_FIELD(gp_jog, by_joint, 40, 4);
GP_FIELD(gp_jog, reserved, 44, 4);
GP_FIELD(gp_jog, velocity_v, 48, 8);
GP_FIELD(gp_jog, scale, 56, 8);
GP_FIELD(gp_jog, value, 64, 72);

/* A piece of a stream. Fields that a kind does not use are zero. The record
   glidepath.SegmentRequest.v3. */
typedef struct gp_segment {
    /* The stream. Filled in. */
    uint64_t session;
    /* Counts the pieces of a stream. Filled in. */
    uint64_t number;
    /* Of GP_SEGMENT_OPEN: when the stream was asked for, by gp_now_ns. An abort after that,
       or the loss of power, ends the stream, also if its planner hangs until then. Filled in
       where it is 0. */
    uint64_t asked_ns;
    /* A GP_SEGMENT_. */
    uint32_t kind;
    /* Line of a program, from 1; 0 for GP_SEGMENT_OPEN and GP_SEGMENT_END. */
    uint32_t line;
    /* Of a line, arc or curve: 1 if it is a rapid move, else 0. */
    uint32_t rapid;
    /* Of a line, arc or curve: a GP_PATH_. */
    uint32_t mode;
    /* Of an arc: a GP_PLANE_. */
    uint32_t plane;
    /* Of an event: a GP_EVENT_ in the lowest byte; above it the number of an output, or a
       phase, or an axis in four bits and a depth in micrometres. */
    uint32_t event_kind;
    /* The event's number (speed, tool, M code). */
    double event_value;
    /* Of a line, arc or curve that is not rapid: feedrate, mm/s (degrees/s for rotary axes
       alone), > 0. */
    double feed_v;
    /* Path tolerance, mm, > 0, with GP_PATH_CONTINUOUS_WITHIN. */
    double tolerance_mm;
    /* Of a dwell: time, s, 0 or more. */
    double dwell_t;
    /* Of an arc: signed sweep, radians, not 0. */
    double sweep_rad;
    /* Of an arc: centre on the first and second axis of the plane, mm. */
    double center[2];
    /* Where it starts: the end of the piece before, bit for bit. */
    double start[9];
    /* Where it ends. */
    double end[9];
    /* Of a curve: first derivative of X, Y, Z by path position, at its start, then at its
       end. */
    double tangents[6];
    /* Of a curve: second derivative likewise, 1/mm. */
    double bends[6];
    /* Of a curve: its length, mm, > 0. */
    double length;
    /* Of a curve: how far it is from what it stands for, mm, 0 or more. */
    double error_mm;
} gp_segment;
GP_ASSERT(sizeof(gp_segment) == 360, "gp_segment has another size");
GP_FIELD(gp_segment, session, 0, 8);
GP_FIELD(gp_segment, number, 8, 8);
GP_FIELD(gp_segment, asked_ns, 16, 8);
GP_FIELD(gp_segment, kind, 24, 4);
GP_FIELD(gp_segment, line, 28, 4);
GP_FIELD(gp_segment, rapid, 32, 4);
GP_FIELD(gp_segment, mode, 36, 4);
GP_FIELD(gp_segment, plane, 40, 4);
GP_FIELD(gp_segment, event_kind, 44, 4);
GP_FIELD(gp_segment, event_value, 48, 8);
GP_FIELD(gp_segment, feed_v, 56, 8);
GP_FIELD(gp_segment, tolerance_mm, 64, 8);
GP_FIELD(gp_segment, dwell_t, 72, 8);
GP_FIELD(gp_segment, sweep_rad, 80, 8);
GP_FIELD(gp_segment, center, 88, 16);
GP_FIELD(gp_segment, start, 104, 72);
GP_FIELD(gp_segment, end, 176, 72);
GP_FIELD(gp_segment, tangents, 248, 48);
GP_FIELD(gp_segment, bends, 296, 48);
GP_FIELD(gp_segment, length, 344, 8);
GP_FIELD(gp_segment, error_mm, 352, 8);

/* The answer to a piece of a stream. The record glidepath.SegmentReply.v2. */
typedef struct gp_segment_reply {
    /* The stream. */
    uint64_t session;
    /* The number of the piece. */
    uint64_t number;
    /* Pieces of the stream accepted so far: the number of the next one expected. */
    uint64_t accepted;
    /* How many more would be accepted now. */
    uint32_t credit;
    /* A GP_SEGMENT_REFUSAL_, 0 if the piece was accepted. */
    uint32_t refusal;
    /* Where the next piece must start. */
    double position[9];
    /* More about a refusal, for people. */
    char message[1024];
} gp_segment_reply;
GP_ASSERT(sizeof(gp_segment_reply) == 1128, "gp_segment_reply has another size");
GP_FIELD(gp_segment_reply, session, 0, 8);
GP_FIELD(gp_segment_reply, number, 8, 8);
GP_FIELD(gp_segment_reply, accepted, 16, 8);
GP_FIELD(gp_segment_reply, credit, 24, 4);
GP_FIELD(gp_segment_reply, refusal, 28, 4);
GP_FIELD(gp_segment_reply, position, 32, 72);
GP_FIELD(gp_segment_reply, message, 104, 1024);

/* What a joint is to do. */
typedef struct gp_joint {
    /* mm or degrees */
    double position;
    /* mm/s or degrees/s */
    double velocity;
    /* mm/s^2 or degrees/s^2 */
    double acceleration;
} gp_joint;
GP_ASSERT(sizeof(gp_joint) == 24, "gp_joint has another size");
GP_FIELD(gp_joint, position, 0, 8);
GP_FIELD(gp_joint, velocity, 8, 8);
GP_FIELD(gp_joint, acceleration, 16, 8);

/* What a joint's own stop may use, both > 0. */
typedef struct gp_stop_limits {
    /* mm/s^2 or degrees/s^2 */
    double acceleration;
    /* mm/s^3 or degrees/s^3 */
    double jerk;
} gp_stop_limits;
GP_ASSERT(sizeof(gp_stop_limits) == 16, "gp_stop_limits has another size");
GP_FIELD(gp_stop_limits, acceleration, 0, 8);
GP_FIELD(gp_stop_limits, jerk, 8, 8);

/* Beyond this a setpoint is a jump and is not played; both > 0, INFINITY for no guard. Set
   them above the joint's limits: 1.2 times the velocity and twice the acceleration are good. */
typedef struct gp_jump_limits {
    /* mm/s or degrees/s */
    double velocity;
    /* mm/s^2 or degrees/s^2 */
    double acceleration;
} gp_jump_limits;
GP_ASSERT(sizeof(gp_jump_limits) == 16, "gp_jump_limits has another size");
GP_FIELD(gp_jump_limits, velocity, 0, 8);
GP_FIELD(gp_jump_limits, acceleration, 8, 8);

/* How a servo behaves when setpoints stay away, or jump. */
typedef struct gp_servo_settings {
    /* how long after the time of the last setpoint the joints go on at constant
       acceleration, ns */
    uint64_t patience_ns;
    /* what each joint's own stop may use */
    gp_stop_limits stop[9];
    /* what each joint is never asked for */
    gp_jump_limits jump[9];
} gp_servo_settings;
GP_ASSERT(sizeof(gp_servo_settings) == 296, "gp_servo_settings has another size");
GP_FIELD(gp_servo_settings, patience_ns, 0, 8);
GP_FIELD(gp_servo_settings, stop, 8, 144);
GP_FIELD(gp_servo_settings, jump, 152, 144);

/* A setpoint that was not played, because the way to it is beyond the limits. */
typedef struct gp_jump {
    /* the joint, from 0 */
    uint32_t joint;
    /* what is too much: GP_JUMP_NONE before the first jump */
    uint32_t of;
    /* where the joint would have come from, mm or degrees */
    double from_position;
    /* where it was to go, mm or degrees */
    double to_position;
    /* in what time, s */
    double span_t;
    /* how much it would have been, in units per s or s^2 */
    double asked;
    /* how much is allowed */
    double limit;
} gp_jump;
GP_ASSERT(sizeof(gp_jump) == 48, "gp_jump has another size");
GP_FIELD(gp_jump, joint, 0, 4);
GP_FIELD(gp_jump, of, 4, 4);
GP_FIELD(gp_jump, from_position, 8, 8);
GP_FIELD(gp_jump, to_position, 16, 8);
GP_FIELD(gp_jump, span_t, 24, 8);
GP_FIELD(gp_jump, asked, 32, 8);
GP_FIELD(gp_jump, limit, 40, 8);

/* What a servo does, and what arrived so far. */
typedef struct gp_servo_state {
    /* 1 if setpoints are played, or will be from the first that the servo can begin at */
    uint32_t armed;
    /* why the servo stopped the joints by itself, GP_STOPPED_NOT if it did not */
    uint32_t stopped;
    /* 1 if no setpoint comes any more, because the transport failed: gp_servo_close says why */
    uint32_t port_failed;
    /* zero */
    uint32_t reserved;
    /* means something if stopped is GP_STOPPED_JUMP */
    gp_jump jump;
    /* setpoints that arrived and were new */
    uint64_t received;
    /* setpoints that were published but did not arrive */
    uint64_t lost;
    /* gaps in the numbers, of any length */
    uint64_t gaps;
    /* setpoints that arrived again, or after a later one */
    uint64_t duplicates;
    /* setpoints that arrived after their time */
    uint64_t late;
    /* records that failed their check */
    uint64_t refused;
    /* ticks that the interpolator missed */
    uint64_t missed_ticks;
    /* times the interpolator was started anew */
    uint64_t restarts;
    /* times the position was taken anew from the drives */
    uint64_t references;
    /* own stops */
    uint64_t stops;
    /* setpoints that were not played because they jumped */
    uint64_t jumps;
} gp_servo_state;
GP_ASSERT(sizeof(gp_servo_state) == 152, "gp_servo_state has another size");
GP_FIELD(gp_servo_state, armed, 0, 4);
GP_FIELD(gp_servo_state, stopped, 4, 4);
GP_FIELD(gp_servo_state, port_failed, 8, 4);
GP_FIELD(gp_servo_state, reserved, 12, 4);
GP_FIELD(gp_servo_state, jump, 16, 48);
GP_FIELD(gp_servo_state, received, 64, 8);
GP_FIELD(gp_servo_state, lost, 72, 8);
GP_FIELD(gp_servo_state, gaps, 80, 8);
GP_FIELD(gp_servo_state, duplicates, 88, 8);
GP_FIELD(gp_servo_state, late, 96, 8);
GP_FIELD(gp_servo_state, refused, 104, 8);
GP_FIELD(gp_servo_state, missed_ticks, 112, 8);
GP_FIELD(gp_servo_state, restarts, 120, 8);
GP_FIELD(gp_servo_state, references, 128, 8);
GP_FIELD(gp_servo_state, stops, 136, 8);
GP_FIELD(gp_servo_state, jumps, 144, 8);
/* layout: end */

/* What the library was built as: to be compared with GP_ABI and GP_LAYOUT, which gp_open does. */
uint32_t gp_abi_version(void);
uint64_t gp_layout(void);

/* The version of Glidepath, as text. */
const char *gp_version(void);

/* Now, by CLOCK_MONOTONIC. */
uint64_t gp_now_ns(void);

/* The text of the last failure in this thread, cut to the room there is and ended with a zero.
 * Returns the length of all of it, without the zero; at most 512. NULL asks for the length alone. */
size_t gp_last_error(char *text, size_t size);

/* ---- what states and faults are called ----
 *
 * The texts that `glidepath status` shows, in UTF-8 and safe for a terminal: cut to the room there is, and ended
 * with a zero. Each returns the length of all of it, without the zero; NULL for text asks for the length alone.
 * Commands in them, such as `glidepath reset`, are to be given the instance. */

/* What the machine does in a GP_STATE_. GP_E_ARGUMENT: there is no such state. */
int gp_state_text(uint32_t state, char *text, size_t size);

/* The latched fault of a status in one clause, with its axis or joint, numbers and line; "" where there is none.
 * GP_E_RECORD: status is none of this version. */
int gp_fault_text(const gp_status *status, size_t status_size, char *text, size_t size);

/* What to do about it: what clears it comes last. "" where there is no fault. As gp_fault_text. */
int gp_fault_remedy(const gp_status *status, size_t status_size, char *text, size_t size);

/* ---- an instance ---- */

/* A thread's part in an instance. */
typedef struct gp_link gp_link;

/* Joins an instance, by the name that the interpolator has it by ("default" if it was given none).
 * It may be joined before the interpolator runs. The instance lies in the runtime directory of the
 * user, and is for processes of that user alone. To be called by way of gp_open. */
int gp_open_as(const char *instance, uint32_t abi, uint64_t layout, gp_link **link);

static inline int gp_open(const char *instance, gp_link **link) {
    return gp_open_as(instance, GP_ABI, GP_LAYOUT, link);
}

int gp_close(gp_link *link);

/* Waits for the first status that is shown after the call. 1: there is one; 0: none came within
 * patience_ms; GP_E_NO_SERVER: no interpolator runs. */
int gp_read_status(gp_link *link, gp_status *status, size_t size, uint32_t patience_ms);

/* Commands, and waits for the answer: kind is a GP_COMMAND_. value is a ratio for overrides, a
 * position for GP_COMMAND_SET_POSITION, 1 or 0 for GP_COMMAND_SINGLE_BLOCK, else 0. joints is the
 * index of a joint for GP_COMMAND_SET_POSITION, a set for GP_COMMAND_HOME and GP_COMMAND_UNHOME, else
 * 0. reply may be NULL. 1: accepted, and begun; 0: no answer within patience_ms, so it may yet be
 * done; GP_E_REFUSED: refused, see reply; GP_E_RECORD: an argument is out of range;
 * GP_E_NO_SERVER: no interpolator runs. It needs no shared memory: a machine can be held when there
 * is none left. */
int gp_command(gp_link *link, uint32_t kind, double value, uint32_t joints, uint32_t patience_ms,
               gp_reply *reply, size_t size);

/* Says that an event which the machine waits for was done, or has failed (done is 0). Else as
 * gp_command. */
int gp_acknowledge(gp_link *link, const gp_event_id *event, int done, uint32_t patience_ms,
                   gp_reply *reply, size_t size);

/* ---- setpoints as they come ---- */

/* A subscriber. One that is more than a thousand behind loses the oldest, which their numbers show;
 * nobody waits for it. */
typedef struct gp_setpoints gp_setpoints;

int gp_setpoints_open(gp_link *link, gp_setpoints **setpoints);

/* 1: the next one that has arrived; 0: there is no more yet; GP_E_RECORD: what arrived is not to
 * be used, and was left out. */
int gp_next(gp_setpoints *setpoints, gp_setpoint *setpoint, size_t size);

/* 1: the last one that has arrived; 0: none is new. skipped, which may be NULL, gets the number of
 * those that arrived before it. */
int gp_latest(gp_setpoints *setpoints, gp_setpoint *setpoint, size_t size, uint64_t *skipped);

int gp_setpoints_close(gp_setpoints *setpoints);

/* ---- what the drives say ---- */

/* A servo stack's way to the interpolator. */
typedef struct gp_feedback_sink gp_feedback_sink;

int gp_feedback_open(gp_link *link, gp_feedback_sink **sink);

/* Sends what the drives say; boot_id and number are filled in. Once a period or more often.
 * GP_E_RECORD: a field is not finite or out of range, and nothing was sent. */
int gp_feedback_send(gp_feedback_sink *sink, const gp_feedback *feedback, size_t size);

int gp_feedback_close(gp_feedback_sink *sink);

/* ---- moving by hand ---- */

/* A client that moves the machine by hand. */
typedef struct gp_jog_sink gp_jog_sink;

int gp_jog_open(gp_link *link, gp_jog_sink **sink);

/* Asks for something new: a velocity for as long as it is kept, steps of some length once, or what a
 * wheel counts; GP_JOG_MODE_NONE lets go. client, number and sent_ns are filled in. Whether it is
 * obeyed, gp_jog_is_followed tells; another client's jog comes first until it has come to rest. GP_E_RECORD: a field is not finite or out of range, and nothing was sent. */
int gp_jog_send(gp_jog_sink *sink, const gp_jog *jog, size_t size);

/* Whether what was asked for last moves the machine by this status, or was the last that did: 1 or 0. What a state
 * alone tells may be another client's jog. The step is done when this is 1 and the state is not jogging any more. */
int gp_jog_is_followed(gp_jog_sink *sink, const gp_status *status, size_t size);

/* Says that the client lives and wants what it wanted: every 50 ms or more often. The interpolator
 * stops a jog of which it hears nothing for 150 ms (dead_man_ms of its configuration). */
int gp_jog_keep(gp_jog_sink *sink);

/* Lets go, too. */
int gp_jog_close(gp_jog_sink *sink);

/* ---- segments ---- */

/* A stream of segments, for a planner that listens (glidepath planner --listen). */
typedef struct gp_segments gp_segments;

int gp_segments_open(gp_link *link, gp_segments **segments);

/* Sends one piece, in order: GP_SEGMENT_OPEN first, whose answer tells where the machine stands;
 * GP_SEGMENT_END last, behind which the machine comes to rest. session and number are filled in. reply
 * may be NULL. 1: accepted; 0: no answer within patience_ms: send the same once more, which waits on
 * and sends nothing twice; GP_E_REFUSED: refused, see reply, and nothing of it will be done. With
 * GP_SEGMENT_REFUSAL_NO_CREDIT wait a little and send the same again. GP_E_RECORD: a field is out of
 * range, and nothing was sent; GP_E_NO_SERVER: no planner listens. */
int gp_segments_send(gp_segments *segments, const gp_segment *segment, size_t size,
                     uint32_t patience_ms, gp_segment_reply *reply, size_t reply_size);

/* A stream that was not ended is given up: the machine comes to rest behind what was sent, or does not move if it has not
 * begun to. */
int gp_segments_close(gp_segments *segments);

/* ---- the servo ---- */

/* Plays setpoints by their time, and between them; goes on for a little while when they stay away,
 * and then brings the joints to rest by itself, and plays no more until it is rearmed. It does the
 * same for a setpoint that jumps, and when it is told to. A thread of its own takes the setpoints
 * from shared memory. */
typedef struct gp_servo gp_servo;

/* Three periods of 4 ms; 2000 mm/s^2 and 40 000 mm/s^3; no guard against jumps. */
int gp_servo_settings_default(gp_servo_settings *settings, size_t size);

int gp_servo_open(gp_link *link, const gp_servo_settings *settings, size_t size,
                  gp_servo **servo);

/* Takes one setpoint that has arrived: 1; 0: there is no more yet. setpoint may be NULL. To be
 * called until it gives 0, before every gp_servo_demand. */
int gp_servo_receive(gp_servo *servo, uint64_t now_ns, gp_setpoint *setpoint, size_t size);

/* What the joints are to do at a time, which is not before that of the last call: 1. 0: nothing,
 * the drives are to stay where they are: before the first setpoint, without power, after a rearming
 * until a setpoint is there to begin at. joints has room for GP_AXES; size is that of all. */
int gp_servo_demand(gp_servo *servo, uint64_t now_ns, gp_joint *joints, size_t size);

/* Brings the joints to rest within their own limits, and plays no setpoint until the servo is
 * rearmed or the position is taken anew from the drives: for a drive or a bus that fails. They
 * stop from the time of the last gp_servo_demand on; from now_ns where there was none. The
 * interpolator does not know of it: command GP_COMMAND_ABORT, or say it by feedback. */
int gp_servo_stop(gp_servo *servo, uint64_t now_ns);

/* Plays setpoints again, from the next on. For an operator who has made sure that the joints are
 * where the interpolator takes them to be. */
int gp_servo_rearm(gp_servo *servo);

/* Plays setpoints again once one is at rest with power on and tells every joint to stand within
 * window of actual, both GP_AXES numbers. The way to begin with drives whose positions are known.
 * INFINITY in window is for a joint that there is not. */
int gp_servo_rearm_at(gp_servo *servo, const double *actual, const double *window);

int gp_servo_read_state(gp_servo *servo, gp_servo_state *state, size_t size);

/* Gives the servo away: it belongs to the next thread that uses it. The way into a real-time thread,
 * and back for closing it. */
int gp_servo_release(gp_servo *servo);

/* Ends the servo's thread. Below 0, with the text, if setpoints stayed away because the transport
 * failed; it is closed then, too, unless the answer is GP_E_THREAD or GP_E_ARGUMENT. */
int gp_servo_close(gp_servo *servo);

#ifdef __cplusplus
}
#endif

#endif
