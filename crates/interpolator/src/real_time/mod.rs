//! The real-time thread: from frames, orders and observations to one setpoint a period.
//!
//! * `tick` is one period. It owns a `track` (the frames ahead), a `rate` (of program time: the essay on hold, resume and
//!   override is there, and the diagram of its states), a `queue_level` (are there frames enough?), `stop_requests` (what
//!   stops the motion), a `single_block_stop` (the end of a block to rest at), a `retrace` (the way back) and a `wait` (for
//!   the answer to an event).
//! * The rate is chosen by `ramp`s that are played through along the frames: `program_time` is how far they come, and
//!   `differences` and `limited_joints` are the limits that they keep.
//! * What follows no program: `jog` moves the axes by hand, and away from a path that is held and back to it,
//!   `joint_mover` joints each for itself; `spindle` is what a pass of a thread follows instead of the clock, and
//!   `superposition` what an axis does in addition to all of that.
//! * `output` is what a tick says: `setpoint` writes what is published, `joints` turns its axes into those of the mechanism,
//!   `compensated` says where their drives are to be, `events_told` which events it has; `resting_travel` is where the
//!   axes stand when a path is dropped.
//! * `drives` is their power, as it is seen here, and `tick_statistics` is how well the host kept time.
//!
//! It may know `shared`, and neither the ports thread nor who starts both. After the start nothing here allocates, locks,
//! writes a log or makes a system call.

pub(crate) mod block_end;
pub(crate) mod compensated;
pub(crate) mod counters;
pub(crate) mod differences;
pub(crate) mod drives;
pub(crate) mod events_told;
pub(crate) mod frame_summary;
pub(crate) mod jog;
pub(crate) mod joint_mover;
pub(crate) mod joints;
pub(crate) mod limited_joints;
pub(crate) mod output;
pub(crate) mod pairs;
pub(crate) mod probing;
pub(crate) mod program_time;
pub(crate) mod queue_level;
pub(crate) mod quintic;
pub(crate) mod ramp;
pub(crate) mod rate;
pub(crate) mod resting_travel;
pub(crate) mod retrace;
pub(crate) mod setpoint;
pub(crate) mod single_block_stop;
pub(crate) mod spindle;
pub(crate) mod stop_requests;
pub(crate) mod stop_time;
pub(crate) mod stops;
pub(crate) mod superposition;
pub(crate) mod tick;
pub(crate) mod tick_statistics;
pub(crate) mod track;
pub(crate) mod wait;
